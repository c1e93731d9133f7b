// What stands in place of {} in text for people.
// In: a value. Out: the value; of text, what a terminal can be shown.
#pragma once

#include <string_view>
#include <type_traits>

#include "core/printable.hpp"

namespace piblocks::cli {

template <typename Value>
decltype(auto) printable_value(const Value& value) {
  if constexpr (std::is_convertible_v<const Value&, std::string_view>) {
    return printable(value);
  } else {
    return (value);
  }
}

}  // namespace piblocks::cli
