// Frames read back from files.
// In: a PNG file, many of them, or a video. Out: one frame after the other, as samples.
#pragma once

#include <piblocks/image.hpp>

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace piblocks {

class FrameReader {
 public:
  virtual ~FrameReader() = default;
  /// Goes on to the next frame, before the first call to the first one. False after the last.
  /// @throws IoError, MediaError if it cannot be read.
  virtual bool next() = 0;
  /// What the samples are: "rgba", or libavutil's name of a format of 8 bits such as "yuv420p",
  /// whose chroma is repeated over the pixels that share it: Y, Cb and Cr in place of red, green
  /// and blue. Frames with the same layout can be compared exactly.
  virtual std::string layout() const = 0;
  /// The frame as it is stored. Call this once a frame, or rgb(): where both are the same, the
  /// picture is handed over.
  virtual Image samples() = 0;
  /// The frame as it is shown, 0xAARRGGBB.
  virtual Image rgb() = 0;
  /// Of the frame, for people: the file's name or the frame's number from 0.
  virtual std::string name() const = 0;
};

/// @throws IoError if the file cannot be read, MediaError if it is no PNG or larger than
///         kMaxFrame_px.
Image read_png(const std::filesystem::path& path);

/// PNG files, one frame each, in this order.
std::unique_ptr<FrameReader> read_png_files(std::vector<std::filesystem::path> paths);

/// The first video stream of any file that libavformat reads.
/// @throws IoError, MediaError
std::unique_ptr<FrameReader> read_video(const std::string& path);

}  // namespace piblocks
