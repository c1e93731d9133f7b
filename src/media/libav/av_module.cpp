#include "media/libav/av_module.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/version.hpp>

#include <filesystem>
#include <string_view>

#include "core/own_binary.hpp"
#include "media/png/png_reader.hpp"

namespace piblocks {
namespace {

constexpr const char* kFile = "libpiblocks_av.so";

/// Where the module may be, best first.
std::vector<std::filesystem::path> candidates() {
  const std::filesystem::path folder = PIBLOCKS_MODULE_FOLDER;
  auto files =
      places_of_installed(PIBLOCKS_PREFIX, folder / kFile, std::filesystem::path("lib") / kFile);
  // By the search path of the binary: a library user's, the Python package's, or a test's.
  files.insert(files.begin(), kFile);
  return files;
}

/// The module in this file; null, and one more reason, if it cannot be used.
const AvModule* load(const std::string& file, std::string& reasons) {
  std::unique_ptr<void, int (*)(void*)> library(::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL),
                                                ::dlclose);
  void* const entry = library ? ::dlsym(library.get(), kAvModuleEntry) : nullptr;
  if (entry == nullptr) {
    reasons += fmt::format("; {}", ::dlerror());
    return nullptr;
  }
  const AvModule* const module = reinterpret_cast<const AvModule* (*)()>(entry)();
  if (std::string_view(module->version) != kVersion) {
    reasons += fmt::format("; {} is of version {}, not {}", file, module->version, kVersion);
    return nullptr;
  }
  static_cast<void>(library.release());  // its code is called until the program ends
  return module;
}

const AvModule& load() {
  std::string reasons;
  for (const std::filesystem::path& file : candidates()) {
    if (const AvModule* const module = load(file, reasons)) return *module;
  }
  throw MediaError("output: cannot load the encoders; reinstall piblocks:" + reasons);
}

}  // namespace

const AvModule& av_module() {
  static const AvModule& module = load();
  return module;
}

std::unique_ptr<FrameReader> read_video(const std::string& path, const std::stop_token& stop) {
  // libavformat takes an animated PNG that is cut off for a shorter one.
  if (is_png_file(path) && is_animated_png(path)) return read_apng(path);
  return av_module().read_video(path, stop);
}

std::string hash_of_bytes(ByteSpan bytes) { return av_module().hash_of_bytes(bytes); }

std::vector<std::string> encoder_names(EncoderKind kind) { return av_module().encoder_names(kind); }

}  // namespace piblocks
