// The closed form as a bulk producer: a table of directions, turned into place block by block.
// In: a range of rays. Out: the collisions on them, in batches.
#pragma once

#include <piblocks/run.hpp>

#include <array>
#include <memory>
#include <optional>

#include "physics/unfolding.hpp"

namespace piblocks {

/// Rays that share one anchor.
inline constexpr std::size_t kBlockRays = 64;

/// Directions of up to kBlockRays rays, measured from the first or the last of them, and the other
/// numbers that depend on their order alone, in columns.
struct RayTable {
  using Column = std::array<double, kBlockRays>;

  alignas(64) Column sine;
  alignas(64) Column cosine;
  alignas(64) Column even_sine;  ///< of the next even ray
  alignas(64) Column even_cosine;
  alignas(64) Column blue_reach;
  alignas(64) Column red_reach;
  alignas(64) Column side;
};

/// The anchor of a block is its ray nearest to the landmark from which the rays are counted. Angles
/// of the other rays are sums of two positive ones, so nothing cancels (README.md, "Collisions, one
/// or all"). Every ray costs two rotations, two divisions and some thirty multiplications and
/// additions without branches, so that the compiler makes vectors of them.
class UnfoldedStream final : public CollisionStream {
 public:
  /// Rays first … last in the order of time; the collision on `first` has index `index`.
  /// @param contact  as in time_within()
  UnfoldedStream(const Unfolding& form, Integer first, Integer last, Integer index,
                 std::optional<Integer> contact);

  bool read(CollisionBatch& batch) override;

 private:
  /// Rays that are computed in one way.
  struct Stretch {
    Integer last;
    int end_sign = 0;  ///< of the nearer end of time; 0 if there is no stretch yet
    const Landmark* landmark = nullptr;  ///< nearest: that end, or the turn
    bool is_near_start = false;

    bool is_near_turn() const { return landmark->sign != end_sign; }
  };

  Stretch stretch_from(const Integer& ray) const;
  void fill(std::size_t begin, std::size_t rows, CollisionBatch& batch);
  const RayTable& table(const Landmark& landmark, int end_sign, bool anchor_is_odd);
  void keep_within(CollisionBatch& batch) const;

  const Unfolding& form_;
  Integer next_;
  Integer last_;
  Integer index_;
  std::optional<Integer> contact_;
  Stretch stretch_;
  Integer last_by_past_;  // later rays are nearer to the turn
  Integer last_by_turn_;  // later rays are nearer to the future
  // By the side on which the landmark lies, by that of the nearer end of time, and by the parity of
  // the anchor.
  std::array<std::array<std::array<std::unique_ptr<RayTable>, 2>, 2>, 2> tables_;
};

}  // namespace piblocks
