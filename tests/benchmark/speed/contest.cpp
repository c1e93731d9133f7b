#include "speed/contest.hpp"

#include <piblocks/error.hpp>

#include <algorithm>
#include <functional>
#include <utility>

#include "median.hpp"

namespace piblocks::benchmark {
namespace {

struct Entrant {
  const Contender* contender;
  double output_MB = 0;
  Quality quality{};
  std::vector<Usage> runs{};
};

Usage run(const Workbench& bench, const Contender& contender) {
  bench.renew_output();
  return bench.runner.run(contender.command).usage;
}

std::vector<Entrant> warm_up(const Workbench& bench, const std::vector<Contender>& contenders) {
  std::vector<Entrant> entrants;
  for (const Contender& contender : contenders) {
    try {
      run(bench, contender);
      entrants.push_back(
          {&contender, bench.output_MB(), contender.judge ? contender.judge() : Quality{}});
    } catch (const Interrupted&) {
      throw;
    } catch (const Error& error) {
      if (entrants.empty()) throw;
      print_skipped(contender.subject.name, error.what());
    }
  }
  return entrants;
}

std::vector<double> column(const Entrant& entrant, double Usage::*field) {
  std::vector<double> values;
  for (const Usage& usage : entrant.runs) values.push_back(usage.*field);
  return values;
}

std::vector<double> seconds_per_frame(const Entrant& entrant) {
  std::vector<double> values = column(entrant, &Usage::seconds);
  for (double& value : values) value /= static_cast<double>(entrant.contender->subject.frames);
  return values;
}

Result result_of(const Entrant& entrant, const Entrant& first) {
  const std::vector<double> seconds = column(entrant, &Usage::seconds);
  const std::vector<double> divisors = seconds_per_frame(first);
  std::vector<double> ratios = seconds_per_frame(entrant);
  std::ranges::transform(ratios, divisors, ratios.begin(), std::divides<>());
  return {.runs = static_cast<int>(seconds.size()),
          .seconds = median(seconds),
          .least_seconds = std::ranges::min(seconds),
          .greatest_seconds = std::ranges::max(seconds),
          .cpu_seconds = median(column(entrant, &Usage::cpu_seconds)),
          .peak_MB = median(column(entrant, &Usage::peak_MB)),
          .output_MB = entrant.output_MB,
          .quality = entrant.quality,
          .ratio = median(ratios),
          .least_ratio = std::ranges::min(ratios),
          .greatest_ratio = std::ranges::max(ratios)};
}

}  // namespace

void hold_contest(const Workbench& bench, const std::vector<Contender>& contenders, int rounds) {
  std::vector<Entrant> entrants = warm_up(bench, contenders);
  for (int round = 0; round < rounds; ++round) {
    for (Entrant& entrant : entrants) entrant.runs.push_back(run(bench, *entrant.contender));
  }
  bench.remove_outputs();
  for (const Entrant& entrant : entrants) {
    print_row(bench.circumstances, entrant.contender->subject, result_of(entrant, entrants[0]));
  }
}

}  // namespace piblocks::benchmark
