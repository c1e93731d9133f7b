// Where blocks spend an interval of time: against sums over all collisions, against many instants,
// and by what must hold at any number of collisions.
#include "physics/exposure.hpp"

#include <gtest/gtest.h>
#include <piblocks/two_blocks.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "support/exposure_sums.hpp"
#include "support/traced_random.hpp"

namespace piblocks {
namespace {

constexpr std::array kBlocks = {BlockName::blue, BlockName::red};

double position_of(const PairState& state, BlockName block) {
  return block == BlockName::blue ? state.blue.position : state.red.position;
}

/// Positions all over a range and on both sides of it, denser where the blocks turn.
std::vector<double> positions_in(const Travel& range) {
  std::vector<double> positions = {range.from - 1, range.to + 1};
  if (range.to - range.from < 1e-12) return positions;  // at rest, but for a rounding
  for (int i = 0; i <= 8; ++i) {
    positions.push_back(range.from + (range.to - range.from) * (i * i / 64.0));
  }
  std::ranges::sort(positions);
  return positions;
}

/// F and G of a block at some positions, summed over every flight of an interval.
class DirectSum {
 public:
  DirectSum(BlockName block, std::vector<double> positions)
      : block_(block),
        positions_(std::move(positions)),
        time_(positions_.size()),
        area_(positions_.size()) {}

  void add(double duration, double from, double to) {
    total_ += duration;
    const double low = std::min(from, to);
    const double high = std::max(from, to);
    for (std::size_t i = 0; i < positions_.size(); ++i) {
      const double y = positions_[i];
      if (y >= high) {
        time_[i] += duration;
        area_[i] += duration * (y - (low + high) / 2);
      } else if (y > low) {
        const double part = duration * ((y - low) / (high - low));
        time_[i] += part;
        area_[i] += part * (y - low) / 2;
      }
    }
  }

  /// Where red turns it is so slow that the rounding of a position is a noticeable share of time.
  void expect_same(const PairExposure& exposure) const {
    const Travel range = exposure.range(block_);
    for (std::size_t i = 0; i < positions_.size(); ++i) {
      SCOPED_TRACE(positions_[i]);
      EXPECT_NEAR(area_below(exposure, block_, positions_[i]), double(area_[i] / total_), 1e-13);
      if (exposure.area_below) continue;  // has no shares
      const bool is_at_turn =
          block_ == BlockName::red && std::fabs(positions_[i] - range.from) < 1e-9;
      EXPECT_NEAR(share_below(exposure, block_, positions_[i]), double(time_[i] / total_),
                  is_at_turn ? 1e-6 : 1e-11);
    }
  }

 private:
  BlockName block_;
  std::vector<double> positions_;
  std::vector<long double> time_;
  std::vector<long double> area_;
  long double total_ = 0;
};

void expect_the_sum_of_all_flights(const PairLog& log, const Rational& begin, const Rational& end) {
  SCOPED_TRACE(begin.get_str() + " to " + end.get_str());
  const PairExposure exposure = log.expose(begin, end);
  DirectSum blue(BlockName::blue, positions_in(exposure.blue_range));
  DirectSum red(BlockName::red, positions_in(exposure.red_range));
  const PairState first = log.blocks_at(begin);
  const PairState last = log.blocks_at(end);
  Time now = to_time(begin);
  double blue_now = first.blue.position;
  double red_now = first.red.position;
  const auto fly_to = [&](const Time& time, double blue_then, double red_then) {
    const double duration = std::max(0.0, (time.hi - now.hi) + (time.lo - now.lo));
    blue.add(duration, blue_now, blue_then);
    red.add(duration, red_now, red_then);
    now = time;
    blue_now = blue_then;
    red_now = red_then;
  };
  const auto stream = log.stream(first.count + 1, last.count);
  const auto batch = std::make_unique<PairBatch>();
  while (stream->read(*batch)) {
    for (std::size_t i = 0; i < batch->size; ++i) {
      fly_to({batch->time_hi[i], batch->time_lo[i]}, batch->blue_position[i],
             batch->red_position[i]);
    }
  }
  fly_to(to_time(end), last.blue.position, last.red.position);
  blue.expect_same(exposure);
  red.expect_same(exposure);
}

TEST(Exposure, IsTheSumOfAllFlights) {
  const Rational turn(7, 2);
  for (int digits = 1; digits <= 6; ++digits) {
    SCOPED_TRACE(digits);
    const auto log = make_pair_log(article_blocks(digits));
    expect_the_sum_of_all_flights(*log, 0, 1);   // before the first collision
    expect_the_sum_of_all_flights(*log, 1, 2);   // the first
    expect_the_sum_of_all_flights(*log, 0, 10);  // all of them
    expect_the_sum_of_all_flights(*log, 9, 10);  // after the last
    expect_the_sum_of_all_flights(*log, Rational(17, 5), Rational(18, 5));
    expect_the_sum_of_all_flights(*log, turn - Rational(1, 100), turn);
    expect_the_sum_of_all_flights(*log, turn, turn + Rational(1, 120));
    expect_the_sum_of_all_flights(*log, turn - Rational(1, 300), turn + Rational(1, 90));
  }
}

TEST(Exposure, IsTheSumOfMillionsOfFlights) {
  const auto log = make_pair_log(article_blocks(7));
  expect_the_sum_of_all_flights(*log, Rational(699, 200), Rational(701, 200));
}

TEST(Exposure, OfEveryEngineIsTheSumOfAllFlights) {
  const auto log = make_pair_log(article_blocks(3), Engine::events);
  expect_the_sum_of_all_flights(*log, 0, 10);
  expect_the_sum_of_all_flights(*log, Rational(17, 5), Rational(18, 5));
  TwoBlocks light;
  for (const Rational& mass : {Rational(1), Rational(1, 3), Rational(1, 1000)}) {
    light.red.mass = mass;
    expect_the_sum_of_all_flights(*make_pair_log(light), 0, 100);
  }
}

/// The shares of two halves, weighted, are those of the whole.
void expect_additive(const PairLog& log, const Rational& begin, const Rational& middle,
                     const Rational& end) {
  SCOPED_TRACE(begin.get_str() + ", " + middle.get_str() + ", " + end.get_str());
  const PairExposure whole = log.expose(begin, end);
  const PairExposure early = log.expose(begin, middle);
  const PairExposure late = log.expose(middle, end);
  const double weight = to_double((middle - begin) / (end - begin));
  for (const BlockName block : kBlocks) {
    for (const double position : positions_in(whole.range(block))) {
      const auto mean = [&](double a, double b) { return weight * a + (1 - weight) * b; };
      EXPECT_NEAR(area_below(whole, block, position),
                  mean(area_below(early, block, position), area_below(late, block, position)),
                  1e-13);
      if (whole.area_below || std::fabs(position - whole.range(block).from) < 1e-9) continue;
      EXPECT_NEAR(share_below(whole, block, position),
                  mean(share_below(early, block, position), share_below(late, block, position)),
                  1e-11);
    }
  }
}

TEST(Exposure, IsAdditiveAtAnyNumberOfDigits) {
  TracedRandom random(613);
  for (const int digits : {1, 2, 3, 4, 6, 9, 14, 20, 60}) {
    SCOPED_TRACE(digits);
    const auto log = make_pair_log(article_blocks(digits));
    for (int i = 0; i < 40; ++i) {
      const Rational begin = Rational(7, 2) - random.rational(-1, 3, 100'000) / (i % 4 * 100 + 1);
      const Rational length = random.rational(0, 1, 10'000) / (i % 3 * 100 + 1) + Rational(1, 9999);
      expect_additive(*log, begin, begin + length * random.rational(0, 1, 1000), begin + length);
    }
  }
}

/// The integral is 0 up to the range, rises ever faster in it, and by 1 for each unit above it.
void expect_distribution(const PairExposure& exposure) {
  for (const BlockName block : kBlocks) {
    const Travel range = exposure.range(block);
    EXPECT_NEAR(area_below(exposure, block, std::nextafter(range.from, -1e9)), 0, 1e-15);
    EXPECT_NEAR(area_below(exposure, block, range.from), 0, 1e-15);
    EXPECT_NEAR(area_below(exposure, block, range.to + 1) - area_below(exposure, block, range.to),
                1, 1e-13);
    const std::vector<double> positions = positions_in(range);
    double slope = 0;
    for (std::size_t i = 1; i < positions.size(); ++i) {
      const double step = positions[i] - positions[i - 1];
      const double area =
          area_below(exposure, block, positions[i]) - area_below(exposure, block, positions[i - 1]);
      EXPECT_GE(area, slope * step - 2e-13);
      EXPECT_LE(area, step + 1e-13);
      slope = area / step - 2e-13 / step;
    }
  }
  double total = 0;
  for (const UniformPiece& piece : exposure.pieces) total += piece.share;
  EXPECT_NEAR(total, 1, 1e-12);
}

/// As many instants as one likes say the same, to what their number leaves open.
void expect_shares_of_instants(const PairLog& log, const Rational& begin, const Rational& end,
                               Random& random) {
  constexpr int kInstants = 4000;
  SCOPED_TRACE(begin.get_str() + " to " + end.get_str());
  const PairExposure exposure = log.expose(begin, end);
  expect_distribution(exposure);
  std::vector<PairState> states;
  for (int i = 0; i < kInstants; ++i) {
    const Rational at = (i + random.rational(0, 1, 1'000'000)) / kInstants;
    states.push_back(log.blocks_at(begin + at * (end - begin)));
  }
  for (const BlockName block : kBlocks) {
    const Travel range = exposure.range(block);
    for (const double position : positions_in(range)) {
      double below = 0;
      double area = 0;
      for (const PairState& state : states) {
        below += position_of(state, block) <= position + 1e-13 ? 1.0 / kInstants : 0;
        area += std::max(0.0, position - position_of(state, block)) / kInstants;
      }
      EXPECT_NEAR(area_below(exposure, block, position), area,
                  0.03 * (range.to - range.from) + 1e-12);
      if (exposure.area_below) continue;  // has no shares
      EXPECT_NEAR(share_below(exposure, block, position), below, 0.03);
    }
  }
}

TEST(Exposure, AgreesWithInstants) {
  TracedRandom random(1618);
  for (const int digits : {1, 3, 5, 12, 20}) {
    SCOPED_TRACE(digits);
    const auto log = make_pair_log(article_blocks(digits));
    const Rational turn(7, 2);
    expect_shares_of_instants(*log, 0, 1, random);
    expect_shares_of_instants(*log, Rational(3, 2), Rational(181, 120), random);
    expect_shares_of_instants(*log, turn - Rational(1, 120), turn, random);
    expect_shares_of_instants(*log, turn - Rational(1, 1000), turn + Rational(1, 10), random);
    expect_shares_of_instants(*log, 3, 9, random);
    expect_shares_of_instants(*log, -4, -3, random);
  }
}

TEST(Exposure, BeforeTimeZeroRunsTheMotionBack) {
  TracedRandom random(2718);
  // The turn is 3 before time 0, collisions on both sides of it.
  for (const Rational& mass : {Rational(1, 2), Rational(100), power(100, 6)}) {
    TwoBlocks late;
    late.red.mass = mass;
    late.red.velocity = 1;
    late.blue.velocity = Rational(1, 3);
    for (const Engine engine : {Engine::unfolded, Engine::events}) {
      if (engine == Engine::events && mass > 100) continue;
      const auto log = make_pair_log(late, engine);
      expect_shares_of_instants(*log, -10, 10, random);
      expect_shares_of_instants(*log, -2, -1, random);
    }
  }
}

TEST(Exposure, OfNoTimeIsTheInstant) {
  for (const int digits : {1, 3, 20}) {
    const auto log = make_pair_log(article_blocks(digits));
    for (const Rational& time : {Rational(0), Rational(3, 2), Rational(7, 2), Rational(9)}) {
      const PairExposure exposure = log->expose(time, time);
      const PairState state = log->blocks_at(time);
      ASSERT_EQ(exposure.pieces.size(), 1U);
      for (const BlockName block : kBlocks) {
        const double x = position_of(state, block);
        EXPECT_EQ(share_below(exposure, block, x), 1);
        EXPECT_EQ(share_below(exposure, block, std::nextafter(x, 0)), 0);
        EXPECT_DOUBLE_EQ(area_below(exposure, block, x + 2), 2);
      }
    }
  }
}

TEST(Exposure, DoesNotAskWhichWayTimeRuns) {
  for (const int digits : {1, 3, 9}) {
    const auto log = make_pair_log(article_blocks(digits));
    const PairExposure forth = expose(*log, 3, 4).closed->blocks;
    const PairExposure back = expose(*log, 4, 3).closed->blocks;
    for (const BlockName block : kBlocks) {
      for (const double position : positions_in(forth.range(block))) {
        EXPECT_EQ(area_below(forth, block, position), area_below(back, block, position));
      }
    }
  }
}

TEST(Exposure, OfACornerPassesIt) {
  TwoBlocks system = article_blocks(5);
  system.blue.position = Rational(1, 2);
  const auto log = make_pair_log(system);
  const Rational meeting = log->blocks_collision(1).time.hi;
  const PairExposure exposure = log->expose(meeting - 1, meeting + 1);
  EXPECT_FALSE(exposure.area_below);
  expect_distribution(exposure);
  EXPECT_NEAR(share_below(exposure, BlockName::red, 2), 0.5, 1e-9);
}

TEST(Exposure, OfManyCollisionsHasSlowBouncesBetweenTheSamePlaces) {
  const auto log = make_pair_log(article_blocks(9));
  const PairExposure exposure = log->expose(Rational(7, 2) - Rational(1, 120), Rational(7, 2));
  ASSERT_TRUE(exposure.area_below);
  for (const BlockName block : kBlocks) {
    const Travel range = exposure.range(block);
    for (const double position : positions_in(range)) {
      EXPECT_NEAR(area_of_pieces(exposure, block, position), area_below(exposure, block, position),
                  0.005 * (range.to - range.from));
    }
  }
}

}  // namespace
}  // namespace piblocks
