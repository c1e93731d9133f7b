#include <fmt/format.h>
#include <piblocks/error.hpp>

#include "draw/cairo_calls.hpp"

namespace piblocks {

void* drawing_function(const char* name) {
  if (void* const found = find_in_library(PIBLOCKS_CAIRO_FILE, name)) return found;
  throw DrawError(fmt::format("draw: cannot load Cairo: {}; reinstall libcairo2", ::dlerror()));
}

}  // namespace piblocks
