#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/instant.hpp>

#include <algorithm>
#include <cmath>

namespace piblocks {
namespace {

constexpr const char* kExpected = "must be a time, 'last', or '#K' for the K-th collision";

bool is_digits(std::string_view text) {
  constexpr std::size_t kMaxLength = 1000;
  return !text.empty() && text.size() <= kMaxLength &&
         std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

Rational parse_time(std::string_view text) {
  Rational time;
  try {
    time = parse_rational(text);
  } catch (const UsageError& error) {
    throw UsageError(fmt::format("{}; {}", error.what(), kExpected));
  }
  if (std::isfinite(to_double(time))) return time;
  throw UsageError("is beyond the range of a double (about 1.8e308)");
}

TimedState at_collision(const CollisionLog& log, const Integer& index) {
  const BlockState state = state_after(log, index);
  return {log.at(index).time, state};
}

}  // namespace

Instant parse_instant(std::string_view text) {
  if (text == "last") return LastCollision{};
  if (!text.starts_with('#')) return parse_time(text);
  if (!is_digits(text.substr(1))) throw UsageError(kExpected);
  return NthCollision{Integer(std::string(text.substr(1)), 10)};
}

TimedState state_at(const CollisionLog& log, const Instant& instant) {
  if (const auto* time = std::get_if<Rational>(&instant)) {
    return {to_time(*time), state_at(log, *time)};
  }
  if (const auto* collision = std::get_if<NthCollision>(&instant)) {
    return at_collision(log, collision->index);
  }
  if (log.size() == 0) throw UsageError("last: the scene has no collisions");
  return at_collision(log, log.size());
}

}  // namespace piblocks
