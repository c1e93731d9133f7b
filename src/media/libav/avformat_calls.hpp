// The functions of libavformat that are called here. It is loaded when the first of them is called:
// with the 38 libraries that it brings it takes nearly as long as libavcodec, and sound in an MP4
// file or pictures of a WebP do without.
#pragma once

extern "C" {
#include <libavformat/avformat.h>
}

#include "core/found_function.hpp"

namespace piblocks {

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

}  // namespace piblocks
