// The diagrams of counts, positions, distances and conserved sums, against the log.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "draw/composed_pictures.hpp"
#include "draw/look.hpp"
#include "draw/number_text.hpp"
#include "draw/panels/corner_path.hpp"
#include "draw/panels/count_curve.hpp"

namespace piblocks {
namespace {

Settings lecture(const char* panels, const Settings& more = {}) {
  return Settings{{"view.theme", "lecture"}, {"view.size", "1280x720"}, {"show.panels", panels}} +
         more;
}

TEST(CountCurve, IsTheLogs) {
  for (const int digits : {1, 2, 3, 5, 20}) {
    const auto log = make_pair_log(article_system(digits));
    const Span span{0, 8};
    constexpr int kColumns = 300;
    const auto points = count_curve(*log, span, kColumns);
    EXPECT_LT(points.size(), 3000U);
    EXPECT_EQ(points.front().count, 0);
    EXPECT_EQ(points.back().count, log->blocks_at(8).count);
    constexpr double kStep = 1.0 / 64 / kColumns;
    for (std::size_t i = 1; i < points.size(); ++i) {
      const auto& [share, count] = points[i];
      EXPECT_GE(share, points[i - 1].share);
      EXPECT_GE(count, points[i - 1].count);
      if (share == points[i - 1].share && count > points[i - 1].count) {
        EXPECT_EQ(count - points[i - 1].count, 1);
        EXPECT_NEAR(log->blocks_collision(count).time.hi / 8, share, kStep)
            << digits << ' ' << count;
      } else if (count > points[i - 1].count) {
        // A straight line ends at the exact counts of its column.
        const Rational time = span.to * std::lround(share * kColumns) / kColumns;
        EXPECT_EQ(log->blocks_at(time).count, count) << digits;
      }
    }
  }
}

TEST(CountPanel, SaysThatCollisionsAreInfinitelyMany) {
  const auto says_so = [](const char* restitution, const char* to) {
    const Pictures pictures(2, lecture("count", {{"restitution", restitution}, {"time.to", to}}));
    return Shown(pictures.at(3)).has_text("Infinitely many collisions");
  };
  EXPECT_TRUE(says_so("1/2", "last+1.5"));
  EXPECT_TRUE(says_so("1/2", "9"));
  EXPECT_FALSE(says_so("1/2", "7/2"));
  EXPECT_FALSE(says_so("0.95", "last+1.5"));
  EXPECT_FALSE(says_so("1", "last+1.5"));
}

TEST(CountCurve, BeginsWithWhatHappensAtTheVeryBeginning) {
  const Pictures pictures(3, {{"blue.position", "1/2"},
                              {"red.position", "3/2"},
                              {"blue.velocity", "-1"},
                              {"time.to", "1"}});
  const auto points = count_curve(*pictures.log, {0, 1}, 100);
  EXPECT_EQ(points.front().count, 0);
  EXPECT_EQ(points[1].share, 0);
  EXPECT_EQ(points[1].count, pictures.log->blocks_at(0).count);
  EXPECT_GT(points[1].count, 1);
}

TEST(CountCurve, TheTurnIsEnlargedUntilStepsAreSeen) {
  for (int digits = 2; digits <= 20; ++digits) {
    const auto log = make_pair_log(article_system(digits));
    const Integer total = log->last();
    const InsetLimits limits{.span = {0, 8},
                             .width_share = Rational(1, 3),
                             .most_steps = 12,
                             .counts_in_height = total / 2};
    const auto part = enlarged_turn(*log, limits);
    ASSERT_TRUE(part) << digits;
    const auto& [span, time_factor, count_factor, low, high] = *part;
    EXPECT_EQ((span.from + span.to) / 2, *turn_of(log->blocks()));
    EXPECT_EQ((span.to - span.from) * time_factor.value(), Rational(8, 3));
    EXPECT_EQ(log->blocks_at(span.from).count, low);
    EXPECT_EQ(log->blocks_at(span.to).count, high);
    EXPECT_GE(high - low, 2) << digits;
    EXPECT_LE(high - low, 12) << digits;
    EXPECT_LE((high - low) * count_factor.value(), limits.counts_in_height);
    EXPECT_GT((high - low) * count_factor.next().value(), limits.counts_in_height);
    // Each step is there, and at its time.
    const auto points = count_curve(*log, span, 200);
    Integer steps = 0;
    for (std::size_t i = 1; i < points.size(); ++i) {
      if (points[i].count == points[i - 1].count) continue;
      EXPECT_EQ(points[i].share, points[i - 1].share);
      steps += points[i].count - points[i - 1].count;
      const Rational exact = (log->time_after(points[i].count) - span.from) / (span.to - span.from);
      EXPECT_NEAR(to_double(exact), points[i].share, 1.0 / 64 / 200) << digits;
    }
    EXPECT_EQ(steps, high - low) << digits;
  }
}

TEST(CountCurve, NothingIsEnlargedWithoutNeed) {
  const auto log = make_pair_log(article_system(1));
  EXPECT_FALSE(enlarged_turn(*log, {{0, 8}, Rational(1, 3), 12, 10}));
  const auto many = make_pair_log(article_system(4));
  EXPECT_FALSE(enlarged_turn(*many, {{5, 8}, Rational(1, 3), 12, 1000})) << "no turn is shown";
  TwoBlocks corner = article_blocks(3);
  corner.blue.position = 4;  // touches red
  corner.blue.velocity = corner.red.velocity;
  const InsetLimits all{{0, 8}, Rational(1, 3), 12, 100};
  EXPECT_FALSE(enlarged_turn(*make_pair_log(corner), all)) << "all happen at once";
}

TEST(CountCurve, FactorsAreRound) {
  EXPECT_EQ(round_factor_below(1).text(), "1");
  EXPECT_EQ(round_factor_below(Rational(199, 100)).text(), "1");
  EXPECT_EQ(round_factor_below(4999).text(), "2,000");
  EXPECT_EQ(round_factor_below(70'000'000).text(), "5×10⁷");
  EXPECT_EQ(round_factor_below(power_of_ten(37)).text(), "10³⁷");
}

TEST(CountPanel, SaysThatHalfComesBeforeTheTurnIfItDoes) {
  const auto says_half = [](const Settings& settings) {
    return Shown(Pictures(3, lecture("count", settings)).at(1))
        .has_text("Half of the collisions come before the turn");
  };
  EXPECT_TRUE(says_half({}));
  EXPECT_FALSE(says_half({{"blue.velocity", "50"}}));
  EXPECT_FALSE(says_half({{"time.to", "3"}})) << "the turn is not shown";
}

TEST(CountPanel, EnlargesTimeAsOftenAsItSays) {
  const Pictures pictures(3, lecture("count"));
  const Rational turn = pictures.turn();
  const auto dots_at = [&](const Rational& time) { return Shown(pictures.at(time)).discs; };
  EXPECT_EQ(dots_at(1).size(), 1U) << "far from the turn";
  const double scale = (dots_at(2).front().centre.x - dots_at(0).front().centre.x) / 2;
  const Rational step(1, 100'000);
  ASSERT_EQ(dots_at(turn).size(), 2U);
  const double moved = dots_at(turn + step).back().centre.x - dots_at(turn).back().centre.x;
  const long factor = std::lround(moved / scale / to_double(step));
  EXPECT_NEAR(moved / scale / to_double(step), double(factor), 1e-6 * double(factor));
  EXPECT_TRUE(Shown(pictures.at(turn)).has_text("time ×" + fixed_text(double(factor), 0)));
}

/// The area is filled up to the present and no further, by strips that stay as they are.
TEST(CountPanel, IsFilledUpToThePresent) {
  const Pictures pictures(2, lecture("count"));
  std::vector<PathItem> before;
  for (int time = 1; time <= 6; ++time) {
    const Shown shown(pictures.at(time));
    const Point present = shown.discs.front().centre;
    std::vector<PathItem> strips;
    for (const PathItem& path : shown.paths) {
      if (path.fill == kLecturePalette.shade) strips.push_back(path);
    }
    double right = 0;
    for (const PathItem& strip : strips) right = std::max(right, strip.points.bounds().right());
    EXPECT_NEAR(right, present.x, 1e-9);
    for (std::size_t i = 0; i + 1 < before.size(); ++i) EXPECT_EQ(before[i], strips[i]);
    before = std::move(strips);
  }
}

TEST(GraphPanels, SayWhatIsTrue) {
  const std::vector<std::pair<const char*, const char*>> sentences = {
      {"time", " turns around; "},
      {"position", "The distances zigzag into the corner and out"},
      {"conservation", "Energy only changes hands; the wall takes the momentum"}};
  for (const auto& [panel, text] : sentences) {
    const auto is_said = [&](const char* end) {
      return Shown(Pictures(3, lecture(panel, {{"time.to", end}})).at(1)).has_text(text);
    };
    EXPECT_TRUE(is_said("8")) << text;
    EXPECT_FALSE(is_said("3")) << text << ": red has not turned by then";
  }
}

TEST(CornerZoom, IsContinuousAndGrowsAsTheGapShrinks) {
  const Fonts fonts;
  const CornerZoom zoom(1e-19, {fonts, Face::text});
  double last = 1;
  EXPECT_EQ(zoom.factor_for(1), 1);
  for (double share = 1; share > 1e-19; share /= 1.0005) {
    const double now = zoom.factor_for(share);
    EXPECT_GE(now, last);
    EXPECT_LE(now, 1.02 * last) << share;
    EXPECT_LE(now * share, 1) << "out of the picture at " << share;
    EXPECT_GE(now * share, 0.07) << "hardly seen at " << share;
    last = now;
  }
  EXPECT_EQ(zoom.factor_for(0.5), 1);
  EXPECT_EQ(zoom.factor_for(0.05), 10);
  EXPECT_EQ(zoom.factor_for(5e-8), 1e7);
  EXPECT_EQ(*zoom.exponent_of(1e7), 7U);
  EXPECT_FALSE(zoom.exponent_of(2e7));
}

/// Whether a place is a corner of the lines that are shown.
bool has_corner(const ShownPath& path, const Gaps& gaps, double within) {
  return std::ranges::any_of(path.lines, [&](const std::vector<Gaps>& line) {
    return std::ranges::any_of(line, [&](const Gaps& corner) {
      return std::abs(corner.y1 - gaps.y1) <= within && std::abs(corner.y2 - gaps.y2) <= within;
    });
  });
}

TEST(CornerPath, HoldsAllCollisionsAtEveryMagnification) {
  for (const int digits : {1, 2, 3, 4}) {
    const auto log = make_pair_log(article_system(digits));
    const CornerPath path(*log, {0, 8}, 200);
    for (double window = path.greatest_y2(); window > path.least_y2(); window /= 3.7) {
      const ShownPath shown = path.shown({.to = window, .least_apart = window / 100});
      const Integer seen = log->blocks_at(8).count;
      for (Integer k = 1; k <= seen; k += digits < 4 ? 1 : 13) {
        const Gaps gaps = log->gaps_at_collision(k);
        if (gaps.y2 > window) continue;
        const double slack = 1e-9 * window;
        const bool is_filled =
            gaps.y2 >= shown.filled_low - slack && gaps.y2 <= shown.filled_high + slack;
        EXPECT_TRUE(is_filled || has_corner(shown, gaps, slack)) << digits << ' ' << k;
      }
      for (const auto& line : shown.lines) {
        for (const Gaps& gaps : line) {
          EXPECT_LE(gaps.y2, window * (1 + 1e-12));
          EXPECT_LE(gaps.y1, gaps.y2 * (1 + 1e-12));
        }
      }
      EXPECT_LE(shown.filled_high, window * (1 + 1e-12));
    }
  }
}

TEST(CornerPath, CostsNoMoreForMoreCollisions) {
  const auto log = make_pair_log(article_system(20));
  const CornerPath path(*log, {0, 8}, 200);
  EXPECT_LT(path.least_y2(), 1e-18);
  for (double window = path.greatest_y2(); window > path.least_y2(); window /= 10) {
    std::size_t points = 0;
    for (const auto& line : path.shown({window, window / 200}).lines) points += line.size();
    EXPECT_LT(points, 300U) << window;
  }
}

/// The dot is where the gaps are, at the magnification that is said.
TEST(PositionPanel, ZoomsWithThePoint) {
  for (const int digits : {2, 5, 20}) {
    const Pictures pictures(digits, lecture("position"));
    const Rational turn = pictures.turn();
    const Shown far(pictures.at(0));
    EXPECT_FALSE(far.has_text("×10"));
    // The corner at the lower left is where the first line of the wedge begins.
    const auto corner_of = [](const Shown& shown) {
      return shown.paths.front().points.view().front().x;
    };
    const double scale =
        (far.discs.front().centre.x - corner_of(far)) / pictures.log->gaps_at(0).y2;
    const Shown near(pictures.at(turn));
    const double zoom =
        (near.discs.front().centre.x - corner_of(near)) / scale / pictures.log->gaps_at(turn).y2;
    EXPECT_NEAR(zoom, std::pow(10, digits - 1), 1e-9 * zoom) << digits;
    EXPECT_TRUE(near.has_text("×10")) << "with an exponent beside it from five digits on";
  }
}

/// Bars begin at zero, and their signed lengths are the momenta: red's, blue's, the wall's.
TEST(ConservationPanel, SumsAreConstant) {
  for (const int digits : {1, 2, 3}) {
    const Pictures pictures(digits, lecture("conservation"));
    const double mass = to_double(pictures.scene.system.bodies[1].mass.value());
    // All momentum is red's at first, to the left.
    const Rect first = Shown(pictures.at(0)).bars.at(1).bounds;
    const double zero = first.right();
    const auto momentum = [&](const RectangleItem& bar) {
      const Rect& box = bar.bounds;
      const bool is_right = std::abs(box.x - zero) < 1e-9;
      EXPECT_TRUE(is_right || std::abs(box.right() - zero) < 1e-9);
      return (is_right ? box.width : -box.width) / first.width;
    };
    for (Integer k = 1; k <= pictures.log->last(); k += 1) {
      const PairState state = state_after(*pictures.log, k);
      const std::vector<RectangleItem> bars = Shown(pictures.after(k)).bars;
      ASSERT_EQ(bars.size(), 4U);
      EXPECT_NEAR(momentum(bars[1]), state.red.velocity, 1e-9);
      EXPECT_NEAR(momentum(bars[2]), state.blue.velocity / mass, 1e-9);
      EXPECT_NEAR(momentum(bars[1]) + momentum(bars[2]) + momentum(bars[3]), -1, 1e-9) << k;
    }
  }
}

TEST(ConservationPanel, EnergyIsShared) {
  const Pictures pictures(3, lecture("conservation"));
  const double whole = Shown(pictures.at(0)).bars.front().bounds.width;
  for (Integer k = 1; k <= pictures.log->last(); k += 1) {
    const double velocity = state_after(*pictures.log, k).red.velocity;
    EXPECT_NEAR(Shown(pictures.after(k)).bars.front().bounds.width / whole, velocity * velocity,
                1e-9);
  }
}

/// Whoever pushes: walls on both sides, a fixed block, nobody; rows that blocks share, too.
TEST(ConservationPanel, BarsStayInTheirColumn) {
  const Body fixed{std::nullopt, {20, 0}, {}, 1};
  const Body heavy{30, {5, 0}, {3, 0}, 1};
  std::vector<System> systems(5, System{1, {{1, {2, 0}, {-7, 0}, 1}, heavy}, {}});
  systems[1].walls = {{"right", {9, 0}, {-1, 0}}};
  systems[2].walls = {{"left", {0, 0}, {1, 0}}, {"right", {9, 0}, {-1, 0}}};
  systems[3].bodies.push_back(fixed);
  systems[4] = systems[2];
  for (int i = 1; i < 9; ++i) systems[4].bodies.push_back({i, {5 + i, 0}, {i, 0}, Rational(1, 2)});
  systems[4].walls[1].point[0] = 30;
  for (const System& system : systems) {
    Scene scene = scene_with(1, lecture("conservation"));
    scene.system = system;
    scene.styles.resize(system.bodies.size());
    scene.time.to = Rational(40);
    const auto log = make_log(system, Rational(40));
    const Composition composition(scene, *log);
    double longest = 0;
    for (Rational time = 0; time < 40; time += Rational(1, 7)) {
      const Shown shown(composition.frame({.state = log->state_at(time), .time = time}));
      double left = HUGE_VAL;  // of figures
      for (const TextItem& text : shown.texts) {
        if (!text.text.ends_with("%") && text.text.find('.') != std::string::npos) {
          left = std::min(left, text.origin.x);
        }
      }
      const std::size_t parts = system.bodies.size() - 1;
      for (std::size_t i = parts; i < shown.bars.size(); ++i) {
        const Rect& bar = shown.bars[i].bounds;
        longest = std::max(longest, bar.width);
        EXPECT_GE(bar.x, shown.bars.front().bounds.x - 1e-6) << to_double(time);
        EXPECT_LE(bar.right(), left) << to_double(time);
      }
    }
    EXPECT_GT(longest, 20);
  }
}

TEST(GraphPanels, HoldAnySystem) {
  const std::vector<Settings> systems = {
      {{"blue.position", "4"}, {"blue.velocity", "-1"}},
      {{"base", "2"}, {"red.mass", "4096"}},
      {{"red.mass", "10^310"}},
      {{"red.mass", "1/10^310"}},
      {{"red.velocity", "0"}},
      {{"blue.velocity", "1/3"}, {"red.velocity", "0"}},
      {{"red.mass", "100"}, {"blue.velocity", "-100"}, {"red.velocity", "1"}}};
  for (const Settings& system : systems) {
    const Pictures pictures(
        1,
        Settings{{"show.panels", "position,time,count,conservation"}, {"time.to", "9"}} + system);
    for (const int time : {0, 3, 9}) {
      const Shown shown(pictures.at(time));
      for (const TextItem& text : shown.texts) {
        EXPECT_EQ(text.text.find("nan"), std::string::npos);
        EXPECT_EQ(text.text.find("inf"), std::string::npos);
      }
      for (const RectangleItem& bar : shown.bars) {
        EXPECT_GE(bar.bounds.x, 0);
        EXPECT_LE(bar.bounds.right(), pictures.scene.view.width_px);
      }
    }
  }
}

class GraphPanelShapes : public testing::TestWithParam<PanelShape> {};

/// Texts are apart from each other, and all is inside of the margins.
TEST_P(GraphPanelShapes, FitTheirPlaces) {
  const Fonts fonts;
  for (const char* theme : {"lecture", "lecture-light", "print"}) {
    for (const int digits : {1, 2, 3, 6, 20}) {
      const Pictures pictures(digits, {{"show.panels", GetParam().panels},
                                       {"view.size", GetParam().size},
                                       {"view.theme", theme}});
      const Sizes sizes(pictures.scene.view);
      for (const Rational& time :
           {Rational(0), Rational(3), pictures.turn(), Rational(pictures.turn() + 1)}) {
        const DrawList list = pictures.at(time);
        const Shown shown(list);
        const Rect place = whole_of(list).grown(1 - sizes.margin, 0);
        EXPECT_EQ(text_problem(boxes_of(shown.texts, fonts), place), "")
            << digits << " digits in " << theme << " at " << time;
        for (const TextItem& text : shown.texts) {
          EXPECT_LE(text.origin.y, list.height_px - sizes.margin / 2) << text.text;
        }
        for (const PathItem& path : shown.paths) {
          EXPECT_GE(path.points.bounds().x, place.x);
          EXPECT_LE(path.points.bounds().right(), place.right());
        }
        if (HasFailure()) return;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Shapes, GraphPanelShapes,
    testing::Values(PanelShape{"1280x720", "position,count"},
                    PanelShape{"1280x720", "time,conservation"},
                    PanelShape{"3840x2160", "position,time,count,conservation"},
                    PanelShape{"1080x1920", "position,time,count,conservation"},
                    PanelShape{"1080x1080", "count,conservation"},
                    PanelShape{"1080x1080", "position,time"},
                    PanelShape{"1440x1080", "position,time,count,conservation"},
                    PanelShape{"1920x1080", "position,time,count,conservation"}));

TEST(CountPanel, HasRisingIdsInTheWidestFrame) {
  const Pictures pictures(3, lecture("count", {{"view.size", "16384x400"}}));
  const DrawList list = pictures.at(100);
  EXPECT_GT(list.items.size(), 500U);
  EXPECT_TRUE(have_rising_ids(list));
}

}  // namespace
}  // namespace piblocks
