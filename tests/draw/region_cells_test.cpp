// A region's rectangles against the definition of its cells, pixel by pixel.
#include <gtest/gtest.h>

#include <algorithm>
#include <span>
#include <vector>

#include "draw/region.hpp"
#include "support/traced_random.hpp"

namespace piblocks {
namespace {

bool is_in(const PixelRect& r, int x, int y) {
  return x >= r.x_px && x < r.right_px() && y >= r.y_px && y < r.bottom_px();
}

/// How many of the rectangles have the pixel.
std::ptrdiff_t count_at(std::span<const PixelRect> rects, int x, int y) {
  return std::ranges::count_if(rects, [&](const PixelRect& rect) { return is_in(rect, x, y); });
}

/// By the definition: the least rectangle around the pixels of a cell that are in `added`.
PixelRect least_rect(const PixelRect& cell, std::span<const PixelRect> added) {
  int from_x = cell.right_px();
  int from_y = cell.bottom_px();
  int to_x = -1;
  int to_y = -1;
  for (int y = cell.y_px; y < cell.bottom_px(); ++y) {
    for (int x = cell.x_px; x < cell.right_px(); ++x) {
      if (count_at(added, x, y) == 0) continue;
      from_x = std::min(from_x, x);
      from_y = std::min(from_y, y);
      to_x = std::max(to_x, x);
      to_y = std::max(to_y, y);
    }
  }
  return {from_x, from_y, to_x - from_x + 1, to_y - from_y + 1};
}

/// Compares what a Region says of one of its cells, pixel by pixel.
void expect_cell(std::span<const PixelRect> rects, const PixelRect& cell,
                 std::span<const PixelRect> added) {
  const PixelRect wanted = least_rect(cell, added);
  for (int y = cell.y_px; y < cell.bottom_px(); ++y) {
    for (int x = cell.x_px; x < cell.right_px(); ++x) {
      ASSERT_EQ(count_at(rects, x, y), is_in(wanted, x, y) ? 1 : 0) << "pixel " << x << ", " << y;
    }
  }
}

int integer(Random& random, int first, int last) {
  return static_cast<int>(random.integer(first, last));
}

PixelRect random_rect(Random& random, int width_px, int height_px) {
  const int x = integer(random, 0, width_px - 1);
  const int y = integer(random, 0, height_px - 1);
  return {x, y, integer(random, 0, width_px - x), integer(random, 0, height_px - y)};
}

TEST(RegionCells, AreTheLeastRectanglesAndNoPixelIsInTwo) {
  TracedRandom random(17);
  for (std::int64_t i = 0; i < many(300); ++i) {
    const int width_px = integer(random, 1, 90);
    const int height_px = integer(random, 1, 70);
    Region region(width_px, height_px);
    // What was there before clear() leaves nothing.
    region.add(random_rect(random, width_px, height_px));
    region.clear();
    std::vector<PixelRect> added;
    for (int count = integer(random, 0, 6); count > 0; --count) {
      added.push_back(random_rect(random, width_px, height_px));
      region.add(added.back());
    }
    const auto rects = region.rects();
    SCOPED_TRACE(testing::Message() << width_px << "x" << height_px);
    for (int y = 0; y < height_px; y += Region::kCell_px) {
      for (int x = 0; x < width_px; x += Region::kCell_px) {
        const PixelRect cell = {x, y, std::min(Region::kCell_px, width_px - x),
                                std::min(Region::kCell_px, height_px - y)};
        ASSERT_NO_FATAL_FAILURE(expect_cell(rects, cell, added));
      }
    }
  }
}

TEST(RegionCells, OfOneRectangleAreThatRectangle) {
  Region region(1920, 1080);
  for (const PixelRect& rect : {PixelRect{0, 0, 1920, 1080},
                                {3, 5, 1, 1},
                                {15, 15, 2, 2},
                                {100, 200, 3, 700},
                                {1919, 1079, 1, 1}}) {
    region.clear();
    region.add(rect);
    const auto rects = region.rects();
    ASSERT_EQ(rects.size(), 1U);
    EXPECT_EQ(rects.front(), rect);
  }
}

TEST(RegionCells, WithoutAnyHaveNoRectangles) {
  Region region(100, 100);
  EXPECT_TRUE(region.rects().empty());
  region.add({5, 5, 0, 10});
  EXPECT_TRUE(region.rects().empty());
}

}  // namespace
}  // namespace piblocks
