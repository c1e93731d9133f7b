// The chunks of an H.264 video, coded from what changes in them.
// In: frames, and which rectangles of them have changed. Out: packets of one stream, made by
// src/h264 or, if too much changes, by libavcodec's encoder.
#pragma once

#include <piblocks/encode.hpp>

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "h264/encoder.hpp"
#include "media/output/output.hpp"

namespace piblocks {

/// Our own encoder, as the command line calls it.
inline constexpr std::string_view kBuiltin = "builtin";

/// Whether our own encoder makes the pictures: if nothing else is asked for.
bool is_builtin(const EncoderSettings& settings);

/// Why H.264 cannot hold pictures of this size and rate; empty if it can.
std::string h264_level_problem(const VideoFormat& format);

/// Which players may not show pictures of this size and rate; nothing if none is known.
/// @pre h264_level_problem() is empty
std::vector<std::string> h264_notes(const VideoFormat& format);

/// A stream of our own encoder.
struct H264Stream {
  /// @throws UsageError if H.264 cannot hold the format, or a setting is given that the encoder has
  ///         no use for
  H264Stream(const VideoFormat& video_format, const EncoderSettings& settings);

  VideoFormat format;
  h264::Config config;
  int level_idc;
  Bytes headers;  ///< parameter sets, with start codes
  int frames_per_chunk;
  /// Whether libavcodec's encoder may take the rest of a chunk in which much changes.
  bool may_hand_over;

  /// What the parts of one file have to agree in, in one line.
  std::string signature() const;
};

/// Makes the encoder that may take the rest of a chunk; null if there is none whose slices fit the
/// headers of the stream. Thread-safe.
using MakeSuccessor =
    std::function<std::unique_ptr<ChunkEncoder>(const VideoFormat&, const h264::Config&)>;

/// The encoder of one worker. @param make_successor  is called when it is first needed
std::unique_ptr<ChunkEncoder> h264_chunk_encoder(const H264Stream& stream,
                                                 const MakeSuccessor& make_successor);

}  // namespace piblocks
