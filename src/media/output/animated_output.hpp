// Animated pictures, such as GIF: of each frame what has changed, and how long it is shown.
// In: frames. Out: an image for each frame that differs from the one before, in one file.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/output_file.hpp"
#include "media/output/output_kinds.hpp"

namespace piblocks {

/// A picture that remembers what has changed in it: what a frame of a GIF or an APNG has to hold.
class ChangedPicture {
 public:
  ChangedPicture(int width_px, int height_px, bool has_alpha = false);

  /// @param rects  cover every pixel in which the frame differs from the one taken before.
  void take(const ImageView& frame, std::span<const PixelRect> rects);
  /// Forgets what has changed.
  void settle();
  /// Takes everything for changed.
  void mark_all();

  bool has_changed() const noexcept { return left_ < right_; }
  /// Around all that has changed since settle(). One pixel if nothing has: no image is empty.
  PixelRect changed() const noexcept;
  /// Pixels as ImageView has them.
  const std::uint32_t* row(int y) const noexcept { return words_.data() + offset(y); }
  ImageView view() const noexcept {
    return {.data = reinterpret_cast<const std::uint8_t*>(words_.data()),
            .width_px = width_px_,
            .height_px = height_px_,
            .stride_bytes = std::ptrdiff_t{4} * width_px_,
            .has_alpha = has_alpha_};
  }
  /// 1 for each pixel that has changed since settle(), else 0.
  const std::uint8_t* marks(int y) const noexcept { return marks_.data() + offset(y); }

 private:
  std::size_t offset(int y) const noexcept { return std::size_t(y) * std::size_t(width_px_); }
  void take_row(const ImageView& frame, const PixelRect& rect, int y);

  int width_px_;
  int height_px_;
  bool has_alpha_;
  std::vector<std::uint32_t> words_;
  std::vector<std::uint8_t> marks_;
  // The rectangle; empty if left is not before right.
  int left_;
  int top_;
  int right_ = 0;
  int bottom_ = 0;
};

/// Makes an image of each frame that differs from the one before. The packet of any other frame is
/// empty: the image before it is shown longer. The output needs_frame_before.
class AnimationEncoder : public PacketPerFrameEncoder {
 public:
  /// @param longest  frames for which one image can be shown, at least 1. Every frame whose number
  ///                 is a multiple of it has an image, so that no sink needs to make one.
  AnimationEncoder(const VideoFormat& format, std::int64_t longest)
      : PacketPerFrameEncoder(format),
        most_frames_(longest),
        picture_(format.width_px, format.height_px, format.has_alpha) {}
  void begin(std::int64_t first_frame) final {
    PacketPerFrameEncoder::begin(first_frame);
    picture_.settle();  // the frame before; nothing follows from it in frame 0
  }

 private:
  void convert(const ImageView& frame, std::span<const PixelRect> rects) final {
    picture_.take(frame, rects);
  }
  Bytes encode_picture(std::int64_t number) final;
  /// The bytes of what has changed in a picture. In that of frame 0, everything has.
  virtual Bytes encode_image(const ChangedPicture& picture) = 0;

  std::int64_t most_frames_;
  ChangedPicture picture_;
};

/// A file of such images. Each is written when it is known how long it is shown.
class AnimationSink : public FrameSink {
 public:
  /// @param least_bytes  of an image
  /// @throws UsageError if the file cannot be opened.
  AnimationSink(const OutputRequest& request, std::size_t least_bytes)
      : request_(request), least_bytes_(least_bytes), file_(request.name) {}
  void append(const EncodedChunk& chunk) final;
  void finish() final;

 protected:
  const OutputRequest& request() const { return request_; }
  /// How often it plays; 0 for ever.
  int plays() const { return request_.settings.plays.value_or(0); }
  /// How long frames from `first` to before `end` are shown, in units of a second's fraction. Times
  /// are rounded, and durations are their differences, so that nothing drifts.
  std::uint64_t ticks_of(std::int64_t first, std::int64_t end, int ticks_per_s) const;
  OutputFile& file() { return file_; }

 private:
  /// @param image  what encode_image() returned; shown from frame `first` on, up to frame `end`
  virtual void write_image(Bytes image, std::int64_t first, std::int64_t end) = 0;
  virtual void write_end() = 0;
  void write_last(std::int64_t end);

  OutputRequest request_;
  std::size_t least_bytes_;
  FrameCounter counter_;
  OutputFile file_;
  Packet last_;  // the image that is not written yet
};

/// An output of such an encoder and such a sink. @param maker  of the bytes, for the signature
template <typename Encoder, typename Sink>
Output animated_output(const OutputRequest& request, std::int64_t frames_per_chunk,
                       std::int64_t longest, const std::string& maker) {
  return {.frames_per_chunk = frames_per_chunk,
          .signature = maker + ", plays " + std::to_string(request.settings.plays.value_or(0)),
          .make_encoder = [format = request.format,
                           longest] { return std::make_unique<Encoder>(format, longest); },
          .open = [request](const Opening& /*opening*/) { return std::make_unique<Sink>(request); },
          .needs_frame_before = true};
}

}  // namespace piblocks
