// Memory that is written once, from its beginning to its end.
// In: a piece of memory that nothing has touched yet. Out: a hint to the system.
#pragma once

#include <cstddef>

namespace piblocks {

/// Asks for pages of 2 MiB where there is room for them, so that the system is called once a page
/// and not 512 times: a tenth of the time in which two pictures are read and compared.
void prefer_large_pages(void* begin, std::size_t bytes) noexcept;

}  // namespace piblocks
