// Ctrl-C as a request to stop.
// In: SIGINT, SIGTERM, SIGHUP, unless the process was started with them ignored (nohup). Out: a
// stop token; a second signal ends the process at once. Without work to give up the first one does.
#pragma once

#include <pthread.h>

#include <csignal>
#include <stop_token>
#include <thread>

#include "core/descriptor.hpp"

namespace piblocks::cli {

/// From now on each of the signals ends the process at once, with a message and exit code 1: while
/// it waits for somebody to write to a pipe that it reads, for example.
void end_at_once_on_signals();

/// Whether a signal has asked to stop.
bool stop_was_requested() noexcept;

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
  void wait_for_signals();

  sigset_t signals_{};
  Descriptor pending_;  // readable when one of the signals has come
  Descriptor end_;      // readable when the work is done
  std::stop_source stop_;
  std::thread waiter_;
};

}  // namespace piblocks::cli
