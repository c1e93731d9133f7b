// Where bodies spend an interval of time: every collision is in it, at its time.
#include <gtest/gtest.h>
#include <piblocks/error.hpp>
#include <piblocks/system.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include "physics/exposure.hpp"
#include "physics/logs.hpp"

namespace piblocks {
namespace {

constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();

/// A body of mass 1 between two that never move, 9/2 apart for its centre.
System between_two(const Rational& velocity) {
  System system{1, {}, {}};
  system.bodies.push_back({.mass = std::nullopt, .position = {-3, 0}});
  system.bodies.push_back(
      {.mass = 1, .position = {0, 0}, .velocity = {velocity, 0}, .size = Rational(1, 2)});
  system.bodies.push_back({.mass = std::nullopt, .position = {3, 0}});
  return system;
}

/// The position of the body in the middle, which bounces between -9/4 and 9/4, by folding its way.
double folded(double way) {
  const double length = 4.5;
  const double from_left = std::fmod(way + length / 2, 2 * length);
  return (from_left > length ? 2 * length - from_left : from_left) - length / 2;
}

/// The share of an exposure that a body is below a position.
double share_below(const std::vector<BodyPiece>& pieces, double position) {
  double share = 0;
  for (const BodyPiece& piece : pieces) {
    const auto [low, high] = std::minmax(piece.from[0], piece.to[0]);
    share += (piece.end - piece.begin) *
             std::clamp((position - low) / std::max(high - low, 1e-300), 0.0, 1.0);
  }
  return share;
}

TEST(Exposure, ListsEveryCollision) {
  // 2000 bounces in 1/10, exactly two of them a 1/1000 of it.
  const auto log = make_log(between_two(90'000), Rational(1));
  const Exposure exposure = expose(*log, Rational(1, 7), Rational(1, 7) + Rational(1, 10));
  ASSERT_EQ(exposure.pieces.size(), 3U);
  EXPECT_EQ(exposure.pieces[1].size(), 2001U);
  for (const BodyPiece& piece : exposure.pieces[1]) {
    EXPECT_NEAR(piece.from[0], folded(90'000 * (1.0 / 7 + piece.begin / 10)), 1e-6);
  }
  for (const double position : {-2.0, -1.0, 0.0, 0.5, 2.25}) {
    EXPECT_NEAR(share_below(exposure.pieces[1], position), (position + 2.25) / 4.5, 1e-9);
  }
  EXPECT_EQ(exposure.pieces[0].size(), 1U);
}

/// At even times it would always be at one place.
TEST(Exposure, FewPointsOfAWayFollowNoRhythm) {
  constexpr std::size_t kPoints = 100;
  const auto log = make_log(between_two(9 * 99), Rational(2));
  const auto paths = log->paths(0, 1, kPoints);
  ASSERT_EQ(paths.size(), 3U);
  ASSERT_EQ(paths[1].size(), kPoints);
  std::vector<double> places;
  for (std::size_t i = 0; i < kPoints; ++i) {
    const PathPoint& point = paths[1][i];
    EXPECT_NEAR(point.position[0], folded(9 * 99 * point.after), 1e-9);
    EXPECT_TRUE(i == 0 || point.after > paths[1][i - 1].after);
    places.push_back(point.position[0]);
  }
  EXPECT_EQ(paths[1].front().after, 0);
  EXPECT_EQ(paths[1].back().after, 1);
  EXPECT_LT(std::ranges::min(places), -2);
  EXPECT_GT(std::ranges::max(places), 2);
}

TEST(Exposure, PathsAreThoseOfStates) {
  const auto log = make_log(between_two(Rational(17, 3)), Rational(10));
  const Rational from(1, 3);
  for (const Rational& to : {Rational(1, 3), Rational(1, 2), Rational(19, 3), Rational(10)}) {
    const auto paths = log->paths(from, to, kAll);
    const State before = log->state_at(from);
    const State after = log->state_at(to);
    for (std::size_t body = 0; body < 3; ++body) {
      EXPECT_EQ(paths[body].front().position, before.bodies[body].position);
      EXPECT_EQ(paths[body].back().position, after.bodies[body].position);
      EXPECT_EQ(paths[body].back().after, to_double(to - from));
    }
    EXPECT_EQ(Integer(paths[1].size() - 2), after.count - before.count);
  }
  EXPECT_THROW(log->paths(-1, 1, kAll), UsageError);
}

/// By other names, and mirrored.
TEST(Exposure, OfTheClosedFormIsThatOfTheBlocks) {
  for (const int sign : {1, -1}) {
    System system{1, {}, {}};
    system.bodies.push_back({.mass = std::nullopt, .position = {sign * Rational(-1, 2), 0}});
    system.bodies.push_back({.mass = 1, .position = {sign * 2, 0}});
    system.bodies.push_back(
        {.mass = 100'000'000, .position = {sign * 5, 0}, .velocity = {-sign, 0}});
    const auto log = make_log(system);
    ASSERT_TRUE(log->pair());
    const Exposure exposure = expose(*log, 3, 5);
    EXPECT_TRUE(exposure.pieces.empty());
    ASSERT_TRUE(exposure.closed);
    EXPECT_EQ(exposure.closed->blue, 1U);
    EXPECT_EQ(exposure.closed->red, 2U);
    EXPECT_EQ(exposure.closed->sign, sign);
    ASSERT_TRUE(exposure.closed->blocks.area_below);
    const auto red_at = [&](int time) { return sign * log->state_at(time).bodies[2].position[0]; };
    EXPECT_NEAR(exposure.closed->blocks.red_range.to, std::max(red_at(3), red_at(5)), 1e-9);
    const auto paths = log->paths(3, 5, 10);
    EXPECT_EQ(paths[0].size(), 2U);
    EXPECT_EQ(paths[1].size(), 10U);
  }
}

}  // namespace
}  // namespace piblocks
