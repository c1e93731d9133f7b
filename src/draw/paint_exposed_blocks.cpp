#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "draw/block_cover.hpp"
#include "draw/blocks_together.hpp"
#include "draw/extent.hpp"
#include "draw/painter.hpp"

namespace piblocks {
namespace {

/// What each kind of block covers of a row.
using RowCover = std::vector<Cover>;

/// One column after another, from left to right.
class ExposedColumn {
 public:
  ExposedColumn(const ExposedBlocksItem& item, const Light& light, const PixelRect& area)
      : item_(item),
        light_(light),
        blocks_(item.blocks.begin(), item.blocks.end()),
        shares_(item.blocks.size()),
        kinds_(item.blocks.size()),
        ends_px_(item.blocks.size()),
        together_(item.blocks, blocks_) {
    for (std::size_t i = 0; i < blocks_.size(); ++i) {
      const PixelRect pixels = pixels_of(extent_of(item.blocks[i]), area);
      if (pixels.width_px > 0) coming_.push_back({i, pixels});
      if (pixels.width_px > 0 || !item.contacts.empty()) kinds_[i] = kind_of(i);
    }
    std::ranges::stable_sort(coming_, std::ranges::greater{},
                             [](const Coming& block) { return block.pixels.x_px; });
  }

  /// Tells rows apart by how the blocks cover them: of a picture there are few kinds.
  std::size_t kind_of_row(int y) {
    RowCover cover;
    for (const std::size_t block : unlike_) cover.push_back(blocks_[block].of_row(y));
    const auto found = std::ranges::find(rows_, cover);
    if (found != rows_.end()) return static_cast<std::size_t>(found - rows_.begin());
    rows_.push_back(std::move(cover));
    return rows_.size() - 1;
  }

  /// Turns to the column from `x` to `x` + 1. False if no moving block is ever in it.
  bool enter(int x) {
    bool is_new = find_blocks(x);
    if (is_new) known_.clear();
    if (std::ranges::all_of(here_, [&](std::size_t i) { return item_.blocks[i].is_still(); })) {
      return false;
    }
    x_ = x;
    const auto at = [&](double place) {
      return std::ranges::lower_bound(item_.contacts, place, {}, &TouchingBlocks::right_x);
    };
    // Within a block, one column is like the next.
    is_new |= !contacts_.empty() || !moments_.empty();
    contacts_ = {at(x), at(x + 1.0)};
    if (has_paths()) moments_ = together_.find(x, here_);
    is_new |= !contacts_.empty() || !moments_.empty();
    present_.clear();
    for (const std::size_t i : here_) {
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
  struct Coming {
    std::size_t block = 0;
    PixelRect pixels = {};
  };

  /// Blocks of one kind cover rows in the same way.
  std::size_t kind_of(std::size_t i) {
    const auto is_alike = [&](std::size_t other) {
      const ExposedBlock& a = item_.blocks[i];
      const ExposedBlock& b = item_.blocks[other];
      return a.bounds.y == b.bounds.y && a.bounds.height == b.bounds.height && a.bars == b.bars &&
             blocks_[i].line_px() == blocks_[other].line_px();
    };
    const auto found = std::ranges::find_if(unlike_, is_alike);
    if (found != unlike_.end()) return static_cast<std::size_t>(found - unlike_.begin());
    unlike_.push_back(i);
    return unlike_.size() - 1;
  }

  bool has_paths() const {
    return std::ranges::any_of(here_,
                               [&](std::size_t i) { return !item_.blocks[i].paths.empty(); });
  }

  /// @returns whether blocks have left
  bool find_blocks(int x) {
    const std::size_t before = here_.size();
    std::erase_if(here_, [&](std::size_t i) { return x >= ends_px_[i]; });
    const bool have_left = here_.size() < before;
    for (; !coming_.empty() && coming_.back().pixels.x_px <= x; coming_.pop_back()) {
      const auto& [block, pixels] = coming_.back();
      here_.insert(std::ranges::upper_bound(here_, block), block);
      ends_px_[block] = pixels.x_px + pixels.width_px;
    }
    return have_left;
  }

  /// @returns whether that changes anything
  static bool replace(std::vector<CoverShare>& shares, std::span<const CoverShare> by) {
    if (std::ranges::equal(shares, by)) return false;
    shares.assign(by.begin(), by.end());
    return true;
  }

  const Cover& row_of(const RowCover& row, std::size_t block) const { return row[kinds_[block]]; }

  /// Each block changes the light behind it by its share of time. Where several are in one pixel at
  /// the same time, these changes do not add up: contacts and moments correct that.
  double light_of(const RowCover& row, double background, std::uint8_t Color::*channel) const {
    const double plain = light_.of(background);
    double sum = plain;
    for (const std::size_t i : present_) {
      for (const auto& [cover, share] : shares_[i]) {
        const PixelCover pixel{item_.blocks[i], cover, row_of(row, i)};
        sum += share * (light_.of(pixel.over(background, channel)) - plain);
      }
    }
    for (const auto& [right_x, left_x, share] : contacts_) {
      const Cover behind_column = blocks_[0].of_column(x_, right_x);
      const Cover front_column = blocks_[1].of_column(x_, left_x);
      const PixelCover over{item_.blocks[1], front_column, row_of(row, 1)};
      const double only_behind =
          PixelCover{item_.blocks[0], behind_column, row_of(row, 0)}.over(background, channel);
      const double only_front = over.over(background, channel);
      const double both = over.over(only_behind, channel);
      sum += share * (light_.of(both) - light_.of(only_behind) - light_.of(only_front) + plain);
    }
    for (const TogetherMoment& moment : moments_) {
      double all = background;
      double apart = 0;
      for (const auto& [block, column] : moment.blocks) {
        const PixelCover pixel{item_.blocks[block], column, row_of(row, block)};
        all = pixel.over(all, channel);
        apart += light_.of(pixel.over(background, channel)) - plain;
      }
      sum += moment.share * (light_.of(all) - plain - apart);
    }
    return sum;
  }

  const ExposedBlocksItem& item_;
  const Light& light_;
  std::vector<BlockCover> blocks_;
  std::vector<RowCover> rows_;  // of each kind
  std::vector<std::vector<CoverShare>> shares_;
  std::vector<std::size_t> kinds_;  // of each block: a place in unlike_
  std::vector<int> ends_px_;        // of each block: the first column that it is never in
  BlocksTogether together_;
  std::vector<std::size_t> unlike_;   // a block of each kind
  std::vector<Coming> coming_;        // the next one is the last
  std::vector<std::size_t> here_;     // blocks that are ever in the column, from back to front
  std::vector<std::size_t> present_;  // the blocks with shares
  std::span<const TouchingBlocks> contacts_;
  std::span<const TogetherMoment> moments_;
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
  ExposedColumn column(item, *light_, moving);
  exposed.paint(column);
  cairo_surface_mark_dirty(surface);
}

}  // namespace piblocks
