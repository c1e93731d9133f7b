// Files of a video stream, and one of sound if asked for, written by libavformat.
// In: chunks of packets, in order. Out: a file whose index comes first, or no trace of it.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "media/libav/sound_encoder.hpp"
#include "media/libav/video_encoder.hpp"
#include "media/output/frame_sink.hpp"

namespace piblocks {

/// How libavformat is told what kind of file to write.
struct Container {
  const char* muxer = nullptr;         ///< its name
  const char* index_option = nullptr;  ///< which, set so, brings the index to the front
  const char* index_value = nullptr;
  /// Whether a file that is read back has so many packets of each stream.
  bool (*is_whole)(AVFormatContext& file, std::span<const std::int64_t> packets) = nullptr;
  SoundCodec sound;  ///< what its sound is encoded by
  /// Names of those that its pictures may be encoded by.
  std::vector<std::string> (*encoders)() = nullptr;
  /// Whether sound is counted from its first packet. Otherwise that is before 0, where libavformat
  /// moves all streams of a file that cannot have such times.
  bool sound_from_zero = false;
};

extern const Container kMp4;
extern const Container kMov;
extern const Container kWebm;

/// @param encoder  of the pictures, and
/// @param sound    of the sound, if there is any; they must outlive the sink.
/// @throws UsageError if the file cannot be opened.
std::unique_ptr<FrameSink> open_video_file(const std::string& name, const VideoEncoder& encoder,
                                           const Container& container, const SoundEncoder* sound);

}  // namespace piblocks
