// The speed benchmark: the whole program against what else a lecturer would use.
// In: options. Out: CSV on standard output; README.md of this folder says what it means.
#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <array>
#include <cstdlib>
#include <utility>

#include "speed/groups.hpp"
#include "speed/report.hpp"

namespace piblocks::benchmark {
namespace {

struct Options {
  std::string program = "build/release/piblocks";
  std::string commit = "unknown";
  std::string only;
  int rounds = 3;
};

using Measure = void (*)(const Workbench&);
constexpr std::array<std::pair<const char*, Measure>, 6> kGroups = {
    {{"job", measure_job},
     {"encoders", measure_encoders},
     {"png", measure_png},
     {"stages", measure_stages},
     {"scaling", measure_scaling},
     {"features", measure_features}}};

void run(const Options& options) {
  const Workbench bench{.circumstances = {.commit = options.commit},
                        .program = options.program,
                        .rounds = options.rounds};
  print_header();
  for (const auto& [name, measure] : kGroups) {
    if (options.only.empty() || options.only == name) measure(bench);
  }
}

}  // namespace
}  // namespace piblocks::benchmark

int main(int argc, char** argv) {
  piblocks::benchmark::Options options;
  CLI::App app("Measures the whole program against others and prints CSV.");
  app.add_option("--program", options.program, "The program to measure")->capture_default_str();
  app.add_option("--commit", options.commit, "Name of the version, for the table");
  app.add_option("--rounds", options.rounds, "Rounds over all programs, after one to warm up")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--only", options.only,
                 "Measure one group: job, encoders, png, stages, scaling or features")
      ->check(CLI::IsMember({"job", "encoders", "png", "stages", "scaling", "features"}));
  CLI11_PARSE(app, argc, argv);
  try {
    piblocks::benchmark::run(options);
  } catch (const std::exception& error) {
    fmt::print(stderr, "speed_benchmark: {}\n", error.what());
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
