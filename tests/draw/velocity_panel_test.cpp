// The diagrams of velocities, against the log: points, chords, the end, the ellipse, room.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "draw/composed_pictures.hpp"
#include "draw/contrast.hpp"
#include "draw/look.hpp"

namespace piblocks {
namespace {

constexpr double kMorphed_s = 10;  ///< of video: the ellipse is a circle by then

struct VelocityPictures : Pictures {
  explicit VelocityPictures(const Settings& settings, const char* panel = "velocity")
      : Pictures(
            scene_with(Settings{{"view.theme", "lecture"}, {"show.panels", panel}} + settings)) {}

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
};

/// Axes cross in its centre; its outline passes through angle 0 and half a turn.
struct Frame {
  explicit Frame(const Shown& figure) {
    const auto outline = std::ranges::find_if(figure.paths, [](const PathItem& path) {
      return path.closed && path.stroke && path.stroke->color == kLecturePalette.muted;
    });
    const Rect& box = outline->points.bounds();
    red = blue = box.width / 2;
    centre = {box.x + red, figure.lines_of(kLecturePalette.grid).front().points.view()[0].y};
  }
  Point at(const Point& unit) const { return {centre.x + red * unit.x, centre.y - blue * unit.y}; }

  Point centre;
  double red;   ///< semi-axis
  double blue;  ///< as red on a circle
};

const Point& present_of(const Shown& figure) { return figure.discs.back().centre; }

void expect_near(const Point& found, const Point& expected, const char* what, const Integer& k) {
  EXPECT_NEAR(found.x, expected.x, 1e-9 * 1000) << what << ' ' << k;
  EXPECT_NEAR(found.y, expected.y, 1e-9 * 1000) << what << ' ' << k;
}

class Starts : public testing::TestWithParam<Settings> {};

TEST_P(Starts, EachCollisionIsAChordOfItsKind) {
  const VelocityPictures pictures(GetParam());
  const PairLog& log = *pictures.log;
  for (Integer count = 0; count <= log.last(); ++count) {
    const Shown figure(pictures.after(count));
    const Frame circle(figure);
    const auto red = figure.lines_of(kLecturePalette.red.line);
    const auto blue = figure.lines_of(kLecturePalette.blue.line);
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
    expect_near(present_of(figure), circle.at(before), "present", count);
  }
}

bool is_of_a_collision(const DrawItem& item) {
  if (const auto* disc = std::get_if<DiscItem>(&item)) return disc->fill == kLecturePalette.text;
  const auto* path = std::get_if<PathItem>(&item);
  if (path == nullptr || !path->stroke) return false;
  return path->stroke->color == kLecturePalette.red.line ||
         path->stroke->color == kLecturePalette.blue.line;
}

TEST_P(Starts, ChordsStayWhatTheyAre) {
  const VelocityPictures pictures(GetParam());
  std::map<ItemId, DrawItem> seen;
  for (Integer count = 0; count <= pictures.log->last(); ++count) {
    const DrawList list = pictures.after(count);
    std::size_t kept = 0;
    ItemId last{};
    for (const DrawItem& item : list.items) {
      const ItemId id = id_of(item);
      if (id < ItemId::panels || id >= ItemId::card) continue;
      EXPECT_LT(last, id);
      last = id;
      if (!is_of_a_collision(item)) continue;
      const auto [place, is_new] = seen.try_emplace(id, item);
      EXPECT_TRUE(place->second == item) << count;
      if (!is_new) ++kept;
    }
    EXPECT_EQ(kept + (count == 0 ? 1 : 2), seen.size())
        << "one chord and one dot are new after " << count;
  }
}

TEST_P(Starts, TheEndIsInTheWedge) {
  const VelocityPictures pictures(GetParam());
  for (Integer count = 0; count <= pictures.log->last(); ++count) {
    const Shown figure(pictures.after(count));
    const Frame circle(figure);
    const auto wedge = std::ranges::find_if(figure.paths, [](const PathItem& path) {
      return path.fill && path.fill->green == kLecturePalette.done.green && !path.stroke &&
             path.fill->alpha < 255;
    });
    ASSERT_EQ(wedge != figure.paths.end(), count == pictures.log->last()) << count;
    if (wedge == figure.paths.end()) continue;
    const Point& corner = wedge->points.view().back();
    EXPECT_NEAR(corner.x, circle.centre.x, 1e-6);
    EXPECT_NEAR(corner.y, circle.centre.y, 1e-6);
    const Point& end = wedge->points.view()[wedge->points.view().size() - 2];
    EXPECT_NEAR(std::atan2(corner.y - end.y, end.x - corner.x), pictures.theta(), 1e-9);
    const Point at = present_of(figure);
    const double angle = std::atan2(corner.y - at.y, at.x - corner.x);
    EXPECT_GT(angle, -1e-9);
    EXPECT_LT(angle, pictures.theta() + 1e-9);
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
  const VelocityPictures pictures({{"mass-ratio", "40"},
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
    const Shown figure(pictures.of(state, 0));
    const Frame circle(figure);
    const auto chords = figure.lines_of(kLecturePalette.red.line).size() +
                        figure.lines_of(kLecturePalette.blue.line).size();
    EXPECT_EQ(Integer(static_cast<unsigned long>(chords)), count - before);
    expect_near(present_of(figure), circle.at(pictures.unit(state.blue, state.red)), "now", count);
    expect_near(figure.discs.at(chords).centre, present_of(figure), "dot", count);
  }
}

TEST(VelocityPanel, TheWedgeStandsOutInEveryTheme) {
  for (const Theme theme : kThemes) {
    const Palette palette = palette_of(theme);
    const auto mixed = [](std::uint8_t over, std::uint8_t below) {
      return static_cast<std::uint8_t>(style::kWedgeFill * over + (1 - style::kWedgeFill) * below);
    };
    const Color fill{mixed(palette.done.red, palette.background.red),
                     mixed(palette.done.green, palette.background.green),
                     mixed(palette.done.blue, palette.background.blue)};
    EXPECT_GE(contrast(fill, palette.background), 2) << exact_text(theme);
  }
}

TEST(VelocityPanel, ShowsThatNothingMoves) {
  const Shown figure(
      VelocityPictures({{"digits", "2"}, {"red.velocity", "0"}, {"time.to", "1"}}).after(0));
  ASSERT_EQ(figure.discs.size(), 1U);
  const auto axes = figure.lines_of(kLecturePalette.grid);
  ASSERT_EQ(axes.size(), 2U);
  EXPECT_EQ(present_of(figure), (Point{axes[1].points.view()[0].x, axes[0].points.view()[0].y}));
  EXPECT_TRUE(figure.lines_of(kLecturePalette.muted).empty()) << "there is no circle";
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
    const VelocityPictures pictures(start);
    const Integer& last = pictures.log->last();
    for (Integer count = 0; count <= last; count += 53) {
      const Shown figure(pictures.after(count));
      const Frame circle(figure);
      double area = 0;
      for (const PathItem& path : figure.paths) {
        if (path.fill == kLecturePalette.shade) area += area_of(path);
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
      EXPECT_LT(figure.lines_of(kLecturePalette.red.line).size(), 2U);
      EXPECT_LT(figure.lines_of(kLecturePalette.blue.line).size(), 2U);
    }
  }
}

TEST(VelocityPanel, CostsLittleForAnyNumberOfDigits) {
  for (const int digits : {3, 4, 9, 20, 100, 300}) {
    const VelocityPictures pictures(
        {{"digits", std::to_string(digits)}, {"view.theme", "article"}});
    for (const Rational& time : {Rational(0), Rational(3), Rational(7, 2), Rational(9)}) {
      EXPECT_LT(pictures.of(pictures.log->blocks_at(time), 0).items.size(), 60U) << digits;
    }
  }
}

TEST(EllipsePanel, FollowsOneMapToTheCircle) {
  const VelocityPictures pictures({{"mass-ratio", "100"}}, "ellipse");
  // Hits cost time, and it shows none.
  EXPECT_TRUE(pictures.composition.needs().video_s);
  EXPECT_EQ(pictures.composition.needs().hits, pictures.scene.show.hits);
  const Settings without = {{"show.hits", "false"}, {"show.loupe", "off"}};
  EXPECT_FALSE(VelocityPictures(without, "ellipse").composition.needs().hits);
  const Frame circle{Shown(pictures.after(0))};
  for (const auto& [video_s, share] :
       {std::pair(0.0, 0.0), {4.0, 0.0}, {4.375, 5.0 / 32}, {4.75, 0.5}, {5.5, 1.0}}) {
    for (const int count : {0, 1, 14, 15, 30, 31}) {
      const Shown figure(pictures.after(count, video_s));
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
      EXPECT_EQ(figure.lines_of(kLecturePalette.red.line).size(),
                static_cast<std::size_t>(count + 1) / 2);
      EXPECT_EQ(figure.lines_of(kLecturePalette.blue.line).size(),
                static_cast<std::size_t>(count) / 2);
    }
  }
}

TEST(EllipsePanel, SaysWhatIsNotToScale) {
  const auto says_at = [](const char* ratio, double video_s) {
    return Shown(VelocityPictures({{"mass-ratio", ratio}}, "ellipse").after(0, video_s))
        .has_text("not to scale");
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
    const VelocityPictures pictures({{"digits", "2"}, {"view.size", size}}, "ellipse,velocity");
    EXPECT_TRUE(Shown(pictures.after(0, 0)).has_text("stays the same")) << size;
    EXPECT_FALSE(Shown(pictures.after(0)).has_text("stays the same")) << size;
    EXPECT_FALSE(Shown(pictures.after(30)).has_text("no more hits here")) << size;
    EXPECT_TRUE(Shown(pictures.after(31)).has_text("no more hits here")) << size;
  }
}

TEST(VelocityPanel, SaysInTheEndHowManyArcsAreInTheCircle) {
  const auto words_after = [](const Settings& settings, bool is_end) {
    const VelocityPictures pictures(settings);
    return Shown(pictures.after(is_end ? pictures.log->last() : Integer(1))).words();
  };
  for (const auto& [ratio, what] : {std::pair("100", " ≈ 10π = 31.4…"),
                                    {"10000", " ≈ 100π = 314.1…"},
                                    {"2500", " ≈ 50π = 157.0…"},
                                    {"7", " = 8.6…"}}) {
    EXPECT_NE(words_after({{"mass-ratio", ratio}}, true).find(what), std::string::npos) << ratio;
    EXPECT_EQ(words_after({{"mass-ratio", ratio}}, false).find(what), std::string::npos) << ratio;
    EXPECT_NE(words_after({{"mass-ratio", ratio}}, false).find("cuts off an arc of 2"),
              std::string::npos);
  }
  EXPECT_EQ(words_after({{"mass-ratio", "1"}}, true).find("π"), std::string::npos)
      << "π/θ is 4, and there are 3 hits";
}

/// Once, beside the circle or below the mirrors; on an ellipse no arc is 2 theta.
TEST(VelocityPanel, SaysWhatThetaIs) {
  const auto times_said = [](const char* panels, double video_s, const char* ratio = "100") {
    const VelocityPictures pictures({{"mass-ratio", ratio}, {"view.size", "1280x720"}}, panels);
    const std::string words = Shown(pictures.after(3, video_s)).words();
    int times = 0;
    for (auto at = words.find("arctan"); at != std::string::npos; at = words.find("arctan", at + 1))
      ++times;
    return times;
  };
  EXPECT_EQ(times_said("velocity", 0), 1);
  EXPECT_EQ(times_said("ellipse", 0), 0);
  EXPECT_EQ(times_said("ellipse", kMorphed_s), 1);
  EXPECT_EQ(times_said("velocity,unfolded", 0), 1);
  EXPECT_EQ(times_said("velocity,mirrors", 0), 1);
  EXPECT_EQ(times_said("velocity", 0, "1"), 0) << "the count is not the whole part of π/θ";
}

TEST(EllipsePanel, IsTheCircleInTheEnd) {
  const Shown circle(VelocityPictures(Settings{{"digits", "2"}}).after(17));
  const Shown ellipse(VelocityPictures(Settings{{"digits", "2"}}, "ellipse").after(17));
  EXPECT_TRUE(std::ranges::equal(circle.discs, ellipse.discs));
  EXPECT_EQ(circle.lines_of(kLecturePalette.red.line), ellipse.lines_of(kLecturePalette.red.line));
  EXPECT_EQ(circle.lines_of(kLecturePalette.blue.line),
            ellipse.lines_of(kLecturePalette.blue.line));
}

class VelocityPanelShapes : public testing::TestWithParam<PanelShape> {};

/// The items of the first panel alone.
DrawList first_panel(DrawList list) {
  const auto second = static_cast<std::uint32_t>(ItemId::panels) + ids_from(1);
  std::erase_if(list.items, [&](const DrawItem& item) {
    return id_of(item) < ItemId::panels || static_cast<std::uint32_t>(id_of(item)) >= second;
  });
  return list;
}

TEST_P(VelocityPanelShapes, HoldThePanelsWithoutOverlaps) {
  const Fonts fonts;
  for (const char* digits : {"1", "2", "3", "5", "8", "13", "20"}) {
    const VelocityPictures pictures({{"digits", digits}, {"view.size", GetParam().size}},
                                    GetParam().panels);
    const Integer& last = pictures.log->last();
    for (const Integer& count : {Integer(0), Integer(1), Integer(last / 2), last}) {
      for (const double video_s : {0.0, 4.4, 5.1, kMorphed_s}) {
        const Shown figure(first_panel(pictures.after(count, video_s)));
        const Rect& bounds = figure.plates.front().bounds;
        for (const PathItem& path : figure.paths) {
          EXPECT_TRUE(bounds.holds(path.points.bounds())) << digits;
        }
        EXPECT_EQ(text_problem(boxes_of(figure.texts, fonts), bounds), "") << digits;
      }
    }
  }
}

TEST_P(VelocityPanelShapes, LetTheCircleFillThePanel) {
  const VelocityPictures pictures({{"digits", "2"}, {"view.size", GetParam().size}},
                                  GetParam().panels);
  const Shown figure(first_panel(pictures.after(3)));
  const Sizes sizes(pictures.scene.view);
  // A plate is half an em larger than its diagram, whose title takes one and a half.
  const Rect& plate = figure.plates.front().bounds;
  const double width = plate.width - sizes.text;
  const double height = plate.height - 2.5 * sizes.text;
  EXPECT_GE(2 * Frame(figure).red, 0.75 * std::min(width, height) - 3);
}

INSTANTIATE_TEST_SUITE_P(
    Aspects, VelocityPanelShapes,
    testing::Values(
        PanelShape{"1280x720", "velocity"}, PanelShape{"1280x720", "velocity,time"},
        PanelShape{"1280x720", "ellipse,velocity"}, PanelShape{"3840x2160", "velocity,unfolded"},
        PanelShape{"1080x1920", "velocity,time"}, PanelShape{"1080x1920", "ellipse,time,count"},
        PanelShape{"1080x1080", "velocity"}, PanelShape{"1080x1080", "ellipse,unfolded"},
        PanelShape{"1440x1080", "velocity,unfolded,time"}, PanelShape{"2560x1080", "velocity"},
        PanelShape{"640x360", "velocity,time"}),
    [](const auto& test) {
      std::string name = std::string(test.param.size) + '_' + test.param.panels;
      std::ranges::replace(name, ',', '_');
      return name;
    });

}  // namespace
}  // namespace piblocks
