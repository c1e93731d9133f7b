#include "core/waiting_thread.hpp"

#include <pthread.h>

#include <algorithm>
#include <csignal>
#include <mutex>
#include <vector>

namespace piblocks {
namespace {

/// The marked threads of the process: signals are the process's, too, and POSIX has no list.
struct Marked {
  std::mutex mutex;  // no thread ends while it is sent a signal
  std::vector<pthread_t> threads;
};

Marked& marked() {
  static Marked threads;
  return threads;
}

}  // namespace

WaitingThread::WaitingThread() {
  const std::lock_guard lock(marked().mutex);
  marked().threads.push_back(::pthread_self());
}

WaitingThread::~WaitingThread() {
  const std::lock_guard lock(marked().mutex);
  auto& threads = marked().threads;
  const auto is_this = [](pthread_t thread) {
    return ::pthread_equal(thread, ::pthread_self()) != 0;
  };
  threads.erase(std::ranges::find_if(threads, is_this));
}

void break_off_calls(int signal) noexcept {
  const std::lock_guard lock(marked().mutex);
  for (const pthread_t thread : marked().threads) ::pthread_kill(thread, signal);
}

}  // namespace piblocks
