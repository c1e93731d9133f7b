// Options that take a value, kept as text until a command reads it.
// In: the text of an option. Out: its value, or a UsageError that names the option and the text.
#pragma once

#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/exact.hpp>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/command.hpp"

namespace piblocks::cli {

/// The option's value as `parse` makes it of the text; nothing if it was not given.
template <typename Parse>
auto value_of(const Option& option, const Parse& parse)
    -> std::optional<decltype(parse(std::string()))> {
  const std::optional<std::string> text = option.text();
  if (!text) return std::nullopt;
  try {
    return parse(*text);
  } catch (const UsageError& error) {
    throw UsageError(fmt::format("{} {}: {}", option.name(), *text, error.what()));
  }
}

/// @throws UsageError unless the text is a whole number >= low and, if there is a high, <= high.
Integer parse_whole_number(const std::string& text, const Integer& low,
                           const std::optional<Integer>& high = std::nullopt);

/// The value whose name the text is.
/// @throws UsageError with all the names otherwise.
template <typename Value>
Value parse_choice(const std::string& text,
                   const std::vector<std::pair<std::string, Value>>& choices) {
  std::string names;
  for (const auto& [name, value] : choices) {
    if (text == name) return value;
    if (!names.empty()) names += " or ";
    names += name;
  }
  throw UsageError("must be " + names);
}

}  // namespace piblocks::cli
