#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/instant.hpp>
#include <piblocks/two_blocks.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/nearest_name.hpp"
#include "core/text.hpp"
#include "scene/run_log.hpp"

namespace piblocks {
namespace {

using Anchor = Instant::Anchor;

constexpr const char* kExpected =
    "must be a time, 'turn', 'last', or '#K' for collision K; an offset may follow the last three, "
    "as in turn-0.3";

/// The longest index that is accepted.
constexpr std::size_t kMaxIndex_bytes = 1000;

constexpr std::array<std::pair<std::string_view, Anchor>, 2> kNamedAnchors = {
    {{"turn", Anchor::turn}, {"last", Anchor::last}}};

/// Removes the anchor from the front of the text. A time has none: its text stays as it is.
Instant take_anchor(std::string_view& text) {
  for (const auto& [name, anchor] : kNamedAnchors) {
    if (!text.starts_with(name)) continue;
    text.remove_prefix(name.size());
    return anchor == Anchor::turn ? Instant::turn() : Instant::last();
  }
  if (!text.starts_with('#')) return {};
  text.remove_prefix(1);
  const std::size_t sign = text.starts_with('-') ? 1 : 0;
  const std::size_t length = std::min(text.find_first_not_of("0123456789", sign), text.size());
  if (length == sign || length > kMaxIndex_bytes) throw UsageError(kExpected);
  Instant instant = Instant::collision(Integer(std::string(text.substr(0, length)), 10));
  text.remove_prefix(length);
  return instant;
}

Rational parse_number(std::string_view text) {
  try {
    return parse_rational(text);
  } catch (const UsageError& error) {
    throw UsageError(
        fmt::format("{}; {}{}", error.what(), kExpected, did_you_mean(text, {"turn", "last"})));
  }
}

/// The offset behind an anchor: nothing, or a sign and an unsigned number.
Rational parse_offset(std::string_view text) {
  if (text.empty()) return 0;
  const bool is_signed = text.front() == '+' || text.front() == '-';
  if (!is_signed || text.find_first_of("0123456789.", 1) != 1) throw UsageError(kExpected);
  return parse_number(text.front() == '+' ? text.substr(1) : text);
}

/// The index of the collision that the anchor names. Nothing if it names none, or the run has no
/// such collision.
std::optional<Integer> anchoring_collision(const Instant& instant, const Log& log) {
  if (instant.anchor == Anchor::last) {
    const Integer last = log.last();
    return last > 0 ? std::optional(last) : std::nullopt;
  }
  if (instant.anchor == Anchor::collision && log.is_listed(instant.index)) return instant.index;
  return std::nullopt;
}

[[noreturn]] void fail_missing(const Instant& instant, const Log& log) {
  if (instant.anchor == Anchor::turn) {
    throw UsageError(
        "'turn': there is no turn; only two blocks beside a wall have one, if they move; give a "
        "time");
  }
  if (instant.anchor == Anchor::last) {
    throw UsageError("'last': no collision happens from time 0 on; give a time");
  }
  throw UsageError(fmt::format("collision #{}: the scene has {}", instant.index.get_str(),
                               listed_collisions(log, "#")));
}

}  // namespace

Instant parse_instant(std::string_view text) {
  text = trimmed(text);
  Instant instant = take_anchor(text);
  instant.offset = instant.is_time() ? parse_number(text) : parse_offset(text);
  if (std::isfinite(to_double(instant.offset))) return instant;
  throw UsageError("is beyond the range of a double (about 1.8e308)");
}

std::string exact_text(const Instant& instant) {
  std::string offset = instant.offset.get_str();
  if (instant.is_time()) return offset;
  std::string text = fmt::format("#{}", instant.index.get_str());
  for (const auto& [name, anchor] : kNamedAnchors) {
    if (anchor == instant.anchor) text = name;
  }
  if (instant.offset == 0) return text;
  return text + (instant.offset > 0 ? "+" : "") + offset;
}

bool exists(const Instant& instant, const Log& log) {
  if (instant.is_time()) return true;
  if (instant.anchor == Anchor::turn) return turn_of(log).has_value();
  if (instant.anchor == Anchor::last && !log.has_last()) return false;
  try {
    return anchoring_collision(instant, log).has_value();
  } catch (const SimulationError&) {  // too many collisions until then
    return false;
  }
}

Rational time_of(const Instant& instant, const Log& log) {
  if (instant.is_time()) return instant.offset;
  if (instant.anchor == Anchor::turn) {
    const std::optional<Rational> turn = turn_of(log);
    if (!turn) fail_missing(instant, log);
    return *turn + instant.offset;
  }
  const std::optional<Integer> index = anchoring_collision(instant, log);
  if (!index) fail_missing(instant, log);
  return log.time_after(*index) + instant.offset;
}

}  // namespace piblocks
