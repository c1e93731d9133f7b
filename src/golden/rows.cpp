#include "golden/rows.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <array>
#include <numeric>

namespace piblocks {

void Rows::take(ComparedPair pair) {
  is_compared_ |= pair.is_compared;
  for (const std::size_t mask : pair.mask_indices) hides_[mask] = true;
  FrameComparison& row = pair.row;
  row.number = number_++;
  if (row.key.empty()) row.key = row.name;
  ++result_.rows.at(static_cast<std::size_t>(row.outcome));
  result_.reference_frames += pair.has_reference ? 1 : 0;
  result_.actual_frames += pair.has_actual ? 1 : 0;
  const bool differs = row.difference ? !row.difference->is_equal()  // also if it is accepted
                                      : row.outcome == Outcome::different;
  if (differs) ++result_.different_frames;
  if (row.difference && row.difference->masked_pixels > 0) ++result_.masked_frames;
  on_frame_(row);
}

void Rows::check_masks() const {
  if (!is_compared_) return;
  for (std::size_t i = 0; i < hides_.size(); ++i) {
    const Mask& mask = job_.masks[i];
    if (hides_[i] || !mask.must_hide) continue;
    throw UsageError(
        mask.name_pattern.empty()
            ? fmt::format("compare: the mask {} lies outside of every picture that is compared",
                          mask.text)
            : fmt::format("compare: the mask {} hides nothing: no picture that is compared has "
                          "this name, or the mask lies outside of it",
                          mask.text));
  }
}

ComparisonResult Rows::finish() {
  check_masks();
  const bool has_reference = result_.reference_frames > 0;
  const bool has_actual = result_.actual_frames > 0;
  // What cannot be read may hide all frames of the other side.
  if ((!has_reference || !has_actual) && result_.worst() != Outcome::unreadable) {
    set_problem(
        fmt::format("there is no frame in '{}'", has_reference ? job_.actual : job_.reference));
  }
  if (!has_reference && !has_actual) {
    ComparedPair nothing;
    nothing.row.name = job_.actual;
    nothing.row.outcome = Outcome::missing;
    take(std::move(nothing));
  }
  return result_;
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
