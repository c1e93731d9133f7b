// Slow motion that sets in and ends gradually: exact, and only where there is room.
#include <gtest/gtest.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <chrono>
#include <string>
#include <vector>

#include "scene/pacing.hpp"
#include "scene/pacing_fixture.hpp"
#include "support/traced_random.hpp"

namespace piblocks {
namespace {

std::vector<Move> paced(const Scene& scene) {
  const auto log = make_pair_log(scene.system);
  return moves_of(scene, *log, span_of(scene, *log));
}

Scene with_ease(Scene scene, Rational ease_s) {
  scene.pacing.ease_s = std::move(ease_s);
  return scene;
}

bool is_frozen(const Move& move) { return move.frozen_s > 0; }

/// Windows in order, many of them next to each other or so near that eases have no room; the first
/// may begin with the span. Freezes anywhere, also at their borders.
Scene any_pacing(Random& random) {
  Scene scene = paced_scene({{"time.from", "0"}, {"time.to", "10"}});
  Rational at = random.integer(0, 2) == 0 ? Rational(0) : random.rational(0, 2, 50);
  for (std::int64_t i = random.integer(1, 5); i > 0 && at < 9; --i) {
    const Rational to = at + random.rational(0, 1, 40) + Rational(1, 40);
    const Rational factor = random.rational(1, 60, 3);
    scene.pacing.slow_motion.push_back(
        {Instant(at), Instant(to), random.integer(0, 4) == 0 ? Rational(1 / factor) : factor});
    if (random.integer(0, 3) == 0) scene.pacing.freezes.push_back({Instant(to), Rational(1, 3)});
    at = to + (random.integer(0, 2) == 0 ? Rational(0) : random.rational(0, 1, 100));
  }
  if (random.integer(0, 1) == 0) {
    scene.pacing.freezes.push_back({Instant(random.rational(0, 10, 50)), 1});
  }
  scene.time.speed = random.rational(1, 3, 4);
  scene.pacing.ease_s = random.rational(0, 2, 60) + Rational(1, 100);
  return scene;
}

TEST(Ease, FillsTheSpanAndNeverRunsFasterThanWithoutIt) {
  TracedRandom random(1912);
  for (int run = 0; run < many(150); ++run) {
    const Scene scene = any_pacing(random);
    const std::vector<Move> eased = paced(scene);
    const std::vector<Move> plain = paced(with_ease(scene, 0));
    EXPECT_EQ(eased.back().to, 10);
    EXPECT_EQ(std::ranges::count_if(eased, is_frozen), std::ranges::count_if(plain, is_frozen));
    for (std::size_t i = 0; i < eased.size(); ++i) {
      const Move& move = eased[i];
      ASSERT_EQ(is_frozen(move), move.from == move.to) << i;
      ASSERT_EQ(move.from, i > 0 ? eased[i - 1].to : Rational(0)) << i;
      const bool is_no_faster = std::ranges::any_of(plain, [&](const Move& without) {
        return without.from <= move.from && move.to <= without.to &&
               without.frozen_s == move.frozen_s && without.slowdown <= move.slowdown;
      });
      ASSERT_TRUE(is_no_faster) << i;
    }
    expect_no_gaps(schedule_of(scene));
    if (HasFailure()) return;
  }
}

/// What is slower than its neighbours keeps its speed from beginning to end.
TEST(Ease, LeavesTheSlowerSideAsItIs) {
  TracedRandom random(2112);
  int kept = 0;
  for (int run = 0; run < many(100); ++run) {
    const Scene scene = any_pacing(random);
    const std::vector<Move> eased = paced(scene);
    const std::vector<Move> plain = paced(with_ease(scene, 0));
    for (std::size_t i = 0; i < plain.size(); ++i) {
      const auto is_no_faster = [&](std::size_t k) {
        return k >= plain.size() || is_frozen(plain[k]) || plain[k].slowdown <= plain[i].slowdown;
      };
      if (!is_no_faster(i - 1) || !is_no_faster(i + 1)) continue;
      const auto same = std::ranges::find_if(eased, [&](const Move& move) {
        return move.from == plain[i].from && move.to == plain[i].to &&
               move.frozen_s == plain[i].frozen_s;
      });
      ASSERT_NE(same, eased.end()) << i;
      EXPECT_EQ(same->slowdown, plain[i].slowdown) << i;
      ++kept;
    }
  }
  EXPECT_GT(kept, many(100));
}

TEST(Ease, NoStepIsMoreThanAnEighthOfTheChange) {
  for (const char* factor : {"2", "10", "1000", "1/5"}) {
    for (const char* ease : {"0.01", "0.5", "1/3", "5"}) {
      // Two of the windows are close to each other, one begins early.
      const Scene scene =
          paced_scene({{"time.to", "10"},
                       {"time.speed", "3/2"},
                       {"time.ease", ease},
                       {"time.slow-motion",
                        std::string("0.03:1:") + factor + ",3:4:" + factor + ",4.01:5:" + factor}});
      const std::vector<Move> moves = paced(scene);
      const Rational whole = abs(Rational(1 - 1 / parse_rational(factor)));
      for (std::size_t i = 1; i < moves.size(); ++i) {
        const Rational jump = 1 / moves[i].slowdown - 1 / moves[i - 1].slowdown;
        EXPECT_LE(abs(jump), whole / 8) << factor << ", " << ease << ": " << i;
      }
    }
  }
}

TEST(Ease, TakesItsTimeBesideTheWindow) {
  const Schedule schedule = schedule_of({{"time.to", "10"}, {"time.slow-motion", "2:4:10"}});
  // Half a second at the mean of both speeds shows 0.275, which takes 0.225 s less without.
  EXPECT_EQ(schedule.frame_count(), 60 * (8 + 20) + 60 * 2 * Rational(9, 40));
  const Rational ease_s(1, 2);
  const Rational begin_s = 2 - Rational(11, 40);
  EXPECT_EQ(schedule.at(begin_s).time, begin_s);
  EXPECT_EQ(schedule.at(begin_s - Rational(1, 1000)).slowdown, 1);
  EXPECT_GT(schedule.at(begin_s).slowdown, 1);
  EXPECT_EQ(schedule.at(begin_s + ease_s).time, 2);
  EXPECT_EQ(schedule.at(begin_s + ease_s).slowdown, 10);
  const Rational end_s = begin_s + ease_s + 20;
  EXPECT_EQ(schedule.at(end_s - Rational(1, 1000)).slowdown, 10);
  EXPECT_EQ(schedule.at(end_s).time, 4);
  EXPECT_LT(schedule.at(end_s).slowdown, 10);
  EXPECT_EQ(schedule.at(end_s + ease_s).time, 4 + Rational(11, 40));
  EXPECT_EQ(schedule.at(end_s + ease_s).slowdown, 1);
  // The integral of 1 - 0.9 (3u^2 - 2u^3) from 1/2 to 1.
  EXPECT_NEAR(to_double(2 - schedule.at(begin_s + ease_s / 2).time), 0.5 * (0.5 - 0.9 * 0.40625),
              4e-5);
}

TEST(Ease, OfNothingIsAJump) {
  const Schedule schedule =
      schedule_of({{"time.to", "10"}, {"time.ease", "0"}, {"time.slow-motion", "2:4:10"}});
  EXPECT_EQ(schedule.stretches().size(), 3 + kStand);
  EXPECT_EQ(schedule.frame_count(), 60 * (8 + 20));
}

TEST(Ease, IsNotWhereNothingMovesOrNothingIsBeside) {
  // A window from the first instant to the last, one that a freeze follows, and a freeze elsewhere.
  EXPECT_EQ(schedule_of({{"time.to", "4"}, {"time.slow-motion", "0:4:10"}}).stretches().size(),
            1 + kStand);
  const Scene frozen =
      paced_scene({{"time.to", "4"}, {"time.slow-motion", "0:2:10"}, {"time.freeze", "2:1,3:1"}});
  EXPECT_EQ(schedule_of(frozen).stretches().size(), 5 + kStand);
  const Scene held =
      paced_scene({{"time.to", "4"}, {"time.hold-start", "1"}, {"time.hold-end", "1"}});
  EXPECT_EQ(schedule_of(held).stretches().size(), 2 + kStand);
}

TEST(Ease, IsMeasuredAtTheSpeedOfTheSceneAndScaledByADuration) {
  const auto begin_of_window = [](const Setting& speed) {
    const Schedule schedule =
        schedule_of({{"time.to", "10"}, {"time.slow-motion", "4:6:10"}, speed});
    const auto stretches = schedule.stretches();
    const auto first_step = std::ranges::find_if(
        stretches, [](const Stretch& stretch) { return stretch.slowdown != 1; });
    const auto window = std::ranges::find(stretches, Rational(10), &Stretch::slowdown);
    return std::pair<Rational, Rational>(window->video_s - first_step->video_s,
                                         window->time - first_step->time);
  };
  const Rational span(11, 40);
  EXPECT_EQ(begin_of_window({"time.speed", "1"}), std::pair(Rational(1, 2), span));
  EXPECT_EQ(begin_of_window({"time.speed", "3"}), std::pair(Rational(1, 2), Rational(3 * span)));
  // At speed 1 the video is 28.45 s long.
  EXPECT_EQ(begin_of_window({"time.duration", "56.9"}), std::pair(Rational(1), span));
}

TEST(Ease, LeavesTheDurationAsItIsAsked) {
  for (const char* duration : {"5", "20", "61/60", "7.777"}) {
    for (const char* to : {"last+1", "9"}) {
      for (const char* loop : {"false", "true"}) {
        const Schedule schedule = schedule_of({{"time.to", to},
                                               {"time.duration", duration},
                                               {"time.ease", "2"},
                                               {"time.loop", loop},
                                               {"time.slow-motion", "auto,1:1.2:7"}});
        expect_no_gaps(schedule);
        Integer frames = ceil(parse_rational(duration) * 60);
        if (*loop == 't') frames += frames % 2;
        EXPECT_EQ(schedule.frame_count(), frames) << duration << to << loop;
      }
    }
  }
}

TEST(Ease, OfAThousandWindowsIsFast) {
  Scene scene = paced_scene({{"time.to", "10"}, {"time.ease", "5"}});
  for (int i = 0; i < int(kMaxWindows); ++i) {
    const Rational from = Rational(i) / 100;
    scene.pacing.slow_motion.push_back({from, Rational(from + Rational(1, 700)), 2 + i});
  }
  const auto begin = std::chrono::steady_clock::now();
  const Schedule schedule = schedule_of(scene);
  const std::chrono::duration<double> taken_s = std::chrono::steady_clock::now() - begin;
  EXPECT_GT(schedule.stretches().size(), 20'000U);
  EXPECT_LT(taken_s.count(), 10) << "a fraction of a second, unless the machine is busy";
  expect_no_gaps(schedule);
}

}  // namespace
}  // namespace piblocks
