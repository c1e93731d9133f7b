// Every collision of the film is heard once, and when it is seen.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "physics/impact.hpp"
#include "sound/click_train.hpp"
#include "support/article_scene.hpp"

namespace piblocks {
namespace {
using testing_support::clacks_of;

constexpr double kRate_hz = 48000;

/// Impulses of one kind.
double sum(const std::vector<Clack>& clacks, CollisionKind kind) {
  double total = 0;
  for (const Clack& clack : clacks) total += clack.kind == kind ? clack.impulse : 0;
  return total;
}

void expect_all_collisions(const PairLog& log, const std::vector<Clack>& clacks) {
  for (const CollisionKind kind : {CollisionKind::wall, CollisionKind::blocks}) {
    const auto all = log.impact(kind, 1, log.last());
    const double expected = all ? all->impulse : 0;
    EXPECT_NEAR(sum(clacks, kind), expected, 1e-9 * expected);
  }
}

TEST(ClackStream, HasEachCollisionAtItsSample) {
  for (int digits = 1; digits <= 3; ++digits) {
    const auto log = make_pair_log(article_system(digits));
    for (const char* speed : {"1", "1/20", "7/3"}) {
      const Rational s(speed);
      const std::vector<Clack> clacks = clacks_of(*log, {{0, 1, s}}, 12 / s);
      ASSERT_EQ(clacks.size(), log->last().get_ui()) << digits << " digits at " << speed;
      for (std::size_t i = 0; i < clacks.size(); ++i) {
        const PairCollision c = log->blocks_collision(Integer(i + 1));
        EXPECT_EQ(clacks[i].kind, c.kind);
        EXPECT_NEAR(clacks[i].sample, (c.time.hi - 1) / to_double(s) * kRate_hz, 1e-6);
        const double to_contact = c.kind == CollisionKind::wall ? -0.5 : 0.5;
        EXPECT_NEAR(clacks[i].position, c.blue.position + to_contact, 1e-12);
      }
    }
  }
}

TEST(ClackStream, FollowsEasesStepByStep) {
  Scene scene = testing_support::article_scene(3);
  scene.time.to = Rational(7);
  scene.pacing.automatic_slow_motion = true;
  const auto log = make_pair_log(scene.system);
  const Schedule schedule = make_schedule(scene, *log);
  const auto stretches = schedule.stretches();
  ASSERT_GT(stretches.size(), 50U);
  const std::vector<Clack> clacks =
      clacks_of(*log, {stretches.begin(), stretches.end()}, Rational(schedule.frame_count()) / 60);
  ASSERT_EQ(clacks.size(), log->blocks_at(7).count.get_ui());
  for (std::size_t i = 0; i < clacks.size(); ++i) {
    const Rational seen = schedule.at(Rational(clacks[i].sample) / Rational(kRate_hz)).time;
    EXPECT_NEAR(to_double(seen), log->blocks_collision(Integer(i + 1)).time.hi, 1e-10) << i + 1;
  }
}

TEST(ClackStream, BackwardsHasTheSameInReverseOrder) {
  const auto log = make_pair_log(article_system(3));
  const std::vector<Clack> forwards = clacks_of(*log, {{0, 1, 1}}, 12);
  std::vector<Clack> backwards = clacks_of(*log, {{0, 13, -1}}, 12);
  std::ranges::reverse(backwards);
  ASSERT_EQ(backwards.size(), forwards.size());
  for (std::size_t i = 0; i < forwards.size(); ++i) {
    EXPECT_NEAR(backwards[i].sample, 12 * kRate_hz - forwards[i].sample, 1e-6);
    EXPECT_EQ(backwards[i].kind, forwards[i].kind);
    EXPECT_NEAR(backwards[i].impulse, forwards[i].impulse, 1e-12 * forwards[i].impulse);
  }
}

TEST(ClackStream, IsSilentWhereTheFilmStandsStill) {
  const auto log = make_pair_log(article_system(2));
  const Time seventh = log->blocks_collision(7).time;
  const Rational stop = to_rational(seventh);  // the instant of a collision
  // Up to the collision, 2 s of standing, and on.
  const std::vector<Clack> clacks =
      clacks_of(*log, {{0, 0, 1}, {stop, stop, 0}, {stop + 2, stop, 1}}, 20);
  ASSERT_EQ(clacks.size(), 31u);
  expect_all_collisions(*log, clacks);
  for (std::size_t i = 0; i < clacks.size(); ++i) {
    const double time = log->blocks_collision(Integer(i + 1)).time.hi;
    const double wait = i < 6   ? 0
                        : i > 6 ? 2
                                : std::round((clacks[i].sample / kRate_hz - time) / 2) * 2;
    EXPECT_NEAR(clacks[i].sample, (time + wait) * kRate_hz, 1e-6) << i;
  }
  // Heard before or after the stop, as the picture of the stop has counted it or not.
  const bool is_counted = log->blocks_at(stop).count == 7;
  EXPECT_EQ(clacks[6].sample < (seventh.hi + 1) * kRate_hz, is_counted);
}

TEST(ClackStream, LosesNothingHoweverManyCollisionsThereAre) {
  for (int digits : {4, 6, 9, 20, 100}) {
    const auto log = make_pair_log(article_system(digits));
    const std::vector<Clack> clacks = clacks_of(*log, {{0, 0, 1}}, 20);
    EXPECT_LT(clacks.size(), 20'000u) << digits;
    expect_all_collisions(*log, clacks);
    // In slow motion around the turn too.
    expect_all_collisions(*log,
                          clacks_of(*log, {{0, 0, 1}, {3, 3, Rational(1, 5)}, {8, 4, 1}}, 24));
  }
}

TEST(ClackStream, IsInOrder) {
  for (int digits : {3, 8}) {
    const auto log = make_pair_log(article_system(digits));
    const std::vector<Clack> clacks = clacks_of(*log, {{0, 0, 1}}, 10);
    for (std::size_t i = 1; i < clacks.size(); ++i) {
      EXPECT_GT(clacks[i].sample, clacks[i - 1].sample - 0.125);
    }
  }
}

TEST(ClackStream, HearsWhatHappensInTheFirstFrame) {
  TwoBlocks system = article_blocks(3);
  system.red.position = 3;  // touching, and moving in: the blocks meet at time 0
  const auto log = make_pair_log(system);
  ASSERT_EQ(log->blocks_collision(1).time.hi, 0);
  const Rational half(1, 2);
  for (const std::vector<Stretch>& stretches : {std::vector<Stretch>{{0, 0, 1}},
                                                {{0, 0, 0}, {2, 0, 1}},
                                                {{0, 0, 0}, {1, 0, 0}, {2, 0, half}}}) {
    const std::vector<Clack> clacks = clacks_of(*log, stretches, 24);
    ASSERT_EQ(clacks.size(), log->last().get_ui());
    EXPECT_NEAR(clacks.front().sample, 0, 1e-9);
    EXPECT_GT(clacks[1].sample, to_double(stretches.back().video_s) * kRate_hz);
  }
}

TEST(ClackStream, HearsTheFirstInstantOnceWhicheverWayTheFilmGoesOn) {
  const auto log = make_pair_log(article_system(1));
  ASSERT_EQ(log->blocks_collision(1).time.hi, 2);
  for (const int speed : {1, -1}) {
    const std::vector<Clack> clacks = clacks_of(*log, {{0, 2, 0}, {1, 2, speed}}, 2);
    ASSERT_EQ(clacks.size(), 1U) << speed;
    EXPECT_NEAR(clacks.front().sample, speed == 1 ? 0 : kRate_hz, 1e-6);
  }
  EXPECT_TRUE(clacks_of(*log, {{0, 2, 0}}, 1).empty()) << "nothing moves at all";
}

TEST(ClackStream, HearsACornerAsOneBlowOfEachKind) {
  TwoBlocks system = article_blocks(3);
  system.blue.position = Rational(1, 2);
  const auto log = make_pair_log(system);
  const std::vector<Clack> clacks = clacks_of(*log, {{0, 0, 1}}, 10);
  ASSERT_EQ(clacks.size(), 2u);
  for (const Clack& clack : clacks) {
    EXPECT_NEAR(clack.sample, to_double(corner_of(system)->time) * kRate_hz, 1e-6);
  }
  expect_all_collisions(*log, clacks);
}

TEST(ClackStream, HearsWhatWasBeforeTimeZero) {
  TwoBlocks system = article_blocks(1);
  system.blue.position = 3;
  system.red.position = 5;
  system.red.velocity = 1;  // they have met at time -1
  const auto log = make_pair_log(system);
  const std::vector<Clack> clacks = clacks_of(*log, {{0, -3, 1}}, 5);
  ASSERT_FALSE(clacks.empty());
  EXPECT_NEAR(clacks.back().sample, 2 * kRate_hz, 1e-6);
}

TEST(ClackStream, SlowsDownToCollisionsThatShareADouble) {
  // About 1e-21 s of the turn of 12 digits, a second of film.
  const auto log = make_pair_log(article_system(12));
  const Integer index = log->last() / 3;
  const Rational begin = to_rational(log->blocks_collision(index).time);
  const Rational end = to_rational(log->blocks_collision(index + 5).time);
  const Rational speed = end - begin;
  const std::vector<Clack> clacks =
      clacks_of(*log, {{0, begin - speed / 10, speed}}, Rational(6, 5));
  ASSERT_EQ(clacks.size(), 6u);
  for (std::size_t i = 0; i < clacks.size(); ++i) {
    const Rational time =
        to_rational(log->blocks_collision(index + static_cast<unsigned long>(i)).time);
    EXPECT_NEAR(clacks[i].sample, to_double((time - begin) / speed + Rational(1, 10)) * kRate_hz,
                1);
  }
}

}  // namespace
}  // namespace piblocks
