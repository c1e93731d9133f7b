// A region's rectangles against the definition of its cells, pixel by pixel.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "draw/region.hpp"
#include "support/traced_random.hpp"

namespace piblocks {
namespace {

bool is_in(const PixelRect& r, int x, int y) {
  return x >= r.x_px && x < r.right_px() && y >= r.y_px && y < r.bottom_px();
}

/// What a Region says of a picture, pixel by pixel, against the definition of its cells.
class BruteRegion {
 public:
  BruteRegion(int width_px, int height_px) : width_px_(width_px), height_px_(height_px) {}

  void add(const PixelRect& rect) { added_.push_back(rect); }
  /// Whether the pixel is in the least rectangle around its cell's pixels that were added.
  bool contains(int x, int y) const {
    const int left = x / Region::kCell_px * Region::kCell_px;
    const int top = y / Region::kCell_px * Region::kCell_px;
    int from_x = width_px_;
    int from_y = height_px_;
    int to_x = -1;
    int to_y = -1;
    for (int cell_y = top; cell_y < std::min(top + Region::kCell_px, height_px_); ++cell_y) {
      for (int cell_x = left; cell_x < std::min(left + Region::kCell_px, width_px_); ++cell_x) {
        const auto has_pixel = [&](const PixelRect& rect) { return is_in(rect, cell_x, cell_y); };
        if (std::ranges::none_of(added_, has_pixel)) continue;
        from_x = std::min(from_x, cell_x);
        from_y = std::min(from_y, cell_y);
        to_x = std::max(to_x, cell_x);
        to_y = std::max(to_y, cell_y);
      }
    }
    return x >= from_x && x <= to_x && y >= from_y && y <= to_y;
  }

 private:
  int width_px_;
  int height_px_;
  std::vector<PixelRect> added_;
};

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
    BruteRegion brute(width_px, height_px);
    for (int count = integer(random, 0, 6); count > 0; --count) {
      const PixelRect rect = random_rect(random, width_px, height_px);
      region.add(rect);
      brute.add(rect);
    }
    const auto rects = region.rects();
    for (int y = 0; y < height_px; ++y) {
      for (int x = 0; x < width_px; ++x) {
        const auto has_pixel = [&](const PixelRect& rect) { return is_in(rect, x, y); };
        ASSERT_EQ(std::ranges::count_if(rects, has_pixel), brute.contains(x, y) ? 1 : 0)
            << "pixel " << x << ", " << y << " of " << width_px << "x" << height_px;
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
