// Whether the system has threads, and how one is started. A page has none: it starts the program
// again in each worker.
#pragma once

#include <piblocks/error.hpp>

#include <string>
#include <system_error>

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

}  // namespace piblocks
