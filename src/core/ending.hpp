// File extensions.
// In: a name, and an ending such as ".png". Out: whether the name has it, in small letters or in
// capitals, as other systems write it.
#pragma once

#include <algorithm>
#include <string_view>

namespace piblocks {

/// @param ending  in small letters.
constexpr bool has_ending(std::string_view name, std::string_view ending) {
  if (name.size() < ending.size()) return false;
  const auto is_same = [](char letter, char small) {
    return letter == small || (letter >= 'A' && letter <= 'Z' && letter - 'A' + 'a' == small);
  };
  return std::ranges::equal(name.substr(name.size() - ending.size()), ending, is_same);
}

}  // namespace piblocks
