#include "cli/options.hpp"

namespace piblocks::cli {
namespace {

/// Nothing if the text is no whole number.
std::optional<Integer> whole_number(const std::string& text) {
  try {
    const Rational value = parse_rational(text);
    if (value.get_den() == 1) return value.get_num();
  } catch (const UsageError&) {  // the caller says better what is wanted
  }
  return std::nullopt;
}

}  // namespace

Integer parse_whole_number(const std::string& text, const Integer& low,
                           const std::optional<Integer>& high) {
  const std::optional<Integer> value = whole_number(text);
  if (value && *value >= low && (!high || *value <= *high)) return *value;
  const std::string upper = high ? "to " + high->get_str() : "on";
  throw UsageError(fmt::format("must be a whole number from {} {}", low.get_str(), upper));
}

}  // namespace piblocks::cli
