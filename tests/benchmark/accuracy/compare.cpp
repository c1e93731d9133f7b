#include "accuracy/compare.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <limits>
#include <vector>

#include "accuracy/article_loop.hpp"
#include "accuracy/gap_loop.hpp"
#include "accuracy/methods.hpp"
#include "accuracy/velocity_loop.hpp"

namespace piblocks::benchmark {
namespace {

struct Timed {
  std::int64_t events;
  double seconds;
};

Timed timed_log(const Method& method, const BlockSystem& system) {
  const Deadline none(std::numeric_limits<double>::infinity());
  const double start_s = thread_seconds();
  const std::int64_t events = method.whole_log(system, {}, none).count;
  return {events, thread_seconds() - start_s};
}

void compare(const Circumstances& circumstances, int digits, int pairs, const Method& loop) {
  const BlockSystem system = article_system(digits);
  const MethodPtr program = product();
  std::int64_t events = 0;
  std::vector<double> program_s;
  std::vector<double> loop_s;
  std::vector<double> ratios;
  for (int i = 0; i < pairs; ++i) {
    const Timed one = timed_log(*program, system);
    const Timed other = timed_log(loop, system);
    events = one.events;
    program_s.push_back(one.seconds);
    loop_s.push_back(other.seconds);
    ratios.push_back(other.seconds / one.seconds);
  }
  const auto [least, greatest] = std::ranges::minmax(ratios);
  fmt::print("{},{},{},{},{},{},{:.3g},{:.3g},{:.3g},{:.3g},{:.3g}\n", circumstances.fields(),
             digits, events, loop.label().method, loop.label().scalar, pairs, *median(program_s),
             *median(loop_s), *median(loop_s) / *median(program_s), least, greatest);
  std::fflush(stdout);
}

}  // namespace

void compare_whole_logs(const Circumstances& circumstances, int pairs) {
  fmt::print(
      "date,commit,cpu,compiler,digits,events,loop,scalar,pairs,program_seconds,loop_seconds,ratio,"
      "least_ratio,greatest_ratio\n");
  std::vector<MethodPtr> loops;
  loops.push_back(event_loop<ArticleLoop<double>>("article's loop"));
  loops.push_back(event_loop<GapLoop<double>>("gap loop"));
  loops.push_back(event_loop<VelocityStepper<double>>("velocity-only loop"));
  for (const int digits : {6, 7}) {
    for (const MethodPtr& loop : loops) compare(circumstances, digits, pairs, *loop);
  }
}

}  // namespace piblocks::benchmark
