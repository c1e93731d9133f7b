#include "python/extension/without_gil.hpp"

#include <pthread.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <thread>

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

[[noreturn]] void leave_for_good() {
  --scopes;
  wait_for_exit();
}

/// A child has none of its parent's other threads.
void forget_other_threads() { scopes = 0; }

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

bool WithoutGil::is_closing() const noexcept { return must_stop(); }

void wait_for_exit() {
  while (true) ::pause();
}

void wait_for_work_at_exit() {
  ::pthread_atfork(nullptr, nullptr, forget_other_threads);
  py::module_::import("atexit").attr("register")(py::cpp_function(&wait_for_work));
}

}  // namespace piblocks::python
