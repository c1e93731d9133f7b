// The rows of a comparison: they are counted here, whatever was compared.
// In: what was found about a frame. Out: the row with its number, and the counts of all.
#pragma once

#include <piblocks/compare.hpp>

#include <functional>
#include <string>
#include <utility>

namespace piblocks {

using OnFrame = std::function<void(const FrameComparison&)>;

class Rows {
 public:
  explicit Rows(OnFrame on_frame) : on_frame_(std::move(on_frame)) {}

  /// Counts the row, and hands it on. A row has a frame on the sides that it says.
  void take(FrameComparison row, bool has_reference, bool has_actual);

  /// Notes why one side has no frame, or no partner for one. The first reason stays.
  void set_problem(const std::string& problem) {
    if (result_.problem.empty()) result_.problem = problem;
  }
  /// Makes sure that a side without a frame is never taken for equality.
  ComparisonResult finish(const ComparisonJob& job);

 private:
  OnFrame on_frame_;
  ComparisonResult result_;
  std::int64_t number_ = 0;
};

/// Adds a reason why a frame cannot be read. The same reason on both sides is said once.
void add_unreadable(FrameComparison& row, const std::string& problem);

}  // namespace piblocks
