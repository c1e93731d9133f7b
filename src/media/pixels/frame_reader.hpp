// Frames read back from files.
// In: PNG files or a video. Out: one frame after the other, as samples.
#pragma once

#include <string>
#include <string_view>

#include "media/pixels/samples.hpp"

namespace piblocks {

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
  virtual std::string layout() const = 0;
  /// How players change the stored pixels, such as "turned clockwise by 90 degrees"; empty if they
  /// do not.
  virtual std::string presentation() const { return {}; }
  /// The frame as it is stored. Call either this or rgb(), once a frame: the picture is moved out.
  virtual Samples samples() = 0;
  /// The frame's colours, at no less than the depth of the samples.
  virtual Samples rgb() = 0;
  /// The frame for people: the file's name, or the frame's number from 0.
  virtual std::string name() const = 0;
};

}  // namespace piblocks
