// Ctrl-C as a request to stop.
// In: SIGINT, SIGTERM, SIGHUP. Out: a stop token; a second signal ends the process at once.
#pragma once

#include <csignal>
#include <stop_token>
#include <thread>

namespace piblocks::cli {

/// Make one before any other thread, so that every thread leaves the signals to it.
class StopOnSignals {
 public:
  StopOnSignals();
  ~StopOnSignals();
  StopOnSignals(const StopOnSignals&) = delete;
  StopOnSignals& operator=(const StopOnSignals&) = delete;

  std::stop_token token() const { return stop_.get_token(); }

 private:
  void wait_for_signals();

  sigset_t signals_{};
  std::stop_source stop_;
  std::thread waiter_;
};

}  // namespace piblocks::cli
