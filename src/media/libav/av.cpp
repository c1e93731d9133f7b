#include "media/libav/av.hpp"

#include <fmt/format.h>
#include <gif_lib.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <array>
#include <cerrno>
#include <new>

#include "media/libav/av_module.hpp"

extern "C" {
#include <libavutil/log.h>
}

namespace piblocks {
namespace {

bool is_io_failure(int code) {
  constexpr std::array kErrors = {EACCES, EDQUOT, EFBIG, EIO, ENOENT, ENOSPC, EPIPE, EROFS};
  return std::ranges::any_of(kErrors, [&](int error) { return code == AVERROR(error); });
}

/// libavformat asks this before it repeats a call that a signal interrupted.
int is_stop_requested(void* stop) {
  return static_cast<const std::stop_token*>(stop)->stop_requested() ? 1 : 0;
}

}  // namespace

void* avformat_function(const char* name) {
  if (void* const found = find_in_library(PIBLOCKS_AVFORMAT_FILE, name)) return found;
  throw MediaError(fmt::format("video: cannot load libavformat: {}; reinstall it", ::dlerror()));
}

AvInputPtr open_av_input(const std::string& path, const std::stop_token* stop) {
  AVFormatContext* allocated = avformat_alloc_context();
  if (allocated == nullptr) throw std::bad_alloc();
  if (stop != nullptr) {
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-const-cast): libav hands it back as it is
    allocated->interrupt_callback = {is_stop_requested, const_cast<std::stop_token*>(stop)};
  }
  // "file:" keeps libav from reading a protocol out of a path with a colon.
  const std::string url = "file:" + path;
  // Otherwise libav takes a picture with a percent sign in its name for a sequence.
  AVDictionary* options = nullptr;
  check_av(av_dict_set(&options, "pattern_type", "none", 0), "read", path);
  const int code = avformat_open_input(&allocated, url.c_str(), nullptr, &options);
  av_dict_free(&options);  // only the picture demuxer takes the option
  check_av_read(code, "read", path);
  AvInputPtr input(allocated);
  // The overwrite check does not know the files in such a list.
  constexpr std::array<std::string_view, 5> kLists = {"concat", "dash", "hls", "imf", "sdp"};
  if (std::ranges::count(kLists, input->iformat->name) > 0) {
    throw MediaError(fmt::format(
        "video: cannot read '{}': it is a list of other files; name one of these", path));
  }
  return input;
}

int check_av(int code, std::string_view operation, std::string_view object) {
  if (code == AVERROR(ENOMEM)) throw std::bad_alloc();
  return check_av_read(code, operation, object);
}

int check_av_read(int code, std::string_view operation, std::string_view object) {
  if (code >= 0) return code;
  std::array<char, AV_ERROR_MAX_STRING_SIZE> text{};
  av_strerror(code, text.data(), text.size());
  const std::string message =
      fmt::format("video: cannot {} '{}': {}", operation, object, text.data());
  if (is_io_failure(code)) throw IoError(message);
  throw MediaError(message);
}

void silence_av() { av_log_set_level(AV_LOG_QUIET); }

std::string version_text(unsigned number) {
  return fmt::format("{}.{}.{}", AV_VERSION_MAJOR(number), AV_VERSION_MINOR(number),
                     AV_VERSION_MICRO(number));
}

std::vector<std::string> av_library_versions() {
  return {"libavformat " + version_text(avformat_version()),
          "libavcodec " + version_text(avcodec_version()),
          "libavutil " + version_text(avutil_version()),
          fmt::format("giflib {}.{}.{}", GIFLIB_MAJOR, GIFLIB_MINOR, GIFLIB_RELEASE)};
}

}  // namespace piblocks
