// Messages for people.
// In: text and values; what a terminal cannot show in them is escaped. Out: standard error, if it
// can be written: work does not fail because a terminal was closed.
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <string_view>
#include <type_traits>

#include "core/text.hpp"

namespace piblocks::cli {

/// The value itself, or a text that a terminal can show.
template <typename Value>
decltype(auto) printable_value(const Value& value) {
  if constexpr (std::is_convertible_v<const Value&, std::string_view>) {
    return printable(value);
  } else {
    return (value);
  }
}

template <typename... Values>
void say(fmt::format_string<const Values&...> format, const Values&... values) noexcept {
  try {
    fmt::vprint(stderr, fmt::string_view(format),
                fmt::make_format_args(printable_value(values)...));
  } catch (const std::exception&) {
    return;
  }
}

}  // namespace piblocks::cli
