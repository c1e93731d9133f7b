#include "python/extension/without_gil.hpp"

#include <cxxabi.h>
#include <pthread.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <csignal>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "core/threads.hpp"

namespace piblocks::python {
namespace {

namespace py = pybind11;

// NOLINTBEGIN(cppcoreguidelines-avoid-non-const-global-variables): there is one interpreter
std::atomic<int> scopes{0};
std::atomic<bool> is_ending{false};
pthread_t ending_thread{};
// NOLINTEND(cppcoreguidelines-avoid-non-const-global-variables)

/// For callbacks that do not end.
constexpr std::chrono::seconds kLongestWait{5};

/// The thread that ends the interpreter may go on working: other exit functions may need it.
bool must_stop() { return is_ending && ::pthread_equal(::pthread_self(), ending_thread) == 0; }

void wait_for_work() {
  ending_thread = ::pthread_self();
  is_ending = true;
  const py::gil_scoped_release released;
  const auto end = std::chrono::steady_clock::now() + kLongestWait;
  while (scopes > 0 && std::chrono::steady_clock::now() < end) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

/// Waits for the end of the process.
[[noreturn]] void wait_for_exit() {
  while (true) ::pause();
}

[[noreturn]] void leave_for_good() {
  --scopes;
  wait_for_exit();
}

/// A child has none of its parent's other threads.
void forget_other_threads() { scopes = 0; }

constexpr std::chrono::milliseconds kSignalInterval{20};
/// How long work may take to notice that it is to stop, before system calls are broken off.
constexpr std::chrono::milliseconds kPatience{100};
constexpr int kBreakOff = SIGURG;

extern "C" void do_nothing(int /*signal*/) {}

/// Ends the system call in which a thread waits: opening a pipe without a reader, for example. Does
/// nothing where the program has a use for the signal.
class BreakOff {
 public:
  BreakOff() {
    ::sigaction(kBreakOff, nullptr, &before_);
    if (before_.sa_handler != SIG_DFL && before_.sa_handler != SIG_IGN) return;
    struct sigaction action {};
    action.sa_handler = do_nothing;  // without SA_RESTART: the call ends with EINTR
    is_set_ = ::sigaction(kBreakOff, &action, nullptr) == 0;
  }
  ~BreakOff() {
    if (is_set_) ::sigaction(kBreakOff, &before_, nullptr);
  }
  BreakOff(const BreakOff&) = delete;
  BreakOff& operator=(const BreakOff&) = delete;

  void operator()(std::thread& thread) const {
    if (is_set_) ::pthread_kill(thread.native_handle(), kBreakOff);
  }

 private:
  struct sigaction before_ {};
  bool is_set_ = false;
};

/// What the worker and the waiting thread share.
class Conversation {
 public:
  /// By the thread that works.
  void call(const std::function<void()>& function) {
    std::unique_lock lock(mutex_);
    function_ = &function;
    changed_.notify_all();
    changed_.wait(lock, [&] { return function_ == nullptr; });
  }
  void end(std::exception_ptr failure) {
    const std::scoped_lock lock(mutex_);
    failure_ = std::move(failure);
    is_ended_ = true;
    changed_.notify_all();
  }

  /// By the thread that waits, without the GIL, until the work has ended.
  void listen(WithoutGil& gil, std::thread& worker, std::stop_source& stop) {
    using Clock = std::chrono::steady_clock;
    std::optional<Clock::time_point> stopped;
    std::optional<BreakOff> break_off;
    std::unique_lock lock(mutex_);
    while (true) {
      changed_.wait_for(lock, kSignalInterval, [&] { return is_ended_ || function_ != nullptr; });
      if (is_ended_) return;
      const std::function<void()>* const function = function_;
      lock.unlock();
      const bool is_to_stop = interruption_ || must_stop();
      if (!is_to_stop) attend(gil, function);
      if ((is_to_stop || interruption_) && !stopped) {
        stop.request_stop();
        stopped = Clock::now();
      } else if (stopped && Clock::now() - *stopped > kPatience) {
        if (!break_off) break_off.emplace();
        (*break_off)(worker);
      }
      lock.lock();
      if (function == nullptr) continue;
      function_ = nullptr;
      changed_.notify_all();
    }
  }

  void rethrow() const {
    if (interruption_) std::rethrow_exception(interruption_);
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  void attend(WithoutGil& gil, const std::function<void()>* function) {
    gil.take();
    try {
      if (function != nullptr) (*function)();
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    } catch (const abi::__forced_unwind&) {  // the interpreter has ended under a callback
      wait_for_exit();
    } catch (...) {
      interruption_ = std::current_exception();
    }
    gil.give();
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  const std::function<void()>* function_ = nullptr;  // to be called by the thread that waits
  bool is_ended_ = false;
  std::exception_ptr failure_;
  std::exception_ptr interruption_;
};

}  // namespace

// A scope counts from before it frees the lock until it has it again: the interpreter does not end
// in between.
WithoutGil::WithoutGil() {
  ++scopes;
  state_ = PyEval_SaveThread();
  if (must_stop()) leave_for_good();
}

WithoutGil::~WithoutGil() {
  if (must_stop()) leave_for_good();
  PyEval_RestoreThread(state_);
  --scopes;
}

void wait_for_work_at_exit() {
  ::pthread_atfork(nullptr, nullptr, forget_other_threads);
  py::module_::import("atexit").attr("register")(py::cpp_function(&wait_for_work));
}

void run_interruptibly(const InterruptibleWork& work) {
  Conversation conversation;
  {
    WithoutGil gil;
    std::stop_source stop;
    const auto converse = [&] {
      std::exception_ptr failure;
      try {
        work(stop.get_token(), [&](const auto& function) { conversation.call(function); });
      } catch (...) {
        failure = std::current_exception();
      }
      conversation.end(failure);
    };
    std::thread worker = start_thread([&] { return std::thread(converse); });
    conversation.listen(gil, worker, stop);
    worker.join();
  }
  conversation.rethrow();
}

}  // namespace piblocks::python
