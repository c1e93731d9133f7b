#include "core/whole_number.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

namespace piblocks {

std::optional<Integer> whole_number(std::string_view text) {
  try {
    const Rational value = parse_rational(text);
    if (value.get_den() == 1) return value.get_num();
  } catch (const UsageError&) {  // the caller says better what is wanted
  }
  return std::nullopt;
}

Integer parse_whole_number(std::string_view text, const Integer& low,
                           const std::optional<Integer>& high) {
  const std::optional<Integer> value = whole_number(text);
  if (value && *value >= low && (!high || *value <= *high)) return *value;
  const std::string upper = high ? "to " + high->get_str() : "on";
  throw UsageError(fmt::format("must be a whole number from {} {}", low.get_str(), upper));
}

int parse_int(std::string_view text, int low, int high) {
  return static_cast<int>(parse_whole_number(text, low, Integer(high)).get_si());
}

}  // namespace piblocks
