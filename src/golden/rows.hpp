// The rows of a comparison, counted in one place for pictures, videos and hashes.
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

  /// Numbers the row, counts it, and hands it on.
  /// @param has_reference, has_actual  on which sides it has a frame
  void take(FrameComparison row, bool has_reference, bool has_actual);

  /// Notes why a side has no frame, or why no picture has a partner. The first reason stays.
  void set_problem(const std::string& problem) {
    if (result_.problem.empty()) result_.problem = problem;
  }
  void set_note(const std::string& note) { result_.note = note; }
  /// The result. A comparison in which a side has no frame is never equal.
  ComparisonResult finish(const ComparisonJob& job);

 private:
  OnFrame on_frame_;
  ComparisonResult result_;
  std::int64_t number_ = 0;
};

/// Adds a reason why a frame cannot be read. The same reason on both sides is said once.
void add_unreadable(FrameComparison& row, const std::string& problem);

}  // namespace piblocks
