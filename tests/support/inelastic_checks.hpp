// Random blocks that lose energy, and the library's answers about them against exact steps.
// In: random numbers. Out: failures of the running test.
#pragma once

#include <gtest/gtest.h>
#include <piblocks/error.hpp>
#include <piblocks/two_blocks.hpp>

#include <cmath>
#include <string>

#include "physics/impact.hpp"
#include "support/inelastic_run.hpp"
#include "support/property.hpp"

namespace piblocks {

inline std::string describe_inelastic(const TwoBlocks& s) {
  std::string text;
  for (const Rational& value :
       {s.wall_face, s.blue.mass, s.blue.position, s.blue.velocity, s.blue.width, s.red.mass,
        s.red.position, s.red.velocity, s.red.width, s.blocks_restitution, s.wall_restitution}) {
    text += value.get_str() + " ";
  }
  return text;
}

/// A share of 1, often one that needs care.
inline Rational random_restitution(Random& random, const Rational& mass_ratio) {
  switch (random.integer(0, 7)) {
    case 0:
      return 0;
    case 1:
      return 1;
    case 2:
      return Rational(1) - Rational(1) / random.integer(100, 1000000);
    case 3: {  // near (1 - e)^2 = 4 e m_blue/m_red, where runs begin to be endless
      const double r = to_double(mass_ratio);
      const double critical = 1 + 2 * r - 2 * std::sqrt(r * (1 + r));
      const Rational near(std::round(critical * 0x1p20) / 0x1p20);
      return near + random.rational(0, 4, 1) / 1048576;
    }
    case 4:
      return Rational(1) / random.integer(2, 1000);
    default:
      return random.rational(0, 1, 20);
  }
}

inline Rational random_mass_ratio(Random& random) {
  const double decade = random.uniform(-6, 4);  // of m_blue/m_red
  const Rational ratio(std::round(std::pow(10, decade) * 0x1p24) / 0x1p24);
  if (random.integer(0, 4) > 0 && ratio > 0) return ratio;
  switch (random.integer(0, 3)) {
    case 0:
      return 1;
    case 1: {  // (1 - e)^2/(4 e): exactly critical for that e
      const Rational e = random.rational(1, 19, 1) / 20;
      return (1 - e) * (1 - e) / (4 * e);
    }
    case 2:
      return 3;
    default:
      return Rational(1, 100);
  }
}

inline TwoBlocks random_inelastic_system(Random& random) {
  TwoBlocks system;
  const Rational ratio = random_mass_ratio(random);
  system.blue.mass = random.rational(1, 5, 3);
  system.red.mass = system.blue.mass / ratio;
  const auto gap = [&] {
    return random.integer(0, 5) == 0 ? Rational(0) : random.rational(0, 4, 9);
  };
  const auto velocity = [&] {
    return random.integer(0, 3) == 0 ? Rational(0) : random.rational(-3, 3, 8);
  };
  system.wall_face = random.rational(-2, 2, 4);
  system.blue.width = random.rational(1, 3, 5);
  system.red.width = random.rational(1, 3, 5);
  system.blue.position = system.wall_face + system.blue.width / 2 + gap();
  system.red.position = system.blue.position + (system.blue.width + system.red.width) / 2 + gap();
  system.blue.velocity = velocity();
  system.red.velocity =
      random.integer(0, 2) == 0 ? velocity() : Rational(-random.rational(0, 3, 8));
  if (random.integer(0, 9) == 0) system.blue.velocity = system.red.velocity;
  system.blocks_restitution = random_restitution(random, ratio);
  system.wall_restitution =
      random.integer(0, 2) == 0 ? random_restitution(random, ratio) : system.blocks_restitution;
  if (is_elastic(system)) system.wall_restitution = Rational(1, 2);
  return system;
}

inline void expect_rounded(double given, const Rational& exact, const char* what) {
  const double wanted = to_double(exact);
  EXPECT_LE(std::fabs(given - wanted), 0x1p-52 * std::fabs(wanted))
      << what << " " << given << ", not " << wanted;
}

inline void expect_state(const PairLog& log, const Rational& time,
                         const oracle::InelasticRun& run) {
  SCOPED_TRACE("t = " + time.get_str().substr(0, 80));
  const std::size_t count = run.count_at(time);
  const TwoBlocks& system = log.blocks();
  Block blue = count == 0 ? system.blue : run.events[count - 1].blue;
  Block red = count == 0 ? system.red : run.events[count - 1].red;
  const Rational since = count == 0 ? Rational(0) : run.events[count - 1].time;
  blue.position += blue.velocity * (time - since);
  red.position += red.velocity * (time - since);
  const PairState state = log.blocks_at(time);
  EXPECT_EQ(state.count, Integer(count));
  expect_rounded(state.blue.position, blue.position, "blue.position");
  expect_rounded(state.red.position, red.position, "red.position");
  expect_rounded(state.blue.velocity, blue.velocity, "blue.velocity");
  expect_rounded(state.red.velocity, red.velocity, "red.velocity");
  const Gaps gaps = log.gaps_at(time);
  const Rational y1 = blue.position - blue.width / 2 - system.wall_face;
  expect_rounded(gaps.y1, y1, "y1");
  expect_rounded(gaps.y2, red.position - red.width / 2 - system.wall_face - blue.width, "y2");
  const auto bounds = log.bounds_at(time);
  ASSERT_TRUE(bounds);
  EXPECT_LE(abs(Rational(state.blue.position) - blue.position), Rational(bounds->blue));
  EXPECT_LE(abs(Rational(state.red.position) - red.position), Rational(bounds->red));
}

inline void expect_collision(const PairLog& log, const oracle::InelasticRun& run,
                             std::size_t place) {
  const oracle::InelasticEvent& event = run.events[place];
  const Integer index = place + 1;
  SCOPED_TRACE("collision " + index.get_str());
  const PairCollision collision = log.blocks_collision(index);
  EXPECT_EQ(collision.kind, event.kind);
  EXPECT_LE(abs(to_rational(collision.time) - event.time), event.time * power(Rational(1, 2), 104));
  expect_rounded(collision.blue.position, event.blue.position, "blue.position");
  expect_rounded(collision.red.position, event.red.position, "red.position");
  expect_rounded(collision.blue.velocity, event.blue.velocity, "blue.velocity");
  expect_rounded(collision.red.velocity, event.red.velocity, "red.velocity");
  const Gaps gaps = log.gaps_at_collision(index);
  const Rational offset = log.blocks().wall_face + event.blue.width;
  expect_rounded(gaps.y1, event.blue.position - log.blocks().wall_face - event.blue.width / 2,
                 "y1");
  expect_rounded(gaps.y2, event.red.position - event.red.width / 2 - offset, "y2");
  const bool has_next = place + 1 < run.events.size();
  if (has_next && run.events[place + 1].time == event.time) {
    EXPECT_THROW(log.time_after(index), UsageError);
    return;
  }
  if (!has_next && !run.ended) return;  // the next one may be at the same time
  const Rational after = log.time_after(index);
  EXPECT_GE(after, event.time);
  if (has_next) {
    const Rational flight = run.events[place + 1].time - event.time;
    EXPECT_LE(after - event.time, flight * power(Rational(1, 2), 100));
  }
  EXPECT_EQ(log.blocks_at(after).count, index);
}

/// Impulses of all listed collisions of `run`, of both kinds, against their exact sums.
inline void expect_impulses(const PairLog& log, const oracle::InelasticRun& run) {
  const TwoBlocks& s = log.blocks();
  const Rational& m = s.blue.mass;
  const Rational unit = 2 * m * s.red.mass / (m + s.red.mass);
  const Rational speed_squared =
      m / s.red.mass * s.blue.velocity * s.blue.velocity + s.red.velocity * s.red.velocity;
  for (const CollisionKind kind : {CollisionKind::wall, CollisionKind::blocks}) {
    Rational sum = 0;
    Rational moment = 0;
    for (const oracle::InelasticEvent& event : run.events) {
      if (event.kind != kind) continue;
      sum += event.impulse;
      moment += event.impulse * event.time;
    }
    const auto all = log.impact(kind, 1, Integer(run.events.size()));
    ASSERT_EQ(all.has_value(), sum > 0);
    if (!all) continue;
    const double wanted = to_double(sum / unit) / std::sqrt(to_double(speed_squared));
    EXPECT_NEAR(all->impulse, wanted, 1e-14 * wanted);
    EXPECT_NEAR(all->time.hi, to_double(moment / sum), 1e-15 * to_double(moment / sum));
  }
}

/// The limit of three numbers that approach it geometrically.
inline Rational extrapolated(const Rational& a, const Rational& b, const Rational& c) {
  const Rational bend = (c - b) - (b - a);
  return bend == 0 ? c : Rational(c - (c - b) * (c - b) / bend);
}

/// Times of collisions since they follow each other in even proportions.
inline void expect_collapse(const TwoBlocks& system, const oracle::InelasticRun& run) {
  const auto collapse = collapse_of(system);
  ASSERT_TRUE(collapse);
  EXPECT_GT(collapse->listed, 0);
  ASSERT_FALSE(run.ended);
  if (!collapse->time) return;
  const Rational end = to_rational(*collapse->time);
  const std::size_t last = run.events.size() - 1;
  const Rational& time = run.events[last].time;
  EXPECT_GE(end * (1 + power(Rational(1, 2), 100)), time);
  // Halfway to it the error of the extrapolation must have become much smaller, or be 0.
  const auto guess = [&](std::size_t n) {
    return extrapolated(run.events[n - 4].time, run.events[n - 2].time, run.events[n].time);
  };
  const Rational early = abs(guess(last / 2) - end);
  const Rational late = abs(guess(last) - end);
  EXPECT_LE(late, early * 3 / 4 + end * power(Rational(1, 2), 100));
  EXPECT_LE(late, (end - run.events[last / 2].time) + end * power(Rational(1, 2), 100));
}

/// Everything about a system whose first collisions, up to `max_events`, can be stepped through.
inline void expect_like_steps(const TwoBlocks& system, Random& random, std::size_t max_events) {
  SCOPED_TRACE(describe_inelastic(system));
  oracle::InelasticRun run = oracle::inelastic_run(system, max_events);
  const auto log = make_pair_log(system);
  EXPECT_EQ(log->first_index(), 1);
  const auto collapse = collapse_of(system);
  if (run.ended) {
    EXPECT_FALSE(collapse);
    EXPECT_EQ(log->last(), Integer(run.events.size()));
    EXPECT_EQ(count_collisions(system), Integer(run.events.size()));
  } else {
    EXPECT_GE(log->last(), collapse ? 1 : Integer(max_events));
    if (collapse) {
      EXPECT_THROW(count_collisions(system), UsageError);
      expect_collapse(system, run);
    }
  }
  // The last collision that is listed stands for all that are not.
  const std::size_t listed =
      log->last() > Integer(run.events.size()) ? run.events.size() : log->last().get_ui();
  const std::size_t usable = collapse && listed == log->last() ? listed - 1 : listed;
  if (listed < run.events.size()) run.events.resize(usable + 1);
  for (std::size_t place = 0; place < usable; ++place) expect_collision(*log, run, place);
  const Rational end = run.events.empty() ? Rational(2) : run.events.back().time;
  for (int i = 0; i < 4; ++i) {
    const Rational time = (run.ended ? end + 1 : end) * random.rational(0, 1, 1000);
    if (run.count_at(time) > usable || (!run.ended && time >= end)) continue;
    expect_state(*log, time, run);
  }
  expect_state(*log, -1, run);
  if (usable > 0 && run.events.size() == usable) expect_impulses(*log, run);
}

}  // namespace piblocks
