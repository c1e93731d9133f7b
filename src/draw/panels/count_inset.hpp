// The turn of a curve of counts, enlarged in a frame of its own.
// In: the enlarged part of the curve, the frame. Out: items to draw, and the place of the present.
#pragma once

#include <piblocks/two_blocks.hpp>

#include <vector>

#include "draw/panels/count_curve.hpp"
#include "draw/panels/panels.hpp"

namespace piblocks {

class CountInset {
 public:
  /// Heights, in ems, of its labels with what is around them: one is above it, one below.
  static constexpr double kLabel_em = 1.25;

  /// @param count_px  height of a count in the curve that is not enlarged
  CountInset(EnlargedTurn part, const Rect& frame, double count_px)
      : part_(std::move(part)), frame_(frame), count_px_(count_px) {}

  bool shows(const Rational& time) const {
    return time >= part_.span.from && time <= part_.span.to;
  }
  Point at(const Rational& time, const Integer& count) const;

  /// Says by how much time and count are enlarged, the first above the frame, the other below.
  /// @returns false, and adds nothing, if a label is wider than `room_px`
  bool add_labels(const Diagram& diagram, double room_px, std::vector<DrawItem>& items) const;
  /// The frame, and thin lines to the place that it enlarges.
  void add_frame(const Diagram& diagram, const Point& from, std::vector<DrawItem>& items) const;
  /// The steps, each in the colour of the hit that makes it.
  void add_steps(const Diagram& diagram, const PairLog& log, std::vector<DrawItem>& items) const;

 private:
  EnlargedTurn part_;
  Rect frame_;
  double count_px_;
};

}  // namespace piblocks
