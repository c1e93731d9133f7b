// Exact numbers in messages.
// In: a Rational among the arguments of fmt::format(). Out: the text that to_text() makes of it.
#pragma once

#include <fmt/format.h>
#include <piblocks/exact.hpp>

template <>
struct fmt::formatter<piblocks::Rational> : fmt::formatter<std::string> {
  template <typename Context>
  auto format(const piblocks::Rational& value, Context& context) const {
    return fmt::formatter<std::string>::format(piblocks::to_text(value), context);
  }
};
