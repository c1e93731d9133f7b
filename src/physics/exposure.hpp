// Where the blocks are during an interval of time, and for how much of it, for motion blur.
// In: a collision log and two times. Out: an Exposure, exact over any number of collisions.
#pragma once

#include <piblocks/log.hpp>
#include <piblocks/two_blocks.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

namespace piblocks {

enum class BlockName { blue, red };

/// Positions of a block's centre, in the scene's units of length.
struct Travel {
  double from = 0;
  double to = 0;

  void include(const Travel& piece);
  /// For even motion: the integral, up to `position`, of the share of its time that the block is
  /// below a position.
  double area_below(double position) const {
    const double low = std::min(from, to);
    const double high = std::max(from, to);
    if (position >= high) return (position - low) / 2 + (position - high) / 2;
    if (position <= low) return 0;
    return (position - low) * ((position - low) / (high - low)) / 2;
  }
};

/// A part of an interval in which both blocks move evenly.
struct UniformPiece {
  double share = 0;  ///< of the interval's time, 0 … 1
  Travel blue;
  Travel red;

  const Travel& of(BlockName block) const { return block == BlockName::blue ? blue : red; }
};

/// The closed form sums up an interval with more collisions instead of listing its pieces. The
/// exact event list never has so many.
inline constexpr std::size_t kMaxListedCollisions = 512;

/// An interval of time. In one of no length the blocks are where they are at that instant.
struct PairExposure {
  /// Both blocks together, in the order of time; shares add up to 1. If area_below is given, a few
  /// slow bounces between the same places stand in for many fast ones. Use these only for the
  /// distance between the blocks; they are true to the first order in the time of a bounce.
  std::vector<UniformPiece> pieces = {};
  Travel blue_range = {};  ///< of all positions
  Travel red_range = {};
  /// If the pieces are not the whole truth: G, the integral, up to a position, of the share of the
  /// time that the block is below a position, in units of length. Thread-safe.
  std::function<double(BlockName block, double position)> area_below = {};

  const Travel& range(BlockName block) const {
    return block == BlockName::blue ? blue_range : red_range;
  }
};

/// The part of a body's motion from one collision to the next.
struct BodyPiece {
  double begin = 0;  ///< share of the interval's time that has passed, 0 … 1
  double end = 0;
  std::array<double, 2> from = {};
  std::array<double, 2> to = {};
};

/// Two bodies that move as the blocks of a PairExposure do, beside others that stay.
struct ClosedExposure {
  PairExposure blocks;
  std::size_t blue = 0;  ///< the body that moves as blue does
  std::size_t red = 0;
  int sign =
      1;  ///< -1 if the bodies are mirrored: their positions are those of the blocks times -1

  bool has(std::size_t body) const { return body == blue || body == red; }
};

/// Any bodies in an interval of time.
struct Exposure {
  /// Of each body, in the order of time; none if the motion is a closed form.
  std::vector<std::vector<BodyPiece>> pieces = {};
  std::optional<ClosedExposure> closed = {};
};

/// The interval between two times, in either order, none of them negative unless the past is known.
/// Every collision is listed, but for those that the closed form of elastic blocks sums up; of two
/// lossy blocks beside something immovable, twice kMaxListedCollisions at most, and else as many
/// times between. Valid after its log is gone.
/// @throws as Log::state_at().
Exposure expose(const Log& log, const Rational& begin, const Rational& end);

/// Collects pieces from instant to instant.
class PieceList {
 public:
  PieceList(double blue, double red) : blue_(blue), red_(red) {}
  /// `duration` later the blocks are there, and have moved evenly.
  void add(double duration, double blue, double red);
  /// Durations as shares of `total`.
  std::vector<UniformPiece> take(double total);
  /// Of at least one piece.
  PairExposure exposure();

 private:
  double blue_;
  double red_;
  std::vector<UniformPiece> pieces_;  // with durations as shares
};

}  // namespace piblocks
