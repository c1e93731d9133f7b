#include <piblocks/error.hpp>

#include <map>
#include <optional>

#include "median.hpp"
#include "speed/groups.hpp"
#include "speed/profile.hpp"
#include "speed/report.hpp"

namespace piblocks::benchmark {
namespace {

constexpr int kDigits = 3;
constexpr int kWrongUsage = 2;

struct Profiled {
  const char* series;
  std::string output;
};

Finished run(const Workbench& bench, const std::string& output) {
  bench.renew_output();
  Command command = bench.render(kDigits, output);
  command.emplace_back("--profile");
  return bench.runner.try_run(command);
}

std::vector<StageTime> profile_of(const Workbench& bench, const std::string& output) {
  const Finished finished = run(bench, output);
  if (finished.exit_code != 0) throw Error(last_line(finished.err));
  std::vector<StageTime> stages = parse_profile(finished.err);
  if (stages.empty()) throw Error("'--profile' printed no stages");
  return stages;
}

void measure(const Workbench& bench, const Profiled& profiled) {
  std::vector<std::string> order;
  std::map<std::string, std::vector<double>> cpu_seconds;
  for (int round = 0; round < bench.rounds; ++round) {
    for (const StageTime& time : profile_of(bench, profiled.output)) {
      if (!cpu_seconds.contains(time.stage)) order.push_back(time.stage);
      cpu_seconds[time.stage].push_back(time.cpu_seconds);
    }
  }
  const std::int64_t frames = article_frames(kDigits);
  const std::string version = bench.program_version();
  for (const std::string& stage : order) {
    print_row(bench.circumstances,
              {"stages", profiled.series, std::to_string(kDigits), stage, version, frames},
              {.runs = bench.rounds, .cpu_seconds = median(cpu_seconds[stage])});
  }
}

}  // namespace

void measure_stages(const Workbench& bench) {
  const Finished warm_up = run(bench, "null");
  if (warm_up.exit_code == kWrongUsage) {
    return print_skipped("group stages", last_line(warm_up.err));
  }
  measure(bench, {"mp4", bench.output("program.mp4")});
  measure(bench, {"png", bench.output("%06d.png")});
  measure(bench, {"null", "null"});
  bench.remove_outputs();
}

}  // namespace piblocks::benchmark
