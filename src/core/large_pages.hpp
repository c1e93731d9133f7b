// Memory that is written once, from its beginning to its end.
// In: a piece of memory that nothing has touched yet. Out: a hint to the system.
#pragma once

#include <cstddef>

namespace piblocks {

/// Asks for pages of 2 MiB where there is room for them. The first write then enters the system
/// once for 2 MiB and not 512 times, which saves a tenth of the time of a comparison.
void prefer_large_pages(void* begin, std::size_t bytes) noexcept;

}  // namespace piblocks
