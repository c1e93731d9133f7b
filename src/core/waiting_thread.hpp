// Threads that may wait in a system call for somebody else, such as for the writer of a pipe.
// In: a mark on the stack of the thread. Out: a signal to all that are marked, which ends their
// calls with EINTR.
#pragma once

namespace piblocks {

/// Marks the thread that makes it as long as it lives. Costs a lock.
class WaitingThread {
 public:
  WaitingThread();
  ~WaitingThread();
  WaitingThread(const WaitingThread&) = delete;
  WaitingThread& operator=(const WaitingThread&) = delete;
};

/// Sends a signal to each marked thread. Needs a handler without SA_RESTART. Thread-safe.
void break_off_calls(int signal) noexcept;

}  // namespace piblocks
