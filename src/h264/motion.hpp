// Where a macroblock's samples were in the picture before.
// In: its samples and the picture before. Out: a motion vector, what decoders predict it from, and
// the samples that they take by it. Clause 8.4 of ITU-T H.264, for P_L0_16x16 and P_Skip.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "h264/picture.hpp"
#include "h264/residual.hpp"

namespace piblocks::h264 {

/// mvpLX of a 16x16 partition, 8.4.1.3.
MotionVector predicted_vector(const Neighbours& neighbours);
/// The vector of P_Skip, 8.4.1.1.
MotionVector skip_vector(const Neighbours& neighbours);

/// Whether a macroblock moved by the vector is inside the picture before.
bool stays_inside(const Picture& picture, int x_mb, int y_mb, MotionVector vector);
/// Inter prediction of the macroblock, 8.4.2.
void predict_moved(const Picture& before, int x_mb, int y_mb, MotionVector vector,
                   Samples& samples);

/// Finds vectors of what slides, scrolls or is dragged, by whole samples. It looks first where
/// others have found theirs, in this picture and in those before since the last IDR picture.
class MotionSearch {
 public:
  /// @param qp  of the pictures: a coarser quantiser leaves larger differences
  explicit MotionSearch(int qp);

  void begin_group();
  /// @param changed_macroblocks  more of them allow more far searches
  void begin_picture(int changed_macroblocks);
  /// The vector by which the luma samples of the picture before are nearest, if they are near.
  std::optional<MotionVector> find(const Samples& source, const Picture& before, int x_mb, int y_mb,
                                   const Neighbours& neighbours);

 private:
  void remember(MotionVector vector);

  static constexpr int kMostSearches = 4;
  static constexpr int kShortReach = 48;

  int near_;                           // a larger sum of differences is no motion
  std::vector<MotionVector> recent_;   // the latest first
  int searches_left_ = kMostSearches;  // far ones that may still find nothing
  int reach_ = kShortReach;            // of these, in samples
};

}  // namespace piblocks::h264
