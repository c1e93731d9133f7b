#include <algorithm>
#include <thread>

#include "core/processors.hpp"

namespace piblocks {

int processor_count() {
  return static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

}  // namespace piblocks
