// An interval of time as all of its pieces.
// In: uniform pieces, in order. Out: their sums.
#pragma once

#include <vector>

#include "physics/exposure.hpp"

namespace piblocks {

/// The share of its time that a block which moves evenly is below `position`.
double share_below(const Travel& travel, double position);
/// The integral of that share up to `position`.
double area_below(const Travel& travel, double position);
/// Widens a range by a piece.
void include(Travel& range, const Travel& piece);

class ListedExposure final : public Exposure {
 public:
  /// @param pieces  at least one, their shares in any unit of time.
  explicit ListedExposure(std::vector<UniformPiece> pieces);

  Travel range(BlockName block) const override;
  double share_below(BlockName block, double position) const override;
  double area_below(BlockName block, double position) const override;
  bool is_listed() const override { return true; }
  std::span<const UniformPiece> pieces() const override { return pieces_; }

 private:
  std::vector<UniformPiece> pieces_;
  Travel blue_range_;
  Travel red_range_;
};

/// Collects pieces from instant to instant.
class PieceList {
 public:
  /// The blocks are here now.
  PieceList(double blue, double red) : blue_(blue), red_(red) {}
  /// `duration` later they are there, and have moved evenly.
  void add(double duration, double blue, double red);
  std::vector<UniformPiece> take() { return std::move(pieces_); }

 private:
  double blue_;
  double red_;
  std::vector<UniformPiece> pieces_;
};

}  // namespace piblocks
