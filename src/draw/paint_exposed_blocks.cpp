#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "draw/block_cover.hpp"
#include "draw/extent.hpp"
#include "draw/painter.hpp"

namespace piblocks {
namespace {

/// A kind of rows.
struct RowCover {
  std::array<Cover, 2> of;                ///< what each of two blocks covers of it
  std::array<std::size_t, 2> inset;       ///< the number of each block's inset
  std::array<std::size_t, 2> alike = {};  ///< the first kind of which a block covers the same
};

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
    const std::array<Cover, 2> cover{blocks_[0].of_row(y), blocks_[1].of_row(y)};
    // Most rows are like the one above.
    for (std::size_t kind = rows_.size(); kind-- > 0;) {
      if (rows_[kind].of == cover) return kind;
    }
    RowCover row{cover,
                 {number_of(cover[0].inset, insets_[0]), number_of(cover[1].inset, insets_[1])}};
    for (std::size_t i = 0; i < 2; ++i) {
      const auto is_alike = [&](const RowCover& other) { return other.of[i] == cover[i]; };
      row.alike[i] =
          static_cast<std::size_t>(std::ranges::find_if(rows_, is_alike) - rows_.begin());
    }
    rows_.push_back(row);
    known_.emplace_back();
    return rows_.size() - 1;
  }

  /// Whether rows of both kinds are alike in columns that are not beside an end.
  bool are_alike_inside(std::size_t kind, std::size_t other) const {
    const auto is_alike = [](Cover a, const Cover& b) {
      a.inset = b.inset;
      return a == b;
    };
    return is_alike(rows_[kind].of[0], rows_[other].of[0]) &&
           is_alike(rows_[kind].of[1], rows_[other].of[1]);
  }

  /// Whether the column is beside an end of a block, where corners are.
  bool is_beside_end() const { return is_beside_end_[0] || is_beside_end_[1]; }

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
      const bool was_beside_end = std::exchange(is_beside_end_[i], blocks_[i].is_beside_end(x));
      is_new |= was_beside_end != is_beside_end_[i];
      shares_[i].resize(insets_[i].size());
      for (std::size_t n = 0; n < (is_beside_end_[i] ? insets_[i].size() : 1); ++n) {
        std::span<const CoverShare> shares;
        if (are_here[i]) shares = blocks_[i].shares_of_column(x, insets_[i][n]);
        is_new |= replace(shares_[i][n], shares);
      }
    }
    if (is_new) std::ranges::fill(known_, std::nullopt);
    return !shares_[0][0].empty() || !shares_[1][0].empty();
  }

  /// The pixel of a row over a background; both 0x00RRGGBB.
  std::uint32_t pixel(std::size_t kind, std::uint32_t background) {
    // Where only one block is, the other does not matter.
    if (contacts_.empty() && shares_[0][0].empty()) kind = rows_[kind].alike[1];
    if (contacts_.empty() && shares_[1][0].empty()) kind = rows_[kind].alike[0];
    std::optional<Known>& known = known_[kind];
    if (known && known->background == background) return known->pixel;
    const Rgb lights = lights_of(rows_[kind], background);
    std::uint32_t pixel = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      pixel |= std::uint32_t{light_.sample(lights[i])} << (16 - 8 * i);
    }
    known = {background, pixel};
    return pixel;
  }

 private:
  static bool is_in(const PixelRect& pixels, int x) {
    return pixels.x_px <= x && x < pixels.right_px();
  }

  static std::size_t number_of(double inset, std::vector<double>& insets) {
    const auto found = std::ranges::find(insets, inset);
    const auto number = static_cast<std::size_t>(found - insets.begin());
    if (found == insets.end()) insets.push_back(inset);
    return number;
  }

  /// @returns whether that changes anything
  static bool replace(std::vector<CoverShare>& shares, std::span<const CoverShare> by) {
    if (std::ranges::equal(shares, by)) return false;
    shares.assign(by.begin(), by.end());
    return true;
  }

  /// Each block changes the light behind it by its share of time. Where both are in one pixel at
  /// the same time, these changes do not add up: contacts correct that.
  Rgb lights_of(const RowCover& row, std::uint32_t background) const {
    constexpr std::array kChannels{&Color::red, &Color::green, &Color::blue};
    Rgb samples{};
    Rgb plain{};
    for (std::size_t i = 0; i < 3; ++i) {
      samples[i] = background >> (16 - 8 * i) & 0xFF;
      plain[i] = light_.of(samples[i]);
    }
    Rgb sums = plain;
    const std::array<const ExposedBlock*, 2> blocks{&item_.behind, &item_.front};
    for (std::size_t n = 0; n < 2; ++n) {
      for (const auto& [cover, share] : shares_[n][is_beside_end_[n] ? row.inset[n] : 0]) {
        const PixelCover pixel(*blocks[n], cover, row.of[n]);
        for (std::size_t i = 0; i < 3; ++i) {
          sums[i] += share * (light_.of(pixel.over(samples[i], kChannels[i])) - plain[i]);
        }
      }
    }
    for (const auto& [behind_x, front_x, share] : contacts_) {
      const PixelCover behind(item_.behind, blocks_[0].of_column(x_, behind_x, row.of[0].inset),
                              row.of[0]);
      const PixelCover front(item_.front, blocks_[1].of_column(x_, front_x, row.of[1].inset),
                             row.of[1]);
      for (std::size_t i = 0; i < 3; ++i) {
        const double only_behind = behind.over(samples[i], kChannels[i]);
        const double only_front = front.over(samples[i], kChannels[i]);
        const double both = front.over(only_behind, kChannels[i]);
        sums[i] +=
            share * (light_.of(both) - light_.of(only_behind) - light_.of(only_front) + plain[i]);
      }
    }
    return sums;
  }

  const ExposedBlocksItem& item_;
  const Light& light_;
  // Of both blocks.
  std::array<BlockCover, 2> blocks_;
  std::array<PixelRect, 2> pixels_;
  std::array<std::vector<double>, 2> insets_{{{0.0}, {0.0}}};
  std::array<std::vector<std::vector<CoverShare>>, 2> shares_;  // for each inset
  std::array<bool, 2> is_beside_end_{};
  std::vector<RowCover> rows_;  // of each kind
  std::span<const TouchingBlocks> contacts_;
  int x_ = 0;
  struct Known {
    std::uint32_t background = 0;
    std::uint32_t pixel = 0;
  };
  std::vector<std::optional<Known>> known_;  // of each kind, in this column and those before
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
      add(runs_, x);
      if (!column.is_beside_end()) add(inner_runs_, x);
      for (const auto& [y, kind, is_alike_inside] : unlike_) {
        if (is_alike_inside && !column.is_beside_end()) continue;
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
    bool is_alike_inside = false;  // where columns are not beside an end
  };

  static void add(std::vector<PixelRun>& runs, int x) {
    if (runs.empty() || runs.back().end != x) runs.push_back({x, x});
    runs.back().end = x + 1;
  }

  const std::uint32_t* background_row(std::size_t y) const {
    return background_.data() + y * static_cast<std::size_t>(area_.width_px);
  }
  void find_rows(ExposedColumn& column) {
    for (std::size_t y = 0; y < rows_.size(); ++y) {
      const std::size_t kind = column.kind_of_row(area_.y_px + static_cast<int>(y));
      const bool has_background_above =
          y > 0 &&
          std::equal(background_row(y), background_row(y) + area_.width_px, background_row(y - 1));
      if (has_background_above && kind == unlike_.back().kind) continue;
      const bool is_alike_inside =
          has_background_above && column.are_alike_inside(kind, unlike_.back().kind);
      unlike_.push_back({y, kind, is_alike_inside});
    }
  }
  void copy_rows() {
    for (std::size_t i = 0; i < unlike_.size(); ++i) {
      if (unlike_[i].is_alike_inside) copy_from_above(unlike_[i].y, inner_runs_);
      const std::size_t end = i + 1 < unlike_.size() ? unlike_[i + 1].y : rows_.size();
      for (std::size_t y = unlike_[i].y + 1; y < end; ++y) copy_from_above(y, runs_);
    }
  }
  void copy_from_above(std::size_t y, const std::vector<PixelRun>& runs) {
    const std::uint32_t* const above = rows_[y - 1];
    for (const PixelRun& run : runs) {
      std::copy(above + run.begin, above + run.end, rows_[y] + run.begin);
    }
  }

  PixelRect area_;
  std::vector<std::uint32_t>& background_;  // row by row
  std::vector<std::uint32_t*> rows_;
  std::vector<Row> unlike_;     // the row above, in what the blocks cover or in the background
  std::vector<PixelRun> runs_;  // with blocks in them
  std::vector<PixelRun> inner_runs_;  // of these, not beside an end of a block
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
