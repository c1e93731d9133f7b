#include <piblocks/error.hpp>
#include <piblocks/scene.hpp>

#include <array>
#include <string>

namespace piblocks {
namespace {

/// Parts between colons. @throws UsageError unless there are as many as expected.
template <std::size_t N>
std::array<std::string_view, N> split(std::string_view text, const char* expected) {
  std::array<std::string_view, N> parts;
  for (std::size_t i = 0; i < N; ++i) {
    const std::size_t colon = text.find(':');
    if ((colon == std::string_view::npos) != (i + 1 == N)) {
      throw UsageError(std::string("must be ") + expected);
    }
    parts[i] = text.substr(0, colon);
    text.remove_prefix(i + 1 == N ? text.size() : colon + 1);
  }
  return parts;
}

}  // namespace

SlowMotion parse_slow_motion(std::string_view text) {
  const auto parts = split<3>(text, "FROM:TO:FACTOR, as turn-0.3:turn+0.3:10");
  return {parse_instant(parts[0]), parse_instant(parts[1]), parse_rational(parts[2])};
}

Freeze parse_freeze(std::string_view text) {
  const auto parts = split<2>(text, "AT:SECONDS, as turn:2");
  return {parse_instant(parts[0]), parse_rational(parts[1])};
}

std::string exact_text(const SlowMotion& window) {
  return exact_text(window.from) + ':' + exact_text(window.to) + ':' + window.factor.get_str();
}

std::string exact_text(const Freeze& freeze) {
  return exact_text(freeze.at) + ':' + freeze.length_s.get_str();
}

}  // namespace piblocks
