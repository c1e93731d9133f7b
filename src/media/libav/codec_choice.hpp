// What the pictures of a video are encoded by.
// In: the format of the output and what the user said to the encoder. Out: one of libavcodec's
// encoders, the pixels it takes, and how it is set up.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "media/libav/av.hpp"
#include "media/output/frame_sink.hpp"

namespace piblocks {

struct CodecChoice {
  const AVCodec* codec;  ///< libavcodec's, which lives as long as the program
  AVPixelFormat pixel_format;
  int frames_per_chunk;
  /// Applies the settings to an encoder that is not open yet. Thread-safe.
  std::function<void(AVCodecContext& context)> set_up;
  /// Names of the encoders to use if this one cannot be opened.
  std::vector<std::string> (*usable)();
};

/// Frames of a closed group of pictures that lasts about a second; 2 to 300.
int frames_in_a_second(const Rational& frame_rate);

/// Whether the encoder has an option of its own with this name.
bool has_option(const AVCodec& codec, const char* name);

/// H.264 in 4:2:0.
/// @param usable  names the encoders that may be asked for.
/// @throws UsageError listing everything that is wrong with the size and the settings.
CodecChoice h264_choice(const VideoFormat& format, const EncoderSettings& settings,
                        std::vector<std::string> (*usable)());

/// ProRes 4444, with alpha if the frames have it.
/// @throws UsageError if something is said to it, or it is not there.
CodecChoice prores_choice(const VideoFormat& format, const EncoderSettings& settings);

/// VP9 or AV1 in 4:2:0; VP9 with alpha if the frames have it.
/// @throws UsageError listing everything that is wrong with the size and the settings.
CodecChoice webm_choice(const VideoFormat& format, const EncoderSettings& settings);

}  // namespace piblocks
