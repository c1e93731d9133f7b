#include "cli/stop_on_signals.hpp"

#include <unistd.h>

#include <atomic>
#include <chrono>
#include <string_view>

#include "cli/command.hpp"
#include "core/threads.hpp"
#include "core/waiting_thread.hpp"

namespace piblocks::cli {
namespace {

/// Interrupts a system call that waits. Its handler does nothing.
constexpr int kBreakOff = SIGURG;
constexpr std::chrono::milliseconds kBreakOffInterval{50};

// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): signals are the process's too
std::atomic<int> stop_signal = 0;  // 0 if none has come

/// Calls only async-signal-safe functions.
[[noreturn]] void end_by(int signal) noexcept {
  struct sigaction action {};
  action.sa_handler = SIG_DFL;
  ::sigaction(signal, &action, nullptr);
  sigset_t only;
  sigemptyset(&only);
  sigaddset(&only, signal);
  ::pthread_sigmask(SIG_UNBLOCK, &only, nullptr);
  ::raise(signal);
  _exit(kFailed);  // the first process of a container cannot be ended by a signal
}

void say_and_end(int signal) {
  constexpr std::string_view kMessage = "piblocks: interrupted\n";
  [[maybe_unused]] const ssize_t ignored = ::write(STDERR_FILENO, kMessage.data(), kMessage.size());
  end_by(signal);
}

void do_nothing(int /*signal*/) {}

void handle(int signal, void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;  // without SA_RESTART: a call that waits ends with EINTR
  ::sigaction(signal, &action, nullptr);
}

bool is_ignored(int signal) {
  struct sigaction action {};
  return ::sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

/// Those that ask to stop.
sigset_t stop_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    if (!is_ignored(signal)) sigaddset(&signals, signal);
  }
  return signals;
}

/// These, and the one that wakes the waiting thread when the work is done.
sigset_t with_break_off(sigset_t signals) {
  sigaddset(&signals, kBreakOff);
  return signals;
}

/// One of these signals that is pending; 0 if none is.
int pending_of(const sigset_t& signals) {
  sigset_t pending;
  sigpending(&pending);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    if (sigismember(&signals, signal) == 1 && sigismember(&pending, signal) == 1) return signal;
  }
  return 0;
}

}  // namespace

void end_at_once_on_signals() {
  const sigset_t signals = stop_signals();
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    if (sigismember(&signals, signal) == 1) handle(signal, say_and_end);
  }
}

bool stop_was_requested() noexcept { return stop_signal != 0; }

void end_by_signal() noexcept { end_by(stop_signal); }

StopOnSignals::StopOnSignals() : signals_(stop_signals()) {
  handle(kBreakOff, do_nothing);
  // The thread is born with all of them blocked: it takes them by sigwait().
  const sigset_t all = with_break_off(signals_);
  ::pthread_sigmask(SIG_BLOCK, &all, nullptr);
  waiter_ = start_thread([this] {
    return std::thread([this] {
      if (wait_for_signal()) wait_for_end();
    });
  });
  sigset_t none;
  sigemptyset(&none);
  const sigset_t break_off = with_break_off(none);
  ::pthread_sigmask(SIG_UNBLOCK, &break_off, nullptr);
}

StopOnSignals::~StopOnSignals() {
  {
    const std::lock_guard lock(mutex_);
    is_done_ = true;
  }
  done_.notify_one();
  ::pthread_kill(waiter_.native_handle(), kBreakOff);
  waiter_.join();  // the signals stay blocked: what is done is done
}

bool StopOnSignals::is_done() {
  const std::lock_guard lock(mutex_);
  return is_done_;
}

bool StopOnSignals::wait_for_signal() {
  const sigset_t awaited = with_break_off(signals_);
  int signal = kBreakOff;  // which others may send, too
  while (signal == kBreakOff) {
    if (is_done()) return false;
    if (::sigwait(&awaited, &signal) != 0) signal = kBreakOff;
  }
  stop_signal = signal;
  stop_.request_stop();
  return true;
}

/// No thread is left waiting for input: it may come to a call that waits only after it was told to
/// break off, hence again and again.
void StopOnSignals::wait_for_end() {
  std::unique_lock lock(mutex_);
  while (!is_done_) {
    if (const int signal = pending_of(signals_)) end_by(signal);
    break_off_calls(kBreakOff);
    done_.wait_for(lock, kBreakOffInterval);
  }
}

}  // namespace piblocks::cli
