// Animated pictures, such as GIF: of each frame what has changed, and how long it is shown.
// In: frames. Out: an image for each frame that differs from the one before, in one file.
#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "core/output_file.hpp"
#include "media/output/output.hpp"
#include "media/pixels/changed_picture.hpp"

namespace piblocks {

/// When a frame appears, in units of a second's fraction, rounded to the nearest. Durations are
/// differences of these times, so that nothing drifts.
inline Integer tick_of(std::int64_t frame, const Rational& frame_rate, int ticks_per_s) {
  return floor(Rational(to_integer(frame)) * ticks_per_s / frame_rate + Rational(1, 2));
}

/// Makes an image of each frame that differs from the one before. The packet of any other frame is
/// empty: the image before it is shown longer. The output needs_frame_before.
class AnimationEncoder : public ChunkEncoder {
 public:
  /// @param longest  frames for which one image can be shown, at least 1. Every frame whose number
  ///                 is a multiple of it has an image, so that no sink needs to make one.
  AnimationEncoder(const VideoFormat& format, std::int64_t longest)
      : ChunkEncoder(format), most_frames_(longest), picture_(format.width_px, format.height_px) {}
  void begin(std::int64_t first_frame) final;
  void encode() final;
  EncodedChunk finish() final { return std::exchange(chunk_, {}); }

 private:
  void convert(const ImageView& frame, std::span<const PixelRect> rects) final {
    picture_.take(frame, rects);
  }
  /// The bytes of what has changed in a picture. In that of frame 0, everything has.
  virtual Bytes encode_image(const ChangedPicture& picture) = 0;

  std::int64_t most_frames_;
  ChangedPicture picture_;
  std::int64_t next_frame_ = 0;
  EncodedChunk chunk_;
};

/// A file of such images. Each is written when it is known how long it is shown.
class AnimationSink : public FrameSink {
 public:
  /// @param least_bytes  of an image
  /// @throws UsageError if the file cannot be opened.
  AnimationSink(const std::string& name, std::size_t least_bytes)
      : least_bytes_(least_bytes), file_(name) {}
  void append(const EncodedChunk& chunk) final;
  void finish() final;

 protected:
  OutputFile& file() { return file_; }

 private:
  /// @param image  what encode_image() returned; shown from frame `first` on, up to frame `end`
  virtual void write_image(Bytes image, std::int64_t first, std::int64_t end) = 0;
  virtual void write_end() = 0;
  void write_last(std::int64_t end);

  std::size_t least_bytes_;
  FrameCounter counter_;
  OutputFile file_;
  Packet last_;  // the image that is not written yet
};

}  // namespace piblocks
