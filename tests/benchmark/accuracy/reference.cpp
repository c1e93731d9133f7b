#include "accuracy/reference.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <set>

#include "accuracy/closed_form.hpp"
#include "support/oracle.hpp"

namespace piblocks::benchmark {
namespace {

constexpr int kMaxDigitsWithEveryEvent = 5;
constexpr std::int64_t kEvenlySpaced = 20'000;
constexpr std::int64_t kNeighbours = 5'000;  // on each side of the turn, and at both ends
constexpr std::size_t kCheckedEvents = 20;

std::vector<std::int64_t> selected_indices(int digits, std::int64_t count) {
  std::set<std::int64_t> indices;
  const auto add_range = [&](std::int64_t first, std::int64_t last) {
    const std::int64_t end = std::min(last, count);
    for (std::int64_t k = std::max<std::int64_t>(first, 1); k <= end; ++k) indices.insert(k);
  };
  if (digits <= kMaxDigitsWithEveryEvent) {
    add_range(1, count);
  } else {
    for (std::int64_t i = 1; i <= kEvenlySpaced; ++i) indices.insert(count / kEvenlySpaced * i);
    add_range(1, kNeighbours);
    add_range(count / 2 - kNeighbours, count / 2 + kNeighbours);
    add_range(count - kNeighbours, count);
  }
  return {indices.begin(), indices.end()};
}

Rational to_rational(const Reference& value) {
  Rational result;
  mpfr_get_q(result.get_mpq_t(), value.backend().data());
  return result;
}

/// Just before the event it has not been counted, just after it it has, and the blocks are in
/// their places, but for what they move in that little time at a speed of 10^8 at most.
void check_with_oracle(const TwoBlocks& system, const LoggedEvent& event) {
  const Rational time = to_rational(event.time);
  const Rational little = power(Rational(1, 10), 60);
  const oracle::ExactState before = oracle::high_precision_state(system, time - little);
  const oracle::ExactState after = oracle::high_precision_state(system, time + little);
  const Rational off = abs(after.blue.position - to_rational(event.blue)) +
                       abs(after.red.position - to_rational(event.red));
  if (before.count == event.index - 1 && after.count == event.index && off < 1'000'000'000 * little)
    return;
  throw SimulationError(
      fmt::format("reference: event {} is not where the oracle has it", event.index));
}

}  // namespace

ReferenceRun reference_run(int digits) {
  ReferenceRun run;
  run.digits = digits;
  run.system = article_blocks(digits);
  run.count = oracle::high_precision_total(run.system).get_si();
  run.indices = selected_indices(digits, run.count);
  const OneSided<Reference> formula(run.system);
  for (const std::int64_t k : run.indices) {
    const auto event = formula.event(k);
    run.events.push_back({k, event.time, event.blue, event.red});
  }
  const std::size_t stride = std::max<std::size_t>(1, run.events.size() / kCheckedEvents);
  for (std::size_t i = 0; i < run.events.size(); i += stride) {
    check_with_oracle(run.system, run.events[i]);
  }
  run.instants = random_instants();
  for (const Rational& time : run.instants.exact) {
    const oracle::ExactState state = oracle::high_precision_state(run.system, time);
    run.blue.push_back(to_reference(state.blue.position));
  }
  return run;
}

}  // namespace piblocks::benchmark
