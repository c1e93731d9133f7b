// Messages for people.
// In: text; what stands in place of {} is made printable. Out: standard error, if it can be
// written: work does not fail because nobody can be told about it, on a terminal that was closed
// for example.
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <exception>

#include "cli/printable_value.hpp"

namespace piblocks::cli {

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
