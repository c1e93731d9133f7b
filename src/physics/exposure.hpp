// Where the blocks are during an interval of time, and for how much of it.
// In: two instants, by expose() of the physics. Out: the share of the time that a block's position
// is below a value, exactly, over any number of collisions.
#pragma once

#include <cstddef>
#include <span>

namespace piblocks {

enum class BlockName { blue, red };

/// Positions of a block's centre, in the scene's units of length.
struct Travel {
  double from = 0;
  double to = 0;
};

/// A part of an interval in which both blocks move evenly.
struct UniformPiece {
  double share = 0;  ///< of the interval's time, 0 … 1
  Travel blue;
  Travel red;

  const Travel& of(BlockName block) const { return block == BlockName::blue ? blue : red; }
};

/// Most collisions in an interval whose pieces the closed form lists; more it sums up. Engines that
/// step list all they have.
inline constexpr std::size_t kMaxListedCollisions = 512;

/// An interval of time, however short: in one of no length the blocks are where they are then.
/// Valid after its log is gone; const members are thread-safe.
class Exposure {
 public:
  virtual ~Exposure() = default;
  Exposure() = default;
  Exposure(const Exposure&) = delete;
  Exposure& operator=(const Exposure&) = delete;

  /// All positions of the interval are within.
  virtual Travel range(BlockName block) const = 0;
  /// F: the share of the time in which the block's centre is at or below `position`. 0 below the
  /// range, 1 at its top and beyond, and never falling by more than a rounding. Right to 1e-11 for
  /// a position within a rounding of the one given (src/physics/README.md).
  virtual double share_below(BlockName block, double position) const = 0;
  /// G: the integral of F from below up to `position`, in units of length. Averaged over [a, b], F
  /// is (G(b) - G(a)) / (b - a).
  virtual double area_below(BlockName block, double position) const = 0;
  /// Whether pieces() are the whole truth.
  virtual bool is_listed() const = 0;
  /// Both blocks together, in the order of time; shares add up to 1. If !is_listed(), those in the
  /// middle are fewer and slower bounces between the same places, for who needs to know how near to
  /// each other the blocks are: blue spends its time in each of them as in the many that they stand
  /// for, to the first order in the time that a bounce takes.
  virtual std::span<const UniformPiece> pieces() const = 0;
};

}  // namespace piblocks
