#include "accuracy/measure.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <limits>

namespace piblocks::benchmark {
namespace {

constexpr double kRound_s = 0.07;

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

void judge_whole_log(const Method& method, const ReferenceRun& reference, double budget_s,
                     Measurement& result) {
  const WholeLog log = method.whole_log(reference.system, reference.indices, Deadline(budget_s));
  result.count = Integer(log.count);
  compare_events(log.kept, reference, result);
}

void judge_instants(const Method& method, const ReferenceRun& reference, double budget_s,
                    Measurement& result) {
  double worst = 0;
  std::visit(
      [&](const auto& blue) {
        for (std::size_t i = 0; i < blue.size(); ++i) {
          raise(worst, Reference(blue[i]) - reference.blue[i]);
        }
      },
      method.blue_at(reference.system, reference.instants, Deadline(budget_s)));
  result.worst_position_error = worst;
}

/// The answer is thrown away.
void ask(const Method& method, Question question, const ReferenceRun& reference) {
  const Deadline none(std::numeric_limits<double>::infinity());
  switch (question) {
    case Question::whole_log:
      method.whole_log(reference.system, {}, none);
      break;
    case Question::instants:
      method.blue_at(reference.system, reference.instants, none);
      break;
    case Question::count:
      (void)method.count(reference.system, none);
      break;
  }
}

}  // namespace

Measurement judge(const Method& method, Question question, const ReferenceRun& reference,
                  double budget_s) {
  Measurement result;
  try {
    switch (question) {
      case Question::whole_log:
        judge_whole_log(method, reference, budget_s, result);
        break;
      case Question::instants:
        judge_instants(method, reference, budget_s, result);
        break;
      case Question::count:
        result.count = method.count(reference.system, Deadline(budget_s));
        break;
    }
    result.answered = true;
  } catch (const OutOfBudget&) {
    return skip(method, question, reference);
  } catch (const std::runtime_error& failure) {  // of the method, or of the engine it tries
    result.note = failure.what();
  }
  return result;
}

void time_round(const Method& method, Question question, const ReferenceRun& reference,
                std::vector<double>& seconds) {
  double spent_s = 0;
  do {
    const double start_s = thread_seconds();
    ask(method, question, reference);
    seconds.push_back(thread_seconds() - start_s);
    spent_s += seconds.back();
  } while (spent_s < kRound_s);
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
