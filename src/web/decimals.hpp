// Exact numbers as people write them.
// In: fractions. Out: decimals where that is exact.
#pragma once

#include <piblocks/exact.hpp>

#include <string>
#include <string_view>

namespace piblocks::web {

/// "2.5" for 5/2; a fraction that is no decimal of at most 20 places stays one.
std::string decimal_text(const Rational& value);

/// The same for every fraction in a text: "turn-0.3" for "turn-3/10".
std::string with_decimals(std::string_view text);

}  // namespace piblocks::web
