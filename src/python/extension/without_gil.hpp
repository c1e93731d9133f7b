// Work without Python's global lock, which the interpreter waits for when it ends.
// In: a scope, entered with the lock. Out: the lock is free as long as the scope lasts.
//
// An interpreter that ends kills each thread that asks for the lock, by unwinding its stack. C++
// code does not survive that. So the interpreter waits at exit until all scopes are left. A thread
// that enters or leaves a scope later waits for the end of the process.
#pragma once

#include <pybind11/pybind11.h>

namespace piblocks::python {

class WithoutGil {
 public:
  WithoutGil();
  ~WithoutGil();
  WithoutGil(const WithoutGil&) = delete;
  WithoutGil& operator=(const WithoutGil&) = delete;

  /// Whether the work is to end, because the interpreter does.
  bool is_closing() const noexcept;
  /// Takes the lock for a while, and gives it back.
  void take() { PyEval_RestoreThread(state_); }
  void give() { state_ = PyEval_SaveThread(); }

 private:
  PyThreadState* state_ = nullptr;
};

/// Waits for the end of the process.
[[noreturn]] void wait_for_exit();

/// Lets the interpreter wait before it ends. Once, when the module is loaded.
void wait_for_work_at_exit();

}  // namespace piblocks::python
