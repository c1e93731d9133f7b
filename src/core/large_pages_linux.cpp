#include <sys/mman.h>

#include <cstdint>

#include "core/large_pages.hpp"

namespace piblocks {

void prefer_large_pages(void* begin, std::size_t bytes) noexcept {
  constexpr std::size_t kPage = 4096;  // a larger one is a multiple, and the call fails: no harm
  constexpr std::size_t kLargePage = std::size_t{2} << 20;
  if (bytes < 2 * kLargePage) return;
  const std::size_t skipped = -reinterpret_cast<std::uintptr_t>(begin) % kPage;
  ::madvise(static_cast<char*>(begin) + skipped, bytes - skipped, MADV_HUGEPAGE);
}

}  // namespace piblocks
