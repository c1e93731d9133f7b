// What blocks cover of columns and rows of pixels.
// In: an exposed block. Out: covers, and for which shares of the exposure's time.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "draw/draw_list.hpp"

namespace piblocks {

/// How much of a row or column of pixels a block covers: all of it, inside its line, its bars.
struct Cover {
  double outer = 0;
  double inner = 0;
  double bars = 0;
  double inset = 0;  ///< of a row: how far its ends are inside, where corners are round
  bool operator==(const Cover&) const = default;
};

/// A cover, and the share of the exposure for which it holds.
struct CoverShare {
  Cover cover;
  double share = 0;
  bool operator==(const CoverShare&) const = default;
};

/// How much of the pixel from `pixel` to `pixel` + 1 is between two places.
inline double overlap(double pixel, double begin, double end) {
  return std::clamp(std::min(pixel + 1, end) - std::max(pixel, begin), 0.0, 1.0);
}

inline Cover cover_of(double pixel, double begin, double length, double line_px) {
  return {overlap(pixel, begin, begin + length),
          overlap(pixel, begin + line_px, begin + length - line_px)};
}

/// What a block covers of a pixel.
class PixelCover {
 public:
  PixelCover(const ExposedBlock& block, const Cover& column, const Cover& row)
      : block_(block),
        outer_(column.outer * row.outer),
        line_(outer_ - column.inner * row.inner),
        bars_(column.outer * row.bars) {}

  /// A sample after the block's fill, its line and its bars are painted over it, as Cairo does.
  double over(double sample, std::uint8_t Color::*channel) const {
    const double edge = block_.stroke.color.*channel;
    const double filled = sample + outer_ * (block_.fill.*channel - sample);
    const double edged = filled + line_ * (edge - filled);
    return edged + bars_ * (edge - edged);
  }

 private:
  const ExposedBlock& block_;
  double outer_;
  double line_;
  double bars_;
};

/// How a block covers a row, and a column over the time of the exposure.
class BlockCover {
 public:
  explicit BlockCover(const ExposedBlock& block)
      : block_(block),
        // A shape thinner than its stroke is nothing but stroke.
        line_px_(std::min({block.stroke.width_px, block.bounds.width, block.bounds.height})),
        end_px_(std::max(line_px_, block.corner_px)),
        sums_{0} {
    for (const Dwell& dwell : block.dwells) sums_.push_back(sums_.back() + dwell.share);
  }

  double line_px() const { return line_px_; }

  Cover of_row(int y) const {
    const Rect& bounds = block_.bounds;
    const bool is_inside = bounds.y + end_px_ <= y && y + 1 <= bounds.bottom() - end_px_;
    if (is_inside && block_.bars.empty()) return kInside;
    Cover cover = cover_of(y, block_.bounds.y, block_.bounds.height, line_px_);
    // Each bar covers a part of what the ones before left uncovered.
    for (const Bar& bar : block_.bars) {
      cover.bars += (1 - cover.bars) * overlap(y, bar.y, bar.y + bar.height);
    }
    const double middle = y + 0.5;
    cover.inset = corner_inset(block_.corner_px,
                               std::min(middle - block_.bounds.y, block_.bounds.bottom() - middle));
    return cover;
  }

  /// What a block with its left edge at `x` covers of the column from `column` to `column` + 1.
  /// @param inset  of the row
  Cover of_column(double column, double x, double inset) const {
    Cover cover = cover_of(column, x, block_.bounds.width, line_px_);
    cover.outer = overlap(column, x + inset, x + block_.bounds.width - inset);
    return cover;
  }

  /// Whether rows with an inset may have another column than others.
  bool is_beside_end(double column) const {
    const bool is_still = block_.is_still();
    const double from = is_still ? block_.bounds.x : block_.dwells.front().x;
    const double to = is_still ? block_.bounds.x : block_.dwells.back().x;
    const auto is_near = [&](double left, double right) {
      return left - 1 < column && column < right;
    };
    const double width = block_.bounds.width;
    return is_near(from, to + block_.corner_px) ||
           is_near(from + width - block_.corner_px, to + width);
  }

  /// All ways in which the block covers a column; valid until the next call.
  std::span<const CoverShare> shares_of_column(double column, double inset) {
    shares_.clear();
    if (block_.is_still()) {
      const Cover still = of_column(column, block_.bounds.x, inset);
      if (still.outer > 0) shares_.push_back({still, 1});
    } else if (block_.dwells.back().x + end_px_ <= column &&
               column + 1 <= block_.dwells.front().x + block_.bounds.width - end_px_) {
      shares_.push_back({kInside, sums_.back()});
    } else if (block_.dwells.back().x >= column - block_.bounds.width &&
               block_.dwells.front().x < column + 1) {
      each_part(column, inset, [&](const Part& part) { add_dwells(column, inset, part); });
    }
    return shares_;
  }

 private:
  static constexpr Cover kInside{.outer = 1, .inner = 1};
  /// Places of the left edge, [from, to).
  struct Part {
    double from = 0;
    double to = 0;
    bool is_alike = false;  ///< from all of them the block covers the column in the same way
  };

  template <typename Visit>
  void each_part(double column, double inset, const Visit& visit) const {
    const double width = block_.bounds.width;
    const double end = std::max(line_px_, inset);
    if (line_px_ < 1 || width - 2 * end < 1) {
      visit(Part{column - width, column + 1, false});
      return;
    }
    if (inset > 0) {
      visit(Part{column - width, column + 1 - width + end, false});
      visit(Part{column + 1 - width + end, column - end, true});
      visit(Part{column - end, column + 1, false});
      return;
    }
    // The column has, in this order: the block's right edge, only its line, the line's inner
    // edge, only its fill, and the same on the other side.
    visit(Part{column - width, column + 1 - width, false});
    visit(Part{column + 1 - width, column - width + line_px_, true});
    visit(Part{column - width + line_px_, column + 1 - width + line_px_, false});
    visit(Part{column + 1 - width + line_px_, column - line_px_, true});
    visit(Part{column - line_px_, column + 1 - line_px_, false});
    visit(Part{column + 1 - line_px_, column, true});
    visit(Part{column, column + 1, false});
  }

  std::size_t first_at(double x) const {
    return static_cast<std::size_t>(std::ranges::lower_bound(block_.dwells, x, {}, &Dwell::x) -
                                    block_.dwells.begin());
  }

  /// One share for all places that are alike. At corners, which are few pixels, one for a few.
  void add_dwells(double column, double inset, const Part& part) {
    constexpr std::size_t kFewAtCorner = 4;
    const std::size_t begin = first_at(part.from);
    const std::size_t end = first_at(part.to);
    const std::size_t step = part.is_alike ? std::max(begin + 1, end) - begin
                             : inset > 0   ? kFewAtCorner
                                           : 1;
    for (std::size_t i = begin; i < end; i += step) {
      const std::size_t next = std::min(i + step, end);
      const double x = block_.dwells[(i + next - 1) / 2].x;
      shares_.push_back({of_column(column, x, inset), sums_[next] - sums_[i]});
    }
  }

  const ExposedBlock& block_;
  double line_px_;
  double end_px_;             ///< what is not inside, at each end
  std::vector<double> sums_;  // of the shares before each dwell
  std::vector<CoverShare> shares_;
};

}  // namespace piblocks
