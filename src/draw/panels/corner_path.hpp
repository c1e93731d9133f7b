// The path through the plane of both gaps, for pictures of it at any magnification.
// In: a log and a span of time. Out: the path's corners as far as a picture can tell them apart,
// and lines and filled areas of a part of the plane.
#pragma once

#include <piblocks/two_blocks.hpp>

#include <array>
#include <optional>
#include <vector>

#include "draw/formula.hpp"
#include "draw/overlays/zoom.hpp"
#include "scene/schedule.hpp"

namespace piblocks {

/// How much of the plane is seen: 0 <= y2 <= to.
struct GapWindow {
  double to = 1;
  double least_apart = 0;  ///< red's gaps that are nearer to each other cannot be told apart
};

/// What of the path is in a window.
struct ShownPath {
  std::vector<std::vector<Gaps>> lines;
  // Between these of red's gaps the path covers the whole wedge; none if low == high.
  double filled_low = 0;
  double filled_high = 0;
};

class CornerPath {
 public:
  /// @param most_corners  of those on the way in, and on the way out; a picture so many pixels wide
  ///                      shows no more, whatever its magnification
  /// @throws SimulationError as gaps_at().
  CornerPath(const PairLog& log, const Span& span, int most_corners);

  /// Red's greatest and least gap.
  double greatest_y2() const noexcept { return greatest_y2_; }
  double least_y2() const noexcept { return least_y2_; }

  ShownPath shown(const GapWindow& window) const;

 private:
  struct Side {
    std::vector<Gaps> line;
    double dense_from;  ///< nearer to the corner than this the path is filled; 0 if it is not
  };
  Side side_of(const std::vector<Gaps>& corners, const GapWindow& window) const;

  // From far away to the corner.
  std::vector<Gaps> in_;
  std::vector<Gaps> out_;
  bool is_complete_ = true;  ///< no corner was left out
  double greatest_y2_ = 0;
  double least_y2_ = 0;
};

/// How many times the plane is enlarged about its corner. The zoom stays at 1, 10, 100 …, and takes
/// the values between them while it rises from one to the next.
class CornerZoom {
 public:
  /// @param least_share  the least part of red's greatest gap that is shown, > 0
  CornerZoom(double least_share, const FormulaSetter& set);

  /// Continuous; it grows as the gap shrinks, and the gap stays in the picture.
  /// @param share  of red's greatest gap, > 0
  double factor_for(double share) const;
  /// The exponent of a power of ten; nothing between them.
  std::optional<std::size_t> exponent_of(double zoom) const;
  double power(std::size_t exponent) const { return zoom_.power(static_cast<long>(exponent)); }
  std::size_t most_exponent() const { return static_cast<std::size_t>(zoom_.most_exponent()); }
  /// "×100", "×2.5×10⁷": two digits.
  Formula text(double zoom) const;

 private:
  Zoom zoom_;
  static constexpr std::size_t kPlain = 4;

  std::array<std::vector<Formula>, kPlain> plain_;  ///< by exponent, and ten times the mantissa
  std::vector<Formula> powers_;                     ///< by exponent
};

}  // namespace piblocks
