// Which step of a rendering the processor's time goes to.
// In: what a thread turns to next. Out: its processor time by step.
#pragma once

#include <piblocks/render.hpp>

#include <cstddef>
#include <ctime>

namespace piblocks {

inline double processor_seconds(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

inline void add(StepSeconds& sum, const StepSeconds& spent) {
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += spent[i];
}

/// Adds what a later rendering of the process has cost.
inline void add(Profile& sum, const Profile& later) {
  add(sum.steps, later.steps);
  sum.total_s = later.total_s;
  sum.chunk_methods.insert(sum.chunk_methods.end(), later.chunk_methods.begin(),
                           later.chunk_methods.end());
}

/// Used by one thread. Switched off, it costs a comparison.
class StepClock {
 public:
  StepClock(bool is_on, Step step) : is_on_(is_on), step_(step) {
    if (is_on_) since_s_ = processor_seconds(CLOCK_THREAD_CPUTIME_ID);
  }

  /// From now on the thread works on this step.
  void enter(Step step) {
    if (is_on_) charge();
    step_ = step;
  }
  Step step() const noexcept { return step_; }
  /// What was spent up to now.
  const StepSeconds& spent() {
    if (is_on_) charge();
    return spent_;
  }

 private:
  void charge() {
    const double now_s = processor_seconds(CLOCK_THREAD_CPUTIME_ID);
    spent_[static_cast<std::size_t>(step_)] += now_s - since_s_;
    since_s_ = now_s;
  }

  bool is_on_;
  Step step_;
  double since_s_ = 0;
  StepSeconds spent_{};
};

}  // namespace piblocks
