// Every collision of the program's logs, against the closed form in fifty digits.
#include <gtest/gtest.h>
#include <piblocks/two_blocks.hpp>

#include <algorithm>
#include <memory>
#include <string>

#include "accuracy/closed_form.hpp"

namespace piblocks::benchmark {
namespace {

struct Worst {
  double rounded_time = 0;  ///< relative to the time itself
  double time = 0;
  double position = 0;
};

double size(const Decimal50& error) { return static_cast<double>(Decimal50(abs(error))); }

/// The row is collision k.
void compare(const PairBatch& batch, std::size_t row, std::int64_t k,
             const OneSided<Decimal50>& formula, Worst& worst) {
  const auto right = formula.event(k);
  const Decimal50 rounded = batch.time_hi[row];
  const Decimal50 time = rounded + batch.time_lo[row];
  worst.rounded_time = std::max(worst.rounded_time, size((rounded - right.time) / right.time));
  worst.time = std::max(worst.time, size((time - right.time) / right.time));
  worst.position = std::max({worst.position, size(batch.blue_position[row] - right.blue),
                             size(batch.red_position[row] - right.red)});
}

class WholeLogOfDigits : public testing::TestWithParam<int> {};

TEST_P(WholeLogOfDigits, HasEveryTimeToFourTimesTenToTheMinusSixteenOfItself) {
  const TwoBlocks system = article_blocks(GetParam());
  const auto log = make_pair_log(system);
  const auto stream = log->stream(1, log->last());
  const auto batch = std::make_unique<PairBatch>();
  const OneSided<Decimal50> formula(system);
  Worst worst;
  std::int64_t events = 0;
  while (stream->read(*batch)) {
    for (std::size_t row = 0; row < batch->size; ++row) {
      compare(*batch, row, ++events, formula, worst);
    }
  }
  EXPECT_EQ(events, formula.count());
  EXPECT_LE(worst.rounded_time, 4e-16);
  EXPECT_LE(worst.time, 4e-16);
  EXPECT_LE(worst.position, 4e-15);
  RecordProperty("worst_rounded_time_error", std::to_string(worst.rounded_time * 1e16) + "e-16");
  RecordProperty("worst_time_error", std::to_string(worst.time * 1e16) + "e-16");
  RecordProperty("worst_position_error", std::to_string(worst.position * 1e16) + "e-16");
}

INSTANTIATE_TEST_SUITE_P(Article, WholeLogOfDigits, testing::Range(2, 7));

}  // namespace
}  // namespace piblocks::benchmark
