// Blocks that lose energy where they collide, against steps in rational numbers.
#include <gtest/gtest.h>
#include <piblocks/error.hpp>
#include <piblocks/two_blocks.hpp>

#include "physics/exposure.hpp"
#include "physics/logs.hpp"
#include "support/inelastic_checks.hpp"
#include "support/traced_random.hpp"

namespace piblocks {
namespace {

TwoBlocks with_restitution(TwoBlocks system, const Rational& e) {
  system.blocks_restitution = e;
  system.wall_restitution = e;
  return system;
}

/// Collisions of the article's run with e = p/q, from velocities alone, as integers: each collision
/// multiplies them by a number that does not matter. Stops at `most`.
std::int64_t count_by_velocities(const Rational& mass_ratio, const Rational& e, std::int64_t most) {
  const Integer& p = e.get_num();
  const Integer& q = e.get_den();
  const Integer& m_blue = mass_ratio.get_den();
  const Integer& m_red = mass_ratio.get_num();
  Integer blue = 0;
  Integer red = -1;
  for (std::int64_t n = 0; n < most; ++n) {
    if (blue > red) {  // in turn with the wall, since only one pair approaches
      const Integer momentum = q * (m_blue * blue + m_red * red);
      const Integer apart = p * (blue - red);
      blue = momentum - m_red * apart;
      red = momentum + m_blue * apart;
    } else if (blue < 0) {
      blue *= -p;
      red *= q;
    } else {
      return n;
    }
  }
  return most;
}

TEST(LeastRestitution, StepsCountTheSame) {
  for (int digits = 1; digits <= 4; ++digits) {
    SCOPED_TRACE(digits);
    const LeastRestitution least = least_restitution(digits);
    const Rational ratio = mass_ratio_of(digits);
    EXPECT_EQ(least.count_above, count_collisions(article_blocks(digits)));
    EXPECT_EQ(least.count_below, least.count_above + 1);
    EXPECT_EQ(Integer(count_by_velocities(ratio, least.above, 5000)), least.count_above);
    EXPECT_EQ(Integer(count_by_velocities(ratio, least.below, 5000)), least.count_below);
    const Rational loss = digits == 1 ? Rational(1) : Rational(1 - least.above);
    EXPECT_LE(least.above - least.below, loss * power(Rational(1, 2), 64));
    EXPECT_LE(least.above, 1);
  }
}

TEST(LeastRestitution, CountsFallAsRestitutionRises) {
  const Rational ratio = mass_ratio_of(2);
  std::int64_t before = 5000;
  for (int percent = 90; percent <= 100; ++percent) {
    const std::int64_t count = count_by_velocities(ratio, Rational(percent) / 100, 5000);
    EXPECT_LE(count, before) << percent;
    before = count;
  }
  EXPECT_EQ(before, 31);
}

/// README.md, "How much loss pi can take".
TEST(LeastRestitution, FollowsTheFormula) {
  for (int digits = 3; digits <= 25; ++digits) {
    SCOPED_TRACE(digits);
    const LeastRestitution least = least_restitution(digits);
    const double n = std::pow(10, digits - 1);
    const Rational pi = parse_rational(pi_digits(10, 60));
    const Rational exact = pi * power(10, static_cast<unsigned long>(digits - 1));
    const double rest = to_double(1 - (exact - floor(exact)));
    const double loss = 2 * std::sqrt(2 * rest / M_PI) / (n * std::sqrt(n));
    EXPECT_NEAR(to_double(1 - least.above) / loss, 1, 2 / (n * rest) + 1e-13);
  }
  EXPECT_THROW(least_restitution(0), UsageError);
  EXPECT_THROW(least_restitution(3, 10, 0), UsageError);
  EXPECT_LE(least_restitution(3, 10, 200).above - least_restitution(3, 10, 200).below,
            power(Rational(1, 2), 200));
}

/// With nothing lost the general form is compared with the elastic one.
void expect_like_elastic(const TwoBlocks& system, const PairLog& inelastic, double tolerance,
                         Random& random) {
  TwoBlocks elastic_system = system;
  elastic_system.blocks_restitution = elastic_system.wall_restitution = 1;
  const auto elastic = make_pair_log(elastic_system);
  ASSERT_EQ(inelastic.last(), elastic->last());
  const Rational y1 = system.blue_gap();
  const bool in_corner =
      (y1 + system.blocks_gap()) * system.blue.velocity == y1 * system.red.velocity;
  if (inelastic.last() == 0 || in_corner) return;
  for (int i = 0; i < 8; ++i) {
    const Integer index =
        1 + (inelastic.last() - 1) * Integer(long(random.integer(0, 1000000))) / 1000000;
    SCOPED_TRACE(index.get_str());
    const PairCollision a = inelastic.blocks_collision(index);
    const PairCollision b = elastic->blocks_collision(index);
    EXPECT_EQ(a.kind, b.kind);
    EXPECT_NEAR(a.time.hi, b.time.hi, tolerance * (1 + std::fabs(b.time.hi)));
    EXPECT_NEAR(a.blue.position, b.blue.position, tolerance * (1 + std::fabs(b.blue.position)));
    EXPECT_NEAR(a.red.position, b.red.position, tolerance * (1 + std::fabs(b.red.position)));
    const double speed = std::fabs(b.blue.velocity) + std::fabs(b.red.velocity);
    EXPECT_NEAR(a.blue.velocity, b.blue.velocity, tolerance * speed);
    EXPECT_NEAR(a.red.velocity, b.red.velocity, tolerance * speed);
    const Rational time = elastic->time_after(index) + 1;
    EXPECT_NEAR(inelastic.blocks_at(time).blue.position, elastic->blocks_at(time).blue.position,
                elastic->bounds_at(time)->blue);
  }
}

TEST(Restitution, OfOneIsTheClosedForm) {
  TracedRandom random(7);
  for (std::int64_t i = 0; i < many(60) && !testing::Test::HasFailure(); ++i) {
    TwoBlocks system = random_inelastic_system(random);
    system.blocks_restitution = system.wall_restitution = 1;
    SCOPED_TRACE(describe_inelastic(system));
    expect_like_elastic(system, *make_inelastic_log(system_of(system)), 1e-13, random);
  }
}

TEST(Restitution, NearOneOfManyDigits) {
  Random random(8);
  for (const int digits : {1, 5, 12, 20, 40}) {
    SCOPED_TRACE(digits);
    const Rational loss = power(Rational(1, 10), static_cast<unsigned long>(3 * digits));
    const TwoBlocks system = with_restitution(article_blocks(digits), 1 - loss / 1000000);
    if (digits == 1) continue;  // any loss makes one collision more
    expect_like_elastic(system, *make_pair_log(system), 1e-13, random);
  }
  const TwoBlocks slight = with_restitution(article_blocks(3), 1 - power(Rational(1, 10), 30));
  expect_like_elastic(slight, *make_pair_log(slight), 1e-13, random);
}

/// The run of 20 digits that loses a little, where nothing can be stepped: neighbours must fit.
TEST(Restitution, NeighboursFitAtTwentyDigits) {
  const TwoBlocks system = with_restitution(article_blocks(20), 1 - power(Rational(1, 10), 20));
  const auto log = make_pair_log(system);
  ASSERT_GT(log->last(), count_collisions(article_blocks(20)));
  EXPECT_EQ(log->last(), count_collisions(system));
  for (const Integer& index :
       {Integer(1), Integer(12345), Integer(log->last() / 2), Integer(log->last() - 1)}) {
    SCOPED_TRACE(index.get_str());
    const Rational now = log->time_after(index);
    const Rational next = log->time_after(index + 1);
    EXPECT_LT(now, next);
    EXPECT_EQ(log->blocks_at(now).count, index);
    EXPECT_EQ(log->blocks_at(next).count, index + 1);
    const Rational middle = (now + next) / 2;
    EXPECT_EQ(log->blocks_at(middle).count, index);
    // Half-way the gaps are the means of those at both ends.
    const Gaps a = log->gaps_at_collision(index);
    const Gaps b = log->gaps_at_collision(index + 1);
    const Gaps m = log->gaps_at(middle);
    EXPECT_NEAR(m.y1, (a.y1 + b.y1) / 2, 1e-15 * (a.y1 + b.y1));
    EXPECT_NEAR(m.y2, (a.y2 + b.y2) / 2, 1e-15 * (a.y2 + b.y2));
  }
}

TEST(Restitution, HalfOfEqualMasses) {
  // Worked by hand: (0, -1) -> (-3/4, -1/4) -> (3/8, -1/4) -> (-3/32, 7/32) -> (3/64, 7/32).
  TwoBlocks system = with_restitution(article_blocks(1), Rational(1, 2));
  EXPECT_EQ(count_collisions(system), 4);
  const auto log = make_pair_log(system);
  EXPECT_EQ(log->blocks_collision(4).blue.velocity, 3.0 / 64);
  EXPECT_EQ(log->blocks_collision(4).red.velocity, 7.0 / 32);
}

TEST(Restitution, NoReboundEndsInTheCornerAtOnce) {
  const TwoBlocks system = with_restitution(article_blocks(1), 0);
  const auto collapse = collapse_of(system);
  ASSERT_TRUE(collapse);
  // Red is 2 away from blue, and both go on to the wall, 3/2 away, at half its speed.
  EXPECT_EQ(collapse->time, Time({5, 0}));
  const auto log = make_pair_log(system);
  EXPECT_EQ(log->blocks_collision(1).blue.velocity, -0.5);
  EXPECT_EQ(log->blocks_collision(1).red.velocity, -0.5);
  EXPECT_EQ(log->blocks_at(Rational(9, 2)).count, 1);
  const PairState after = log->blocks_at(5);
  EXPECT_EQ(after.count, log->last());
  EXPECT_EQ(after.blue.position, 0.5);
  EXPECT_EQ(after.red.position, 1.5);
  EXPECT_EQ(after.blue.velocity, 0);
  EXPECT_EQ(after.red.velocity, 0);
  EXPECT_THROW(log->time_after(2), UsageError);
  EXPECT_EQ(log->time_after(log->last()), 5);
}

/// With e = 1/4 and (1 + e)^2/(1 + r) = 9/8 a round has the eigenvalues 1/2 and 1/8. Velocities of
/// -6 and -1, the wall being first, are the eigenvector of the lesser: they fall to an eighth in
/// each round, and flights become four times as long.
TEST(Restitution, AnEndlessRunMayTakeForever) {
  TwoBlocks system = with_restitution(article_blocks(1), Rational(1, 4));
  system.blue.mass = Rational(7, 18);
  system.blue.velocity = -6;
  const auto collapse = collapse_of(system);
  ASSERT_TRUE(collapse);
  EXPECT_FALSE(collapse->time);
  EXPECT_THROW(count_collisions(system), UsageError);
  Random random(1);
  expect_like_steps(system, random, 60);
  const auto log = make_pair_log(system);
  EXPECT_EQ(log->blocks_collision(3).blue.velocity, log->blocks_collision(1).blue.velocity / 8);
  // A hair beside it there is an end.
  system.red.velocity -= power(Rational(1, 10), 30);
  ASSERT_TRUE(collapse_of(system));
  EXPECT_TRUE(collapse_of(system)->time);
  system.red.velocity += 2 * power(Rational(1, 10), 30);
  EXPECT_FALSE(collapse_of(system));
}

/// Found by the stress test: the wall's place and the gap add up to nothing.
TEST(Restitution, APositionOfZeroIsZero) {
  TwoBlocks system;
  system.wall_face = -2;
  system.blue = {Rational(7, 3), Rational(13, 18), Rational(-3, 4), 1};
  system.red = {Rational(7, 9), Rational(103, 18), Rational(-3, 4), 1};
  const TwoBlocks inelastic = with_restitution(system, Rational(3, 5));
  EXPECT_EQ(make_pair_log(inelastic)->blocks_collision(2).blue.position, 0);
  Random random(3);
  expect_like_steps(inelastic, random, 40);
}

TEST(Restitution, StateBeforeTimeZeroIsFree) {
  const TwoBlocks system = with_restitution(article_blocks(2), Rational(1, 2));
  const auto log = make_pair_log(system);
  EXPECT_EQ(log->first_index(), 1);
  const PairState state = log->blocks_at(-7);
  EXPECT_EQ(state.count, 0);
  EXPECT_EQ(state.red.position, 12);
  EXPECT_EQ(state.red.velocity, -1);
}

/// Sums of many collisions of both kinds against all of them one by one.
TEST(Restitution, ImpactsAreSums) {
  const TwoBlocks system = with_restitution(article_blocks(4), Rational(999999, 1000000));
  const auto log = make_pair_log(system);
  const double r = to_double(system.blue.mass / system.red.mass);
  for (const auto& [first, last] :
       {std::pair(1, 3000), std::pair(1500, 1501), std::pair(7, 7), std::pair(1400, 1700)}) {
    for (const CollisionKind kind : {CollisionKind::wall, CollisionKind::blocks}) {
      double sum = 0;
      double moment = 0;
      for (int n = first; n <= last; ++n) {
        const PairCollision now = log->blocks_collision(n);
        if (now.kind != kind) continue;
        const double e = to_double(system.wall_restitution);
        // The speed of approach, from that of parting. Red had all the energy, at a speed of 1.
        const double parting = kind == CollisionKind::wall ? now.blue.velocity * (1 + r)
                                                           : now.red.velocity - now.blue.velocity;
        sum += (1 + e) / 2 * parting / e;
        moment += (1 + e) / 2 * parting / e * now.time.hi;
      }
      const auto all = log->impact(kind, first, last);
      ASSERT_EQ(all.has_value(), sum > 0) << first;
      if (!all) continue;
      EXPECT_NEAR(all->impulse, sum, 1e-12 * sum);
      EXPECT_NEAR(all->time.hi, moment / sum, 1e-12);
    }
  }
}

/// Where blue is on average, from its position at many times.
void expect_mean(const PairLog& log, const Rational& begin, const Rational& end, double tolerance) {
  const Exposure exposure = expose(log, begin, end);
  EXPECT_FALSE(exposure.closed);
  double share = 0;
  double mean = 0;
  for (const BodyPiece& piece : exposure.pieces[log.blocks().blue_id]) {
    share += piece.end - piece.begin;
    mean += (piece.end - piece.begin) * (piece.from[0] + piece.to[0]) / 2;
  }
  EXPECT_NEAR(share, 1, 1e-12);
  constexpr int kTimes = 5000;
  double wanted = 0;
  for (int i = 0; i < kTimes; ++i) {
    const Rational time = begin + (end - begin) * (2 * i + 1) / (2 * kTimes);
    wanted += log.blocks_at(time).blue.position / kTimes;
  }
  EXPECT_NEAR(mean, wanted, tolerance);
}

TEST(Restitution, ExposuresListOrSampleTheFlights) {
  const auto few = make_pair_log(with_restitution(article_blocks(3), Rational(99, 100)));
  expect_mean(*few, 3, 4, 1e-4);
  const auto many = make_pair_log(with_restitution(article_blocks(6), Rational(999, 1000)));
  ASSERT_GT(many->state_at(Rational(36, 10)).count - many->state_at(Rational(34, 10)).count, 10000);
  expect_mean(*many, Rational(34, 10), Rational(36, 10), 3e-3);
}

TEST(Restitution, RedTurnsAtTheTurn) {
  for (const char* const e : {"0.9", "0.99", "1/2", "0"}) {
    const TwoBlocks system = with_restitution(article_blocks(2), parse_rational(e));
    const auto log = make_pair_log(system);
    const auto turn = turn_of(system);
    ASSERT_TRUE(turn);
    const double nearest = log->blocks_at(*turn).red.position;
    EXPECT_GE(log->blocks_at(*turn).red.velocity, 0);
    for (int i = -100; i <= 100; ++i) {
      const Rational time = *turn + Rational(i * i * i) / 1000000;
      EXPECT_GE(log->blocks_at(time).red.position, nearest) << e << " " << i;
    }
  }
  TwoBlocks rest = with_restitution(article_blocks(2), Rational(1, 2));
  rest.red.velocity = 0;
  EXPECT_FALSE(turn_of(rest));
  EXPECT_EQ(count_collisions(rest), 0);
}

/// Blue rests at the wall: steps with each order of the first two collisions.
TEST(Restitution, CornersHaveTwoCounts) {
  TwoBlocks system = with_restitution(article_blocks(2), Rational(99, 100));
  system.blue.position = Rational(1, 2);
  const auto corner = corner_of(system);
  ASSERT_TRUE(corner);
  EXPECT_EQ(corner->time, Rational(7, 2));
  EXPECT_TRUE(corner->blocks_first);
  EXPECT_EQ(corner->count, Integer(oracle::inelastic_run(system, 100).events.size()));
  EXPECT_EQ(corner->other_count, corner->count + 1);
  const auto log = make_pair_log(system);
  EXPECT_EQ(log->blocks_at(Rational(7, 2)).count, corner->count);
  EXPECT_EQ(log->blocks_at(Rational(6, 2)).count, 0);
  // Both come into the corner on a slant: a later red block meets blue first.
  system.blue.position = Rational(3, 2);
  system.red.position = Rational(7, 2);
  system.blue.velocity = -1;
  system.red.velocity = -2;
  const auto slant = corner_of(system);
  ASSERT_TRUE(slant);
  TwoBlocks sooner = system;
  sooner.blue.position += Rational(1, 1000);
  EXPECT_EQ(slant->count, Integer(oracle::inelastic_run(sooner, 100).events.size()));
  sooner.blue.position -= Rational(2, 1000);
  EXPECT_EQ(slant->other_count, Integer(oracle::inelastic_run(sooner, 100).events.size()));
}

TEST(Restitution, EnginesThatStepRefuseIt) {
  const TwoBlocks system = with_restitution(article_blocks(2), Rational(1, 2));
  EXPECT_THROW(make_pair_log(system, Engine::events), UsageError);
}

TEST(Restitution, IsAShare) {
  TwoBlocks system = article_blocks(2);
  system.blocks_restitution = Rational(11, 10);
  system.wall_restitution = -1;
  const std::vector<Problem> problems = problems_of(system_of(system));
  ASSERT_EQ(problems.size(), 2);
  EXPECT_EQ(problems[0].key, "blocks.restitution");
  EXPECT_EQ(problems[1].key, "wall.restitution");
}

}  // namespace
}  // namespace piblocks
