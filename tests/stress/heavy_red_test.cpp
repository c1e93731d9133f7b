// Collisions beside a red block that is heavy and slow, against an oracle in multiple precision.
// The turn then takes 1e39 s, or 1e300 s, while the next collision is seconds away.
#include <gtest/gtest.h>
#include <piblocks/error.hpp>
#include <piblocks/two_blocks.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>
#include <string>

#include "physics/exposure.hpp"
#include "physics/impact.hpp"
#include "support/exposure_sums.hpp"
#include "support/oracle.hpp"
#include "support/random_system.hpp"
#include "support/traced_random.hpp"

namespace piblocks {
namespace {

constexpr double kRoundoff = 0x1p-53;
/// Beyond them a log refuses to place a collision, or has no room for small numbers.
constexpr double kLongest = 1e290;
constexpr double kShortest = 1e-290;

/// Largest errors that were met, in units of their bounds.
struct Worst {
  double time = 0;
  double blue_position = 0;
  double red_position = 0;
  double blue_velocity = 0;
  double red_velocity = 0;

  void record(const char* engine) const {
    const auto put = [&](const char* what, double value) {
      testing::Test::RecordProperty(std::string(engine) + what, std::to_string(value));
    };
    put("_time", time);
    put("_blue_position", blue_position);
    put("_red_position", red_position);
    put("_blue_velocity", blue_velocity);
    put("_red_velocity", red_velocity);
  }
};

/// |error|/unit, which may both be beyond the range of a double.
double quotient(const Rational& error, const Rational& unit) {
  if (error == 0) return 0;
  return unit == 0 ? HUGE_VAL : to_double(abs(error) / abs(unit));
}

/// 8 u of the time or of the time to the turn, whichever is less, and what two doubles do not hold.
Rational time_bound(const Rational& time, const Rational& turn) {
  return Rational(8 * kRoundoff) * std::min<Rational>(abs(time), abs(time - turn)) +
         Rational(0x1p-102) * abs(time);
}

/// At least sqrt(m_red/m_blue).
Rational root_of_ratio(const TwoBlocks& system) {
  return Rational(sqrt(ceil(system.red.mass / system.blue.mass)) + 1);
}

TwoBlocks random_heavy_system(Random& random) {
  const auto hair = [&] {  // 2 to the power of minus up to 2000
    const auto exponent = static_cast<unsigned long>(random.integer(0, 2000));
    return Rational(Rational(random.integer(1, 1000)) / power(2, exponent));
  };
  TwoBlocks system;
  system.blue.mass = random.rational(1, 50, 7);
  system.red.mass =
      system.blue.mass * (1 + power(2, static_cast<unsigned long>(random.integer(0, 1990))) *
                                  random.rational(1, 2, 1000));
  place_blocks(random, system);
  if (system.blue.velocity == 0) system.blue.velocity = 1;
  switch (random.integer(0, 4)) {
    case 0:
      system.red.velocity = 0;
      break;
    case 1:
      system.red.velocity = -hair();
      break;
    case 2:
      system.red.velocity = hair();
      break;
    default:  // with the energy that blue has, more or less
      system.red.velocity = random.rational(-1000, 1000, 300) / root_of_ratio(system);
  }
  return system;
}

/// |V| or somewhat more.
Rational speed_of(const TwoBlocks& system) {
  return abs(system.red.velocity) + 2 * abs(system.blue.velocity) / root_of_ratio(system);
}

void compare(const TwoBlocks& system, const oracle::ExactEvent& exact, const Rational& turn,
             CollisionKind kind, const Rational& time, const BlockMotion& blue,
             const BlockMotion& red, Worst& worst) {
  EXPECT_EQ(kind, exact.kind);
  const auto note = [](double& most, double now) { most = std::max(most, now); };
  note(worst.time, quotient(time - exact.time, time_bound(exact.time, turn)));
  EXPECT_LE(worst.time, 1) << to_double(time) << ", not " << to_double(exact.time);
  const Rational least(kShortest);
  const auto check = [&](const char* what, double& most, double given, const Rational& wanted,
                         const Rational& unit) {
    if (abs(wanted) < least || abs(wanted) > Rational(kLongest)) return;
    note(most, quotient(Rational(given) - wanted, Rational(kRoundoff) * unit));
    EXPECT_LE(most, 8) << what << ": " << given << ", not " << to_double(wanted);
  };
  check("blue", worst.blue_position, blue.position, exact.blue.position,
        8 + abs(exact.blue.position));
  check("red", worst.red_position, red.position, exact.red.position, 8 + abs(exact.red.position));
  // To what a collision changes them by.
  check("blue's velocity", worst.blue_velocity, blue.velocity, exact.blue.velocity,
        abs(exact.blue.velocity) + speed_of(system));
  check("red's velocity", worst.red_velocity, red.velocity, exact.red.velocity,
        abs(exact.red.velocity) + speed_of(system) / root_of_ratio(system) * 2);
}

/// Indices of the first, the last, and of those in which the way to compute them may change.
std::set<Integer> indices_of(Random& random, const TwoBlocks& system, const PairLog& log) {
  std::set<Integer> result;
  const auto add = [&](const Integer& middle, long reach) {
    for (Integer index = middle - reach; index <= middle + reach; ++index) {
      if (index >= 1 && index <= log.last()) result.insert(index);
    }
  };
  const Rational turn = turn_of(system).value();
  const Rational flight(1, 1 + random.integer(0, 9));
  add(1, 3);
  add(log.last(), 2);
  add(log.last() / 2, 1);
  for (const Rational& time : {Rational(turn / 2), turn, Rational(turn * 2), flight}) {
    if (time > 0) add(log.blocks_at(time).count, 1);
  }
  add(Integer(log.last() * random.integer(1, 999) / 1000), 0);
  for (int i = 0; i < 4; ++i) {  // at any scale
    const auto bits =
        random.integer(0, static_cast<long>(mpz_sizeinbase(log.last().get_mpz_t(), 2)));
    add(Integer(log.last() >> static_cast<unsigned long>(bits)), 0);
  }
  return result;
}

bool is_in_range(const Rational& time) {
  return abs(time) < Rational(kLongest) && (time == 0 || abs(time) > Rational(kShortest));
}

/// Calls check(system, log) for random systems whose collisions do not happen all at once.
template <typename Check>
void for_each_system(Random& random, int number, const Check& check) {
  for (int i = 0; i < number && !testing::Test::HasFailure(); ++i) {
    const TwoBlocks system = random_heavy_system(random);
    if (corner_of(system)) continue;
    SCOPED_TRACE("masses " + system.blue.mass.get_str() + " : " + system.red.mass.get_str() +
                 ", velocities " + system.blue.velocity.get_str() + ", " +
                 system.red.velocity.get_str());
    check(system, *make_pair_log(system, Engine::unfolded));
  }
}

TEST(HeavyRed, HasEveryCollisionInItsPlace) {
  TracedRandom random(602214);
  Worst one_by_one;
  Worst streamed;
  const auto batch = std::make_unique<PairBatch>();
  for_each_system(random, 200, [&](const TwoBlocks& system, const PairLog& log) {
    const Rational turn = turn_of(system).value();
    for (const Integer& index : indices_of(random, system, log)) {
      SCOPED_TRACE("collision " + index.get_str());
      const oracle::ExactEvent exact = oracle::high_precision_collision(system, index, 2500);
      if (!is_in_range(exact.time)) continue;
      const PairCollision one = log.blocks_collision(index);
      compare(system, exact, turn, one.kind, to_rational(one.time), one.blue, one.red, one_by_one);

      // In a block with others before or after it.
      const Integer first = std::max<Integer>(1, index - random.integer(0, 100));
      const auto stream = log.stream(first, index);
      Integer row = index - first;
      while (stream->read(*batch) && row >= static_cast<unsigned long>(batch->size)) {
        row -= static_cast<unsigned long>(batch->size);
      }
      const std::size_t r = row.get_ui();
      compare(system, exact, turn, batch->kind[r],
              to_rational({batch->time_hi[r], batch->time_lo[r]}),
              {batch->blue_position[r], batch->blue_velocity[r]},
              {batch->red_position[r], batch->red_velocity[r]}, streamed);
    }
  });
  one_by_one.record("at");
  streamed.record("stream");
}

TEST(HeavyRed, HasItsStatesBetweenCollisions) {
  TracedRandom random(299792);
  for_each_system(random, 200, [&](const TwoBlocks& system, const PairLog& log) {
    for (int j = 0; j < 4; ++j) {
      const Rational time = random.rational(-10, 10, 1000);
      SCOPED_TRACE("t = " + time.get_str());
      const PairState given = log.blocks_at(time);
      const oracle::ExactState exact = oracle::high_precision_state(system, time, 2500);
      EXPECT_EQ(given.count, exact.count);
      // What blue has travelled, and from where, is rounded; not how long the turn takes.
      const Rational way = 8 + abs(exact.blue.position) + abs(exact.red.position) +
                           (abs(system.blue.velocity) + abs(system.red.velocity)) * abs(time);
      EXPECT_LE(quotient(Rational(given.blue.position) - exact.blue.position, way), 8 * kRoundoff)
          << given.blue.position << ", not " << to_double(exact.blue.position);
      EXPECT_LE(quotient(Rational(given.red.position) - exact.red.position, way), 8 * kRoundoff);
    }
  });
}

TEST(HeavyRed, IsHeardWhenItsCollisionsAre) {
  TracedRandom random(667408);
  for_each_system(random, 50, [&](const TwoBlocks& system, const PairLog& log) {
    const Rational turn = turn_of(system).value();
    for (const Integer& index : indices_of(random, system, log)) {
      SCOPED_TRACE("from collision " + index.get_str());
      const Integer last = index + random.integer(0, 5);
      if (last > log.last()) continue;
      Rational impulse;
      Rational moment;
      Rational furthest;
      for (Integer k = index; k <= last; ++k) {
        const oracle::ExactEvent exact = oracle::high_precision_collision(system, k, 2500);
        if (exact.kind != CollisionKind::blocks) continue;
        const Rational blow = exact.red.velocity - exact.blue.velocity;
        impulse += blow;
        moment += blow * exact.time;
        furthest = std::max(furthest, exact.time);
      }
      if (impulse == 0 || !is_in_range(furthest)) continue;
      const Rational mean = moment / impulse;
      const auto together = log.impact(CollisionKind::blocks, index, last);
      ASSERT_TRUE(together.has_value());
      EXPECT_LE(quotient(to_rational(together->time) - mean, time_bound(mean, turn)), 1)
          << together->time.hi << ", not " << to_double(mean);
    }
  });
}

/// The share of [begin, end] in which blue is at most `position`, by the oracle's collisions.
Rational share_below(const TwoBlocks& system, const Rational& begin, const Rational& end,
                     const Rational& position) {
  Rational sum;
  Rational now = begin;
  oracle::ExactState state = oracle::high_precision_state(system, begin, 2500);
  Rational from = state.blue.position;
  const Integer last = oracle::high_precision_state(system, end, 2500).count;
  const auto fly = [&](const Rational& until, const Rational& to) {
    const Rational low = std::min(from, to);
    const Rational high = std::max(from, to);
    const Rational part = position >= high  ? Rational(1)
                          : position <= low ? Rational(0)
                                            : Rational((position - low) / (high - low));
    sum += (until - now) * part;
    now = until;
    from = to;
  };
  for (Integer k = state.count + 1; k <= last; ++k) {
    const oracle::ExactEvent exact = oracle::high_precision_collision(system, k, 2500);
    fly(exact.time, exact.blue.position);
  }
  fly(end, oracle::high_precision_state(system, end, 2500).blue.position);
  return sum / (end - begin);
}

TEST(HeavyRed, IsExposedAsLongAsItIsThere) {
  TracedRandom random(160217);
  for_each_system(random, 100, [&](const TwoBlocks& system, const PairLog& log) {
    const Rational begin = random.rational(0, 10, 1000);
    const Rational end = begin + random.rational(1, 20, 1000);
    const PairExposure exposure = log.expose(begin, end);
    if (exposure.area_below) return;
    const Travel range = exposure.blue_range;
    for (int j = 1; j < 5; ++j) {
      const double position = range.from + (range.to - range.from) * j / 5;
      EXPECT_NEAR(share_below(exposure, BlockName::blue, position),
                  to_double(share_below(system, begin, end, Rational(position))), 1e-13);
    }
  });
}

TEST(HeavyRed, IsLeftAnInstantAfterTheTimeInItsLog) {
  TracedRandom random(137035);
  for_each_system(random, 20, [&](const TwoBlocks& system, const PairLog& log) {
    const Rational turn = turn_of(system).value();
    for (const Integer& index : {Integer(1), Integer(2), Integer(3), Integer(64), Integer(1000)}) {
      if (index > log.last()) continue;
      SCOPED_TRACE("collision " + index.get_str());
      const Rational after = log.time_after(index);
      const Rational time = to_rational(log.blocks_collision(index).time);
      // It is after the collision by up to 2^-100 of the time to the turn and of that which the
      // turn takes.
      const oracle::ExactEvent exact = oracle::high_precision_collision(system, index, 2500);
      EXPECT_GE(after, exact.time * (1 - Rational(1 / power(2, 500))));
      EXPECT_LE(abs(time - exact.time), time_bound(exact.time, turn));
      EXPECT_EQ(log.blocks_at(after).count, index);
    }
  });
}

}  // namespace
}  // namespace piblocks
