#include "golden/rows.hpp"

#include <fmt/format.h>

#include <array>
#include <numeric>

namespace piblocks {

void Rows::take(FrameComparison row, bool has_reference, bool has_actual) {
  row.number = number_++;
  if (row.key.empty()) row.key = row.name;
  ++result_.rows.at(static_cast<std::size_t>(row.outcome));
  result_.reference_frames += has_reference ? 1 : 0;
  result_.actual_frames += has_actual ? 1 : 0;
  const bool differs = row.difference ? !row.difference->is_equal()  // also if it is accepted
                                      : row.outcome == Outcome::different;
  if (differs) ++result_.different_frames;
  if (row.difference && row.difference->masked_pixels > 0) ++result_.masked_frames;
  on_frame_(row);
}

ComparisonResult Rows::finish(const ComparisonJob& job) {
  const bool has_reference = result_.reference_frames > 0;
  const bool has_actual = result_.actual_frames > 0;
  // What cannot be read may hide all frames of the other side.
  if ((!has_reference || !has_actual) && result_.worst() != Outcome::unreadable) {
    set_problem(
        fmt::format("there is no frame in '{}'", has_reference ? job.actual : job.reference));
  }
  if (!has_reference && !has_actual) {
    FrameComparison row;
    row.name = job.actual;
    row.outcome = Outcome::missing;
    take(row, false, false);
  }
  return result_;
}

void add_unreadable(FrameComparison& row, const std::string& problem) {
  row.outcome = Outcome::unreadable;
  if (problem == row.problem) return;
  row.problem += (row.problem.empty() ? "" : "; ") + problem;
}

std::int64_t ComparisonResult::total() const {
  return std::accumulate(rows.begin(), rows.end(), std::int64_t{0});
}

Outcome ComparisonResult::worst() const {
  std::size_t outcome = kOutcomes - 1;
  while (outcome > 0 && rows.at(outcome) == 0) --outcome;
  return static_cast<Outcome>(outcome);
}

const char* name_of(Outcome outcome) {
  constexpr std::array<const char*, kOutcomes> kNames = {
      "equal", "accepted", "different", "new", "missing", "not comparable", "unreadable"};
  return kNames.at(static_cast<std::size_t>(outcome));
}

}  // namespace piblocks
