// Nothing hangs: long computations ask now and then whether their time is up.
// In: a budget of processor time. Out: an exception once it is spent.
#pragma once

#include <ctime>
#include <stdexcept>

namespace piblocks::benchmark {

/// Why a method did not give an answer.
class NotRun : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The time was up.
class OutOfBudget : public NotRun {
 public:
  OutOfBudget() : NotRun("not run: budget") {}
};

/// Time that this thread has computed for; other programs do not count.
inline double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

class Deadline {
 public:
  explicit Deadline(double budget_s) : end_s_(thread_seconds() + budget_s) {}

  /// Costs some 0.3 us. @throws OutOfBudget
  void check() const {
    if (thread_seconds() > end_s_) throw OutOfBudget();
  }

 private:
  double end_s_;
};

}  // namespace piblocks::benchmark
