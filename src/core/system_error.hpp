// What the operating system says of an error.
// In: its number, as in errno. Out: a text for messages.
#pragma once

#include <string>
#include <system_error>

namespace piblocks {

/// "No such file or directory"
inline std::string text_of_error(int error_number) {
  return std::generic_category().message(error_number);
}

}  // namespace piblocks
