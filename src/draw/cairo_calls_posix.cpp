#include <map>
#include <string_view>

#include "draw/cairo_calls.hpp"

namespace piblocks {

void* drawing_function(const char* name) {
// NOLINTNEXTLINE(cppcoreguidelines-macro-usage): only a macro makes entries of a list of names
#define PIBLOCKS_LINKED(name) {#name, reinterpret_cast<void*>(&::name)},
  static const std::map<std::string_view, void*> linked = {
      PIBLOCKS_DRAWING_FUNCTIONS(PIBLOCKS_LINKED)};
#undef PIBLOCKS_LINKED
  return linked.at(name);
}

}  // namespace piblocks
