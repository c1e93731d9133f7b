// The diagrams of velocities, against the log: points, chords, the end, the ellipse, room.
#include <gtest/gtest.h>
#include <piblocks/script.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "draw/composition.hpp"
#include "draw/font.hpp"
#include "draw/look.hpp"
#include "support/state_after.hpp"

namespace piblocks {
namespace {

using Setting = std::pair<const char*, std::string>;
using Settings = std::vector<Setting>;

constexpr double kMorphed_s = 10;  ///< of video: the ellipse is a circle by then

struct Pictures {
  explicit Pictures(const Settings& settings, const char* panel = "velocity")
      : scene(scene_of(settings, panel)),
        log(make_pair_log(scene.system)),
        composition(scene, *log) {}

  static Scene scene_of(const Settings& settings, const char* panel) {
    ScriptBuilder builder;
    builder.set("test", "view.theme", "lecture");
    builder.set("test", "show.panels", panel);
    for (const auto& [key, text] : settings) builder.set("test", key, text);
    return builder.build_scene();
  }

  DrawList of(const PairState& state, double video_s) const {
    FrameState shown{bodies_state(state)};
    shown.video_s = video_s;
    return composition.frame(shown);
  }
  DrawList after(const Integer& index, double video_s = kMorphed_s) const {
    const bool is_start = index == 0 && log->first_index() > 0;
    return of(is_start ? log->blocks_at(0) : state_after(*log, index), video_s);
  }
  /// The velocity as a point of the circle of radius 1; y is up.
  Point unit(const BlockMotion& blue, const BlockMotion& red) const {
    const double m1 = to_double(scene.system.bodies[0].mass.value());
    const double m2 = to_double(scene.system.bodies[1].mass.value());
    const double v1 = to_double(scene.system.bodies[0].velocity[0]);
    const double v2 = to_double(scene.system.bodies[1].velocity[0]);
    const double root = std::sqrt(m1 * v1 * v1 + m2 * v2 * v2);
    return {std::sqrt(m2) * red.velocity / root, std::sqrt(m1) * blue.velocity / root};
  }
  double theta() const {
    return std::atan(std::sqrt(
        to_double(scene.system.bodies[0].mass.value() / scene.system.bodies[1].mass.value())));
  }

  Scene scene;
  std::unique_ptr<PairLog> log;
  Composition composition;
};

bool is_in_panel(ItemId id) { return id >= ItemId::panels && id < ItemId::card; }

/// What one panel shows, with the items of its plate.
struct Figure {
  explicit Figure(const DrawList& list) { add(list.items); }

  void add(const std::vector<DrawItem>& items) {
    for (const DrawItem& item : items) {
      const ItemId id = std::visit([](const auto& any) { return any.id; }, item);
      if (!is_in_panel(id)) continue;
      if (const auto* plate = std::get_if<PlateItem>(&item)) {
        bounds = plate->bounds;
        add(plate->plate->items);
      }
      if (const auto* path = std::get_if<PathItem>(&item)) paths.push_back(*path);
      if (const auto* disc = std::get_if<DiscItem>(&item)) discs.push_back(*disc);
      if (const auto* text = std::get_if<TextItem>(&item)) texts.push_back(*text);
    }
  }
  std::vector<PathItem> lines_of(const Color& color) const {
    std::vector<PathItem> found;
    for (const PathItem& path : paths) {
      if (path.stroke && path.stroke->color == color) found.push_back(path);
    }
    return found;
  }
  const Point& present() const { return discs.back().centre; }

  Rect bounds;
  std::vector<PathItem> paths;
  std::vector<DiscItem> discs;
  std::vector<TextItem> texts;
};

const Palette kPalette = palette_of(Theme::lecture);

/// Axes cross in its centre; its outline passes through angle 0 and half a turn.
struct Frame {
  explicit Frame(const Figure& figure) {
    const auto outline = std::ranges::find_if(figure.paths, [](const PathItem& path) {
      return path.closed && path.stroke && path.stroke->color == kPalette.muted;
    });
    const Rect& box = outline->points.bounds();
    red = blue = box.width / 2;
    centre = {box.x + red, figure.lines_of(kPalette.grid).front().points.view()[0].y};
  }
  Point at(const Point& unit) const { return {centre.x + red * unit.x, centre.y - blue * unit.y}; }

  Point centre;
  double red;   ///< semi-axis
  double blue;  ///< as red on a circle
};

void expect_near(const Point& found, const Point& expected, const char* what, const Integer& k) {
  EXPECT_NEAR(found.x, expected.x, 1e-9 * 1000) << what << ' ' << k;
  EXPECT_NEAR(found.y, expected.y, 1e-9 * 1000) << what << ' ' << k;
}

class Starts : public testing::TestWithParam<Settings> {};

TEST_P(Starts, EachCollisionIsAChordOfItsKind) {
  const Pictures pictures(GetParam());
  const PairLog& log = *pictures.log;
  for (Integer count = 0; count <= log.last(); ++count) {
    const Figure figure(pictures.after(count));
    const Frame circle(figure);
    const auto red = figure.lines_of(kPalette.red.line);
    const auto blue = figure.lines_of(kPalette.blue.line);
    EXPECT_EQ(Integer(static_cast<unsigned long>(red.size() + blue.size())), count);
    std::map<CollisionKind, std::size_t> seen;
    const PairState start = log.blocks_at(0);
    Point before = pictures.unit({0, to_double(pictures.scene.system.bodies[0].velocity[0])},
                                 {0, to_double(pictures.scene.system.bodies[1].velocity[0])});
    expect_near(figure.discs.front().centre, circle.at(before), "start", start.count);
    for (Integer k = 1; k <= count; ++k) {
      const PairCollision collision = log.blocks_collision(k);
      const Point after = pictures.unit(collision.blue, collision.red);
      const auto& chords = collision.kind == CollisionKind::wall ? blue : red;
      const std::size_t n = seen[collision.kind]++;
      ASSERT_LT(n, chords.size()) << k;
      expect_near(chords[n].points.view()[0], circle.at(before), "chord from", k);
      expect_near(chords[n].points.view()[1], circle.at(after), "chord to", k);
      expect_near(figure.discs.at(k.get_ui()).centre, circle.at(after), "dot", k);
      before = after;
    }
    expect_near(figure.present(), circle.at(before), "present", count);
  }
}

TEST_P(Starts, ChordsStayWhatTheyAre) {
  const Pictures pictures(GetParam());
  std::map<ItemId, DrawItem> seen;
  for (Integer count = 0; count <= pictures.log->last(); ++count) {
    const DrawList list = pictures.after(count);
    std::size_t kept = 0;
    ItemId last{};
    for (const DrawItem& item : list.items) {
      const ItemId id = std::visit([](const auto& any) { return any.id; }, item);
      if (!is_in_panel(id)) continue;
      EXPECT_LT(last, id);
      last = id;
      if (&item == &list.items.back()) continue;  // the present
      const auto [place, is_new] = seen.try_emplace(id, item);
      EXPECT_TRUE(place->second == item) << count;
      if (!is_new) ++kept;
    }
    EXPECT_EQ(kept + 2, seen.size()) << "one chord and one dot are new after " << count;
  }
}

TEST_P(Starts, TheEndIsInTheWedge) {
  const Pictures pictures(GetParam());
  for (Integer count = 0; count <= pictures.log->last(); ++count) {
    const Figure figure(pictures.after(count));
    const Frame circle(figure);
    const auto wedge = std::ranges::find_if(figure.paths, [](const PathItem& path) {
      return path.fill && path.fill->green == kPalette.done.green && !path.stroke &&
             path.fill->alpha < 255;
    });
    ASSERT_NE(wedge, figure.paths.end());
    const Point& corner = wedge->points.view().back();
    EXPECT_NEAR(corner.x, circle.centre.x, 1e-6);
    EXPECT_NEAR(corner.y, circle.centre.y, 1e-6);
    const Point& end = wedge->points.view()[wedge->points.view().size() - 2];
    EXPECT_NEAR(std::atan2(corner.y - end.y, end.x - corner.x), pictures.theta(), 1e-9);
    const Point at = figure.present();
    const double angle = std::atan2(corner.y - at.y, at.x - corner.x);
    const bool is_inside = angle > -1e-9 && angle < pictures.theta() + 1e-9;
    EXPECT_EQ(is_inside, count == pictures.log->last()) << count;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Velocities, Starts,
    testing::Values(Settings{{"digits", "1"}}, Settings{{"digits", "2"}},
                    Settings{{"digits", "2"}, {"view.size", "3840x2160"}},
                    Settings{{"mass-ratio", "37"}, {"blue.velocity", "1/2"}},
                    Settings{{"mass-ratio", "50"}, {"blue.velocity", "-3"}},
                    Settings{{"mass-ratio", "1"}, {"blue.velocity", "-1"}, {"red.velocity", "1/2"}},
                    Settings{{"mass-ratio", "1/9"}},
                    Settings{{"mass-ratio", "1/400"}, {"blue.velocity", "-1"}}));

TEST(VelocityPanel, CountsFromTheScenesBeginning) {
  const Pictures pictures({{"mass-ratio", "40"},
                           {"red.velocity", "-1/100"},
                           {"blue.velocity", "3"},
                           {"time.from", "-10"},
                           {"time.to", "10"}});
  const PairLog& log = *pictures.log;
  ASSERT_LT(log.first_index(), 1);
  const Integer before = log.blocks_at(-10).count;
  for (Integer count = before; count <= log.last(); ++count) {
    const PairState state =
        count < log.first_index() ? log.blocks_at(-10) : state_after(log, count);
    const Figure figure(pictures.of(state, 0));
    const Frame circle(figure);
    const auto chords =
        figure.lines_of(kPalette.red.line).size() + figure.lines_of(kPalette.blue.line).size();
    EXPECT_EQ(Integer(static_cast<unsigned long>(chords)), count - before);
    expect_near(figure.present(), circle.at(pictures.unit(state.blue, state.red)), "now", count);
    expect_near(figure.discs.at(chords).centre, figure.present(), "dot", count);
  }
}

/// WCAG 2.1, "relative luminance".
double luminance(const Color& color) {
  const auto linear = [](double byte) {
    const double value = byte / 255;
    return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
  };
  return 0.2126 * linear(color.red) + 0.7152 * linear(color.green) + 0.0722 * linear(color.blue);
}

TEST(VelocityPanel, TheWedgeStandsOutInEveryTheme) {
  for (const Theme theme : {Theme::article, Theme::lecture, Theme::lecture_light, Theme::chalkboard,
                            Theme::dark, Theme::print, Theme::colorblind}) {
    const Palette palette = palette_of(theme);
    const auto mixed = [](std::uint8_t over, std::uint8_t below) {
      return static_cast<std::uint8_t>(style::kWedgeFill * over + (1 - style::kWedgeFill) * below);
    };
    const Color fill{mixed(palette.done.red, palette.background.red),
                     mixed(palette.done.green, palette.background.green),
                     mixed(palette.done.blue, palette.background.blue)};
    const double a = luminance(fill) + 0.05;
    const double b = luminance(palette.background) + 0.05;
    EXPECT_GE(std::max(a, b) / std::min(a, b), 2) << exact_text(theme);
  }
}

TEST(VelocityPanel, ShowsThatNothingMoves) {
  const Figure figure(
      Pictures({{"digits", "2"}, {"red.velocity", "0"}, {"time.to", "1"}}).after(0));
  ASSERT_EQ(figure.discs.size(), 1U);
  const auto axes = figure.lines_of(kPalette.grid);
  ASSERT_EQ(axes.size(), 2U);
  EXPECT_EQ(figure.present(), (Point{axes[1].points.view()[0].x, axes[0].points.view()[0].y}));
  EXPECT_TRUE(figure.lines_of(kPalette.muted).empty()) << "there is no circle";
}

double area_of(const PathItem& path) {
  double twice = 0;
  const auto points = path.points.view();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point& a = points[i];
    const Point& b = points[(i + 1) % points.size()];
    twice += a.x * b.y - a.y * b.x;
  }
  return std::abs(twice) / 2;
}

/// Of a circle of radius 1, left of the vertical chord to this angle.
double segment(double angle) {
  const double half = std::numbers::pi - angle;
  return half - std::sin(half) * std::cos(half);
}

TEST(VelocityPanel, ManyChordsAreTheAreaThatTheyCover) {
  for (const Settings& start :
       {Settings{{"digits", "4"}}, Settings{{"digits", "4"}, {"blue.velocity", "30"}}}) {
    const Pictures pictures(start);
    const Integer& last = pictures.log->last();
    for (Integer count = 0; count <= last; count += 53) {
      const DrawList list = pictures.after(count);
      const Figure figure(list);
      const Frame circle(figure);
      double area = 0;
      for (const PathItem& path : figure.paths) {
        if (path.fill == kPalette.shade) area += area_of(path);
      }
      const Point from = pictures.unit({0, to_double(pictures.scene.system.bodies[0].velocity[0])},
                                       {0, to_double(pictures.scene.system.bodies[1].velocity[0])});
      const PairState state =
          count == 0 ? pictures.log->blocks_at(0) : state_after(*pictures.log, count);
      const Point to = pictures.unit(state.blue, state.red);
      const double expected =
          segment(std::abs(std::atan2(to.y, to.x))) - segment(std::abs(std::atan2(from.y, from.x)));
      // The last chord may be slanted, by two wedge angles.
      EXPECT_NEAR(area / (circle.red * circle.red), expected, 3 * pictures.theta()) << count;
      EXPECT_LT(figure.lines_of(kPalette.red.line).size(), 2U);
      EXPECT_LT(figure.lines_of(kPalette.blue.line).size(), 2U);
    }
  }
}

TEST(VelocityPanel, CostsLittleForAnyNumberOfDigits) {
  for (const int digits : {3, 4, 9, 20, 100, 300}) {
    const Pictures pictures({{"digits", std::to_string(digits)}, {"view.theme", "article"}});
    for (const Rational& time : {Rational(0), Rational(3), Rational(7, 2), Rational(9)}) {
      EXPECT_LT(pictures.of(pictures.log->blocks_at(time), 0).items.size(), 60U) << digits;
    }
  }
}

TEST(EllipsePanel, FollowsOneMapToTheCircle) {
  const Pictures pictures({{"mass-ratio", "100"}}, "ellipse");
  // Hits cost time, and it shows none.
  EXPECT_TRUE(pictures.composition.needs().video_s);
  EXPECT_EQ(pictures.composition.needs().hits, pictures.scene.show.hits);
  EXPECT_FALSE(Pictures({{"show.hits", "false"}}, "ellipse").composition.needs().hits);
  const Frame circle{Figure(pictures.after(0))};
  for (const auto& [video_s, share] :
       {std::pair(0.0, 0.0), {1.5, 0.0}, {2.125, 5.0 / 32}, {2.75, 0.5}, {4.0, 1.0}}) {
    for (const int count : {0, 1, 14, 15, 30, 31}) {
      const Figure figure(pictures.after(count, video_s));
      Frame ellipse(figure);
      EXPECT_EQ(ellipse.centre.y, circle.centre.y);
      EXPECT_NEAR(ellipse.red, circle.red * std::pow(10, share - 1), 1e-9);
      ellipse.blue = circle.red;
      ASSERT_EQ(figure.discs.size(), static_cast<std::size_t>(count) + 2);
      for (int k = 1; k <= count; ++k) {
        const PairCollision collision = pictures.log->blocks_collision(k);
        expect_near(figure.discs[static_cast<std::size_t>(k)].centre,
                    ellipse.at(pictures.unit(collision.blue, collision.red)), "dot", k);
      }
      EXPECT_EQ(figure.lines_of(kPalette.red.line).size(), static_cast<std::size_t>(count + 1) / 2);
      EXPECT_EQ(figure.lines_of(kPalette.blue.line).size(), static_cast<std::size_t>(count) / 2);
    }
  }
}

bool says(const Figure& figure, const char* words) {
  return std::ranges::any_of(figure.texts,
                             [&](const TextItem& text) { return text.text == words; });
}

TEST(EllipsePanel, SaysWhatIsNotToScale) {
  const auto says_at = [](const char* ratio, double video_s) {
    return says(Figure(Pictures({{"mass-ratio", ratio}}, "ellipse").after(0, video_s)),
                "not to scale");
  };
  EXPECT_FALSE(says_at("100", 0));
  EXPECT_FALSE(says_at("144", 0));
  EXPECT_TRUE(says_at("145", 0));
  EXPECT_TRUE(says_at("1/145", 0));
  EXPECT_TRUE(says_at("10000000000000000000000000000000000000000", 0));
  EXPECT_FALSE(says_at("145", kMorphed_s));
}

TEST(EllipsePanel, SaysWhyItIsAnEllipse) {
  for (const char* size : {"960x540", "1280x720", "3840x2160", "1080x1920"}) {
    const Pictures pictures({{"digits", "2"}, {"view.size", size}}, "ellipse,velocity");
    EXPECT_TRUE(says(Figure(pictures.after(0, 0)), "stays the same")) << size;
    EXPECT_FALSE(says(Figure(pictures.after(0)), "stays the same")) << size;
    EXPECT_TRUE(says(Figure(pictures.after(0)), "no more hits here")) << size;
  }
}

TEST(EllipsePanel, IsTheCircleInTheEnd) {
  const Figure circle(Pictures(Settings{{"digits", "2"}}).after(17));
  const Figure ellipse(Pictures(Settings{{"digits", "2"}}, "ellipse").after(17));
  EXPECT_TRUE(std::ranges::equal(circle.discs, ellipse.discs));
  EXPECT_EQ(circle.lines_of(kPalette.red.line), ellipse.lines_of(kPalette.red.line));
  EXPECT_EQ(circle.lines_of(kPalette.blue.line), ellipse.lines_of(kPalette.blue.line));
}

struct Shape {
  const char* size;
  const char* panels;
};

class Shapes : public testing::TestWithParam<Shape> {};

Rect box_of(const TextItem& text, const Fonts& fonts) {
  return {text.origin.x, text.origin.y - 0.74 * text.size_px,
          fonts.of(text.face).width_em(text.text) * text.size_px, 0.95 * text.size_px};
}

bool holds(const Rect& outer, const Point& point) {
  return point.x >= outer.x && point.x <= outer.right() && point.y >= outer.y &&
         point.y <= outer.bottom();
}

bool overlap(const Rect& a, const Rect& b) {
  constexpr double kTouch_px = 0.5;
  return a.x < b.right() - kTouch_px && b.x < a.right() - kTouch_px &&
         a.y < b.bottom() - kTouch_px && b.y < a.bottom() - kTouch_px;
}

/// The items of the first panel alone.
DrawList first_panel(DrawList list) {
  const auto second = static_cast<std::uint32_t>(ItemId::panels) + ids_from(1);
  std::erase_if(list.items, [&](const DrawItem& item) {
    const ItemId id = std::visit([](const auto& any) { return any.id; }, item);
    return id < ItemId::panels || static_cast<std::uint32_t>(id) >= second;
  });
  return list;
}

TEST_P(Shapes, HoldThePanelsWithoutOverlaps) {
  const Fonts fonts;
  for (const char* digits : {"1", "2", "3", "5", "8", "13", "20"}) {
    const Pictures pictures({{"digits", digits}, {"view.size", GetParam().size}},
                            GetParam().panels);
    const Integer& last = pictures.log->last();
    for (const Integer& count : {Integer(0), Integer(1), Integer(last / 2), last}) {
      for (const double video_s : {0.0, 2.2, 3.2, kMorphed_s}) {
        const Figure figure(first_panel(pictures.after(count, video_s)));
        for (const PathItem& path : figure.paths) {
          for (const Point& point : path.points.view()) {
            EXPECT_TRUE(holds(figure.bounds, point)) << digits << ' ' << point.x << ' ' << point.y;
          }
        }
        for (std::size_t i = 0; i < figure.texts.size(); ++i) {
          const Rect box = box_of(figure.texts[i], fonts);
          EXPECT_TRUE(holds(figure.bounds, {box.x, box.y}) &&
                      holds(figure.bounds, {box.right(), box.bottom()}))
              << digits << ' ' << figure.texts[i].text;
          for (std::size_t k = 0; k < i; ++k) {
            EXPECT_FALSE(overlap(box, box_of(figure.texts[k], fonts)))
                << digits << ": " << figure.texts[i].text << " and " << figure.texts[k].text;
          }
        }
      }
    }
  }
}

TEST_P(Shapes, LetTheCircleFillThePanel) {
  const Pictures pictures({{"digits", "2"}, {"view.size", GetParam().size}}, GetParam().panels);
  const Figure figure(first_panel(pictures.after(3)));
  const Sizes sizes(pictures.scene.view);
  // A plate is half an em larger than its diagram, whose title takes one and a half.
  const double width = figure.bounds.width - sizes.text;
  const double height = figure.bounds.height - 2.5 * sizes.text;
  EXPECT_GE(2 * Frame(figure).red, 0.75 * std::min(width, height) - 3);
}

INSTANTIATE_TEST_SUITE_P(
    Aspects, Shapes,
    testing::Values(Shape{"1280x720", "velocity"}, Shape{"1280x720", "velocity,time"},
                    Shape{"1280x720", "ellipse,velocity"}, Shape{"3840x2160", "velocity,unfolded"},
                    Shape{"1080x1920", "velocity,time"}, Shape{"1080x1920", "ellipse,time,count"},
                    Shape{"1080x1080", "velocity"}, Shape{"1080x1080", "ellipse,unfolded"},
                    Shape{"1440x1080", "velocity,unfolded,time"}, Shape{"2560x1080", "velocity"},
                    Shape{"640x360", "velocity,time"}),
    [](const auto& test) {
      std::string name = std::string(test.param.size) + '_' + test.param.panels;
      std::ranges::replace(name, ',', '_');
      return name;
    });

}  // namespace
}  // namespace piblocks
