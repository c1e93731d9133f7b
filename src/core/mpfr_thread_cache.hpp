// Frees the memory that MPFR keeps for each thread when the thread ends.
// In: a call before MPFR is used. Out: no leak from threads that come and go.
#pragma once

#include <mpfr.h>

namespace piblocks {

/// MPFR keeps constants and spare numbers in thread-local memory that it never frees by itself
/// (MPFR 4.2 manual, "Memory handling"). Cheap to call again.
inline void free_mpfr_cache_with_thread() {
  struct Cache {
    Cache() = default;
    ~Cache() { mpfr_free_cache2(MPFR_FREE_LOCAL_CACHE); }
    Cache(const Cache&) = delete;
    Cache& operator=(const Cache&) = delete;
  };
  static thread_local const Cache cache;
  static_cast<void>(cache);
}

}  // namespace piblocks
