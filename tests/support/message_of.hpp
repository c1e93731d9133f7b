// What an action says of its failure.
#pragma once

#include <string>

namespace piblocks::testing_support {

/// Empty if it succeeds; an exception of another type is passed on.
template <typename Error, typename Action>
std::string message_of(const Action& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

}  // namespace piblocks::testing_support
