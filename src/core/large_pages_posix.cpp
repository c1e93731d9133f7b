#include "core/large_pages.hpp"

namespace piblocks {

void prefer_large_pages(void* /*begin*/, std::size_t /*bytes*/) noexcept {}

}  // namespace piblocks
