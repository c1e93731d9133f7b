#include <dlfcn.h>
#include <fmt/format.h>
#include <piblocks/error.hpp>

#include "draw/cairo_calls.hpp"

namespace piblocks {
namespace {

DrawError cannot_load() {
  return DrawError(fmt::format("draw: cannot load Cairo: {}; reinstall libcairo2", ::dlerror()));
}

void* load_cairo() {
  void* const library = ::dlopen(PIBLOCKS_CAIRO_FILE, RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) throw cannot_load();
  return library;  // and stays: its functions are called until the program ends
}

}  // namespace

void* drawing_function(const char* name) {
  static void* const library = load_cairo();
  void* const found = ::dlsym(library, name);  // in what Cairo needs, too
  if (found == nullptr) throw cannot_load();
  return found;
}

}  // namespace piblocks
