#include "media/av_module.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <piblocks/error.hpp>

namespace piblocks {
namespace {

constexpr const char* kFile = "libpiblocks_av.so";

const AvModule& load() {
  // Found where the program's own search path says: beside the build, or in its library folder.
  void* const module = ::dlopen(kFile, RTLD_NOW | RTLD_LOCAL);
  void* const entry = module == nullptr ? nullptr : ::dlsym(module, kAvModuleEntry);
  if (entry == nullptr) {
    throw MediaError(fmt::format("output: cannot load the encoders: {}; is piblocks whole?",
                                 ::dlerror()));  // NOLINT(concurrency-mt-unsafe): once
  }
  return *reinterpret_cast<const AvModule* (*)()>(entry)();
}

}  // namespace

const AvModule& av_module() {
  static const AvModule& module = load();
  return module;
}

std::unique_ptr<FrameReader> read_video(const std::string& path) {
  return av_module().decode_video_file(path);
}

std::vector<std::string> h264_encoders() { return av_module().usable_h264_encoders(); }

}  // namespace piblocks
