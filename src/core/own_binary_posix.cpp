#include <dlfcn.h>

#include <string_view>
#include <system_error>

#include "core/own_binary.hpp"

namespace piblocks {
namespace fs = std::filesystem;

/// Some systems return the name that the program was started by. It may be relative to the working
/// folder. A name without a slash was found along PATH; the folder is unknown then.
fs::path own_binary() {
  Dl_info info{};
  const void* here = reinterpret_cast<const void*>(&own_binary);
  const bool is_known = ::dladdr(here, &info) != 0 && info.dli_fname != nullptr;
  const std::string_view name = is_known ? info.dli_fname : "";
  if (name.find('/') == std::string_view::npos) return {};
  std::error_code error;
  const fs::path path = fs::canonical(name, error);
  return error ? fs::path() : path;
}

}  // namespace piblocks
