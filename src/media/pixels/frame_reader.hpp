// Frames read back from files.
// In: PNG files or a video. Out: one frame after the other, of 8 bits a sample or more.
#pragma once

#include <piblocks/image.hpp>

#include <string>
#include <string_view>
#include <variant>

#include "media/png/packed_png.hpp"

namespace piblocks {

/// A picture of 8 bits a sample, of more, or of 8 bits as its file has them.
using AnyImage = std::variant<Image, DeepImage, PackedImage>;

/// The largest possible sample, at least 255.
int max_level_of(const AnyImage& image);

/// A level of one range as a level of another, rounded to the nearest. Exact if one range is a
/// multiple of the other, as 65535 is of 255.
constexpr int scaled_level(int level, int from_max, int to_max) {
  return int((2LL * level * to_max + from_max) / (2LL * from_max));
}

/// The image at a depth that is no less; different levels stay different.
/// @param max_level  above 255, and not below the image's own.
DeepImage deepened(AnyImage image, int max_level);

/// The image in 8 bits, to show it.
Image flattened(AnyImage image);

/// The layout of frames whose samples are red, green, blue and alpha.
inline constexpr std::string_view kRgba = "rgba";

class FrameReader {
 public:
  virtual ~FrameReader() = default;
  /// Goes on to the next frame; the first call, to the first. False after the last.
  /// @throws IoError, MediaError if it cannot be read, or its samples cannot be compared.
  virtual bool next() = 0;
  /// What the samples mean: kRgba, or Y, Cb, Cr and alpha with their depth, chroma sharing, range
  /// and matrix. Shared chroma is repeated. Frames with the same layout can be compared exactly.
  virtual std::string layout() const { return std::string(kRgba); }
  /// How players change the stored pixels, such as "turned clockwise by 90 degrees", or empty.
  virtual std::string presentation() const { return {}; }
  /// The frame as it is stored. Call either this or rgb(), once a frame: the picture is moved out.
  virtual AnyImage samples() = 0;
  /// The frame's colours, at no less than the depth of the samples.
  virtual AnyImage rgb() { return samples(); }
};

}  // namespace piblocks
