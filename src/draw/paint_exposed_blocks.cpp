#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "draw/extent.hpp"
#include "draw/painter.hpp"

namespace piblocks {
namespace {

/// How much of a row or column of pixels a block covers: all of it, inside its line, its bars.
struct Cover {
  double outer = 0;
  double inner = 0;
  double bars = 0;
  bool operator==(const Cover&) const = default;
};

/// In one way for a share of the time.
struct CoverShare {
  Cover cover;
  double share = 0;
  bool operator==(const CoverShare&) const = default;
};

/// What each block covers of a row.
using RowCover = std::vector<Cover>;

/// How much of the pixel from `pixel` to `pixel` + 1 is between two places.
double overlap(double pixel, double begin, double end) {
  return std::clamp(std::min(pixel + 1, end) - std::max(pixel, begin), 0.0, 1.0);
}

Cover cover_of(double pixel, double begin, double length, double line_px) {
  return {overlap(pixel, begin, begin + length),
          overlap(pixel, begin + line_px, begin + length - line_px)};
}

/// What a block covers of a pixel.
struct PixelCover {
  const ExposedBlock& block;
  const Cover& column;
  const Cover& row;

  /// A sample after the block's fill, its line and its bars are painted over it, as Cairo does.
  double over(double sample, std::uint8_t Color::*channel) const {
    const double edge = block.stroke.color.*channel;
    const double outer = column.outer * row.outer;
    const double line = outer - column.inner * row.inner;
    const double filled = sample + outer * (block.fill.*channel - sample);
    const double edged = filled + line * (edge - filled);
    return edged + column.outer * row.bars * (edge - edged);
  }
};

/// How a block covers a row, and a column over the time of the exposure.
class BlockCover {
 public:
  explicit BlockCover(const ExposedBlock& block)
      : block_(block),
        // A shape thinner than its stroke is nothing but stroke.
        line_px_(std::min({block.stroke.width_px, block.bounds.width, block.bounds.height})),
        sums_{0} {
    for (const Dwell& dwell : block.dwells) sums_.push_back(sums_.back() + dwell.share);
  }

  Cover of_row(int y) const {
    Cover cover = cover_of(y, block_.bounds.y, block_.bounds.height, line_px_);
    // Each bar covers a part of what the ones before left uncovered.
    for (const Bar& bar : block_.bars) {
      cover.bars += (1 - cover.bars) * overlap(y, bar.y, bar.y + bar.height);
    }
    return cover;
  }

  /// What a block with its left edge at `x` covers of the column from `column` to `column` + 1.
  Cover of_column(double column, double x) const {
    return cover_of(column, x, block_.bounds.width, line_px_);
  }

  /// All ways in which the block covers a column; valid until the next call.
  std::span<const CoverShare> shares_of_column(double column) {
    shares_.clear();
    const double width = block_.bounds.width;
    if (block_.dwells.empty()) {
      const Cover still = of_column(column, block_.bounds.x);
      if (still.outer > 0) shares_.push_back({still, 1});
    } else if (block_.dwells.back().x < column - width || block_.dwells.front().x >= column + 1) {
      // The block is never there.
    } else if (line_px_ < 1 || width - 2 * line_px_ < 1) {
      add_each(column, column - width, column + 1);
    } else {
      // The column has, in this order: the block's right edge, only its line, the line's inner
      // edge, only its fill, and the same on the other side.
      add_each(column, column - width, column + 1 - width);
      add_alike(column, column + 1 - width, column - width + line_px_);
      add_each(column, column - width + line_px_, column + 1 - width + line_px_);
      add_alike(column, column + 1 - width + line_px_, column - line_px_);
      add_each(column, column - line_px_, column + 1 - line_px_);
      add_alike(column, column + 1 - line_px_, column);
      add_each(column, column, column + 1);
    }
    return shares_;
  }

 private:
  std::size_t first_at(double x) const {
    return static_cast<std::size_t>(std::ranges::lower_bound(block_.dwells, x, {}, &Dwell::x) -
                                    block_.dwells.begin());
  }

  /// Adds up the dwells in [from, to), all of which cover the column in the same way.
  void add_alike(double column, double from, double to) {
    const std::size_t begin = first_at(from);
    const std::size_t end = first_at(to);
    if (begin >= end) return;
    shares_.push_back({of_column(column, block_.dwells[begin].x), sums_[end] - sums_[begin]});
  }

  void add_each(double column, double from, double to) {
    for (std::size_t i = first_at(from); i < block_.dwells.size() && block_.dwells[i].x < to; ++i) {
      shares_.push_back({of_column(column, block_.dwells[i].x), block_.dwells[i].share});
    }
  }

  const ExposedBlock& block_;
  double line_px_;
  std::vector<double> sums_;  // of the shares before each dwell
  std::vector<CoverShare> shares_;
};

/// One column after another.
class ExposedColumn {
 public:
  ExposedColumn(const ExposedBlocksItem& item, const Light& light)
      : item_(item),
        light_(light),
        blocks_(item.blocks.begin(), item.blocks.end()),
        shares_(item.blocks.size()) {}

  /// Tells rows apart by how the blocks cover them: of a picture there are few kinds.
  std::size_t kind_of_row(int y) {
    RowCover cover;
    for (const BlockCover& block : blocks_) cover.push_back(block.of_row(y));
    const auto found = std::ranges::find(rows_, cover);
    if (found != rows_.end()) return static_cast<std::size_t>(found - rows_.begin());
    rows_.push_back(std::move(cover));
    return rows_.size() - 1;
  }

  /// Turns to the column from `x` to `x` + 1. False if no moving block is ever in it.
  bool enter(int x) {
    if (std::ranges::none_of(item_.blocks, [&](const auto& block) { return passes(block, x); })) {
      return false;
    }
    x_ = x;
    const auto at = [&](double place) {
      return std::ranges::lower_bound(item_.contacts, place, {}, &TouchingBlocks::right_x);
    };
    const bool had_contacts = !contacts_.empty();
    contacts_ = {at(x), at(x + 1.0)};
    // Within a block, one column is like the next.
    bool is_new = had_contacts || !contacts_.empty();
    present_.clear();
    for (std::size_t i = 0; i < blocks_.size(); ++i) {
      is_new |= replace(shares_[i], blocks_[i].shares_of_column(x));
      if (!shares_[i].empty()) present_.push_back(i);
    }
    if (is_new) known_.clear();
    return !present_.empty();
  }

  /// The pixel of a row over a background; both 0x00RRGGBB.
  std::uint32_t pixel(std::size_t kind, std::uint32_t background) {
    for (const Known& known : known_) {
      if (known.background == background && known.row == kind) return known.pixel;
    }
    const RowCover& row = rows_[kind];
    const auto sample = [&](int shift, std::uint8_t Color::*channel) {
      const double light = light_of(row, background >> shift & 0xFF, channel);
      return static_cast<std::uint32_t>(light_.sample(light)) << shift;
    };
    const std::uint32_t pixel =
        sample(16, &Color::red) | sample(8, &Color::green) | sample(0, &Color::blue);
    known_.push_back({kind, background, pixel});
    return pixel;
  }

 private:
  static bool passes(const ExposedBlock& block, int x) {
    if (block.dwells.empty()) return false;
    const Extent extent = extent_of(block);
    return std::floor(extent.left) <= x && x < std::ceil(extent.right);
  }

  /// @returns whether that changes anything
  static bool replace(std::vector<CoverShare>& shares, std::span<const CoverShare> by) {
    if (std::ranges::equal(shares, by)) return false;
    shares.assign(by.begin(), by.end());
    return true;
  }

  /// Two blocks that touch, by which is painted first.
  struct Pair {
    std::size_t behind = 0;
    double behind_x = 0;
    std::size_t front = 0;
    double front_x = 0;
  };
  static Pair in_order(const TouchingBlocks& contact) {
    const auto& [right_x, left_x, share, right, left] = contact;
    if (right < left) return {right, right_x, left, left_x};
    return {left, left_x, right, right_x};
  }

  /// Each block changes the light behind it by its share of time. Where both are in one pixel at
  /// the same time, these changes do not add up: contacts correct that.
  double light_of(const RowCover& row, double background, std::uint8_t Color::*channel) const {
    const double plain = light_.of(background);
    double sum = plain;
    for (const std::size_t i : present_) {
      for (const auto& [cover, share] : shares_[i]) {
        const PixelCover pixel{item_.blocks[i], cover, row[i]};
        sum += share * (light_.of(pixel.over(background, channel)) - plain);
      }
    }
    for (const TouchingBlocks& contact : contacts_) {
      const auto [behind, behind_x, front, front_x] = in_order(contact);
      const Cover behind_column = blocks_[behind].of_column(x_, behind_x);
      const Cover front_column = blocks_[front].of_column(x_, front_x);
      const PixelCover over{item_.blocks[front], front_column, row[front]};
      const double only_behind =
          PixelCover{item_.blocks[behind], behind_column, row[behind]}.over(background, channel);
      const double only_front = over.over(background, channel);
      const double both = over.over(only_behind, channel);
      sum += contact.share *
             (light_.of(both) - light_.of(only_behind) - light_.of(only_front) + plain);
    }
    return sum;
  }

  const ExposedBlocksItem& item_;
  const Light& light_;
  std::vector<BlockCover> blocks_;
  std::vector<RowCover> rows_;  // of each kind
  std::vector<std::vector<CoverShare>> shares_;
  std::vector<std::size_t> present_;  // the blocks with shares
  std::span<const TouchingBlocks> contacts_;
  int x_ = 0;
  struct Known {
    std::size_t row = 0;  // its kind
    std::uint32_t background = 0;
    std::uint32_t pixel = 0;
  };
  std::vector<Known> known_;  // of this column and those like it before
};

/// Columns from `begin` to before `end`.
struct ColumnRun {
  int begin = 0;
  int end = 0;
};

/// The pixels of an area, and what was there before the blocks were painted.
class ExposedArea {
 public:
  /// @param row_of  returns the first pixel of the area in a row of the picture.
  template <typename RowOf>
  ExposedArea(const PixelRect& area, std::vector<std::uint32_t>& background, const RowOf& row_of)
      : area_(area), background_(background) {
    background_.clear();
    for (int y = 0; y < area.height_px; ++y) {
      rows_.push_back(row_of(area.y_px + y));
      background_.insert(background_.end(), rows_.back(), rows_.back() + area.width_px);
    }
  }

  /// Paints the rows that are unlike the one above, column by column, and copies the others.
  void paint(ExposedColumn& column) {
    find_rows(column);
    for (int x = 0; x < area_.width_px; ++x) {
      if (!column.enter(area_.x_px + x)) continue;
      if (runs_.empty() || runs_.back().end != x) runs_.push_back({x, x});
      runs_.back().end = x + 1;
      for (const auto& [y, kind] : unlike_) {
        const std::uint32_t background = background_row(y)[x];
        rows_[y][x] = (background & 0xFF000000U) | column.pixel(kind, background & 0xFFFFFFU);
      }
    }
    copy_rows();
  }

 private:
  struct Row {
    std::size_t y = 0;
    std::size_t kind = 0;
  };

  const std::uint32_t* background_row(std::size_t y) const {
    return background_.data() + y * static_cast<std::size_t>(area_.width_px);
  }
  void find_rows(ExposedColumn& column) {
    for (std::size_t y = 0; y < rows_.size(); ++y) {
      const std::size_t kind = column.kind_of_row(area_.y_px + static_cast<int>(y));
      const bool is_alike =
          y > 0 && kind == unlike_.back().kind &&
          std::equal(background_row(y), background_row(y) + area_.width_px, background_row(y - 1));
      if (!is_alike) unlike_.push_back({y, kind});
    }
  }
  void copy_rows() {
    for (std::size_t i = 0; i < unlike_.size(); ++i) {
      const std::size_t end = i + 1 < unlike_.size() ? unlike_[i + 1].y : rows_.size();
      for (std::size_t y = unlike_[i].y + 1; y < end; ++y) {
        const std::uint32_t* const above = rows_[y - 1];
        for (const ColumnRun& run : runs_) {
          std::copy(above + run.begin, above + run.end, rows_[y] + run.begin);
        }
      }
    }
  }

  PixelRect area_;
  std::vector<std::uint32_t>& background_;  // row by row
  std::vector<std::uint32_t*> rows_;
  std::vector<Row> unlike_;      // the row above, in what the blocks cover or in the background
  std::vector<ColumnRun> runs_;  // with blocks in them
};

}  // namespace

/// A pixel depends on its column and its background alone, so that a part of the picture has the
/// pixels of the whole. Cairo paints a block that stays, except where the other one passes.
void Painter::paint_exposed(cairo_t& cr, const ExposedBlocksItem& item, const PixelRect& area) {
  const PixelRect moving = moving_area(item, area);
  if (moving.width_px <= 0 || moving.height_px <= 0) return paint_still(cr, item);
  cairo_surface_t* const surface = cairo_get_target(&cr);
  cairo_surface_flush(surface);
  unsigned char* const data = cairo_image_surface_get_data(surface);
  const std::ptrdiff_t stride_bytes = cairo_image_surface_get_stride(surface);
  ExposedArea exposed(moving, background_, [&](int y) {
    unsigned char* const row = data + (y - area.y_px) * stride_bytes;
    return reinterpret_cast<std::uint32_t*>(row) + (moving.x_px - area.x_px);
  });
  paint_still(cr, item);
  cairo_surface_flush(surface);
  if (!light_) light_ = std::make_unique<Light>();
  ExposedColumn column(item, *light_);
  exposed.paint(column);
  cairo_surface_mark_dirty(surface);
}

}  // namespace piblocks
