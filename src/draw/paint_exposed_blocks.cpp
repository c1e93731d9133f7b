#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "draw/block_cover.hpp"
#include "draw/extent.hpp"
#include "draw/painter.hpp"

namespace piblocks {
namespace {

/// What each of two blocks covers of a row.
using RowCover = std::array<Cover, 2>;

/// One column after another, from left to right.
class ExposedColumn {
 public:
  ExposedColumn(const ExposedBlocksItem& item, const Light& light, const PixelRect& area)
      : item_(item),
        light_(light),
        blocks_{BlockCover(item.behind), BlockCover(item.front)},
        pixels_{pixels_of(extent_of(item.behind), area), pixels_of(extent_of(item.front), area)} {}

  /// Tells rows apart by how the blocks cover them: of a picture there are few kinds.
  std::size_t kind_of_row(int y) {
    const RowCover cover{blocks_[0].of_row(y), blocks_[1].of_row(y)};
    const auto found = std::ranges::find(rows_, cover);
    if (found != rows_.end()) return static_cast<std::size_t>(found - rows_.begin());
    rows_.push_back(cover);
    return rows_.size() - 1;
  }

  /// Turns to the column from `x` to `x` + 1. False if no moving block is ever in it.
  bool enter(int x) {
    const std::array<bool, 2> are_here{is_in(pixels_[0], x), is_in(pixels_[1], x)};
    if (!(are_here[0] && !item_.behind.is_still()) && !(are_here[1] && !item_.front.is_still())) {
      return false;
    }
    x_ = x;
    const auto at = [&](double place) {
      return std::ranges::lower_bound(item_.contacts, place, {}, &TouchingBlocks::right_x);
    };
    // Within a block, one column is like the next.
    bool is_new = !contacts_.empty();
    contacts_ = {at(x), at(x + 1.0)};
    is_new |= !contacts_.empty();
    for (std::size_t i = 0; i < 2; ++i) {
      std::span<const CoverShare> shares;
      if (are_here[i]) shares = blocks_[i].shares_of_column(x);
      is_new |= replace(shares_[i], shares);
    }
    if (is_new) known_.clear();
    return !shares_[0].empty() || !shares_[1].empty();
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
  static bool is_in(const PixelRect& pixels, int x) {
    return pixels.x_px <= x && x < pixels.right_px();
  }

  /// @returns whether that changes anything
  static bool replace(std::vector<CoverShare>& shares, std::span<const CoverShare> by) {
    if (std::ranges::equal(shares, by)) return false;
    shares.assign(by.begin(), by.end());
    return true;
  }

  /// Each block changes the light behind it by its share of time. Where both are in one pixel at
  /// the same time, these changes do not add up: contacts correct that.
  double light_of(const RowCover& row, double background, std::uint8_t Color::*channel) const {
    const double plain = light_.of(background);
    double sum = plain;
    const std::array<const ExposedBlock*, 2> blocks{&item_.behind, &item_.front};
    for (std::size_t i = 0; i < 2; ++i) {
      for (const auto& [cover, share] : shares_[i]) {
        const PixelCover pixel{*blocks[i], cover, row[i]};
        sum += share * (light_.of(pixel.over(background, channel)) - plain);
      }
    }
    for (const auto& [behind_x, front_x, share] : contacts_) {
      const Cover behind_column = blocks_[0].of_column(x_, behind_x);
      const Cover front_column = blocks_[1].of_column(x_, front_x);
      const PixelCover over{item_.front, front_column, row[1]};
      const double only_behind =
          PixelCover{item_.behind, behind_column, row[0]}.over(background, channel);
      const double only_front = over.over(background, channel);
      const double both = over.over(only_behind, channel);
      sum += share * (light_.of(both) - light_.of(only_behind) - light_.of(only_front) + plain);
    }
    return sum;
  }

  const ExposedBlocksItem& item_;
  const Light& light_;
  // Of both blocks.
  std::array<BlockCover, 2> blocks_;
  std::array<PixelRect, 2> pixels_;
  std::array<std::vector<CoverShare>, 2> shares_;
  std::vector<RowCover> rows_;  // of each kind
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
  ExposedArea(const PixelRect& area, std::vector<std::uint32_t>& background,
              const SurfacePixels& pixels)
      : area_(area), background_(background) {
    background_.clear();
    for (int y = 0; y < area.height_px; ++y) {
      rows_.push_back(pixels.at(area.x_px, area.y_px + y));
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
void Painter::paint(cairo_t& cr, const ExposedBlocksItem& item, const PixelRect& area) {
  const bool has_pixels = has_pixels_of_picture(cr);
  const PixelRect moving = has_pixels ? moving_area(item, area) : PixelRect{};
  std::optional<ExposedArea> exposed;
  if (!moving.is_empty()) exposed.emplace(moving, background_, SurfacePixels(cr, area));
  for (const ExposedBlock* block : {&item.behind, &item.front}) {
    if (block->is_still() || !has_pixels) paint_still(cr, item.id, *block);
  }
  if (!exposed) return;
  const SurfacePixels pixels(cr, area);
  ExposedColumn column(item, light(), moving);
  exposed->paint(column);
}

}  // namespace piblocks
