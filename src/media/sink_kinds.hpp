// The kinds of output there are, one function each; open_sink.cpp holds the table of them.
// In: a request whose output name the kind matches. Out: the open sink.
#pragma once

#include <memory>

#include "media/sink_request.hpp"

namespace piblocks {

/// H.264 (or another encoder's video) in MP4: BT.709 in limited range, converted and tagged.
/// @throws UsageError if the size is odd, a setting or the encoder is no good, or the file cannot
///         be opened.
std::unique_ptr<FrameSink> open_mp4(const SinkRequest& request);

/// One PNG file a frame, numbered from 1. The files take their names together, in finish().
/// @throws UsageError if the pattern is no good or the folder cannot be written.
std::unique_ptr<FrameSink> open_png_sequence(const SinkRequest& request);

/// Uncompressed 4:2:0 video for other programs (YUV4MPEG2): BT.709 in limited range.
/// @throws UsageError if a side is odd or the file cannot be opened.
std::unique_ptr<FrameSink> open_y4m(const SinkRequest& request);

/// A line of text a frame with the hash of its RGB bytes, exactly as FFmpeg's framehash muxer
/// writes it for rawvideo rgb24 without its #software line.
/// @throws UsageError if the file cannot be opened.
std::unique_ptr<FrameSink> open_framehash(const SinkRequest& request);

/// Takes frames and keeps nothing: what rendering costs without any output.
std::unique_ptr<FrameSink> open_null(const SinkRequest& request);

}  // namespace piblocks
