#include "cli/stop_on_signals.hpp"

#include <pthread.h>
#include <unistd.h>

namespace piblocks::cli {
namespace {

constexpr int kWake = SIGUSR1;  // from the destructor to the waiting thread
constexpr int kFailed = 1;

}  // namespace

StopOnSignals::StopOnSignals() {
  sigemptyset(&signals_);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, kWake}) sigaddset(&signals_, signal);
  pthread_sigmask(SIG_BLOCK, &signals_, nullptr);
  waiter_ = std::thread([this] { wait_for_signals(); });
}

StopOnSignals::~StopOnSignals() {
  pthread_kill(waiter_.native_handle(), kWake);
  waiter_.join();
}

void StopOnSignals::wait_for_signals() {
  int signal = 0;
  while (sigwait(&signals_, &signal) == 0 && signal != kWake) {
    if (!stop_.request_stop()) _exit(kFailed);
  }
}

}  // namespace piblocks::cli
