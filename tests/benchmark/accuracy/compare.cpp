#include "accuracy/compare.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "accuracy/article_loop.hpp"
#include "accuracy/gap_loop.hpp"
#include "accuracy/methods.hpp"
#include "accuracy/velocity_loop.hpp"
#include "median.hpp"

namespace piblocks::benchmark {
namespace {

struct Timed {
  std::int64_t events;
  double seconds;
};

Timed timed_log(const Method& method, const TwoBlocks& system) {
  const Deadline none(std::numeric_limits<double>::infinity());
  const double start_s = thread_seconds();
  const std::int64_t events = method.whole_log(system, {}, none).count;
  return {events, thread_seconds() - start_s};
}

/// The program and a loop on one system.
struct Match {
  int digits;
  MethodPtr loop;
  std::int64_t events = 0;
  std::vector<double> program_s{};
  std::vector<double> loop_s{};
  std::vector<double> ratios{};
};

void run_pair(const Method& program, Match& match) {
  const TwoBlocks system = article_blocks(match.digits);
  const Timed one = timed_log(program, system);
  const Timed other = timed_log(*match.loop, system);
  match.events = one.events;
  match.program_s.push_back(one.seconds);
  match.loop_s.push_back(other.seconds);
  match.ratios.push_back(other.seconds / one.seconds);
}

void print_match(const std::string& circumstances, const Match& match) {
  const auto [least, greatest] = std::ranges::minmax(match.ratios);
  const double program_s = *median(match.program_s);
  const double loop_s = *median(match.loop_s);
  const Label& label = match.loop->label();
  fmt::print("{},{},{},{},{},{},{:.3g},{:.3g},{:.3g},{:.3g},{:.3g}\n", circumstances, match.digits,
             match.events, label.method, label.scalar, match.ratios.size(), program_s, loop_s,
             loop_s / program_s, least, greatest);
}

}  // namespace

void compare_whole_logs(const std::string& circumstances, int pairs) {
  fmt::print(
      "date,commit,cpu,compiler,digits,events,loop,scalar,pairs,program_seconds,loop_seconds,ratio,"
      "least_ratio,greatest_ratio\n");
  std::vector<Match> matches;
  for (const int digits : {6, 7}) {
    matches.push_back({digits, event_loop<ArticleLoop<double>>("article's loop")});
    matches.push_back({digits, event_loop<GapLoop<double>>("gap loop")});
    matches.push_back({digits, event_loop<VelocityLoop<double>>("velocity-only loop")});
  }
  const MethodPtr program = product();
  for (int i = 0; i < pairs; ++i) {
    for (Match& match : matches) run_pair(*program, match);
  }
  for (const Match& match : matches) print_match(circumstances, match);
}

}  // namespace piblocks::benchmark
