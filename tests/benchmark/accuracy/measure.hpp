// How long a method takes for a question, and how wrong it is.
// In: a method, a question, the right answers, a budget. Out: one row of the results.
#pragma once

#include <optional>
#include <string>

#include "accuracy/method.hpp"
#include "accuracy/reference.hpp"

namespace piblocks::benchmark {

struct Measurement {
  std::optional<double> seconds;           ///< median of the runs, set-up included
  std::optional<double> worst_time_error;  ///< relative
  std::optional<double> worst_position_error;
  std::optional<Integer> count;
  std::string note;
  bool out_of_budget = false;
};

/// At least three runs, and more until 0.2 s are spent; the budget is for each run.
Measurement measure(const Method& method, Question question, const ReferenceRun& reference,
                    double budget_s);

/// The row of a method that was too slow for fewer digits: not timed, errors where it has random
/// access.
Measurement skip(const Method& method, Question question, const ReferenceRun& reference);

}  // namespace piblocks::benchmark
