// Reads a video back, to see what was really written.
// In: a file. Out: its tags and its frames, decoded by libavcodec, as RGB.
#pragma once

#include <piblocks/exact.hpp>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "support/article_frames.hpp"

struct AVFrame;

namespace piblocks::testing_support {

/// libavutil's names, such as "bt709" and "tv"; "unknown" or "unspecified" where there is none.
struct ColourTags {
  std::string matrix;
  std::string primaries;
  std::string transfer;
  std::string range;
  std::string chroma_location;

  friend bool operator==(const ColourTags&, const ColourTags&) = default;
};

struct DecodedFrame {
  Rational time_s;  ///< of its first appearance
  bool key_frame = false;
  Pixels rgb;
};

struct DecodedPacket {
  std::int64_t pts = 0;  ///< in units of the stream's time base
  std::int64_t dts = 0;
};

/// What is true of the video as a whole.
struct DecodedStream {
  int width_px = 0;
  int height_px = 0;
  std::string codec;
  Rational frame_rate;
  Rational duration_s;
  ColourTags container;  ///< as the file's header says
  ColourTags pictures;   ///< as the coded pictures say
  std::vector<DecodedPacket> packets;
};

struct DecodedVideo : DecodedStream {
  std::vector<DecodedFrame> frames;
};

bool is_key_frame(const AVFrame& frame) noexcept;

/// Decodes the first video stream and hands out its frames in the order they are shown.
/// @throws MediaError, IoError
DecodedStream decode_video(const std::filesystem::path& path,
                           const std::function<void(DecodedFrame&&)>& take);

/// The same, everything kept.
DecodedVideo decode_video(const std::filesystem::path& path);

/// Mean squared difference over all RGB samples of two images of one size.
double rgb_mean_squared_error(const Pixels& a, const Pixels& b);

/// Peak signal to noise ratio of 8-bit samples; infinite for no error.
double psnr_db(double mean_squared_error);

}  // namespace piblocks::testing_support
