// The work-precision benchmark: run time against error, for every method that was tried.
// In: options. Out: CSV on standard output; README.md of the folder above says what it means.
#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <cstdlib>
#include <map>
#include <utility>

#include "accuracy/compare.hpp"
#include "accuracy/methods.hpp"
#include "accuracy/report.hpp"

namespace piblocks::benchmark {
namespace {

struct Options {
  int max_digits = 9;
  double budget_s = 7;
  int pairs = 0;
  std::string commit = "unknown";
};

/// A method that was too slow once is not tried with more digits.
void run(const Options& options) {
  const Circumstances circumstances{.commit = options.commit};
  if (options.pairs > 0) return compare_whole_logs(circumstances, options.pairs);
  const std::vector<MethodPtr> methods = all_methods();
  std::map<std::pair<const Method*, Question>, bool> too_slow;
  print_header();
  for (int digits = 1; digits <= options.max_digits; ++digits) {
    const ReferenceRun reference = reference_run(digits);
    for (const Question question : {Question::whole_log, Question::instants, Question::count}) {
      for (const MethodPtr& method : methods) {
        if (!method->answers(question)) continue;
        bool& slow = too_slow[{method.get(), question}];
        const Measurement measured = slow ? skip(*method, question, reference)
                                          : measure(*method, question, reference, options.budget_s);
        slow = measured.out_of_budget;
        print_row(circumstances, question, method->label(), reference, measured);
      }
    }
  }
}

}  // namespace
}  // namespace piblocks::benchmark

int main(int argc, char** argv) {
  piblocks::benchmark::Options options;
  CLI::App app("Measures run time against error and prints CSV.");
  app.add_option("--max-digits", options.max_digits, "Largest number of digits of pi")
      ->check(CLI::Range(1, 9))
      ->capture_default_str();
  app.add_option("--budget", options.budget_s, "Processor time for one run, in seconds")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--compare", options.pairs,
                 "Compare the program's whole logs with those of loops, in N runs in turn")
      ->type_name("N")
      ->check(CLI::PositiveNumber);
  app.add_option("--commit", options.commit, "Name of the version, for the table");
  CLI11_PARSE(app, argc, argv);
  try {
    piblocks::benchmark::run(options);
  } catch (const piblocks::Error& error) {
    fmt::print(stderr, "accuracy_benchmark: {}\n", error.what());
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
