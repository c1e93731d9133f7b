#include <dlfcn.h>
#include <link.h>

#include <string_view>
#include <system_error>

#include "core/own_binary.hpp"

namespace piblocks {

std::filesystem::path own_binary() {
  Dl_info info{};
  void* extra = nullptr;
  const void* here = reinterpret_cast<const void*>(&own_binary);
  const bool is_known = ::dladdr1(here, &info, &extra, RTLD_DL_LINKMAP) != 0;
  const std::string_view name = is_known ? static_cast<const link_map*>(extra)->l_name : "";
  if (!name.empty()) return name;
  // The main program has no name there.
  std::error_code unreadable;
  return std::filesystem::read_symlink("/proc/self/exe", unreadable);
}

}  // namespace piblocks
