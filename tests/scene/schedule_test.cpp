#include "scene/schedule.hpp"

#include <gtest/gtest.h>
#include <piblocks/error.hpp>
#include <piblocks/script.hpp>
#include <piblocks/two_blocks.hpp>

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "scene/pacing_fixture.hpp"
#include "support/contains.hpp"
#include "support/message_of.hpp"
#include "support/traced_random.hpp"

namespace piblocks {
namespace {

using testing_support::contains;
using testing_support::message_of;

Rational frame_time(const Schedule& schedule, const Integer& frame, int rate = 60) {
  return schedule.at(Rational(frame) / rate).time;
}

TEST(Schedule, RunsEvenlyUnlessAskedOtherwise) {
  const Schedule schedule = schedule_of({{"time.from", "1"}, {"time.speed", "1/3"}});
  ASSERT_EQ(schedule.stretches().size(), 1 + kStand);
  EXPECT_EQ(schedule.at(Rational(7, 2)).time, 1 + Rational(7, 6));
  EXPECT_EQ(schedule.at(Rational(7, 2)).slowdown, 1);
}

TEST(Schedule, WindowTakesItsFactorOfTime) {
  const Schedule plain = schedule_of({{"time.to", "10"}});
  const Schedule slow =
      schedule_of({{"time.to", "10"}, {"time.ease", "0"}, {"time.slow-motion", "2:4:10"}});
  expect_no_gaps(slow);
  EXPECT_EQ(slow.frame_count() - plain.frame_count(), 2 * 9 * 60);
  EXPECT_EQ(slow.at(2).time, 2);
  EXPECT_EQ(slow.at(12).time, 3);
  EXPECT_EQ(slow.at(12).slowdown, 10);
  EXPECT_EQ(slow.at(22).time, 4);
  EXPECT_EQ(slow.at(22).slowdown, 1);
  EXPECT_EQ(slow.at(23).time, 5);
}

TEST(Schedule, WindowsAreCutToWhatIsShown) {
  const Schedule schedule = schedule_of({{"time.from", "3"},
                                         {"time.to", "4"},
                                         {"time.ease", "0"},
                                         {"time.slow-motion", "1:3.5:2,3.9:7:3"}});
  expect_no_gaps(schedule);
  EXPECT_EQ(schedule.frame_count(), 60 * (1 + Rational(1, 2) + Rational(1, 10) * 2));
}

TEST(Schedule, MomentsAreMeasuredFromTurnAndLastCollision) {
  const Scene scene = paced_scene({{"time.to", "last+1"}, {"time.freeze", "turn:2,last+0.5:1"}});
  const auto log = make_pair_log(scene.system);
  const Schedule schedule = make_schedule(scene, *log);
  expect_no_gaps(schedule);
  const auto stretches = schedule.stretches();
  ASSERT_EQ(stretches.size(), 5 + kStand);
  // The article's turn: red's reduced gap of 3.5 at unit speed.
  EXPECT_EQ(stretches[1].time, Rational(7, 2));
  EXPECT_EQ(stretches[1].speed, 0);
  EXPECT_EQ(stretches[2].video_s - stretches[1].video_s, 2);
  EXPECT_EQ(stretches[3].time, log->time_after(log->last()) + Rational(1, 2));
}

TEST(Schedule, DurationIsMetToTheFrame) {
  for (const char* duration : {"5", "20", "61/60", "7.777"}) {
    for (const char* to : {"last+1", "9"}) {
      const Schedule schedule = schedule_of(
          {{"time.to", to}, {"time.duration", duration}, {"time.slow-motion", "2:4:3"}});
      expect_no_gaps(schedule);
      EXPECT_EQ(schedule.frame_count(), ceil(parse_rational(duration) * 60)) << duration << to;
    }
  }
}

TEST(Schedule, DurationOfARunShownToItsEndEndsThere) {
  const Scene scene = paced_scene({{"time.to", "last+1"}, {"time.duration", "20"}});
  const auto log = make_pair_log(scene.system);
  const Schedule schedule = make_schedule(scene, *log);
  EXPECT_EQ(frame_time(schedule, schedule.frame_count() - 1), log->time_after(log->last()) + 1);
}

TEST(Schedule, DurationCountsWhatStands) {
  const std::vector<Setting> settings = {{"time.duration", "20"}, {"time.hold-start", "2"},
                                         {"time.hold-end", "3"},  {"time.freeze", "turn:1.5"},
                                         {"time.to", "last"},     {"time.slow-motion", "auto"}};
  const Schedule schedule = schedule_of(settings);
  expect_no_gaps(schedule);
  EXPECT_EQ(schedule.frame_count(), 20 * 60);
  EXPECT_EQ(frame_time(schedule, 0), 0);
  EXPECT_EQ(frame_time(schedule, 120), 0);
  EXPECT_GT(frame_time(schedule, 121), 0);
  const Rational last = frame_time(schedule, 1199);
  EXPECT_EQ(frame_time(schedule, 1199 - 180), last);
  EXPECT_LT(frame_time(schedule, 1199 - 181), last);
}

TEST(Schedule, HoldsAddWholeFrames) {
  const Schedule plain = schedule_of(std::vector<Setting>());
  const Schedule held = schedule_of({{"time.hold-start", "0.51"}, {"time.hold-end", "1/61"}});
  expect_no_gaps(held);
  EXPECT_EQ(held.frame_count() - plain.frame_count(), 31 + 1);
  for (int frame : {0, 1, 100, 500}) {
    EXPECT_EQ(frame_time(held, frame + 31), frame_time(plain, frame));
  }
}

TEST(Schedule, LoopComesBackFrameByFrame) {
  struct Case {
    const char* to;
    const char* windows;
    const char* hold_end;
  };
  // The last two have windows that end, or begin and end, after the last frame.
  for (const auto& [to, windows, hold_end] : {Case{"last+1", "2:2.31:7,turn:turn+0.1:10", "0.3"},
                                              {"9.99", "2:2.31:7,turn:turn+0.1:10", "0.3"},
                                              {"9.99", "2:2.31:7,9.9:9.989:2", "0"},
                                              {"9.999", "2:2.31:7,9.995:9.998:3", "0"}}) {
    const std::vector<Setting> settings = {{"time.to", to},
                                           {"time.slow-motion", windows},
                                           {"time.hold-end", hold_end},
                                           {"time.hold-start", "0.1"},
                                           {"time.freeze", "5:1"}};
    std::vector<Setting> looped = settings;
    looped.emplace_back("time.loop", "true");
    const Schedule forth = schedule_of(settings);
    const Schedule schedule = schedule_of(looped);
    expect_no_gaps(schedule);
    const Integer frames = schedule.frame_count();
    EXPECT_EQ(frames, 2 * forth.frame_count() - 2);
    for (Integer frame = 0; frame < frames; frame += 1) {
      const Integer twin = frame == 0 ? Integer(0) : Integer(frames - frame);
      ASSERT_EQ(frame_time(schedule, frame), frame_time(schedule, twin)) << frame;
    }
    for (Integer frame = 0; frame < forth.frame_count(); frame += 1) {
      ASSERT_EQ(frame_time(schedule, frame), frame_time(forth, frame)) << frame;
    }
  }
}

TEST(Schedule, LoopTakesTheDurationAsAWhole) {
  for (const char* to : {"last+1", "9"}) {
    const auto frames = [&](const char* duration) {
      return schedule_of({{"time.to", to}, {"time.loop", "true"}, {"time.duration", duration}})
          .frame_count();
    };
    EXPECT_EQ(frames("12"), 720) << to;
    // Forth and back is an even number of frames, and no length is cut.
    EXPECT_EQ(frames("61/60"), 62) << to;
    EXPECT_EQ(frames("62/60"), 62) << to;
  }
}

TEST(Schedule, DurationIsInPlaceOfASpeed) {
  const std::vector<Setting> fitted = {{"time.duration", "20"}, {"time.slow-motion", "auto"}};
  std::vector<Setting> faster = fitted;
  faster.insert(faster.begin(), {"time.speed", "1/4"});
  const Scene plain = paced_scene(fitted);
  EXPECT_EQ(describe(paced_scene(faster)), describe(plain));
  Scene by_hand = plain;
  by_hand.time.speed = Rational(1, 4);
  const Schedule one = schedule_of(plain);
  const Schedule other = schedule_of(by_hand);
  ASSERT_EQ(one.stretches().size(), other.stretches().size());
  for (std::size_t i = 0; i < one.stretches().size(); ++i) {
    EXPECT_EQ(one.stretches()[i].video_s, other.stretches()[i].video_s);
    EXPECT_EQ(one.stretches()[i].speed, other.stretches()[i].speed);
  }
}

TEST(Schedule, AutomaticWindowsTellCollisionsApart) {
  for (int digits = 2; digits <= 3; ++digits) {
    const Scene scene = paced_scene({{"time.slow-motion", "auto"}}, digits);
    const auto log = make_pair_log(scene.system);
    const Schedule schedule = make_schedule(scene, *log);
    expect_no_gaps(schedule);
    // At the turn, where the video stands in the middle of its slowest stretches.
    const Rational turn = *turn_of(*two_blocks_of(scene.system));
    const auto stretches = schedule.stretches();
    const auto slowest = std::ranges::max_element(stretches, {}, &Stretch::slowdown);
    const Rational turn_s = slowest->video_s + (turn - slowest->time) / slowest->speed;
    const Integer in_a_second = log->blocks_at(schedule.at(turn_s + Rational(1, 2)).time).count -
                                log->blocks_at(schedule.at(turn_s - Rational(1, 2)).time).count;
    EXPECT_LE(in_a_second, 11) << digits;
    EXPECT_GE(in_a_second, 3) << digits;
  }
}

// A scene in other units is the same video.
TEST(Schedule, AutomaticWindowsDoNotDependOnUnits) {
  const std::vector<Setting> settings = {{"time.to", "last"}, {"time.slow-motion", "auto"}};
  const Schedule usual = schedule_of(settings);
  for (const char* velocity : {"1e-200", "1e200"}) {
    Scene scene = paced_scene(settings);
    scene.system.bodies[1].velocity[0] *= parse_rational(velocity);
    scene.time.speed /= parse_rational(velocity);
    const Schedule schedule = schedule_of(scene);
    EXPECT_EQ(schedule.stretches().size(), usual.stretches().size()) << velocity;
    EXPECT_EQ(schedule.frame_count(), usual.frame_count()) << velocity;
  }
}

TEST(Schedule, AutomaticWindowsStopWhereNothingMovesAnyMore) {
  const Schedule schedule = schedule_of({{"time.slow-motion", "auto"}, {"time.ease", "0"}}, 20);
  const auto stretches = schedule.stretches();
  EXPECT_EQ(std::ranges::max_element(stretches, {}, &Stretch::slowdown)->slowdown, 1000);
  EXPECT_EQ(stretches.size(), 7 + kStand);
}

TEST(Schedule, AutomaticWindowsAreAlsoAroundATurnBeforeTimeZero) {
  Scene scene = paced_scene(
      {{"time.from", "-20"}, {"time.to", "1"}, {"time.ease", "0"}, {"time.slow-motion", "auto"}});
  scene.system.bodies[1].velocity[0] = 1;
  const Schedule schedule = schedule_of(scene);
  EXPECT_EQ(schedule.stretches().size(), 7 + kStand);
  expect_no_gaps(schedule);
}

TEST(Schedule, FewCollisionsNeedNoSlowMotion) {
  EXPECT_EQ(schedule_of({{"time.slow-motion", "auto"}}, 1).stretches().size(), 1 + kStand);
}

/// The end is the last picture, and stays where it is held. An end that is a time is seen only
/// where it is held.
void expect_end(const Scene& scene) {
  const auto log = make_pair_log(scene.system);
  const Schedule schedule = make_schedule(scene, *log);
  const Rational end = span_of(scene, *log).to;
  const Integer frames = schedule.frame_count();
  const bool is_loop = scene.pacing.loop && frames > 1;
  const Integer last = is_loop ? Integer(frames / 2) : Integer(frames - 1);
  const Integer held = ceil(scene.pacing.hold_end_s * scene.view.frame_rate);
  const bool is_shown = !scene.time.to.is_time();
  for (Integer frame = 0; frame < frames; frame += 1) {
    const FrameTime shown = schedule.frame(frame.get_si(), open_s(scene.view));
    ASSERT_LE(shown.time, end) << frame << " of " << frames;
    for (const TimeSlice& slice : shown.exposure) ASSERT_LE(std::max(slice.from, slice.to), end);
  }
  for (Integer frame = last - held + (is_shown ? 0 : 1); frame <= last; frame += 1) {
    ASSERT_EQ(schedule.time_of(frame.get_si()), end) << frame << " of " << frames;
  }
  if (is_shown || held > 0) return;
  ASSERT_LT(schedule.time_of(last.get_si()), end);
}

TEST(Schedule, EndsWithThePictureOfTheEndInAnyPacing) {
  TracedRandom random(51);
  int accepted = 0;
  for (int run = 0; run < 300; ++run) {
    const auto any = [&](std::initializer_list<const char*> texts) -> std::string {
      return std::data(texts)[random.integer(0, static_cast<std::int64_t>(texts.size()) - 1)];
    };
    std::vector<Setting> settings = {
        {"time.to", any({"last", "last+1", "turn+1/7", "#3", "#31+0.01", "4", "7.123", "9"})},
        {"time.speed", any({"1", "1/3", "2.5", "37"})},
        {"view.fps", any({"60", "30000/1001", "7", "1000/37"})},
        {"view.shutter", any({"0", "1/2", "1"})},
        {"time.loop", any({"true", "false"})},
        {"time.hold-start", any({"0", "0.3"})},
        {"time.hold-end", any({"0", "0.3", "1"})}};
    if (random.integer(0, 2) == 0) settings.emplace_back("time.slow-motion", "turn-0.3:last+3:9");
    if (random.integer(0, 2) == 0) settings.emplace_back("time.freeze", "turn:0.31");
    if (random.integer(0, 2) == 0) settings.emplace_back("time.duration", any({"5", "7.777"}));
    const Scene scene = paced_scene(settings, 2);
    try {
      make_schedule(scene, *make_pair_log(scene.system));
    } catch (const UsageError&) {  // a window or a freeze after the end
      continue;
    }
    ++accepted;
    expect_end(scene);
    if (!HasFatalFailure()) continue;
    for (const auto& [key, text] : settings) ADD_FAILURE() << key << " = " << text;
    return;
  }
  EXPECT_GT(accepted, 150);
}

TEST(Schedule, WhatIsHeldIsAsSlowAsWhatIsBesideIt) {
  const Schedule schedule = schedule_of({{"time.to", "4"},
                                         {"time.slow-motion", "0:1:3,3:4:10"},
                                         {"time.freeze", "4:1/2"},
                                         {"time.hold-start", "1"},
                                         {"time.hold-end", "1"}});
  const auto stretches = schedule.stretches();
  EXPECT_EQ(stretches.front().speed, 0);
  EXPECT_EQ(stretches.front().slowdown, 3);
  EXPECT_EQ(std::prev(stretches.end(), 2)->speed, 0);
  EXPECT_EQ(std::prev(stretches.end(), 2)->slowdown, 10);
  EXPECT_EQ(stretches.back().slowdown, 10);
}

TEST(Schedule, RandomPacingLeavesNoGaps) {
  TracedRandom random(20);
  int accepted = 0;
  for (int run = 0; run < 300; ++run) {
    std::vector<Setting> settings;
    Rational at = random.rational(0, 3, 7);
    std::string windows;
    std::string freezes;
    Rational to;
    for (int i = 0; i < 3; ++i) {
      to = at + random.rational(1, 4, 5);
      windows += (i > 0 ? "," : "") + at.get_str() + ':' + to.get_str() + ':' +
                 Rational(random.rational(1, 30, 3)).get_str();
      freezes += (i > 0 ? "," : "") + Rational(random.rational(0, 14, 9)).get_str() + ':' +
                 Rational(random.rational(1, 3, 11)).get_str();
      at = to + random.rational(0, 2, 3);
    }
    settings = {{"time.slow-motion", windows},
                {"time.freeze", freezes},
                {"time.hold-start", Rational(random.rational(0, 2, 13)).get_str()},
                {"time.hold-end", Rational(random.rational(0, 2, 13)).get_str()},
                {"time.loop", random.integer(0, 1) == 0 ? "true" : "false"},
                {"view.fps", random.integer(0, 1) == 0 ? "60" : "30000/1001"}};
    if (random.integer(0, 1) == 0) settings.emplace_back("time.duration", "40");
    if (random.integer(0, 1) == 0) {
      // Within a frame or two of the end of a window, or anywhere.
      const Rational end = random.integer(0, 1) == 0 ? Rational(to + random.rational(0, 1, 97) / 40)
                                                     : random.rational(1, 14, 97);
      settings.emplace_back("time.to", end.get_str());
      settings.emplace_back("time.hold-end", "0");
    }
    try {
      const Schedule schedule = schedule_of(settings);
      expect_no_gaps(schedule);
      ++accepted;
    } catch (const UsageError& error) {
      EXPECT_TRUE(contains(error.what(), "is outside of what is shown"));
    }
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(accepted, 100);
}

/// What is shown during a frame is what is shown at each moment of it.
void expect_slices(const Schedule& schedule, const Rational& video_s, const Rational& length_s) {
  Rational now_s = video_s;
  for (const TimeSlice& slice : schedule.during(video_s, length_s)) {
    EXPECT_GT(slice.share, 0);
    EXPECT_EQ(slice.from, schedule.at(now_s).time);
    const Rational slice_s = slice.share * length_s;
    EXPECT_EQ((slice.from + slice.to) / 2, schedule.at(now_s + slice_s / 2).time);
    now_s += slice_s;
    EXPECT_EQ(slice.to, schedule.at(now_s).time);
  }
  EXPECT_EQ(now_s, video_s + length_s);
}

TEST(Schedule, SlicesFollowTheStretches) {
  TracedRandom random(77);
  const Schedule schedule = schedule_of({{"time.to", "5"},
                                         {"time.slow-motion", "1:3:2,3.4:3.5:10"},
                                         {"time.freeze", "2:1/3,3.45:0.1"},
                                         {"time.hold-start", "0.2"},
                                         {"time.loop", "true"}});
  EXPECT_EQ(schedule.during(0, Rational(1, 10)).size(), 1U);
  EXPECT_GT(schedule.during(0, 12).size(), 10U);
  for (int i = 0; i < 200; ++i) {
    expect_slices(schedule, random.rational(0, 16, 120), random.rational(0, 2, 120) + 1);
    expect_slices(schedule, random.rational(0, 16, 120), Rational(1, 60));
  }
}

TEST(Schedule, KnowsWhenAnInstantIsFirstShown) {
  const Schedule schedule = schedule_of({{"time.from", "1"},
                                         {"time.to", "5"},
                                         {"time.slow-motion", "2:3:2"},
                                         {"time.ease", "0"},
                                         {"time.freeze", "4:1"},
                                         {"time.hold-start", "2"},
                                         {"time.loop", "true"}});
  EXPECT_EQ(schedule.first_shown_s(1), 0);
  EXPECT_EQ(schedule.first_shown_s(Rational(3, 2)), Rational(5, 2));
  EXPECT_EQ(schedule.first_shown_s(Rational(5, 2)), 4);
  EXPECT_EQ(schedule.first_shown_s(4), 6);
  EXPECT_EQ(schedule.first_shown_s(Rational(9, 2)), Rational(15, 2));
  EXPECT_EQ(schedule.first_shown_s(Rational(1, 2)), std::nullopt);
}

TEST(Schedule, RefusesWhatCannotBe) {
  const auto problem = [](const std::vector<Setting>& settings, Rational red_velocity = -1) {
    Scene scene = paced_scene(settings);
    scene.system.bodies[1].velocity[0] = std::move(red_velocity);
    return message_of<UsageError>([&] { schedule_of(scene); });
  };
  EXPECT_EQ(problem({{"time.slow-motion", "2:4:3,3:5:3"}}),
            "time.slow-motion: windows overlap at 3; let one begin where the other ends");
  EXPECT_EQ(problem({{"time.slow-motion", "4:3:2"}}),
            "time.slow-motion: the window from 4 to 3 must end after it begins");
  EXPECT_EQ(problem({{"time.slow-motion", "auto,3:4:2"}}),
            "time.slow-motion: windows overlap at 16/5; let one begin where the other ends");
  EXPECT_EQ(problem({{"time.freeze", "turn:1"}, {"time.to", "3"}}, 0),
            "time.freeze: 'turn': there is no turn; only two blocks beside a wall have one, if "
            "they move; give a time");
  EXPECT_EQ(problem({{"time.freeze", "last:1"}, {"time.to", "3"}}, 1),
            "time.freeze: 'last': no collision happens from time 0 on; give a time");
  EXPECT_EQ(problem({{"time.freeze", "#315:1"}, {"time.to", "3"}}),
            "time.freeze: collision #315: the scene has collisions #1 to #314");
  EXPECT_EQ(problem({{"time.freeze", "turn:1"}, {"time.to", "3"}}),
            "time.freeze: turn is outside of what is shown, 0 to 3");
  EXPECT_EQ(problem({{"time.slow-motion", "4:5:2"}, {"time.to", "3"}}),
            "time.slow-motion: the window from 4 to 5 is outside of what is shown, 0 to 3");
  EXPECT_EQ(problem({{"time.from", "turn"}, {"time.to", "3"}}),
            "time.from = 7/2: is not before the end at 3; there is nothing to show");
  EXPECT_TRUE(problem({{"time.duration", "2"}, {"time.hold-end", "2"}})
                  .starts_with("time.duration = 2: leaves no time for the motion"));
  EXPECT_TRUE(problem({{"time.duration", "0.01"}})
                  .starts_with("time.duration = 1/100: is shorter than two frames; "));
  EXPECT_EQ(problem({{"time.duration", "0.01"}, {"time.to", "9"}}), "");
  for (const char* to : {"last", "9"}) {
    EXPECT_TRUE(problem({{"time.duration", "1e-9"}, {"time.loop", "true"}, {"time.to", to}})
                    .starts_with("time.duration = 1/1000000000: is shorter than two frames, "));
    EXPECT_EQ(problem({{"time.duration", "2/60"}, {"time.loop", "true"}, {"time.to", to}}), "");
  }
}

TEST(Pacing, TextsReadBackAsTheSame) {
  for (const char* text : {"0", "-7/3", "turn", "turn-1/3", "last+5", "last-5/2", "#7+1/2"}) {
    const std::string window = std::string(text) + ":turn+1:10";
    EXPECT_EQ(exact_text(parse_slow_motion(window)), window);
    const std::string freeze = std::string(text) + ":3/2";
    EXPECT_EQ(exact_text(parse_freeze(freeze)), freeze);
  }
}

TEST(Pacing, RefusesOtherTexts) {
  for (const char* text : {"", "1", "1:2", "1:2:3:4", "a:b:c", "::"}) {
    EXPECT_THROW(parse_slow_motion(text), UsageError) << text;
  }
  for (const char* text : {"", "1", "1:2:3", ":"}) {
    EXPECT_THROW(parse_freeze(text), UsageError) << text;
  }
  for (const char* text : {"middle", "turning", "turn--1", "last+x"}) {
    EXPECT_TRUE(contains(message_of<UsageError>([&] { parse_instant(text); }),
                         "must be a time, 'turn', 'last', or '#K'"));
  }
}

}  // namespace
}  // namespace piblocks
