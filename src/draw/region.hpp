// A set of pixels of a picture, and what changes from one picture to the next.
// In: rectangles or draw lists. Out: disjoint rectangles around what differs, at most one in each
// cell of 16x16 pixels, joined where they continue each other.
#pragma once

#include <piblocks/image.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "draw/extent.hpp"

namespace piblocks {

/// Pixels of a picture, as a grid of cells. Each cell holds the least rectangle around those of the
/// region's pixels that are in it: so no pixel is painted or converted twice, however much the
/// rectangles overlap that were added.
class Region {
 public:
  static constexpr int kCell_px = 16;

  Region(int width_px, int height_px);

  void clear();
  /// @param rect  inside the picture
  void add(const PixelRect& rect);
  /// The region as disjoint rectangles, row of cells by row of cells, valid until the next call.
  /// The rectangles of cells beside each other are joined where that makes a rectangle.
  std::span<const PixelRect> rects();

 private:
  /// From its cell's upper left corner; empty if `right` is 0.
  struct Box {
    std::uint8_t left = 0;
    std::uint8_t top = 0;
    std::uint8_t right = 0;
    std::uint8_t bottom = 0;
  };
  /// Columns of cells, of which those outside are empty.
  struct Columns {
    int begin = 0;
    int end = 0;
  };

  Box* row(int y_cells) { return cells_.data() + std::size_t(y_cells) * std::size_t(width_cells_); }
  void add_row(int y_cells);
  /// The rectangle of the cell at `x_cells` and of those right of it that continue it.
  PixelRect run(int& x_cells, int y_cells);

  int width_cells_;
  std::vector<Box> cells_;
  std::vector<Columns> rows_;
  std::vector<PixelRect> rects_;
  // Of rects_, those that reach the lower end of the row of cells above, and of this row.
  std::vector<std::size_t> above_;
  std::vector<std::size_t> here_;
};

/// Adds every pixel in which the pictures may differ. These are all pixels if the lists have
/// neither the same ids nor rising ones.
void add_changes(const DrawList& before, const DrawList& after, const MeasureText& width_em,
                 Region& region);

}  // namespace piblocks
