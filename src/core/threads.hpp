// Whether the system has threads, and how one is started. A page has none: it starts the program
// again in each worker.
#pragma once

#include <piblocks/error.hpp>

#include <future>
#include <string>
#include <system_error>
#include <utility>

namespace piblocks {

#ifdef __EMSCRIPTEN__
inline constexpr bool kHasThreads = false;
#else
inline constexpr bool kHasThreads = true;
#endif

/// Calls `start`, which starts a thread, and returns that thread.
/// @throws IoError if the system has no thread left.
template <typename Start>
auto start_thread(const Start& start) {
  try {
    return start();
  } catch (const std::system_error& error) {
    throw IoError("threads: cannot start a thread: " + error.code().message() +
                  "; end other programs, or raise the limits of memory and processes (ulimit)");
  }
}

/// work(a) and work(b). @param in_threads  whether at once, if the system has another thread
template <typename Item, typename Work>
auto on_two_threads(bool in_threads, Item& a, Item& b, const Work& work) {
  std::future<decltype(work(a))> first;
  try {
    if (in_threads) first = std::async(std::launch::async, [&] { return work(a); });
  } catch (const std::system_error&) {
    // One after the other does the same.
  }
  auto second = work(b);
  auto one = first.valid() ? first.get() : work(a);
  return std::pair(std::move(one), std::move(second));
}

}  // namespace piblocks
