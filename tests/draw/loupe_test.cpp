// The loupe shows the gaps where they are, at any number of digits.
#include "draw/overlays/loupe.hpp"

#include <gtest/gtest.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "draw/canvas.hpp"
#include "draw/lecture_frames.hpp"
#include "support/contains.hpp"
#include "support/message_of.hpp"
#include "support/oracle.hpp"
#include "support/traced_random.hpp"

namespace piblocks {
namespace {
using testing_support::contains;
using testing_support::message_of;

struct ExactGaps {
  Rational y1;
  Rational y2;
};

ExactGaps exact_gaps(const TwoBlocks& system, const Rational& time) {
  const auto state = oracle::high_precision_state(system, time, 1024);
  return {
      state.blue.position - system.blue.width / 2 - system.wall_face,
      state.red.position - system.wall_face - system.blue.width - system.red.width / 2,
  };
}

void expect_exact(const Frames& frames, const Rational& time, int& plateaus) {
  const DrawList frame = frames.at(time);
  const auto seen = loupe_in(frame);
  ASSERT_TRUE(seen) << to_double(time);
  const ExactGaps gaps = exact_gaps(*two_blocks_of(frames.scene().system), time);
  const double tolerance = 1e-9 * seen->bounds.width;
  const double blue_gap = seen->blue.x - seen->face;
  const double red_gap = seen->red.x - seen->face - seen->blue.width;
  EXPECT_NEAR(blue_gap, red_gap * to_double(gaps.y1 / gaps.y2), tolerance);
  const std::string& zoom = seen->zoom;
  for (const auto& [text, factor] : {std::pair("×10", 10), {"×100", 100}, {"×1,000", 1000}}) {
    // What is rounded to it is not it.
    const double expected = to_double(gaps.y2) * pixels_per_unit(frame, frames.scene()) * factor;
    if (zoom != text || std::fabs(red_gap / expected - 1) > 1e-6) continue;
    EXPECT_NEAR(red_gap, expected, tolerance);
    ++plateaus;
  }
}

TEST(Loupe, ShowsTheGapsWhereTheyAre) {
  TracedRandom random(202611);
  for (const int digits : {3, 5, 20}) {
    SCOPED_TRACE(digits);
    const Frames frames(lecture(digits));
    int plateaus = 0;
    expect_exact(frames, frames.turn(), plateaus);
    for (std::int64_t i = 0; i < many(60); ++i) {
      const auto scale = static_cast<unsigned long>(random.integer(1, 7L * digits));
      const Rational distance = Rational(random.uniform(-0.5, 0.5)) / power(2, scale);
      expect_exact(frames, frames.turn() + distance, plateaus);
    }
    for (const char* near : {"0.01", "-0.02", "0.06", "-0.1", "0.15"}) {
      expect_exact(frames, frames.turn() + parse_rational(near), plateaus);
    }
    EXPECT_GT(plateaus, 3);
  }
}

/// What all texts of a thing say.
std::string texts_of(const DrawList& list, ItemId thing) {
  std::string all;
  for (const auto& item : items_of<TextItem>(list.items, thing)) all += item.text;
  return all;
}

TEST(Loupe, SaysPowersOfTenAtTheTurn) {
  const auto power_at_turn = [](int digits) {
    const Frames frames(lecture(digits));
    return texts_of(frames.at(frames.turn()), ItemId::loupe);
  };
  EXPECT_EQ(power_at_turn(3), "×100");
  EXPECT_EQ(power_at_turn(4), "×1,000");
  EXPECT_EQ(power_at_turn(5), "×104");  // the exponent is raised
  EXPECT_EQ(power_at_turn(20), "×1019");
}

TEST(Loupe, KeepsRedsFaceInside) {
  for (const char* size : {"1280x720", "1080x1920", "800x800"}) {
    for (const int digits : {2, 3, 5, 8, 20}) {
      SCOPED_TRACE(std::string(size) + ", digits " + std::to_string(digits));
      const Frames frames(lecture(digits, size));
      int seen_times = 0;
      for (double y2 = 1; y2 > std::pow(10.0, -digits); y2 *= 0.97) {
        FrameState state = frames.state({frames.turn()});
        state.gaps = {y2 / 3, y2};
        const auto seen = loupe_in(frames.of(state));
        if (!seen) continue;
        ++seen_times;
        EXPECT_GT(seen->red.x, seen->face + seen->blue.width);
        EXPECT_LT(seen->red.x, seen->bounds.width - 0.03 * 720);
        EXPECT_GT(seen->red.right(), seen->bounds.width);
      }
      EXPECT_GT(seen_times, 20);
    }
  }
}

/// From one power of ten to the next in 0.4 s of the video; red never leaves the inset.
TEST(Loupe, SaysWholePowersOfTenAlone) {
  const Frames frames(lecture(4) + Settings{{"time.from", "turn-0.3"},
                                            {"time.to", "turn+0.3"},
                                            {"time.slow-motion", "turn-0.1:turn+0.1:20"}});
  const Schedule schedule = make_schedule(frames.scene(), frames.log());
  std::set<std::string> said;
  double before = 0;
  int changes = 0;
  for (std::int64_t n = 0; n < schedule.frame_count().get_si(); ++n) {
    const FrameState state = frames.film_state(schedule, n);
    const auto seen = loupe_in(frames.of(state));
    if (!seen) continue;
    said.insert(seen->zoom);
    EXPECT_LT(seen->red.x, seen->bounds.width);
    const double zoom = (seen->red.x - seen->face - seen->blue.width) / state.gaps.y2;
    // A power of ten in 24 frames is 20 % in the steepest, or the gap grows as much.
    if (before > 0) {
      EXPECT_LT(std::fabs(std::log10(zoom / before)), 1.5 / 24 + 0.03) << n;
      changes += std::fabs(zoom / before - 1) > 0.01 ? 1 : 0;
    }
    before = zoom;
  }
  // The gap is small enough for a thousand times only for 0.02 s, and for the first power from 0.4
  // s on: until then it fills the inset, which is not a whole power.
  EXPECT_EQ(said, (std::set<std::string>{"", "×10", "×100"}));
  EXPECT_GT(changes, 48) << "two eases of 24 frames";
}

TEST(Loupe, FadesWithTheGap) {
  const Frames frames(lecture(3));
  double before = 0;
  bool was_half_seen = false;
  for (double y2 = 2; y2 > 1e-3; y2 *= 0.99) {
    FrameState state = frames.state({frames.turn()});
    state.gaps = {0, y2};
    const DrawList frame = frames.of(state);
    const auto seen = loupe_in(frame);
    const double gap_px = y2 * pixels_per_unit(frame, frames.scene());
    const double opacity = seen ? seen->opacity : 0;
    EXPECT_EQ(opacity > 0, gap_px < 72) << gap_px;
    EXPECT_GE(opacity, before);
    EXPECT_LE(opacity, before + 0.03);
    was_half_seen |= opacity > 0.4 && opacity < 0.6;
    before = opacity;
  }
  EXPECT_EQ(before, 1);
  EXPECT_TRUE(was_half_seen);
}

/// Lines beside the blocks begin where red hides them, and stay while the gap is small.
TEST(Loupe, ItsLinesStay) {
  for (const char* width : {"1", "1/5", "5/2"}) {
    const Frames frames(lecture(3) + Settings{{"red.width", width}, {"show.overlays", "none"}});
    std::set<double> begins;
    for (Rational time = frames.turn() - 1; time < frames.turn() + 1; time += Rational(1, 60)) {
      const DrawList frame = frames.at(time);
      const auto seen = loupe_in(frame);
      if (!seen) continue;
      const Rect red = items_of<RectangleItem>(frame.items, ItemId::red_block).front().bounds;
      const double gap_px = frames.state({time}).gaps.y2 * pixels_per_unit(frame, frames.scene());
      for (const PathItem& line : items_of<PathItem>(frame.items, ItemId::wall)) {
        const double begin = line.points.view()[0].x;
        EXPECT_GE(begin, red.x + 0.6 * red.width - 1) << width;
        EXPECT_LE(begin, red.right() + 1) << width;
        if (gap_px < 0.3 * red.width) begins.insert(begin);
      }
    }
    EXPECT_EQ(begins.size(), 1U) << width;
  }
}

TEST(Loupe, IsOnlyWhereItIsAskedFor) {
  const Settings dark = {{"digits", "3"}, {"view.theme", "dark"}};
  const Frames plain(dark);
  const Frames off(dark + Settings{{"show.loupe", "off"}});
  const Frames asked(dark + Settings{{"show.loupe", "auto"}});
  const Frames article(Settings{{"show.loupe", "auto"}});
  const Frames lecture_off(lecture(3) + Settings{{"show.loupe", "off"}});
  EXPECT_EQ(draw_pixels(plain.at(plain.turn())).words, draw_pixels(off.at(off.turn())).words);
  EXPECT_FALSE(loupe_in(plain.at(plain.turn())));
  EXPECT_FALSE(loupe_in(lecture_off.at(plain.turn())));
  EXPECT_TRUE(loupe_in(asked.at(asked.turn())));
  EXPECT_TRUE(loupe_in(article.at(article.turn())));
  // Gaps cost time and are found out only where they are shown.
  EXPECT_EQ(off.state({off.turn()}).gaps.y2, 0);
  EXPECT_GT(asked.state({asked.turn()}).gaps.y2, 0);
  // Equal masses never come near each other.
  EXPECT_EQ(Frames(lecture(1)).state({Rational(3)}).gaps.y2, 0);
}

TEST(Loupe, OfAWindowHasItsZoomAndIsNotSeenOutside) {
  const Frames frames(lecture(4) + Settings{{"show.loupe", "turn-0.01:turn+0.01:50"}});
  const auto zoom_at = [&](const char* distance) {
    const auto seen = loupe_in(frames.at(frames.turn() + parse_rational(distance)));
    return seen ? seen->zoom : std::string();
  };
  EXPECT_EQ(zoom_at("0"), "×50");
  EXPECT_EQ(zoom_at("0.009"), "×50");
  EXPECT_EQ(zoom_at("0.0101"), "");
  EXPECT_EQ(zoom_at("-0.0101"), "");
  const auto edge = loupe_in(frames.at(frames.turn() - parse_rational("0.0099")));
  ASSERT_TRUE(edge);
  EXPECT_NEAR(edge->opacity, 0.05, 1e-9);
  // Red stays in sight.
  const Frames large(lecture(4) + Settings{{"show.loupe", "turn-0.1:turn+0.1:10^9"}});
  const auto turn = loupe_in(large.at(large.turn()));
  ASSERT_TRUE(turn);
  EXPECT_LT(turn->red.x, turn->bounds.width);
}

std::string refusal_of(const Settings& settings) {
  return message_of<Error>([&] { Frames{settings}; });
}

TEST(Loupe, SaysWhyItCannotBeShown) {
  const Settings window = {{"show.loupe", "turn-1:turn+1:10"}};
  EXPECT_TRUE(contains(refusal_of(lecture(3, "200x150") + window), "show.loupe: there is no room"));
  EXPECT_EQ(refusal_of(lecture(3, "200x150")), "");
  Scene away = scene_with(lecture(3) + window);
  away.view.x = {1, 12};
  EXPECT_THROW(Frames{away}, UsageError);
  for (const char* wrong :
       {"last:#1:10", "on", "turn:last", "turn:last:1", "3:2:10", "turn:last:ten", "1:2:3:4"}) {
    EXPECT_TRUE(contains(refusal_of(lecture(3) + Settings{{"show.loupe", wrong}}), "show.loupe"))
        << wrong;
  }
}

TEST(Loupe, IsRefusedWhereItIsNeverSeen) {
  const auto expect = [](int digits, const char* window, const char* message) {
    const std::string refusal = refusal_of(lecture(digits) + Settings{{"show.loupe", window}});
    EXPECT_TRUE(contains(refusal, message)) << window;
    EXPECT_EQ(refusal.find('\n'), std::string::npos);
  };
  expect(1, "turn-0.3:turn+0.3:10",
         "show.loupe: in its window from 16/5 to 19/5 the gap is never below");
  expect(3, "turn+2:turn+3:10", "the loupe is seen below 72; move the window to the turn");
  expect(3, "turn-3:turn-2:10", "is never below");
  expect(1, "100:101:10",
         "show.loupe: its window from 100 to 101 is outside of what is shown, 0 to");
  expect(3, "-2:-1:10", "is outside of what is shown");
  // It is seen at one end alone, or before and after what is shown too.
  for (const char* window : {"turn+0.2:turn+1:10", "turn-1:turn-0.2:10", "-5:100:10"}) {
    EXPECT_EQ(refusal_of(lecture(3) + Settings{{"show.loupe", window}}), "") << window;
  }
  // A light red is nearest at a collision beside the turn.
  EXPECT_EQ(refusal_of({{"view.theme", "lecture"},
                        {"mass-ratio", "1/400"},
                        {"blue.position", "0.55"},
                        {"show.loupe", "turn-1:turn+1:10"}}),
            "");
}

TEST(Loupe, ShowsTheWayThatBlueSweepsWhereFramesMissItsHits) {
  const Frames frames(lecture(3));
  FrameState state = frames.state({frames.turn()});
  int before = 0;
  for (double rate = 10; rate < 1e6; rate *= 1.1) {
    state.hits_per_s = rate;
    const auto seen = loupe_in(frames.of(state));
    const auto blue = items_of<RectangleItem>(seen->list.items, ItemId::blue_block).front();
    const auto red = items_of<RectangleItem>(seen->list.items, ItemId::red_block);
    const auto bodies = std::ranges::count(red, seen->red, &RectangleItem::bounds);
    EXPECT_EQ(bodies, 1);
    const int alpha = red.size() > 1 ? red.back().fill->alpha : 0;
    EXPECT_EQ(alpha > 0, rate > 15.5) << rate;
    EXPECT_GE(alpha, before);
    EXPECT_EQ(blue.fill->alpha == 255, alpha == 0);
    if (red.size() > 1) {
      EXPECT_NEAR(red.back().bounds.x, seen->face, 1e-9);
      EXPECT_NEAR(red.back().bounds.right(), seen->red.x, 1e-9);
    }
    before = alpha;
  }
  EXPECT_LT(before, 140);
}

TEST(Loupe, SaysHowMuchSlowerTimeRuns) {
  const Frames frames(lecture(3) + Settings{{"time.slow-motion", "turn-0.1:turn+0.1:100"}});
  FrameState state = frames.state({frames.turn(), Rational(100)});
  DrawList frame = frames.of(state);
  EXPECT_EQ(texts_of(loupe_in(frame)->list, ItemId::label), "100× slower");
  EXPECT_EQ(texts_of(frame, ItemId::read_outs), "");
  state.gaps.y2 = 2;
  frame = frames.of(state);
  EXPECT_FALSE(loupe_in(frame));
  EXPECT_EQ(texts_of(frame, ItemId::read_outs), "100× slower");
}

TEST(Loupe, LeavesNoRoomForALabelThatItDoesNotHave) {
  const char* const kLong = "turn-0.1:turn+0.1:12345.6789";
  int seen = 0;
  for (const char* size :
       {"1280x720", "1080x1920", "800x800", "1024x768", "1600x600", "720x1600", "1280x560"}) {
    const Settings content =
        lecture(3, size) + Settings{{"show.overlays", "masses,velocities,time"}};
    const Frames plain(content);
    const Frames slow(content + Settings{{"time.slow-motion", kLong}});
    const auto without = loupe_in(plain.at(plain.turn()));
    const DrawList frame = slow.of(slow.state({slow.turn(), parse_rational("12345.6789")}));
    const auto with = loupe_in(frame);
    if (!without || !with) continue;
    ++seen;
    EXPECT_TRUE(items_of<TextItem>(with->list.items, ItemId::label).empty());
    EXPECT_EQ(items_of<TextItem>(frame.items, ItemId::read_outs).size(), 2U);
    EXPECT_EQ(with->red.height, without->red.height) << size;
    EXPECT_EQ(with->bounds.height, without->bounds.height) << size;
  }
  EXPECT_GT(seen, 3);
}

}  // namespace
}  // namespace piblocks
