// Whole numbers as people write them.
// In: text. Out: a number within limits, or a UsageError that says what is expected.
#pragma once

#include <piblocks/exact.hpp>

#include <optional>
#include <string_view>

namespace piblocks {

/// A whole number that parse_rational() can read: 16, +16, 1e3, 2^10. Nothing for any other text.
std::optional<Integer> whole_number(std::string_view text);

/// @throws UsageError unless the text is a whole number >= low and, if there is a high, <= high.
Integer parse_whole_number(std::string_view text, const Integer& low,
                           const std::optional<Integer>& high = std::nullopt);

/// The same for a number that fits into an int.
int parse_int(std::string_view text, int low, int high);

}  // namespace piblocks
