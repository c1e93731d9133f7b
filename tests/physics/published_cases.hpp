// What tests and examples of other public programs state about collisions: how a case is written
// down, and held against piblocks. In: bodies and walls, typed anew, and what the source says. Out:
// piblocks finds its numbers, to the digits that it gives; published.md has both. Where the source
// has a point, there is a disc, and the walls are further away by its radius.
#pragma once

#include <gtest/gtest.h>
#include <piblocks/log.hpp>

#include <limits>
#include <optional>
#include <string>
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

/// Whose words follow, while it lives: a program and its file first, then the case there, then the
/// body.
class Source {
 public:
  explicit Source(std::string name);
  ~Source();
  Source(const Source&) = delete;
  Source& operator=(const Source&) = delete;

 private:
  testing::ScopedTrace trace_;
};

/// Fails unless the source's value is ours, and notes both for the table that PIBLOCKS_TABLE=FILE
/// asks for.
/// @param said  kNotSaid: nothing is done
void expect_said(const std::string& what, double said, double ours, double tolerance);
void expect_motion(const std::string& body, const Motion& said, const Motion& ours,
                   double tolerance);
void expect_hit(const Hit& hit);
void expect_hits(const std::vector<Hit>& hits);
/// Times of the first collisions.
void expect_times(const std::string& source, const Log& log, const std::vector<double>& times,
                  double tolerance);

/// Kinetic, of bodies whose mass is finite.
double energy_of(const System& system, const std::vector<Motion>& motions);

}  // namespace piblocks
