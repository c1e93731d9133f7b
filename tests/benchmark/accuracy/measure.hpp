// How long a method takes for a question, and how wrong it is.
// In: a method, a question, the right answers, a budget. Out: one row of the results.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "accuracy/method.hpp"
#include "accuracy/reference.hpp"

namespace piblocks::benchmark {

struct Measurement {
  std::optional<double> seconds;           ///< median of the runs, set-up included
  std::optional<double> worst_time_error;  ///< relative
  std::optional<double> worst_position_error;
  std::optional<Integer> count;
  std::string note;
  bool answered = false;
  bool out_of_budget = false;
};

/// The method's errors and count, not timed yet. Where they take more than the budget, skip().
Measurement judge(const Method& method, Question question, const ReferenceRun& reference,
                  double budget_s);

/// How long each of the next runs takes: at least one, and more until 0.07 s are spent.
void time_round(const Method& method, Question question, const ReferenceRun& reference,
                std::vector<double>& seconds);

/// The row of a method that was too slow for fewer digits: not timed, errors where it has random
/// access.
Measurement skip(const Method& method, Question question, const ReferenceRun& reference);

}  // namespace piblocks::benchmark
