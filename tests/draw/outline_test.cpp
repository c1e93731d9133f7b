// Outlines of lines and circles as pixels, against the distance of each pixel from the line.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "draw/cairo_calls.hpp"
#include "draw/painter.hpp"
#include "support/traced_random.hpp"

namespace piblocks {
namespace {

constexpr int kSide_px = 96;

/// How much of each pixel the polygons cover, 0 … 255.
class Coverage {
 public:
  template <typename Add>
  explicit Coverage(const Add& add)
      : surface_(image_surface(CAIRO_FORMAT_A8, kSide_px, kSide_px, "test")) {
    const CairoPtr cr(cairo_create(surface_.get()));
    add(*cr);
    cairo_fill(cr.get());
    cairo_surface_flush(surface_.get());
  }
  int at(int x, int y) const {
    return cairo_image_surface_get_data(
        surface_.get())[y * cairo_image_surface_get_stride(surface_.get()) + x];
  }
  /// In pixels.
  double area() const {
    double sum = 0;
    for (int y = 0; y < kSide_px; ++y) {
      for (int x = 0; x < kSide_px; ++x) sum += at(x, y) / 255.0;
    }
    return sum;
  }

 private:
  CairoSurfacePtr surface_;
};

Coverage line(const std::vector<Point>& points, bool closed, double width_px, double dash_px = 0) {
  return Coverage([&](cairo_t& cr) { add_line_outline(cr, points, closed, width_px, dash_px); });
}

double distance(const Point& a, const Point& b) { return std::hypot(a.x - b.x, a.y - b.y); }

/// From a point to a piece of a line.
double distance(const Point& p, const Point& a, const Point& b) {
  const double dx = b.x - a.x;
  const double dy = b.y - a.y;
  const double along =
      std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / (dx * dx + dy * dy), 0.0, 1.0);
  return std::hypot(p.x - a.x - along * dx, p.y - a.y - along * dy);
}

std::vector<Point> random_points(Random& random, std::int64_t count) {
  std::vector<Point> points;
  for (std::int64_t i = 0; i < count; ++i) {
    points.push_back(
        {double(random.integer(120, 840)) / 10, double(random.integer(120, 840)) / 10});
  }
  return points;
}

/// Every pixel that is certainly within the line is full, and every one outside is empty. Flat ends
/// are the exception: around them nothing is expected.
void expect_line(const std::vector<Point>& points, bool closed, double width_px) {
  const Coverage covered = line(points, closed, width_px);
  const std::size_t pieces = closed ? points.size() : points.size() - 1;
  for (int y = 0; y < kSide_px; ++y) {
    for (int x = 0; x < kSide_px; ++x) {
      const Point p{x + 0.5, y + 0.5};
      double nearest = 1e9;
      for (std::size_t i = 0; i < pieces; ++i) {
        nearest = std::min(nearest, distance(p, points[i], points[(i + 1) % points.size()]));
      }
      const double from_end =
          closed ? 1e9 : std::min(distance(p, points.front()), distance(p, points.back()));
      if (from_end < width_px / 2 + 1) continue;
      if (nearest < width_px / 2 - 0.75) {
        EXPECT_EQ(covered.at(x, y), 255) << x << ", " << y;
      }
      if (nearest > width_px / 2 + 0.75) {
        EXPECT_EQ(covered.at(x, y), 0) << x << ", " << y;
      }
    }
  }
}

TEST(Outline, OfRandomLinesCoversThemAndNothingElse) {
  TracedRandom random(5);
  for (int i = 0; i < 60 && !::testing::Test::HasFailure(); ++i) {
    const std::vector<Point> points = random_points(random, random.integer(2, 9));
    SCOPED_TRACE(i);
    expect_line(points, points.size() > 2 && random.integer(0, 1) == 1,
                double(random.integer(10, 200)) / 10);
  }
}

TEST(Outline, TurnsBackWithARoundEnd) {
  const std::vector<Point> there_and_back{{20, 48}, {70, 48}, {20, 48}};
  expect_line(there_and_back, false, 20);
  const std::vector<Point> nearly{{20, 48}, {70, 48}, {20, 48.01}};
  expect_line(nearly, false, 20);
  EXPECT_EQ(line(there_and_back, false, 20).at(78, 48), 255);
}

TEST(Outline, HasFlatEnds) {
  const Coverage covered = line({{20, 48}, {70, 48}}, false, 10);
  EXPECT_EQ(covered.area(), 500);
  EXPECT_EQ(covered.at(19, 48), 0);
  EXPECT_EQ(covered.at(20, 48), 255);
}

TEST(Outline, OfWhatIsNoLineIsEmpty) {
  EXPECT_EQ(line({}, false, 10).area(), 0);
  EXPECT_EQ(line({{20, 20}}, true, 10).area(), 0);
  EXPECT_EQ(line({{20, 20}, {20, 20}, {20, 20}}, true, 10).area(), 0);
}

TEST(Outline, DoesNotDependOnRepeatedPoints) {
  const Coverage once = line({{20, 20}, {70, 30}, {40, 80}}, true, 7);
  const Coverage twice =
      line({{20, 20}, {20, 20}, {70, 30}, {40, 80}, {40, 80}, {20, 20}}, true, 7);
  for (int y = 0; y < kSide_px; ++y) {
    for (int x = 0; x < kSide_px; ++x) EXPECT_EQ(once.at(x, y), twice.at(x, y));
  }
}

/// Dashes and gaps of 5 over 50: five dashes.
TEST(Outline, HasDashes) {
  const Coverage covered = line({{20, 48}, {45, 48}, {70, 48}}, false, 4, 5);
  EXPECT_EQ(covered.area(), 5 * 5 * 4);
  for (int x = 20; x < 70; ++x) {
    EXPECT_EQ(covered.at(x, 48), (x - 20) / 5 % 2 == 0 ? 255 : 0) << x;
  }
}

/// Around a square of 40 there are 16 dashes of 5, which begin in a corner.
TEST(Outline, HasDashesAroundCorners) {
  const Coverage covered = line({{20, 20}, {60, 20}, {60, 60}, {20, 60}}, true, 2, 5);
  EXPECT_EQ(covered.at(22, 20), 255);
  EXPECT_EQ(covered.at(27, 20), 0);
  EXPECT_EQ(covered.at(19, 26), 255);
  EXPECT_EQ(covered.at(19, 23), 0);
  EXPECT_NEAR(covered.area(), 16 * 5 * 2, 0.1);
}

TEST(Outline, OfACircleIsRound) {
  for (const double radius : {0.5, 3.0, 12.5, 40.0}) {
    const Coverage disc([&](cairo_t& cr) { add_circle(cr, {48, 48}, radius); });
    EXPECT_NEAR(disc.area(), M_PI * radius * radius, 0.02 * (1 + 2 * M_PI * radius)) << radius;
    for (int y = 0; y < kSide_px; ++y) {
      for (int x = 0; x < kSide_px; ++x) {
        const double distance = std::hypot(x + 0.5 - 48, y + 0.5 - 48);
        if (distance < radius - 0.75) {
          EXPECT_EQ(disc.at(x, y), 255) << radius;
        }
        if (distance > radius + 0.75) {
          EXPECT_EQ(disc.at(x, y), 0) << radius;
        }
      }
    }
  }
}

TEST(Outline, OfARingHasAHole) {
  const Coverage ring([](cairo_t& cr) {
    add_circle(cr, {48, 48}, 30);
    add_circle(cr, {48, 48}, 20, Winding::counterclockwise);
  });
  EXPECT_EQ(ring.at(48, 48), 0);
  EXPECT_EQ(ring.at(48 + 25, 48), 255);
  EXPECT_NEAR(ring.area(), M_PI * (30 * 30 - 20 * 20), 4);
}

}  // namespace
}  // namespace piblocks
