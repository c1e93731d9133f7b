// Ctrl-C as a request to stop.
// In: SIGINT, SIGTERM, SIGHUP, unless the process was started with them ignored (nohup). Out: a
// stop token; a second signal ends the process at once. Without work to give up the first one does.
// The process ends by the signal itself: that is how a shell knows that its loop has to end, too.
#pragma once

#include <condition_variable>
#include <csignal>
#include <mutex>
#include <stop_token>
#include <thread>

#include "core/waiting_thread.hpp"

namespace piblocks::cli {

/// From now on each of the signals ends the process at once, with a message: while it waits for
/// somebody to write to a pipe that it reads, for example.
void end_at_once_on_signals();

/// Whether a signal has asked to stop.
bool stop_was_requested() noexcept;

/// Ends the process by the signal that has asked to stop. Call it when everything has been cleaned
/// up and printed.
[[noreturn]] void end_by_signal() noexcept;

/// Turns the signals into a request as long as it lives. Make one when all scenes have been read,
/// and before any other thread, so that every thread leaves the signals to it.
class StopOnSignals {
 public:
  StopOnSignals();
  ~StopOnSignals();
  StopOnSignals(const StopOnSignals&) = delete;
  StopOnSignals& operator=(const StopOnSignals&) = delete;

  std::stop_token token() const { return stop_.get_token(); }

 private:
  bool is_done();
  /// @return false if the work was done before any signal came.
  bool wait_for_signal();
  void wait_for_end();

  WaitingThread this_thread_;
  sigset_t signals_{};
  std::stop_source stop_;
  std::mutex mutex_;
  std::condition_variable done_;
  bool is_done_ = false;
  std::thread waiter_;
};

}  // namespace piblocks::cli
