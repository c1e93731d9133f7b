// What tests and examples of other public programs state about collisions: how a case is written
// down, and held against piblocks. In: bodies and walls, typed anew, and what the source says. Out:
// piblocks finds its numbers, to the digits that it gives. Where the source has a point, there is a
// disc, and the walls are further away by its radius.
#pragma once

#include <gtest/gtest.h>
#include <piblocks/log.hpp>

#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace piblocks {

inline constexpr double kNotSaid = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kNever = std::numeric_limits<double>::infinity();
/// Of numbers that the source gives as fractions and roots.
inline constexpr double kRoundings = 1e-14;

inline const Rational kHalf(1, 2);

/// The first collision, and what bodies do just after it and all others at that instant.
struct Hit {
  const char* source;
  System system;
  double time;
  std::vector<Motion> after = {};  ///< of the first bodies
  double tolerance = kRoundings;
  double energy_lost = kNotSaid;
};

inline System discs(std::vector<Body> bodies, std::vector<Wall> walls = {}, const Rational& e = 1) {
  return {.dimensions = 2,
          .bodies = std::move(bodies),
          .walls = std::move(walls),
          .restitution = e,
          .wall_restitution = e};
}

inline Body disc(const ExactVector& position, const ExactVector& velocity = {},
                 const Rational& radius = 1, const std::optional<Rational>& mass = 1) {
  return {mass, position, velocity, radius};
}

inline Body fixed(const ExactVector& position, const Rational& radius = 1) {
  return disc(position, {}, radius, std::nullopt);
}

inline Motion velocity(double x, double y) { return {{kNotSaid, kNotSaid}, {x, y}}; }

inline void expect_said(const char* what, double said, double ours, double tolerance) {
  if (std::isnan(said)) return;
  EXPECT_NEAR(ours, said, tolerance) << what;
}

inline void expect_motion(const Motion& said, const Motion& ours, double tolerance) {
  expect_said("x", said.position[0], ours.position[0], tolerance);
  expect_said("y", said.position[1], ours.position[1], tolerance);
  expect_said("velocity along x", said.velocity[0], ours.velocity[0], tolerance);
  expect_said("velocity along y", said.velocity[1], ours.velocity[1], tolerance);
}

inline double energy_of(const System& system, const std::vector<Motion>& motions) {
  double sum = 0;
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const auto& v = motions[i].velocity;
    const auto& mass = system.bodies[i].mass;
    if (mass) sum += to_double(*mass) / 2 * (v[0] * v[0] + v[1] * v[1]);
  }
  return sum;
}

/// The bodies just after the first collision and all others at that instant.
inline std::vector<Motion> after_first(const Log& log) {
  std::vector<Motion> motions = log.state_at(0).bodies;
  const double first = log.collision(1).time.hi;
  for (Integer k = 1; log.has(k) && log.collision(k).time.hi == first; ++k) {
    const Collision found = log.collision(k);
    motions[found.first] = found.first_after;
    if (found.second < motions.size()) motions[found.second] = found.second_after;
  }
  return motions;
}

inline void expect_hit(const Hit& hit) {
  SCOPED_TRACE(hit.source);
  const auto log = make_log(hit.system);
  ASSERT_EQ(log->has(1), hit.time != kNever);
  if (hit.time == kNever) return;
  expect_said("time", hit.time, log->collision(1).time.hi, hit.tolerance);
  const std::vector<Motion> after = after_first(*log);
  for (std::size_t i = 0; i < hit.after.size(); ++i) {
    SCOPED_TRACE(i);
    expect_motion(hit.after[i], after[i], hit.tolerance);
  }
  std::vector<Motion> start;
  for (const Body& body : hit.system.bodies) {
    start.push_back({{}, {to_double(body.velocity[0]), to_double(body.velocity[1])}});
  }
  expect_said("energy lost", hit.energy_lost,
              energy_of(hit.system, start) - energy_of(hit.system, after), hit.tolerance);
}

inline void expect_hits(const std::vector<Hit>& hits) {
  for (const Hit& hit : hits) expect_hit(hit);
}

/// Times of the first collisions.
inline void expect_times(const char* source, const Log& log, const std::vector<double>& times,
                         double tolerance) {
  SCOPED_TRACE(source);
  for (std::size_t k = 0; k < times.size(); ++k) {
    expect_said("time", times[k], log.collision(Integer(k + 1)).time.hi, tolerance);
  }
}

}  // namespace piblocks
