// Two blocks while the picture is exposed.
// In: the blocks at one instant, and where they are for which share of the time. Out: a draw item;
// and its pixels, column by column, as their mean in linear light.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "draw/draw_list.hpp"
#include "draw/light.hpp"

namespace piblocks {

struct Layout;
struct WeightedExposure;

/// @param red, blue  at the picture's instant, without dwells
ExposedItem exposed_item(ExposedBlock red, ExposedBlock blue, const Layout& layout,
                         std::span<const WeightedExposure> exposures);

/// Adds a block that stays: a rectangle for it, and one for each of its bars.
void add_rectangles(ItemId id, const ExposedBlock& block, std::vector<DrawItem>& items);

/// How much of a row or column of pixels a block covers: all of it, inside its line, its bars.
struct Cover {
  double outer = 0;
  double inner = 0;
  double bars = 0;
  bool operator==(const Cover&) const = default;
};

/// What both blocks cover of a row.
struct RowCover {
  Cover behind;
  Cover front;
  bool operator==(const RowCover&) const = default;
};

/// How a block covers a row, and a column over the time of the exposure.
class BlockCover {
 public:
  explicit BlockCover(const ExposedBlock& block);

  Cover of_row(int y) const;
  /// What a block with its left edge at `x` covers of the column from `column` to `column` + 1.
  Cover of_column(double column, double x) const;

  struct Share {
    Cover cover;
    double share = 0;
  };
  /// All ways in which the block covers a column; valid until the next call.
  std::span<const Share> shares_of_column(double column);

 private:
  void add_alike(double column, double from, double to);
  void add_each(double column, double from, double to);
  std::size_t first_at(double x) const;

  const ExposedBlock& block_;
  double line_px_;
  std::vector<double> sums_;  // of the shares before each dwell
  std::vector<Share> shares_;
};

/// One column after another.
class ExposedColumn {
 public:
  ExposedColumn(const ExposedItem& item, const Light& light)
      : item_(item), light_(light), behind_(item.behind), front_(item.front) {}

  RowCover row_cover(int y) const { return {behind_.of_row(y), front_.of_row(y)}; }
  /// Turns to the column from `x` to `x` + 1. False if no block is ever in it.
  bool enter(int x);
  /// The pixel of a row over a background; both 0x00RRGGBB.
  std::uint32_t pixel(const RowCover& row, std::uint32_t background);

 private:
  double light_of(const RowCover& row, double background, std::uint8_t Color::*channel) const;

  const ExposedItem& item_;
  const Light& light_;
  BlockCover behind_;
  BlockCover front_;
  std::span<const BlockCover::Share> behind_shares_;
  std::span<const BlockCover::Share> front_shares_;
  std::span<const Contact> contacts_;
  int x_ = 0;
  struct Known {
    RowCover row;
    std::uint32_t background = 0;
    std::uint32_t pixel = 0;
  };
  std::vector<Known> known_;  // of this column
};

}  // namespace piblocks
