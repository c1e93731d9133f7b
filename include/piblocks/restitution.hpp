// Blocks that lose energy where they collide: runs without end, and how much loss pi can take.
// In: a TwoBlocks with restitutions, or a number of digits. Out: exact answers.
#pragma once

#include <piblocks/exact.hpp>
#include <piblocks/run.hpp>

#include <optional>

namespace piblocks {

/// A run of infinitely many collisions. In the end the blocks have lost all their energy: they rest
/// at the wall and touch each other. No such run ends in another way.
struct Collapse {
  /// When that is, as the nearest two doubles; nothing if the collisions, each later than the one
  /// before by more, never end.
  std::optional<Time> time;
  /// Collisions in the log, Log::last(). The blocks rest from the last of them on. Each
  /// collision that is not in it begins with less than 2^-200 of the energy, or less than 2^-100 of
  /// the time between the first collision and `time` remains.
  Integer listed;
};

/// The collapse of a system that has one; nothing if its collisions are finitely many.
/// @throws SceneError if problems_of(system) is not empty.
std::optional<Collapse> collapse_of(const TwoBlocks& system);

/// Whether log.last() stands for infinitely many collisions: see Collapse.
inline bool is_endless(const Log& log) { return log.pair() != nullptr && log.pair()->is_endless(); }

/// How elastic the article's blocks have to be. With less restitution the blocks meet more often,
/// not less: see src/physics/README.md.
struct LeastRestitution {
  Rational below;       ///< too little, of blocks and wall alike
  Rational above;       ///< enough, as every restitution from here to 1
  Integer count_below;  ///< collisions, more than count_above
  Integer count_above;  ///< collisions: those of the elastic run
};

/// Encloses the least restitution with which article_system(digits, base) counts what it counts
/// without loss. 1 - below and 1 - above differ by at most 2^-relative_bits of themselves. If only
/// the elastic run counts right, as with equal masses, above is 1 and below 1 - 2^-relative_bits.
/// @param relative_bits  1 … 4096
/// @throws UsageError as mass_ratio_of(), or if relative_bits is out of range.
LeastRestitution least_restitution(int digits, int base = kUsualBase, int relative_bits = 64);

}  // namespace piblocks
