// Random systems without number: invariants of every log, and the oracle's answers.
#include <gtest/gtest.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <memory>
#include <vector>

#include "stress/cases.hpp"
#include "stress/log_checks.hpp"
#include "stress/random_system.hpp"
#include "support/oracle.hpp"

namespace piblocks::stress {
namespace {

/// The first, the last, one between of any magnitude, and those in the middle.
std::vector<Integer> some_indices(Random& random, const Integer& size) {
  if (size <= 3) {
    std::vector<Integer> all;
    for (Integer k = 1; k <= size; ++k) all.push_back(k);
    return all;
  }
  const auto bits = static_cast<std::int64_t>(mpz_sizeinbase(size.get_mpz_t(), 2));
  Integer between = Integer(random.uniform(1, 2) * 0x1p52) << 2000;
  between >>= static_cast<mp_bitcnt_t>(2052 - random.integer(0, bits - 2));
  if (random.integer(0, 1) == 0) between = size - between;
  return {1, size, size / 2, between};
}

/// Times at every scale before, about and after the turning point.
std::vector<Rational> some_times(Random& random, const PairLog& log) {
  std::vector<Rational> times = {0};
  const auto scattered = [&] {
    return Rational(random.uniform(-1, 1) * std::pow(10.0, random.uniform(-8, 8)));
  };
  if (log.last() == 0) return {0, scattered(), scattered()};
  const Rational middle = to_rational(log.blocks_collision((log.last() + 1) / 2).time);
  const Rational last = to_rational(log.blocks_collision(log.last()).time);
  times.push_back(middle);
  times.push_back(middle + (last - middle) * scattered());
  times.push_back(last * scattered());
  times.push_back(middle + last * Rational(random.uniform(-1, 1) * 1e-16));
  return times;
}

/// Whether there are collisions that no double can place: where the masses are far apart the last
/// one may be 1e400 s away, because the heavier block is so slow when all is over.
bool leaves_doubles(const TwoBlocks& system) {
  if (system.red.mass > system.blue.mass) {
    const Bounds bounds(system);
    return bounds.last_time() * (1 + bounds.speed()) > 1e290L;
  }
  const Rational limit = Rational(std::numeric_limits<double>::max()) / power(10, 20);
  for (const TwoBlocks& run : {system, oracle::reversed(system)}) {
    for (const oracle::ExactEvent& event : oracle::exact_run(run, 16)) {
      for (const Rational& number : {event.time, event.blue.position, event.red.position}) {
        if (abs(number) > limit) return true;
      }
    }
  }
  return false;
}

/// Calls check(log) for a system that has answers, or is rightly refused one.
template <typename Check>
void for_answers(const TwoBlocks& system, const Check& check) {
  SCOPED_TRACE(describe(system));
  const auto log = make_pair_log(system);
  EXPECT_EQ(log->last(), count_collisions(system));
  try {
    check(*log);
  } catch (const SimulationError& error) {
    EXPECT_TRUE(leaves_doubles(system)) << error.what();
  }
}

void expect_invariants(Random& random, const TwoBlocks& system, const PairLog& log) {
  const Bounds bounds(system);
  for (const Integer& index : some_indices(random, log.last())) {
    expect_consistent(system, log, index, bounds);
  }
  for (const Rational& time : some_times(random, log)) {
    const PairState state = log.blocks_at(time);
    expect_possible(system, state);
    expect_energy_kept(state, bounds);
    EXPECT_LE(state.count, log.last());
    EXPECT_TRUE(time >= 0 ? state.count >= 0 : state.count <= 0) << state.count;
  }
}

TEST(RandomSystems, KeepEveryInvariant) {
  for_each_case(5'000, 1'000'000, [](Random& random) {
    const TwoBlocks system = random_system(random);
    for_answers(system, [&](const PairLog& log) { expect_invariants(random, system, log); });
  });
}

TEST(RandomSystems, HaveTheOraclesTotals) {
  for_each_case(5'000, 2'000'000, [](Random& random) {
    const TwoBlocks system = random_system(random);
    SCOPED_TRACE(describe(system));
    const Integer total = oracle::high_precision_total(system);
    EXPECT_EQ(count_collisions(system), total);
    EXPECT_EQ(make_pair_log(system)->last(), total);
  });
}

TEST(RandomSystems, AreWhereTheOracleSays) {
  for_each_case(5'000, 3'000'000, [](Random& random) {
    const TwoBlocks system = random_system(random);
    for_answers(system, [&](const PairLog& log) {
      // One time each: the oracle is slow.
      const std::vector<Rational> times = some_times(random, log);
      const auto chosen = static_cast<std::size_t>(random.integer(0, std::ssize(times) - 1));
      expect_oracles_state(system, log, times[chosen], Bounds(system));
    });
  });
}

// Beyond the range of a double there may be no answer, but never a wrong one.
TEST(RandomSystems, OfAnySizeGiveFiniteNumbersOrSayWhyNot) {
  constexpr std::int64_t kCases = 500;
  std::int64_t answered = 0;
  for_each_case(kCases, 4'000'000, [&](Random& random) {
    const TwoBlocks system = random_system_of_any_size(random);
    SCOPED_TRACE(describe(system));
    try {
      expect_invariants(random, system, *make_pair_log(system));
      ++answered;
    } catch (const SimulationError&) {
    }
  });
  EXPECT_TRUE(repeated_case() != nullptr || answered > many(kCases) / 4) << answered;
}

// Rounding may make an engine that steps miscount, but neither hang nor pass on an infinity.
TEST(RandomSystems, AreSteppedToAnEndOrAnError) {
  constexpr std::int64_t kCases = 500;
  std::int64_t answered = 0;
  for_each_case(kCases, 6'000'000, [&](Random& random) {
    const TwoBlocks system =
        random.integer(0, 1) == 0 ? random_system(random) : random_system_of_any_size(random);
    SCOPED_TRACE(describe(system));
    if (std::max(count_collisions(system), count_collisions(oracle::reversed(system))) > 1'000) {
      return;
    }
    try {
      const auto log = make_pair_log(system, Engine::events);
      for (const Integer& index : some_indices(random, log->last())) {
        const PairCollision now = log->blocks_collision(index);
        for (const double number : {now.time.hi, now.blue.position, now.blue.velocity,
                                    now.red.position, now.red.velocity}) {
          EXPECT_TRUE(std::isfinite(number));
        }
      }
      ++answered;
    } catch (const std::runtime_error&) {  // of the engine, or of a width that no double holds
    }
  });
  EXPECT_TRUE(repeated_case() != nullptr || answered > many(kCases) / 4) << answered;
}

TEST(RandomSystems, BeyondTheClosedFormAreCountedAndRefused) {
  for_each_case(20, 5'000'000, [](Random& random) {
    TwoBlocks system = random_system(random);
    SCOPED_TRACE(describe(system));
    system.red.mass =
        system.blue.mass * power(2, static_cast<unsigned long>(random.integer(2002, 4000)));
    if (system.blue.velocity == 0 && system.red.velocity == 0) return;
    EXPECT_EQ(count_collisions(system), oracle::high_precision_total(system));
    EXPECT_THROW(make_pair_log(system), UsageError);
  });
}

}  // namespace
}  // namespace piblocks::stress
