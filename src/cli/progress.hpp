// How far a rendering has come, and what it cost.
// In: frame counts as they grow; a profile. Out: on standard error a bar on a terminal, plain lines
// otherwise, nothing when quiet; a table of steps.
#pragma once

#include <piblocks/render.hpp>

#include <chrono>
#include <string>
#include <string_view>

namespace piblocks::cli {

/// What is counted, and after how long the bar appears: at once, or only if it takes a while.
struct CountedWork {
  std::string_view unit = "frames";
  std::chrono::milliseconds delay{0};
};

class ProgressReport {
 public:
  ProgressReport(std::string output, bool quiet, const CountedWork& work = {});
  ~ProgressReport();
  ProgressReport(const ProgressReport&) = delete;
  ProgressReport& operator=(const ProgressReport&) = delete;

  void update(const Progress& progress);
  /// Prints what has been written. @param aftermath  as Rendered::aftermath
  void finish(const std::string& aftermath);
  /// Whether somebody sees the bar.
  bool is_seen() const { return on_terminal_ && !quiet_; }

 private:
  using Clock = std::chrono::steady_clock;

  double elapsed_s() const;
  void draw_bar() const;
  void print_line() const;

  const std::string output_;
  const bool quiet_;
  const CountedWork work_;
  const bool on_terminal_;
  const Clock::time_point start_ = Clock::now();
  Clock::time_point last_shown_ = start_;
  Progress progress_;
  bool bar_visible_ = false;
};

/// The aftermath as the end of a closing line; empty if there is none.
inline std::string after_semicolon(const std::string& aftermath) {
  return aftermath.empty() ? aftermath : "; " + aftermath;
}

void print_profile(const Rendered& rendered);

}  // namespace piblocks::cli
