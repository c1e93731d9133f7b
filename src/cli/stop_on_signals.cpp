#include "cli/stop_on_signals.hpp"

#include <poll.h>
#include <sys/eventfd.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <string_view>
#include <system_error>

#include "cli/command.hpp"

namespace piblocks::cli {
namespace {

/// Interrupts a system call that waits. Its handler does nothing.
constexpr int kBreakOff = SIGURG;
constexpr int kBreakOffInterval_ms = 50;
constexpr int kForEver = -1;

// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): signals are the process's too
std::atomic<bool> is_stop_requested = false;

void say_and_exit(int /*signal*/) {
  constexpr std::string_view kMessage = "piblocks: interrupted\n";
  [[maybe_unused]] const ssize_t ignored = ::write(STDERR_FILENO, kMessage.data(), kMessage.size());
  _exit(kFailed);
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

Descriptor opened(int descriptor, const char* what) {
  if (descriptor < 0) throw std::system_error(errno, std::generic_category(), what);
  return Descriptor(descriptor);
}

/// In all threads but this one.
void break_off_calls() {
  const pid_t process = ::getpid();
  const pid_t self = ::gettid();
  std::error_code ended;  // a thread may end at any time
  for (const std::filesystem::path& task : entries_of("/proc/self/task", ended)) {
    const int thread = std::atoi(task.filename().c_str());
    if (thread != self) ::tgkill(process, thread, kBreakOff);
  }
}

}  // namespace

void end_at_once_on_signals() {
  const sigset_t signals = stop_signals();
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    if (sigismember(&signals, signal) == 1) handle(signal, say_and_exit);
  }
}

bool stop_was_requested() noexcept { return is_stop_requested; }

StopOnSignals::StopOnSignals()
    : signals_(stop_signals()),
      pending_(opened(::signalfd(-1, &signals_, SFD_CLOEXEC), "signals: cannot wait for them")),
      end_(opened(::eventfd(0, EFD_CLOEXEC), "signals: cannot wait for the end")) {
  handle(kBreakOff, do_nothing);
  ::pthread_sigmask(SIG_BLOCK, &signals_, nullptr);
  waiter_ = std::thread([this] { wait_for_signals(); });
}

StopOnSignals::~StopOnSignals() {
  while (::eventfd_write(end_.get(), 1) != 0 && errno == EINTR) continue;
  waiter_.join();  // the signals stay blocked: what is done is done
}

/// Once a stop is requested, no thread is left waiting for input: it may come to a call that waits
/// only after it was told to break off, hence again and again.
void StopOnSignals::wait_for_signals() {
  std::array<pollfd, 2> events{{{pending_.get(), POLLIN, 0}, {end_.get(), POLLIN, 0}}};
  while (true) {
    const int timeout_ms = stop_.stop_requested() ? kBreakOffInterval_ms : kForEver;
    const int count = ::poll(events.data(), events.size(), timeout_ms);
    if (count > 0 && events[1].revents != 0) return;
    signalfd_siginfo signal{};
    if (count > 0 && events[0].revents != 0 &&
        ::read(pending_.get(), &signal, sizeof signal) == sizeof signal) {
      is_stop_requested = true;
      if (!stop_.request_stop()) _exit(kFailed);
    }
    if (stop_.stop_requested()) break_off_calls();
  }
}

}  // namespace piblocks::cli
