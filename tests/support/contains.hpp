// Whether a text has a part; a failure shows both.
#pragma once

#include <gtest/gtest.h>

#include <string_view>

namespace piblocks::testing_support {

inline testing::AssertionResult contains(std::string_view text, std::string_view part) {
  constexpr std::size_t kMostShown_bytes = 4000;
  const bool is_there = text.find(part) != std::string_view::npos;
  return (is_there ? testing::AssertionSuccess() : testing::AssertionFailure())
         << '\'' << part << (is_there ? "' is in '" : "' is not in '")
         << text.substr(0, kMostShown_bytes) << '\'';
}

}  // namespace piblocks::testing_support
