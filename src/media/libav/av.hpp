// libav's objects with C++ owners, and its error codes as exceptions; libavformat's functions,
// which are loaded late; what differs between the versions. In: what libav's functions return. Out:
// typed owners, or an exception. Only this folder includes libav. Pass AVFrame& and the like
// onward, never the owners.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <stop_token>
#include <string>
#include <string_view>
#include <utility>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/hash.h>
}

#include "core/found_function.hpp"

namespace piblocks {

// The functions of libavformat that are called here. It is loaded when the first of them is called:
// with the 38 libraries that it brings it takes nearly as long as libavcodec, and sound in an MP4
// file or pictures of a WebP do without.

/// The address of one of these functions. Thread-safe. @throws MediaError if it cannot be loaded
void* avformat_function(const char* name);

// NOLINTBEGIN(cppcoreguidelines-macro-usage): only a macro makes declarations of a list of names
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wignored-attributes"  // warn_unused_result is no part of a type
// In this namespace the name of a function means an object, which has the function's type.
#define PIBLOCKS_FOUND(name) \
  inline constinit const FoundFunction<avformat_function, decltype(::name)> name(#name);
PIBLOCKS_FOUND(av_find_best_stream)
PIBLOCKS_FOUND(av_guess_sample_aspect_ratio)
PIBLOCKS_FOUND(av_read_frame)
PIBLOCKS_FOUND(av_write_frame)
PIBLOCKS_FOUND(av_write_trailer)
PIBLOCKS_FOUND(avformat_alloc_context)
PIBLOCKS_FOUND(avformat_alloc_output_context2)
PIBLOCKS_FOUND(avformat_close_input)
PIBLOCKS_FOUND(avformat_find_stream_info)
PIBLOCKS_FOUND(avformat_free_context)
PIBLOCKS_FOUND(avformat_index_get_entries_count)
PIBLOCKS_FOUND(avformat_index_get_entry)
PIBLOCKS_FOUND(avformat_new_stream)
PIBLOCKS_FOUND(avformat_open_input)
PIBLOCKS_FOUND(avformat_version)
PIBLOCKS_FOUND(avformat_write_header)
PIBLOCKS_FOUND(avio_closep)
PIBLOCKS_FOUND(avio_flush)
PIBLOCKS_FOUND(avio_open)
PIBLOCKS_FOUND(avio_rb32)
PIBLOCKS_FOUND(avio_rb64)
PIBLOCKS_FOUND(avio_read)
PIBLOCKS_FOUND(avio_rl32)
PIBLOCKS_FOUND(avio_seek)
PIBLOCKS_FOUND(avio_size)
#undef PIBLOCKS_FOUND
#pragma GCC diagnostic pop
// NOLINTEND(cppcoreguidelines-macro-usage)

/// In place of libavformat's inline function, which would link avio_seek().
// NOLINTNEXTLINE(readability-identifier-naming): the name of the function
inline constinit const auto avio_tell = [](AVIOContext* file) {
  return avio_seek(file, 0, SEEK_CUR);
};

/// Frees through one of libav's functions that take the address of a pointer.
template <auto Free>
struct AvDeleter {
  template <typename T>
  void operator()(T* object) const noexcept {
    Free(&object);
  }
};

struct AvInputDeleter {
  void operator()(AVFormatContext* input) const { avformat_close_input(&input); }
};

/// Closes the file of a muxer, if it is still open, and frees the muxer.
struct AvOutputDeleter {
  void operator()(AVFormatContext* muxer) const {
    avio_closep(&muxer->pb);
    avformat_free_context(muxer);
  }
};

using AvInputPtr = std::unique_ptr<AVFormatContext, AvInputDeleter>;
using AvFramePtr = std::unique_ptr<AVFrame, AvDeleter<av_frame_free>>;
using AvPacketPtr = std::unique_ptr<AVPacket, AvDeleter<av_packet_free>>;
using AvCodecContextPtr = std::unique_ptr<AVCodecContext, AvDeleter<avcodec_free_context>>;
using AvParametersPtr = std::unique_ptr<AVCodecParameters, AvDeleter<avcodec_parameters_free>>;
using AvHashPtr = std::unique_ptr<AVHashContext, AvDeleter<av_hash_freep>>;
using AvOutputPtr = std::unique_ptr<AVFormatContext, AvOutputDeleter>;

/// Opens a media file for reading. @param stop  breaks off calls that wait; has to live as long.
/// @throws IoError, MediaError if it cannot be read.
AvInputPtr open_av_input(const std::string& path, const std::stop_token* stop = nullptr);

/// An opened file. Reading it fails soon after a stop has been requested.
struct VideoInput {
  VideoInput(const std::string& path, std::stop_token token)
      : stop(std::move(token)), file(open_av_input(path, &stop)) {}
  ~VideoInput() = default;
  VideoInput(const VideoInput&) = delete;
  VideoInput& operator=(const VideoInput&) = delete;

  std::stop_token stop;  // libavformat has its address
  AvInputPtr file;
};

/// Returns the result of a call into libav, or throws if it is an error.
/// @param operation  such as "open encoder", of the object.
/// @throws IoError for errors of the system (disk full, pipe closed), std::bad_alloc if memory ran
///         out, MediaError for others.
int check_av(int code, std::string_view operation, std::string_view object);

/// The same for reading, where running out of memory is the fault of a file that asks for too much.
/// @throws IoError, MediaError
int check_av_read(int code, std::string_view operation, std::string_view object);

/// Owns what an allocating call returned. @throws std::bad_alloc if it is null.
template <typename Owner>
Owner own_av(typename Owner::pointer object, std::string_view name) {
  if (object == nullptr) check_av(AVERROR(ENOMEM), "allocate", name);
  return Owner(object);
}

/// Keeps libav from printing; its error codes carry the cause. Affects the whole process.
void silence_av();

/// "59.37.100" for the result of avcodec_version() and the like.
std::string version_text(unsigned number);

// What differs between the versions of libav that the program is built with, FFmpeg 5.1 to 7.1, in
// av_versions.cpp: what an object holds, in whichever field this version keeps it.

/// Those that an encoder takes; empty if it does not say.
std::span<const AVPixelFormat> pixel_formats_of(const AVCodec& encoder) noexcept;

/// The matrix of 9 numbers that a file asks players to turn its pictures by; null if it has none.
const std::uint8_t* display_matrix_of(const AVStream& stream) noexcept;

}  // namespace piblocks
