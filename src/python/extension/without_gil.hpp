// Work without Python's global lock, which the interpreter waits for when it ends.
// In: a scope, entered with the lock; or long work, which looks at a stop token and calls Python
// now and then. Out: the lock is free as long as the scope lasts; the work has run, or what it
// threw, or what Python threw meanwhile: KeyboardInterrupt, or the exception of a callback.
//
// An interpreter that ends kills each thread that asks for the lock, by unwinding its stack. C++
// code does not survive that. So the interpreter waits at exit until all scopes are left. A thread
// that enters or leaves a scope later waits for the end of the process.
#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <stop_token>

namespace piblocks::python {

class WithoutGil {
 public:
  WithoutGil();
  ~WithoutGil();
  WithoutGil(const WithoutGil&) = delete;
  WithoutGil& operator=(const WithoutGil&) = delete;

  /// Takes the lock for a while, and gives it back.
  void take() { PyEval_RestoreThread(state_); }
  void give() { state_ = PyEval_SaveThread(); }

 private:
  PyThreadState* state_ = nullptr;
};

/// What make() returns, which is called without the lock.
template <typename Make>
auto without_gil(const Make& make) {
  const WithoutGil released;
  return make();
}

/// Lets the interpreter wait before it ends. Once, when the module is loaded.
void wait_for_work_at_exit();

/// Runs a function in the thread that waits, with the GIL, and returns when it has ended. After an
/// exception it runs no more.
using CallBack = std::function<void(const std::function<void()>& function)>;

using InterruptibleWork = std::function<void(const std::stop_token& stop, const CallBack& call)>;

/// Calls `work` in a thread of its own, without the GIL. The caller, which has the GIL, gives it up
/// while it waits, and takes it for signals and callbacks.
/// @throws what the work or a callback throws; of both, the callback's
void run_interruptibly(const InterruptibleWork& work);

}  // namespace piblocks::python
