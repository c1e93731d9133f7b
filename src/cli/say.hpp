// Messages for people.
// In: text. Out: standard error, if it can be written: work does not fail because nobody can be
// told about it, on a terminal that was closed for example.
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <utility>

namespace piblocks::cli {

template <typename... Values>
void say(fmt::format_string<Values...> format, Values&&... values) noexcept {
  try {
    fmt::print(stderr, format, std::forward<Values>(values)...);
  } catch (const std::exception&) {
    return;
  }
}

}  // namespace piblocks::cli
