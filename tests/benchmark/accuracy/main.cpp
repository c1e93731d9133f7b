// The work-precision benchmark: run time against error, for every method that was tried.
// In: options. Out: CSV on standard output; README.md of the folder above says what it means.
#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <cstdio>
#include <cstdlib>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "accuracy/compare.hpp"
#include "accuracy/measure.hpp"
#include "accuracy/methods.hpp"
#include "circumstances.hpp"
#include "median.hpp"

namespace piblocks::benchmark {
namespace {

struct Options {
  int max_digits = 9;
  double budget_s = 6.5;
  int pairs = 0;
  std::string commit = "unknown";
};

/// Three rounds over all methods: what else the machine does in one of them slows no method alone.
constexpr int kRounds = 3;

struct Contender {
  const Method* method;
  Measurement result;
  std::vector<double> seconds;
};

std::string name(Question question) {
  switch (question) {
    case Question::whole_log:
      return "whole log";
    case Question::instants:
      return "instants";
    case Question::count:
      return "count";
  }
  return {};
}

std::string cell(const std::optional<double>& value) {
  return value ? fmt::format("{:.3g}", *value) : std::string();
}

void print_header() {
  fmt::print(
      "date,commit,cpu,compiler,question,method,scalar,parameter,digits,events,seconds,"
      "ns_per_event,worst_time_error,worst_position_error,count,count_right,note\n");
}

void print_row(const std::string& circumstances, Question question, const Label& label,
               const ReferenceRun& reference, const Measurement& measured) {
  std::optional<double> ns_per_event;
  if (measured.seconds && question != Question::instants) {
    ns_per_event = *measured.seconds * 1e9 / static_cast<double>(reference.count);
  }
  std::string count;
  std::string right;
  if (measured.count) {
    count = measured.count->get_str();
    right = *measured.count == reference.count ? "yes" : "no";
  }
  fmt::print("{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", circumstances, name(question),
             csv_text(label.method), csv_text(label.scalar), csv_text(label.parameter),
             reference.digits, reference.count, cell(measured.seconds), cell(ns_per_event),
             cell(measured.worst_time_error), cell(measured.worst_position_error), count, right,
             csv_text(measured.note));
  std::fflush(stdout);
}

/// All methods on one question. `too_slow` are not tried, and new ones are added to it.
void run_question(const std::string& circumstances, const std::vector<MethodPtr>& methods,
                  Question question, const ReferenceRun& reference, double budget_s,
                  std::set<const Method*>& too_slow) {
  std::vector<Contender> contenders;
  for (const MethodPtr& method : methods) {
    if (!method->answers(question)) continue;
    const bool slow = too_slow.contains(method.get());
    const Measurement result =
        slow ? skip(*method, question, reference) : judge(*method, question, reference, budget_s);
    if (result.out_of_budget) too_slow.insert(method.get());
    contenders.push_back({method.get(), result, {}});
  }
  for (int round = 0; round < kRounds; ++round) {
    for (Contender& contender : contenders) {
      if (!contender.result.answered) continue;
      time_round(*contender.method, question, reference, contender.seconds);
    }
  }
  for (Contender& contender : contenders) {
    contender.result.seconds = median(std::move(contender.seconds));
    print_row(circumstances, question, contender.method->label(), reference, contender.result);
  }
}

/// A method that was too slow once is not tried with more digits.
void run(const Options& options) {
  const std::string circumstances = benchmark::circumstances(options.commit);
  if (options.pairs > 0) return compare_whole_logs(circumstances, options.pairs);
  const std::vector<MethodPtr> methods = all_methods();
  std::map<Question, std::set<const Method*>> too_slow;
  print_header();
  for (int digits = 1; digits <= options.max_digits; ++digits) {
    const ReferenceRun reference = reference_run(digits);
    for (const Question question : {Question::whole_log, Question::instants, Question::count}) {
      run_question(circumstances, methods, question, reference, options.budget_s,
                   too_slow[question]);
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
