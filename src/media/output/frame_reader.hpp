// Frames read back from files.
// In: a PNG file, many of them, or a video. Out: one frame after the other, as samples.
#pragma once

#include <piblocks/image.hpp>

#include <filesystem>
#include <memory>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "media/pixels/samples.hpp"

namespace piblocks {

/// The layout of frames whose samples are red, green, blue and alpha.
inline constexpr std::string_view kRgba = "rgba";

class FrameReader {
 public:
  virtual ~FrameReader() = default;
  /// Goes on to the next frame, before the first call to the first one. False after the last.
  /// @throws IoError, MediaError if it cannot be read, or its samples are of no kind that can be
  ///         compared.
  virtual bool next() = 0;
  /// What the samples mean: kRgba; or which Y, Cb and Cr are in place of red, green and blue: how
  /// pixels share chroma, which is repeated over them, the depth, the range and the matrix. Frames
  /// with the same layout can be compared exactly.
  virtual std::string layout() const = 0;
  /// How a player changes the pixels that are stored before it shows them, such as "turned
  /// clockwise by 90 degrees"; empty if it does not.
  virtual std::string presentation() const { return {}; }
  /// The frame as it is stored. Call this once a frame, or rgb(): where both are the same, the
  /// picture is handed over.
  virtual Samples samples() = 0;
  /// The frame's colours, at a depth not less than that of the samples.
  virtual Samples rgb() = 0;
  /// Of the frame, for people: the file's name or the frame's number from 0.
  virtual std::string name() const = 0;
};

/// A PNG file as it is stored: no colour profile and no gamma is applied, sRGB is assumed. Samples
/// of 16 bits are rounded to 8.
/// @throws IoError if the file cannot be read, MediaError if it is no PNG or larger than
///         kMaxFrame_px.
Image read_png(const std::filesystem::path& path);

/// The same with all the bits of 16.
Samples read_png_samples(const std::filesystem::path& path);

/// Whether the file is a PNG with more than one frame, of which only read_video() sees all.
/// @throws as read_png().
bool is_animated_png(const std::filesystem::path& path);

/// PNG files, one frame each, in this order.
std::unique_ptr<FrameReader> read_png_files(std::vector<std::filesystem::path> paths);

/// The first video stream of any file that libavformat reads.
/// @throws IoError, MediaError
/// @param stop  breaks off a call that waits, such as for somebody to write to a pipe.
std::unique_ptr<FrameReader> read_video(const std::string& path, const std::stop_token& stop = {});

}  // namespace piblocks
