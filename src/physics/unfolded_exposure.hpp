// An interval of time with many collisions, in closed form.
// In: the unfolded motion, its first and last ray of the interval. Out: shares of time at the cost
// of some hundred sines each.
#pragma once

#include <vector>

#include "physics/exposure.hpp"
#include "physics/ray_sums.hpp"

namespace piblocks {

/// Gaps at one instant.
struct Gaps {
  double tau = 0;   ///< scaled time since closest approach
  double blue = 0;  ///< y1
  double red = 0;   ///< y2
};

/// A ray that is crossed.
struct Crossing {
  RayPhase ray;
  bool is_odd = false;
};

class UnfoldedExposure final : public Exposure {
 public:
  /// @param first, last  the rays that are crossed first and last, many rays apart.
  UnfoldedExposure(const ClosedForm& form, double total_phase, const Gaps& begin,
                   const Crossing& first, const Crossing& last, const Gaps& end);

  Travel range(BlockName block) const override;
  double share_below(BlockName block, double position) const override;
  double area_below(BlockName block, double position) const override;
  bool is_listed() const override { return false; }
  std::span<const UniformPiece> pieces() const override { return pieces_; }

 private:
  /// A uniform motion at either end of the interval.
  struct Loose {
    double duration = 0;
    Travel gap;
  };
  /// What a sum over an interval gives: in units of time, and of time by length.
  struct Sums {
    double time = 0;
    double area = 0;
  };

  void cut_ends(const Gaps& begin, const Crossing& first, const Crossing& last, const Gaps& end);
  void make_pieces(const Gaps& begin, const Gaps& end);
  Sums sums_below(BlockName block, double gap) const;
  Sums blue_below(double gap) const;
  Sums red_below(double gap) const;
  Sums piece_below(const RayPhase& near, const RayPhase& far, double gap) const;
  double offset(BlockName block) const {
    return block == BlockName::blue ? form_.blue_offset : form_.red_offset;
  }

  ClosedForm form_;
  RaySums rays_;
  double duration_;
  Travel blue_gap_;
  Travel red_gap_;
  RayRange even_;  ///< between them blue flies to red and back
  RayRange odd_;   ///< between them red flies evenly from each to the next
  std::vector<Loose> blue_ends_;
  std::vector<Loose> red_ends_;
  std::vector<UniformPiece> pieces_;
};

}  // namespace piblocks
