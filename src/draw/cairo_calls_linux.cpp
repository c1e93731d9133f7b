#include <dlfcn.h>
#include <fmt/format.h>
#include <piblocks/error.hpp>

#include "draw/cairo_calls.hpp"

namespace piblocks {
namespace {

/// @throws DrawError if it is null, the answer of the dynamic linker
void* checked(void* found) {
  if (found != nullptr) return found;
  throw DrawError(fmt::format("draw: cannot load Cairo: {}; reinstall libcairo2", ::dlerror()));
}

}  // namespace

void* drawing_function(const char* name) {
  // Loaded once, and kept: its functions are called until the program ends.
  void* const library = checked(::dlopen(PIBLOCKS_CAIRO_FILE, RTLD_NOW | RTLD_LOCAL));
  return checked(::dlsym(library, name));  // in what Cairo needs, too
}

}  // namespace piblocks
