#include "bodies/contest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <random>

#include "accuracy/deadline.hpp"
#include "median.hpp"

namespace piblocks::benchmark {
namespace {

constexpr int kRounds = 3;
constexpr double kRound_s = 0.07;

void time_round(Contestant& contestant) {
  double spent_s = 0;
  do {
    const double start_s = thread_seconds();
    contestant.run();
    contestant.seconds.push_back(thread_seconds() - start_s);
    spent_s += contestant.seconds.back();
  } while (spent_s < kRound_s);
}

}  // namespace

void time_all(std::vector<Contestant>& contestants) {
  for (int round = 0; round < kRounds; ++round) {
    for (Contestant& contestant : contestants) time_round(contestant);
  }
}

std::string time_text(const Contestant& contestant) {
  const double seconds = median(contestant.seconds).value_or(0);
  if (seconds >= 1) return fmt::format("{:.3g} s", seconds);
  if (seconds >= 1e-3) return fmt::format("{:.3g} ms", seconds * 1e3);
  return fmt::format("{:.3g} µs", seconds * 1e6);
}

std::string error_text(const std::optional<double>& error) {
  if (!error) return "–";
  if (*error < 1e-110) return "0";
  std::string text = fmt::format("{:.0e}", *error);
  const std::size_t sign = text.find("e-0");
  if (sign != std::string::npos) text.erase(sign + 2, 1);
  return text;
}

std::vector<double> random_instants(double end, int number) {
  std::mt19937_64 engine(1);
  std::vector<double> instants;
  for (int i = 0; i + 1 < number; ++i) {
    instants.push_back(end * (static_cast<double>(engine() >> 11) * 0x1p-53));
  }
  std::ranges::sort(instants);
  instants.push_back(end);
  return instants;
}

}  // namespace piblocks::benchmark
