// Options that take a value, kept as text until a command reads it.
// In: the text of an option. Out: its value, or a UsageError that names the option and the text.
#pragma once

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/exact.hpp>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace piblocks::cli {

/// Adds an option with one value. CLI11 only collects the text: what it says of text that it
/// cannot convert is not for users.
/// @param placeholder  what stands for the value in the help, as in "--size WxH".
CLI::Option& add_value_option(CLI::App& command, const std::string& name,
                              const std::string& placeholder, const std::string& help);

/// The option's text; nothing if it was not given.
std::optional<std::string> text_of(const CLI::Option& option);

/// The option's value as `parse` makes it of the text; nothing if it was not given.
template <typename Parse>
auto value_of(const CLI::Option& option, const Parse& parse)
    -> std::optional<decltype(parse(std::string()))> {
  const std::optional<std::string> text = text_of(option);
  if (!text) return std::nullopt;
  try {
    return parse(*text);
  } catch (const UsageError& error) {
    throw UsageError(fmt::format("{} {}: {}", option.get_name(), *text, error.what()));
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
