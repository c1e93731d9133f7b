// Long work that Ctrl-C stops, and that calls Python now and then.
// In: a function that looks at a stop token. Out: it has run; or what it threw, or what Python
// threw meanwhile: KeyboardInterrupt, or the exception of a callback.
#pragma once

#include <functional>
#include <stop_token>

namespace piblocks::python {

/// Runs a function in the thread that waits, with the GIL, and returns when it has ended. After an
/// exception it runs no more.
using CallBack = std::function<void(const std::function<void()>& function)>;

using InterruptibleWork = std::function<void(const std::stop_token& stop, const CallBack& call)>;

/// Calls `work` in a thread of its own, without the GIL. The caller, which has the GIL, gives it up
/// while it waits, and takes it for signals and callbacks.
/// @throws what the work or a callback throws; of both, the callback's
void run_interruptibly(const InterruptibleWork& work);

}  // namespace piblocks::python
