// The closed form as a bulk producer: a table of directions, turned into place block by block.
// In: a range of rays. Out: the collisions on them, in batches.
#pragma once

#include <piblocks/collision_log.hpp>

#include <array>
#include <memory>
#include <optional>

#include "physics/unfolding.hpp"

namespace piblocks {

/// Rays that share one anchor.
inline constexpr std::size_t kBlockRays = 64;

/// Directions of up to kBlockRays rays from the first or the last of them, in columns, and what
/// else depends on their order alone.
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

/// Near the past a block's anchor is its first ray, near the future its last one: the angles of the
/// others are then a sum of two positive ones, with sines that nothing cancels in.
/// Every ray costs two rotations, two divisions and some thirty multiplications and additions, all
/// without branches, so that the compiler makes vectors of them.
class UnfoldedStream final : public CollisionStream {
 public:
  /// Rays first … last in the order of time; the collision on `first` has index `index`.
  /// @param contact  as in time_within()
  UnfoldedStream(const Unfolding& form, Integer first, Integer last, Integer index,
                 const std::optional<Integer>& contact);

  bool read(CollisionBatch& batch) override;

 private:
  void fill(const RoundedAsymptote& end, std::size_t begin, std::size_t rows,
            CollisionBatch& batch);
  const RayTable& table(int sign, bool anchor_is_odd);
  void keep_within(CollisionBatch& batch) const;

  const Unfolding& form_;
  Integer next_;
  Integer last_;
  Integer index_;
  std::optional<Integer> contact_;
  Integer last_of_past_;  // later rays are nearer to the future
  std::array<std::array<std::unique_ptr<RayTable>, 2>, 2> tables_;  // by end and parity of anchor
};

}  // namespace piblocks
