#include "accuracy/measure.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <functional>

namespace piblocks::benchmark {
namespace {

constexpr std::size_t kMinRuns = 3;
constexpr double kMinSpent_s = 0.2;
constexpr std::size_t kMaxRuns = 10'000;

double median_seconds(const std::function<void()>& run) {
  std::vector<double> seconds;
  for (double spent_s = 0;
       seconds.size() < kMinRuns || (spent_s < kMinSpent_s && seconds.size() < kMaxRuns);) {
    const double start_s = thread_seconds();
    run();
    seconds.push_back(thread_seconds() - start_s);
    spent_s += seconds.back();
  }
  const auto middle = seconds.begin() + std::ssize(seconds) / 2;
  std::ranges::nth_element(seconds, middle);
  return *middle;
}

/// Keeps NaN, which std::max would drop.
void raise(double& worst, const Reference& error) {
  const auto size = static_cast<double>(Reference(abs(error)));
  if (!(size <= worst)) worst = size;
}

void compare_events(const std::vector<LoggedEvent>& events, const ReferenceRun& reference,
                    Measurement& result) {
  double time_error = 0;
  double position_error = 0;
  for (std::size_t i = 0; i < events.size(); ++i) {
    const LoggedEvent& right = reference.events[i];
    raise(time_error, (events[i].time - right.time) / right.time);
    raise(position_error, events[i].blue - right.blue);
    raise(position_error, events[i].red - right.red);
  }
  if (!events.empty()) {
    result.worst_time_error = time_error;
    result.worst_position_error = position_error;
  }
  if (!reference.has_every_event()) {
    result.note = fmt::format("errors of {} selected events", events.size());
  }
  if (events.size() < reference.events.size()) result.note = "errors of the events it has";
}

void measure_whole_log(const Method& method, const ReferenceRun& reference, double budget_s,
                       Measurement& result) {
  const WholeLog log = method.whole_log(reference.system, reference.indices, Deadline(budget_s));
  result.count = Integer(log.count);
  compare_events(log.kept, reference, result);
  result.seconds =
      median_seconds([&] { method.whole_log(reference.system, {}, Deadline(budget_s)); });
}

void measure_instants(const Method& method, const ReferenceRun& reference, double budget_s,
                      Measurement& result) {
  const auto run = [&] {
    return method.blue_at(reference.system, reference.instants, Deadline(budget_s));
  };
  double worst = 0;
  std::visit(
      [&](const auto& blue) {
        for (std::size_t i = 0; i < blue.size(); ++i) {
          raise(worst, Reference(blue[i]) - reference.blue[i]);
        }
      },
      run());
  result.worst_position_error = worst;
  result.seconds = median_seconds([&] { run(); });
}

void measure_count(const Method& method, const ReferenceRun& reference, double budget_s,
                   Measurement& result) {
  result.count = method.count(reference.system, Deadline(budget_s));
  result.seconds =
      median_seconds([&] { (void)method.count(reference.system, Deadline(budget_s)); });
}

}  // namespace

Measurement measure(const Method& method, Question question, const ReferenceRun& reference,
                    double budget_s) {
  Measurement result;
  try {
    switch (question) {
      case Question::whole_log:
        measure_whole_log(method, reference, budget_s, result);
        break;
      case Question::instants:
        measure_instants(method, reference, budget_s, result);
        break;
      case Question::count:
        measure_count(method, reference, budget_s, result);
        break;
    }
  } catch (const OutOfBudget&) {
    return skip(method, question, reference);
  } catch (const std::runtime_error& failure) {  // of the method, or of the engine it tries
    result.note = failure.what();
  }
  return result;
}

Measurement skip(const Method& method, Question question, const ReferenceRun& reference) {
  Measurement result;
  result.out_of_budget = true;
  result.note = OutOfBudget().what();
  if (question != Question::whole_log) return result;
  try {
    compare_events(method.single_events(reference.system, reference.indices), reference, result);
    result.note = fmt::format("{}; errors of {} single events", OutOfBudget().what(),
                              reference.events.size());
  } catch (const NotRun&) {  // then there are no errors to show
  }
  return result;
}

}  // namespace piblocks::benchmark
