// Whether the system has threads. A page has none: it starts the program again in each worker.
#pragma once

namespace piblocks {

#ifdef __EMSCRIPTEN__
inline constexpr bool kHasThreads = false;
#else
inline constexpr bool kHasThreads = true;
#endif

}  // namespace piblocks
