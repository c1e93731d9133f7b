// The panels 'unfolded' and 'mirrors': every crossing in its place, counted, named, inside.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "draw/composed_pictures.hpp"
#include "draw/look.hpp"
#include "scene/schedule.hpp"

namespace piblocks {
namespace {

struct UnfoldedPictures : Pictures {
  UnfoldedPictures(int digits, const Settings& settings)
      : Pictures(digits,
                 Settings{{"view.theme", "lecture"}, {"show.panels", "unfolded"}} + settings) {}

  DrawList after(const Integer& index) const { return at(log->time_after(index)); }
  Rational end() const { return span_of(scene, *log).to; }
};

/// Of the crossings.
std::vector<DiscItem> dots_of(const DrawList& list) {
  std::vector<DiscItem> discs = Shown(list).discs;
  const Color present = palette_of(Theme::lecture).accent;
  std::erase_if(discs, [&](const DiscItem& disc) { return disc.fill == present; });
  return discs;
}

std::optional<DiscItem> present_of(const DrawList& list) {
  const std::vector<DiscItem> discs = Shown(list).discs;
  const Color present = palette_of(Theme::lecture).accent;
  if (discs.empty() || discs.back().fill != present) return std::nullopt;
  return discs.back();
}

/// Lines of two points that begin in one place: the corner.
std::vector<PathItem> rays_of(const DrawList& list) {
  std::vector<PathItem> paths = Shown(list).paths;
  std::erase_if(paths, [](const PathItem& path) {
    const auto points = path.points.view();
    return path.closed || points.size() != 2 || points[0].y == points[1].y;
  });
  return paths;
}

std::optional<PathItem> wedge_of(const DrawList& list) {
  for (const PathItem& path : Shown(list).paths) {
    if (path.closed && path.points.view().size() > 2 && path.id > ItemId::panels) {
      if (path.fill && path.fill != palette_of(Theme::lecture).muted) return path;
    }
  }
  return std::nullopt;
}

/// The map back from the picture, found from two instants: positions along the line, seen from
/// its point next to the corner.
struct Plane {
  explicit Plane(const UnfoldedPictures& pictures) {
    const TwoBlocks system = *two_blocks_of(pictures.scene.system);
    const double sigma = std::sqrt(to_double(system.blue.mass / system.red.mass));
    theta = std::atan(sigma);
    const double y1 = to_double(system.blue_gap());
    const double y2 = y1 + to_double(system.blocks_gap());
    const double x = std::cos(theta) * y2;
    const double y = std::sin(theta) * y1;
    const double vx = std::cos(theta) * to_double(system.red.velocity);
    const double vy = std::sin(theta) * to_double(system.blue.velocity);
    const double speed = std::hypot(vx, vy);
    const double turning = x * vy - y * vx;
    height = std::abs(turning) / speed;
    sign = turning < 0 ? 1 : -1;
    start_angle = std::atan2(y, x);
    // Two instants at which the point is seen.
    const double t_a = to_double(*turn_of(system)) - 0.25;
    const double t_b = t_a + 0.5;
    const double x_a = present_of(pictures.at(Rational(t_a)))->centre.x;
    const double x_b = present_of(pictures.at(Rational(t_b)))->centre.x;
    scale = (x_b - x_a) / (t_b - t_a) / (sign * speed);
    foot_x = (x_a + x_b) / 2;
  }
  double along(const Point& dot) const { return (dot.x - foot_x) / scale; }
  double distance(const Point& dot) const { return std::hypot(along(dot), height); }
  /// Counter-clockwise from the base, to the right of the corner.
  double angle(const Point& dot) const { return std::atan2(height, along(dot)); }

  double theta;
  double height;
  double sign;
  double start_angle;
  double scale;
  double foot_x;
};

const std::vector<Settings>& systems() {
  static const std::vector<Settings> kSystems = {
      {},
      {{"red.mass", "7"}},
      {{"red.mass", "3"}},
      {{"red.mass", "1/5"}},
      {{"blue.velocity", "1/2"}, {"red.mass", "60"}},
      {{"blue.velocity", "-1/2"}, {"red.mass", "40"}},
      {{"blue.velocity", "-3"}, {"red.velocity", "0"}, {"red.mass", "9"}, {"time.to", "3"}}};
  return kSystems;
}

TEST(Unfolded, ADotIsWhereTheLineMeetsEachMirror) {
  for (const Settings& settings : systems()) {
    const UnfoldedPictures pictures(2, settings);
    const Plane plane(pictures);
    const std::vector<DiscItem> dots = dots_of(pictures.at(pictures.end()));
    ASSERT_EQ(Integer(static_cast<unsigned long>(dots.size())),
              pictures.log->state_at(pictures.end()).count);
    ASSERT_GT(dots.size(), 1U);
    double before = 0;
    for (std::size_t i = 0; i < dots.size(); ++i) {
      const Integer k(static_cast<unsigned long>(i) + 1);
      const PairCollision collision = pictures.log->blocks_collision(k);
      const Gaps gaps = pictures.log->gaps_at_collision(k);
      EXPECT_NEAR(plane.distance(dots[i].centre),
                  std::hypot(std::cos(plane.theta) * gaps.y2, std::sin(plane.theta) * gaps.y1),
                  1e-9)
          << k;
      const double angle = plane.angle(dots[i].centre);
      if (i > 0) {
        EXPECT_NEAR(angle - before, -plane.sign * plane.theta, 1e-9) << k;
      }
      before = angle;
      const Palette palette = palette_of(Theme::lecture);
      const bool is_wall = collision.kind == CollisionKind::wall;
      EXPECT_EQ(dots[i].fill, is_wall ? palette.blue.line : palette.red.line) << k;
    }
  }
}

TEST(Unfolded, TheMirrorOfCollisionKIsAtKTimesTheta) {
  for (const char* mass : {"1", "3", "7", "100", "1600", "2500", "1000000"}) {
    const UnfoldedPictures pictures(2, {{"red.mass", mass}});
    const Plane plane(pictures);
    const DrawList list = pictures.at(pictures.end());
    const std::vector<DiscItem> dots = dots_of(list);
    const std::vector<PathItem> rays = rays_of(list);
    ASSERT_EQ(rays.size(), dots.size());
    const bool is_thinned = pictures.log->last() > 128;
    for (std::size_t i = 0; i < dots.size(); ++i) {
      const double angle = plane.angle(dots[i].centre);
      const double k = is_thinned ? std::round(angle / plane.theta) : double(i + 1);
      EXPECT_NEAR(angle, k * plane.theta, 1e-9) << mass;
      // The ray goes through the dot.
      const Point& corner = rays[i].points.view()[0];
      const Point& end = rays[i].points.view()[1];
      const double at_line =
          corner.x + (end.x - corner.x) * (dots[i].centre.y - corner.y) / (end.y - corner.y);
      EXPECT_NEAR(at_line, dots[i].centre.x, 1e-6) << mass;
      EXPECT_NEAR(plane.foot_x, corner.x, 1e-6);
    }
  }
}

TEST(Unfolded, DotsComeWithTheirCollisionsAndStay) {
  const UnfoldedPictures pictures(2, {});
  std::vector<DiscItem> before;
  for (int count = 1; count <= 31; ++count) {
    const std::vector<DiscItem> dots = dots_of(pictures.after(count));
    ASSERT_EQ(dots.size(), static_cast<std::size_t>(count));
    EXPECT_TRUE(std::ranges::equal(before, std::span(dots).first(before.size())));
    before = dots;
  }
}

TEST(Unfolded, ManyMirrorsAreThinnedButTrue) {
  for (const int digits : {3, 6, 12, 20, 40}) {
    const UnfoldedPictures pictures(digits, {});
    const Plane plane(pictures);
    const std::vector<DiscItem> dots = dots_of(pictures.at(pictures.end()));
    ASSERT_GT(dots.size(), 20U) << digits;
    ASSERT_LT(dots.size(), 600U) << digits;
    const Integer last = pictures.log->last();
    const auto distance = [&](const Integer& k) {
      const Gaps gaps = pictures.log->gaps_at_collision(k);
      return std::hypot(std::cos(plane.theta) * gaps.y2, std::sin(plane.theta) * gaps.y1);
    };
    for (std::size_t i = 0; i < 4; ++i) {
      const Integer n(static_cast<unsigned long>(i));
      const Point& late = dots[dots.size() - 1 - i].centre;
      EXPECT_NEAR(plane.distance(dots[i].centre), distance(1 + n), 1e-9) << digits;
      EXPECT_NEAR(plane.distance(late), distance(last - n), 1e-9) << digits;
      EXPECT_LT(plane.along(late), 0) << digits;
    }
    for (std::size_t i = 1; i < dots.size(); ++i) {
      EXPECT_LT(dots[i].centre.x, dots[i - 1].centre.x) << digits;
      EXPECT_NE(dots[i].fill, dots[i - 1].fill) << digits << ": both kinds take turns";
    }
  }
}

TEST(Unfolded, ThePresentIsInTheWedgeBetweenItsMirrors) {
  for (const Settings& settings : systems()) {
    const UnfoldedPictures pictures(2, settings);
    for (int i = 0; i <= 60; ++i) {
      const DrawList list = pictures.at(pictures.end() * i / 60);
      const auto present = present_of(list);
      const auto wedge = wedge_of(list);
      ASSERT_TRUE(wedge);
      if (!present) continue;
      // The wedge's two sides, at the height of the line.
      const auto points = wedge->points.view();
      const Point& corner = points.front();
      const auto side_x = [&](const Point& end) {
        if (end.y == corner.y) return end.x > corner.x ? 1e9 : -1e9;
        return corner.x + (end.x - corner.x) * (present->centre.y - corner.y) / (end.y - corner.y);
      };
      EXPECT_LE(present->centre.x, side_x(points[1]) + 1e-6) << i;
      EXPECT_GE(present->centre.x, side_x(points.back()) - 1e-6) << i;
    }
  }
}

TEST(Unfolded, TheTitleSaysInTheEndHowManyMirrorsAndWhy) {
  const auto words_at = [](int digits, const Settings& settings, bool is_end) {
    const UnfoldedPictures pictures(digits, settings);
    return Shown(pictures.at(is_end ? pictures.end() : Rational(1))).words();
  };
  const auto says = [&](int digits, const Settings& settings, const char* what) {
    EXPECT_EQ(words_at(digits, settings, false).find(what), std::string::npos) << "too early";
    const std::string text = words_at(digits, settings, true);
    EXPECT_NE(text.find(what), std::string::npos) << what << " is not in " << text;
  };
  says(2, {}, "31 equal angles ");
  says(2, {}, " fit into half a turn, which is π: π/");
  says(2, {}, " ≈ 10π = 31.4…");
  says(3, {}, "314 equal angles ");
  says(3, {}, " ≈ 100π = 314.1…");
  says(5, {}, "31,415 equal angles ");
  says(1, {{"red.mass", "7"}}, " = 8.6…");      // π/arctan(1/√7) = 8.69
  says(1, {{"red.mass", "1000"}}, " = 99.3…");  // π/arctan(1/√1000) = 99.379
  says(2, {{"base", "2"}}, "110 equal angles ");
  EXPECT_EQ(words_at(2, {{"base", "2"}}, true).find("≈ 10π"), std::string::npos);
  // Here π/θ is 4, 6 and 3, and the line is parallel to the last mirror.
  for (const auto& [mass, count] : {std::pair("1", "3"), {"3", "5"}, {"1/3", "2"}}) {
    const std::string text = words_at(1, {{"red.mass", mass}}, true);
    EXPECT_NE(text.find(std::string("crosses ") + count + " mirrors"), std::string::npos) << text;
    EXPECT_EQ(text.find("half a turn"), std::string::npos) << text;
  }
  for (const Settings& settings : systems()) {
    const UnfoldedPictures pictures(2, settings);
    const std::string text = Shown(pictures.after(pictures.log->last())).words();
    const std::string count = pictures.log->last().get_str();
    const bool says_count = text.find(count + " mirror") != std::string::npos ||
                            text.find(count + " equal angles") != std::string::npos;
    EXPECT_TRUE(says_count) << text;
  }
  const std::string many = words_at(20, {{"view.size", "1080x1920"}}, false);
  EXPECT_NE(many.find("mirrors drawn"), std::string::npos);
}

TEST(Unfolded, AnglesAreTrueWhereTheCrossingsHaveRoom) {
  for (const auto& [digits, size, is_true] : {std::tuple(2, "1280x720", true),
                                              {2, "1920x1080", true},
                                              {2, "1080x1920", true},
                                              {2, "1080x1080", true},
                                              {1, "1280x720", true},
                                              {3, "1920x1080", false}}) {
    const UnfoldedPictures pictures(digits, {{"view.size", size}});
    const DrawList list = pictures.at(pictures.end());
    EXPECT_EQ(Shown(list).words().find("not to scale") == std::string::npos, is_true) << size;
    if (!is_true) continue;
    const Plane plane(pictures);
    const std::vector<DiscItem> dots = dots_of(list);
    const std::vector<PathItem> rays = rays_of(list);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const Point& corner = rays[i].points.view()[0];
      const Point& end = rays[i].points.view()[1];
      const double angle = std::atan2(corner.y - end.y, end.x - corner.x);
      EXPECT_NEAR(angle, double(i + 1) * plane.theta, 1e-9) << size;
      // A mirror is seen at least as far as the path crosses it.
      EXPECT_GE(length(end - corner), length(dots[i].centre - corner) - 1e-6) << size;
      EXPECT_GT(dots[i].centre.x, 0) << size;
      EXPECT_LT(dots[i].centre.x, list.width_px) << size;
    }
  }
}

TEST(Unfolded, SaysTheAngle) {
  const auto has = [](const char* mass, const char* angle) {
    const std::string text = Shown(UnfoldedPictures(1, {{"red.mass", mass}}).at(1)).words();
    return text.find(angle) != std::string::npos;
  };
  EXPECT_TRUE(has("100", "≈ 1/10"));
  EXPECT_TRUE(has("2500", "≈ 1/50"));
  EXPECT_TRUE(has("1", "≈ 0.785"));
  EXPECT_TRUE(has("7", "≈ 0.361"));
  EXPECT_TRUE(has("16", "≈ 0.245")) << "1/4 is not good to three digits";
  EXPECT_TRUE(has("1000", "≈ 0.0316"));
  EXPECT_TRUE(has("300000000000", "≈ 1.83×10"));
}

class UnfoldedSizes : public testing::TestWithParam<const char*> {};

void expect_inside(const DrawList& list, const Rect& place) {
  const Shown shown(list);
  for (const PathItem& path : shown.paths) EXPECT_TRUE(place.holds(path.points.bounds()));
  for (const DiscItem& disc : shown.discs) {
    EXPECT_TRUE(place.holds(Rect{disc.centre.x, disc.centre.y, 0, 0}.grown(disc.radius)));
  }
}

TEST_P(UnfoldedSizes, AllIsInsideAndNoTextsMeet) {
  const Fonts fonts;
  for (const char* panel : {"unfolded", "mirrors", "unfolded,mirrors"}) {
    for (const int digits : {1, 2, 3, 20}) {
      const UnfoldedPictures pictures(digits, {{"view.size", GetParam()}, {"show.panels", panel}});
      for (int i = 0; i <= 4; ++i) {
        const DrawList list = pictures.at(pictures.end() * i / 4);
        const Shown shown(list);
        EXPECT_EQ(text_problem(boxes_of(shown.texts, fonts), whole_of(list)), "");
        ASSERT_FALSE(shown.plates.empty());
        if (std::string(panel).find(',') == std::string::npos) {
          expect_inside(list, shown.plates.front().bounds);
        }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, UnfoldedSizes,
                         testing::Values("1280x720", "3840x2160", "1080x1080", "1080x1920",
                                         "2560x1080"));

/// Where red comes from changes when it is there, and nothing else about the line. From far away
/// times are too long for pairs of doubles to tell collisions apart.
TEST(Unfolded, IsTheSameFromAnyDistance) {
  for (const char* mass : {"100", "1e12"}) {
    const auto dots_from = [&](const char* position) {
      const UnfoldedPictures pictures(1, {{"red.mass", mass},
                                          {"red.position", position},
                                          {"time.from", "turn-3"},
                                          {"time.to", "turn+3"}});
      return dots_of(pictures.at(pictures.end()));
    };
    const std::vector<DiscItem> near = dots_from("8");
    EXPECT_GT(near.size(), 20U);
    for (const char* position : {"1e20", "1e40", "1e300"}) {
      const std::vector<DiscItem> far = dots_from(position);
      ASSERT_EQ(far.size(), near.size()) << position;
      for (std::size_t i = 0; i < far.size(); ++i) {
        EXPECT_NEAR(far[i].centre.x, near[i].centre.x, 0.1) << position;
        EXPECT_EQ(far[i].fill, near[i].fill) << position;
      }
    }
  }
}

TEST(Unfolded, HoldsAnyScene) {
  const std::vector<Settings> extremes = {
      {{"blue.position", "1/2"}},
      {{"red.velocity", "0"}},
      {{"red.velocity", "1"}},
      {{"red.velocity", "1e-300"}},
      {{"red.position", "1e300"}, {"red.mass", "1"}},
      {{"red.position", "1e306"}, {"red.mass", "1"}},
      {{"blue.velocity", "-1"}, {"red.position", "1e150"}, {"red.velocity", "-1e150"}},
      {{"red.mass", "1e310"}, {"view.theme", "article"}}};
  for (const char* panel : {"unfolded", "mirrors"}) {
    for (const Settings& settings : extremes) {
      const UnfoldedPictures pictures(
          2, settings + Settings{{"show.panels", panel}, {"time.to", "6"}});
      for (const int time : {0, 3, 6}) {
        const DrawList list = pictures.at(time);
        EXPECT_TRUE(wedge_of(list)) << settings.front().second;
        EXPECT_TRUE(have_rising_ids(list));
      }
    }
  }
}

TEST(Mirrors, AppearWithTheirCollisions) {
  const UnfoldedPictures pictures(2, {{"show.panels", "mirrors"}});
  EXPECT_EQ(rays_of(pictures.at(0)).size(), 1U) << "the mirror that comes first";
  for (int count = 1; count <= 31; ++count) {
    EXPECT_EQ(int(rays_of(pictures.after(count)).size()), count);
    if (count == 31) break;
    const Rational next = pictures.log->time_after(count + 1);
    const Rational between = (pictures.log->time_after(count) + next) / 2;
    EXPECT_EQ(int(rays_of(pictures.at(between)).size()), count + 1);
  }
}

/// The sides of a wedge, as their places where they leave the picture.
std::pair<Point, Point> sides_of(const DrawList& list) {
  const std::optional<PathItem> wedge = wedge_of(list);
  return {wedge->points.view()[1], wedge->points.view().back()};
}

TEST(Mirrors, OpenFromTheWedgeBeforeOnTheWayToTheNextMirror) {
  constexpr double kFold = 0.4;  // of the way to the nearest mirror
  const UnfoldedPictures pictures(2, {{"show.panels", "mirrors"}});
  const auto time_of = [&](int count) { return pictures.log->time_after(count); };
  for (int count = 2; count < 31; ++count) {
    const Rational before = time_of(count) - time_of(count - 1);
    const Rational after = time_of(count + 1) - time_of(count);
    const auto sides_at = [&](double share) {
      const Rational passed = Rational(share * kFold) * std::min(before, after);
      return sides_of(pictures.at(time_of(count) + passed));
    };
    const auto [right, left] = sides_at(1);
    const auto [last_right, last_left] = sides_at(1 / kFold - 0.01);
    EXPECT_EQ(right, last_right) << count;
    EXPECT_EQ(left, last_left) << count;
    const auto folded = sides_at(0);
    const auto wedge_before = sides_of(pictures.at(time_of(count) - before / 100));
    EXPECT_NEAR(folded.first.x, wedge_before.first.x, 1e-6) << count;
    EXPECT_NEAR(folded.first.y, wedge_before.first.y, 1e-6) << count;
    EXPECT_NEAR(folded.second.x, wedge_before.second.x, 1e-6) << count;
    // Halfway it is seen edge on.
    const auto half = sides_at(0.5);
    EXPECT_NEAR(half.first.x, half.second.x, 1e-6) << count;
    EXPECT_NEAR(half.first.y, half.second.y, 1e-6) << count;
  }
}

}  // namespace
}  // namespace piblocks
