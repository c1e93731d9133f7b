// Hits and their rate, in every frame of films of any pacing, against all collisions of the log.
#include "render/frame_state.hpp"

#include <gtest/gtest.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "support/traced_random.hpp"

namespace piblocks {
namespace {

constexpr int kFrames_hz = 60;
/// A hair less than kHitLife_s.
const Rational kSeen_s = Rational(3, 20) - power(Rational(1, 10), 12);

/// A collision that the video passes.
struct Pass {
  Rational video_s;
  PairCollision collision;
  bool is_forward;
};

/// The exact time where there is one, so that a frame exactly at a collision shows it.
Rational exact_time(const PairLog& log, const PairCollision& collision) {
  try {
    return log.time_after(collision.index);
  } catch (const Error&) {  // several at once, or an engine that steps
    return to_rational(collision.time);
  }
}

/// All passes of a video, by looking for every collision in every stretch.
std::vector<Pass> all_passes(const PairLog& log, const Schedule& schedule) {
  const auto stretches = schedule.stretches();
  const Rational end_s = Rational(schedule.frame_count()) / kFrames_hz;
  std::vector<Pass> passes;
  for (std::size_t i = 0; i < stretches.size(); ++i) {
    const Stretch& now = stretches[i];
    const Rational until_s = i + 1 < stretches.size() ? stretches[i + 1].video_s : end_s;
    if (now.speed == 0) continue;
    const bool is_forward = now.speed > 0;
    for (Integer k = log.first_index(); k <= log.last(); ++k) {
      const PairCollision collision = log.blocks_collision(k);
      const Rational pass_s = now.video_s + (exact_time(log, collision) - now.time) / now.speed;
      // The counter changes at a collision's time forwards, and just after it backwards.
      const bool is_in = is_forward ? pass_s > now.video_s && pass_s <= until_s
                                    : pass_s >= now.video_s && pass_s < until_s;
      if (is_in) passes.push_back({pass_s, collision, is_forward});
    }
  }
  std::ranges::stable_sort(passes, {}, &Pass::video_s);
  return passes;
}

std::vector<Pass> during(const std::vector<Pass>& passes, const Rational& from_s,
                         const Rational& to_s) {
  std::vector<Pass> found;
  std::ranges::copy_if(passes, std::back_inserter(found), [&](const Pass& pass) {
    return pass.is_forward ? pass.video_s > from_s && pass.video_s <= to_s
                           : pass.video_s >= from_s && pass.video_s < to_s;
  });
  return found;
}

/// Eight or more are counted over 0.25 s. The rate of fewer is that of the newest three.
double rate_at(const std::vector<Pass>& passes, const Rational& video_s) {
  const auto counted = during(passes, std::max<Rational>(0, video_s - Rational(1, 4)), video_s);
  const auto recent = during(passes, std::max<Rational>(0, video_s - Rational(1, 2)), video_s);
  if (counted.size() >= 8 || recent.size() < 3) return 4.0 * double(counted.size());
  const Rational& last_s = recent.back().video_s;
  const Rational both_s = last_s - recent[recent.size() - 3].video_s;
  return std::min(32.0, 2 / to_double(std::max<Rational>(both_s, video_s - last_s)));
}

double surface_of(const TwoBlocks& system, const PairCollision& collision) {
  if (collision.kind == CollisionKind::wall) return to_double(system.wall_face);
  return collision.red.position - to_double(system.red.width / 2);
}

FrameState state_at(const Log& log, const Schedule& schedule, const Rational& video_s) {
  return frame_state(log, schedule.at(video_s), {.hits = true}, 1, VideoTime{schedule, video_s});
}

FrameState state_of(const Log& log, const Schedule& schedule, std::int64_t frame) {
  return state_at(log, schedule, Rational(frame) / kFrames_hz);
}

struct Seen {
  int hits = 0;            ///< frames that list some
  int crowded_frames = 0;  ///< frames with too many of them
  int still_frames = 0;    ///< frames with hits, in which the picture stands still
};

void expect_hits(const FrameState& state, const std::vector<Pass>& wanted, const TwoBlocks& system,
                 const Rational& video_s) {
  ASSERT_EQ(state.hits.size(), wanted.size());
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const Hit& hit = state.hits[i];
    const PairCollision& collision = wanted[i].collision;
    EXPECT_EQ(hit.index, collision.index);
    EXPECT_EQ(hit.pair[0], 0U);
    const bool is_wall = collision.kind == CollisionKind::wall;
    EXPECT_EQ(hit.pair[1], is_wall ? 2U : 1U);
    EXPECT_NEAR(hit.age_s, to_double(video_s - wanted[i].video_s), 1e-12);
    EXPECT_GE(hit.age_s, 0);
    EXPECT_LT(hit.age_s, kHitLife_s);
    EXPECT_NEAR(hit.contact[0], surface_of(system, collision), 1e-14);
    EXPECT_NEAR(hit.contact[0] - to_double(system.wall_face),
                is_wall ? 0 : hit.gaps.y1 + to_double(system.blue.width), 1e-14);
  }
}

/// Every frame has the hits that are found among all passes.
Seen expect_true_hits(const PairLog& log, const Schedule& schedule) {
  Seen seen;
  const std::vector<Pass> passes = all_passes(log, schedule);
  for (std::int64_t frame = 0; frame < schedule.frame_count().get_si(); ++frame) {
    SCOPED_TRACE("frame " + std::to_string(frame));
    const Rational video_s = Rational(frame) / kFrames_hz;
    FrameState state = state_of(log, schedule, frame);
    EXPECT_EQ(state.video_s, to_double(video_s));
    const bool is_moving =
        schedule.at(video_s).time != schedule.at(video_s + Rational(1, 100'000)).time;
    const double rate = rate_at(passes, video_s);
    EXPECT_NEAR(state.hits_per_s, is_moving ? rate : 0, 1e-9 * rate);
    if (std::fabs(rate - kMaxHitsPerSecond) < 1e-9) continue;  // rounding decides
    // Rounding decides about what is just about to fade.
    std::vector<Pass> wanted = during(passes, video_s - kSeen_s, video_s);
    std::erase_if(state.hits, [](const Hit& hit) { return hit.age_s >= to_double(kSeen_s); });
    if (rate > kMaxHitsPerSecond) {
      seen.crowded_frames += wanted.empty() ? 0 : 1;
      wanted.clear();
    }
    seen.hits += wanted.empty() ? 0 : 1;
    seen.still_frames += wanted.empty() || is_moving ? 0 : 1;
    expect_hits(state, wanted, log.blocks(), video_s);
  }
  return seen;
}

Scene film_of(int digits) {
  Scene scene;
  scene.system = article_system(digits);
  scene.view.frame_rate = kFrames_hz;
  return scene;
}

Seen expect_true_hits(const Scene& scene) {
  const auto log = make_pair_log(scene.system);
  return expect_true_hits(*log, make_schedule(scene, *log));
}

TEST(Hits, OfAPlainFilm) {
  for (int digits = 1; digits <= 3; ++digits) {
    const Seen seen = expect_true_hits(film_of(digits));
    EXPECT_GT(seen.hits, 10) << digits;
    EXPECT_EQ(seen.crowded_frames > 0, digits > 1) << digits;
    EXPECT_EQ(seen.still_frames, 0) << digits;
  }
}

TEST(Hits, InSlowMotion) {
  Scene scene = film_of(2);
  scene.pacing.automatic_slow_motion = true;
  EXPECT_GT(expect_true_hits(scene).hits, 20);
  scene = film_of(2);
  scene.pacing.slow_motion = {{Rational(3), Rational(7, 2), 7},
                              {Instant::collision(20), Instant::last(), Rational(1, 2)}};
  EXPECT_GT(expect_true_hits(scene).hits, 20);
}

TEST(Hits, GoOnWhileThePictureStandsStill) {
  Scene scene = film_of(1);
  scene.pacing.freezes = {{Instant::collision(2), Rational(1, 2)},
                          {Instant::collision(2, Rational(1, 50)), Rational(1, 2)}};
  scene.pacing.hold_start_s = Rational(1, 3);
  scene.pacing.hold_end_s = 1;
  scene.time.to = Instant::last();
  // In each freeze, and at the end, a hit is shown for 0.15 s less its age when the standstill
  // begins.
  EXPECT_GT(expect_true_hits(scene).still_frames, 15);
}

TEST(Hits, GoAwayWhereAFastCrowdFreezes) {
  Scene scene = film_of(3);
  scene.pacing.freezes = {{Instant::turn(), 1}};
  EXPECT_EQ(expect_true_hits(scene).still_frames, 0);
}

TEST(Hits, OfALoopAreSeenInBothDirections) {
  Scene scene = film_of(1);
  scene.pacing.loop = true;
  const int both = expect_true_hits(scene).hits;
  scene.pacing.loop = false;
  EXPECT_GT(both, expect_true_hits(scene).hits + 10);
  // It turns round while a hit is seen.
  scene.pacing.loop = true;
  scene.time.to = Instant::last(Rational(1, 30));
  expect_true_hits(scene);
}

TEST(Hits, ThatComeEvenlyDoNotComeAndGo) {
  // A blue block between the wall and a red one that is too heavy to give way.
  Scene scene = film_of(1);
  scene.system.bodies[1].mass = power(100, 100);
  scene.system.bodies[1].velocity[0] = 0;
  scene.time.to = Rational(5);
  for (int tenths = 74; tenths <= 600; tenths += 7) {
    SCOPED_TRACE(tenths);
    // Two hits in the time of a passage there and back.
    scene.system.bodies[0].velocity[0] = Rational(tenths) / 10 * 3;
    const auto log = make_pair_log(scene.system);
    const Schedule schedule = make_schedule(scene, *log);
    const double rate = to_double(scene.system.bodies[0].velocity[0] /
                                  (2 + two_blocks_of(scene.system)->blue_gap()));
    for (std::int64_t frame = 60; frame < 300; ++frame) {
      const FrameState state = state_of(*log, schedule, frame);
      EXPECT_NEAR(state.hits_per_s, rate, rate < 28 ? 1e-6 : 4) << frame;
      EXPECT_TRUE(rate <= kMaxHitsPerSecond || state.hits.empty()) << frame;
    }
  }
}

TEST(Hits, BeforeTimeZero) {
  Scene scene = film_of(2);
  scene.system.bodies[1].velocity[0] = 1;
  scene.time.from = Rational(-9);
  scene.time.to = Rational(1);
  EXPECT_GT(expect_true_hits(scene).hits, 10);
}

TEST(Hits, OfARunThatFollowsAnotherClock) {
  const Scene leading = film_of(2);
  const auto leader = make_pair_log(leading.system);
  const Schedule schedule = make_schedule(leading, *leader);
  TwoBlocks other = article_blocks(1);
  other.red.mass = Rational(1, 2);  // the exact list of events
  EXPECT_GT(expect_true_hits(*make_pair_log(other), schedule).hits, 10);
  EXPECT_GT(expect_true_hits(*make_pair_log(article_system(2), Engine::events), schedule).hits, 10);
}

TEST(Hits, OfACornerAreACrowd) {
  Scene scene = film_of(3);
  scene.system.bodies[1].position[0] = scene.system.bodies[0].position[0] + 1;
  scene.system.bodies[0].velocity[0] = scene.system.bodies[1].velocity[0];
  const Seen seen = expect_true_hits(scene);
  EXPECT_EQ(seen.hits, 0);
  EXPECT_GT(seen.crowded_frames, 0);
}

TEST(Hits, OfTwentyDigitsCostNoMore) {
  Scene scene = film_of(20);
  scene.time.to = Rational(7);
  const auto log = make_pair_log(scene.system);
  const Schedule schedule = make_schedule(scene, *log);
  double most = 0;
  for (std::int64_t frame = 0; frame < 420; ++frame) {
    const FrameState state = state_of(*log, schedule, frame);
    const FrameState before = state_of(*log, schedule, std::max<std::int64_t>(0, frame - 15));
    const Integer passed = state.state.count - before.state.count;
    if (passed >= 8) {
      EXPECT_EQ(state.hits_per_s, Integer(4 * passed).get_d());
    }
    most = std::max(most, state.hits_per_s);
    EXPECT_TRUE(state.hits.empty() || state.hits_per_s <= kMaxHitsPerSecond);
  }
  EXPECT_GT(most, 1e19);
}

Scene any_film(Random& random) {
  Scene scene = film_of(static_cast<int>(random.integer(1, 2)));
  scene.system.bodies[1].mass.value() += random.rational(0, 20, 7);
  scene.time.from = random.rational(0, 3, 30);
  scene.time.to = random.rational(4, 9, 30);
  scene.time.speed = Rational(random.integer(1, 8)) / 4;
  Pacing& pacing = scene.pacing;
  const Rational from = random.rational(3, 4, 60);
  pacing.slow_motion = {{from, Rational(from + random.rational(0, 1, 8) + Rational(1, 9)), 3}};
  for (std::int64_t i = random.integer(0, 2); i > 0; --i) {
    pacing.freezes.push_back({random.rational(3, 4, 100), random.rational(0, 1, 9) + 1});
  }
  pacing.hold_start_s = random.rational(0, 1, 3);
  pacing.loop = random.integer(0, 1) == 0;
  return scene;
}

TEST(Hits, OfAnyPacing) {
  TracedRandom random(20261122);
  for (std::int64_t i = 0; i < many(12); ++i) {
    SCOPED_TRACE(i);
    expect_true_hits(any_film(random));
  }
}

TEST(Hits, DoNotDependOnTheOrderOfFrames) {
  Scene scene = film_of(2);
  scene.pacing.loop = true;
  const auto log = make_pair_log(scene.system);
  const Schedule schedule = make_schedule(scene, *log);
  const auto text_of = [&](std::int64_t frame) {
    const FrameState state = state_of(*log, schedule, frame);
    std::string text = std::to_string(state.hits_per_s);
    for (const Hit& hit : state.hits) {
      text += ' ' + hit.index.get_str() + ' ' + std::to_string(hit.age_s);
    }
    return text;
  };
  const std::int64_t count = schedule.frame_count().get_si();
  std::vector<std::string> forwards;
  for (std::int64_t frame = 0; frame < count; ++frame) forwards.push_back(text_of(frame));
  for (std::int64_t frame = count - 1; frame >= 0; --frame) {
    EXPECT_EQ(text_of(frame), forwards[static_cast<std::size_t>(frame)]);
  }
}

TEST(FrameStates, HaveGapsWhereTheyAreNeeded) {
  const auto log = make_pair_log(article_system(20));
  const FrameTime turn{turn_of(log->blocks()).value()};
  const Gaps gaps = frame_state(*log, turn, {.gaps = true}, 1).gaps;
  EXPECT_GT(gaps.y2, 1.4e-19);
  EXPECT_LT(gaps.y2, 1.6e-19);
  EXPECT_EQ(frame_state(*log, turn, {}, 1).gaps.y2, 0);
}

/// Two discs and two blocks, each kind in a box.
Scene scene_of_bodies(int dimensions) {
  System system{dimensions, {}, {{"left", {0, 0}, {2, 0}}, {"right", {8, 0}, {-1, 0}}}};
  system.bodies.push_back(
      {.position = {2, 2}, .velocity = {5, dimensions - 1}, .size = Rational(1, 2)});
  system.bodies.push_back({.mass = 3, .position = {6, dimensions == 1 ? 0 : 2}, .size = 1});
  if (dimensions == 1) {
    system.bodies[0].position[1] = 0;
  } else {
    system.walls.push_back({"lower", {0, 0}, {0, 3}});
    system.walls.push_back({"upper", {0, 4}, {0, -1}});
  }
  Scene scene;
  scene.system = std::move(system);
  scene.styles.resize(2);
  scene.view.frame_rate = kFrames_hz;
  scene.time.to = Rational(6);
  return scene;
}

/// Also of those that a film which runs backwards has undone.
TEST(FrameStates, PairsThatMetAreThoseOfTheNewestCollisions) {
  Scene scene = scene_of_bodies(1);
  scene.system.bodies[0].velocity[0] = 300;
  scene.pacing.loop = true;
  const auto log = make_log(scene.system, Rational(6));
  const Schedule schedule = make_schedule(scene, *log);
  int backwards = 0;
  for (Rational video_s = Rational(1, 3); video_s < 11; video_s += Rational(1, 3)) {
    const FrameState state = state_at(*log, schedule, video_s);
    if (state.met_pairs.empty()) continue;
    const bool is_forward = schedule.at(video_s).time < schedule.at(video_s + Rational(1, 99)).time;
    backwards += is_forward ? 0 : 1;
    std::vector<MetPair> expected;
    for (int n = 0; n < 4; ++n) {  // twice as many as bodies
      const Collision met = log->collision(is_forward ? Integer(state.state.count - n)
                                                      : Integer(state.state.count + 1 + n));
      const MetPair pair{met.first, met.second};
      if (std::ranges::find(expected, pair) == expected.end()) expected.push_back(pair);
    }
    EXPECT_EQ(state.met_pairs, expected) << to_double(video_s);
  }
  EXPECT_GT(backwards, 3);
}

TEST(FrameStates, OfBodiesHaveHitsWhereSurfacesTouch) {
  for (const int dimensions : {1, 2}) {
    SCOPED_TRACE(dimensions);
    const Scene scene = scene_of_bodies(dimensions);
    const System& system = scene.system;
    const auto log = make_log(system, Rational(6));
    const Schedule schedule = make_schedule(scene, *log);
    int hits = 0;
    for (std::int64_t frame = 0; frame < schedule.frame_count().get_si(); ++frame) {
      const FrameState state = state_of(*log, schedule, frame);
      EXPECT_EQ(state.met_pairs.empty(), state.hits_per_s <= kMaxHitsPerSecond);
      for (const Hit& hit : state.hits) {
        ++hits;
        const Collision met = log->collision(hit.index);
        EXPECT_EQ(hit.pair, (MetPair{met.first, met.second}));
        const auto expect_on = [&](std::size_t body, const Motion& motion) {
          const double x = hit.contact[0] - motion.position[0];
          const double y = hit.contact[1] - motion.position[1];
          const double reach = to_double(system.bodies[body].size) / (dimensions == 1 ? 2 : 1);
          EXPECT_NEAR(std::sqrt(x * x + y * y), reach, 1e-9);
        };
        expect_on(met.first, met.first_after);
        if (met.second < system.bodies.size()) {
          expect_on(met.second, met.second_after);
          continue;
        }
        const Wall& wall = system.walls[met.second - system.bodies.size()];
        double apart = 0;
        for (const std::size_t axis : {0U, 1U}) {
          apart += (hit.contact.at(axis) - to_double(wall.point.at(axis))) *
                   to_double(wall.normal.at(axis));
        }
        EXPECT_NEAR(apart, 0, 1e-9);
      }
    }
    EXPECT_GT(hits, 20);
  }
}

}  // namespace
}  // namespace piblocks
