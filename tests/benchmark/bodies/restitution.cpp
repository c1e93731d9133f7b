#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/two_blocks.hpp>

#include <algorithm>
#include <memory>

#include "bodies/contest.hpp"
#include "bodies/tables.hpp"
#include "support/inelastic_run.hpp"

namespace piblocks::benchmark {
namespace {

TwoBlocks inelastic_article(int digits) {
  TwoBlocks system = article_blocks(digits);
  system.blocks_restitution = Rational(999'999, 1'000'000);
  system.wall_restitution = system.blocks_restitution;
  return system;
}

/// The times of all collisions, by a loop over the two gaps.
template <typename Number>
std::vector<Number> inelastic_loop_times(const TwoBlocks& system) {
  const auto number = [](const Rational& value) { return to_number<Number>(value); };
  const Number e = number(system.blocks_restitution);
  const Number e_wall = number(system.wall_restitution);
  const Rational total = system.blue.mass + system.red.mass;
  const Number blue_share = number(system.red.mass / total);
  const Number red_share = number(system.blue.mass / total);
  Number to_wall = number(system.blue_gap());
  Number to_red = number(system.blocks_gap());
  Number blue = number(system.blue.velocity);
  Number red = number(system.red.velocity);
  Number time(0);
  std::vector<Number> times;
  // One pair approaches at a time, as long as red comes to a resting blue.
  while (true) {
    if (blue > red) {
      const Number wait = to_red / (blue - red);
      time += wait;
      to_wall += blue * wait;
      to_red = Number(0);
      const Number change = (1 + e) * (blue - red);
      blue -= blue_share * change;
      red += red_share * change;
    } else if (blue < 0) {
      const Number wait = to_wall / -blue;
      time += wait;
      to_red += (red - blue) * wait;
      to_wall = Number(0);
      blue *= -e_wall;
    } else {
      return times;
    }
    times.push_back(time);
  }
}

std::vector<Time> inelastic_log_times(const TwoBlocks& system) {
  const std::unique_ptr<PairLog> log = make_pair_log(system);
  const std::unique_ptr<PairStream> stream = log->stream(1, log->last());
  const auto batch = std::make_unique<PairBatch>();
  std::vector<Time> times;
  while (stream->read(*batch)) {
    for (std::size_t row = 0; row < batch->size; ++row) {
      times.push_back({batch->time_hi[row], batch->time_lo[row]});
    }
  }
  return times;
}

double relative_error(const Wide& time, const Wide& right) {
  return static_cast<double>(Wide(abs(time - right) / right));
}

/// In 400 bits. The first ones have to be those of a program in rational numbers, whose numbers
/// soon are too long.
Answers right_inelastic_times(const TwoBlocks& system) {
  Answers right = inelastic_loop_times<Wide>(system);
  constexpr std::size_t kExact = 100;
  const auto exact = oracle::inelastic_run(system, kExact).events;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    if (i < right.size() && relative_error(right[i], to_wide(exact[i].time)) < 1e-100) continue;
    throw SimulationError(
        fmt::format("restitution: collision {} in 400 bits is not that in rational numbers: either "
                    "program is wrong",
                    i + 1));
  }
  return right;
}

/// Nothing if the count is wrong.
std::optional<double> worst_time_error(const Answers& times, const Answers& right) {
  if (times.size() != right.size()) return std::nullopt;
  double worst = 0;
  for (std::size_t i = 0; i < right.size(); ++i) {
    worst = std::max(worst, relative_error(times[i], right[i]));
  }
  return worst;
}

std::vector<Contestant> restitution_contestants(const TwoBlocks& system) {
  std::vector<Contestant> all = {contestant("piblocks::PairLog", "MPFR, rounded to two doubles",
                                            [=] { return inelastic_log_times(system); })};
  const auto add = [&]<typename Number>(Number) {
    all.push_back(contestant("gap loop", kNumberName<Number>,
                             [=] { return inelastic_loop_times<Number>(system); }));
  };
  add(0.0);
  add(0.0L);
  add(Decimal50(0));
  return all;
}

}  // namespace

void print_restitution_table() {
  fmt::print("| Digits | Collisions | Method | Number type | time | time error |\n");
  fmt::print("|---:|---:|---|---|---:|---:|\n");
  for (int digits = 2; digits <= 6; ++digits) {
    const TwoBlocks system = inelastic_article(digits);
    const Answers right = right_inelastic_times(system);
    std::vector<Contestant> contestants = restitution_contestants(system);
    time_all(contestants);
    for (const Contestant& contestant : contestants) {
      fmt::print("| {} | {} | {} | {} | {} | {} |\n", digits, readable(Integer(right.size())),
                 contestant.method, contestant.number, time_text(contestant),
                 error_text(worst_time_error(contestant.reply(), right)));
    }
  }
  fmt::print("\n");
}

}  // namespace piblocks::benchmark
