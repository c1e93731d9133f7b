// Files of a video stream, and one of sound if asked for, written by libavformat.
// In: chunks of packets, in order. Out: a file whose index comes first, or no trace of it.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "media/libav/sound_stream.hpp"
#include "media/libav/video_encoder.hpp"
#include "media/output/output.hpp"

namespace piblocks {

/// A kind of file that libavformat writes.
struct Container {
  const char* muxer = nullptr;         ///< libavformat's name
  const char* index_option = nullptr;  ///< the muxer's option that moves the index to the front
  const char* index_value = nullptr;
  /// The muxer's option for the units of the movie's time; null if it has no such time.
  const char* time_scale_option = nullptr;
  /// Whether a file that is read back has so many packets of each stream.
  bool (*is_whole)(AVFormatContext& file, std::span<const std::int64_t> packets) = nullptr;
  SoundCodec sound = {};
  /// Whether sound is counted from its first packet. In other containers that packet is before 0,
  /// and libavformat moves all streams if the file cannot have negative times.
  bool sound_from_zero = false;
};

extern const Container kMp4;

/// @param pictures  must outlive the sink.
/// @param sound     its encoder, or null; must outlive the sink.
/// @throws UsageError if the file cannot be opened.
std::unique_ptr<FrameSink> open_video_file(const std::string& name, const Container& container,
                                           const VideoStream& pictures, const SoundEncoder* sound);

}  // namespace piblocks
