// One instant of a run, named by a time or by what happens then.
// In: text such as "3.5", "turn-0.3", "last+1" or "#314+1/1000". Out: the exact time it stands for.
#pragma once

#include <piblocks/exact.hpp>

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

namespace piblocks {

class Log;

/// An anchor, and an offset in simulation time.
struct Instant {
  enum class Anchor : std::uint8_t {
    time_zero,
    turn,      ///< when the blocks are nearest to the corner; collisions are densest then
    last,      ///< the last collision, if one happens from time 0 on
    collision  ///< the collision with the index that the instant gives
  };
  Anchor anchor = Anchor::time_zero;
  Integer index = 0;    ///< of Anchor::collision, as Log counts
  Rational offset = 0;  ///< positive after the anchor, negative before it

  Instant() = default;
  Instant(Rational time) : offset(std::move(time)) {}
  static Instant turn(Rational offset = 0) { return {Anchor::turn, 0, std::move(offset)}; }
  static Instant last(Rational offset = 0) { return {Anchor::last, 0, std::move(offset)}; }
  static Instant collision(Integer index, Rational offset = 0) {
    return {Anchor::collision, std::move(index), std::move(offset)};
  }

  bool is_time() const noexcept { return anchor == Anchor::time_zero; }
  friend bool operator==(const Instant&, const Instant&) = default;

 private:
  Instant(Anchor at, Integer number, Rational after)
      : anchor(at), index(std::move(number)), offset(std::move(after)) {}
};

/// Reads a time, or "turn", "last" or "#K", alone or with an offset: "last+1.5", "#314-1/1000".
/// @throws UsageError if the text is not an instant, or its time or offset is beyond the range of a
///         double.
Instant parse_instant(std::string_view text);

/// Exact text, which reads back as the same.
std::string exact_text(const Instant& instant);
/// Whether the run has the anchor of this instant.
bool exists(const Instant& instant, const Log& log);

/// The time that the instant stands for. That of a collision is Log::time_after(): it has
/// happened then, and the next one has not.
/// @throws UsageError if the run has no such turn or collision, or as time_after(); SimulationError
///         as time_after().
Rational time_of(const Instant& instant, const Log& log);

}  // namespace piblocks
