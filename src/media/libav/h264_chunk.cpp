#include "media/libav/h264_chunk.hpp"

#include <algorithm>
#include <cstring>
#include <iterator>
#include <utility>

namespace piblocks {
namespace {

/// Repeats each plane's last column and row up to whole macroblocks: that costs the fewest bits.
void extend(h264::Picture& picture, const VideoFormat& format) {
  for (int plane = 0; plane < 3; ++plane) {
    const int shared = plane == 0 ? 1 : 2;  // columns, and rows, of pixels of a sample
    const PlaneView<std::uint8_t> view = {picture.plane(plane), picture.stride_bytes(plane)};
    const int width = format.width_px / shared;
    const int height = format.height_px / shared;
    const auto rest = std::size_t(view.stride_bytes - width);
    for (int y = 0; y < height && rest > 0; ++y) {
      std::uint8_t* const end = view.row(y) + width;
      std::memset(end, end[-1], rest);
    }
    for (int y = height; y < 16 / shared * picture.height_mb(); ++y) {
      std::memcpy(view.row(y), view.row(height - 1), std::size_t(view.stride_bytes));
    }
  }
}

class H264ChunkEncoder final : public ChunkEncoder {
 public:
  H264ChunkEncoder(const VideoEncoder& encoder, const h264::ParameterSets& sets, int qp,
                   bool may_hand_over)
      : ChunkEncoder(encoder.format()),
        encoder_(encoder),
        may_hand_over_(may_hand_over),
        picture_(sets.width_mb, sets.height_mb),
        changed_(sets.width_mb, sets.height_mb),
        coder_(sets, qp) {}
  void begin(std::int64_t first_frame) override {
    next_frame_ = first_frame;
    transformed_ = 0;
    is_handed_over_ = false;
  }
  void encode() override {
    if (is_handed_over_) return libav_encoder_->encode();
    const bool is_first = chunk_.empty();
    chunk_.push_back({.bytes = is_first ? coder_.encode_idr(picture_, changed_)
                                        : coder_.encode_p(picture_, changed_),
                      .pts = next_frame_,
                      .dts = next_frame_,
                      .key_frame = is_first});
    if (!is_first) transformed_ += coder_.transformed_macroblocks();
    changed_.clear();
    ++next_frame_;
  }
  EncodedChunk finish() override {
    EncodedChunk chunk = std::exchange(chunk_, {});
    if (is_handed_over_) std::ranges::move(libav_encoder_->finish(), std::back_inserter(chunk));
    return chunk;
  }
  std::string method() const override {
    const std::string damage(kDamage);
    return is_handed_over_ ? damage + ", then " + encoder_.name() : damage;
  }

 private:
  void convert(const ImageView& frame, std::span<const PixelRect> rects) override {
    const PixelRect whole{0, 0, frame.width_px, frame.height_px};
    const std::span<const PixelRect> all(&whole, 1);
    if (is_handed_over_) {
      libav_encoder_->take(frame, rects);
    } else if (changes_too_much()) {
      hand_over();
      libav_encoder_->take(frame, all);
    } else {
      convert_here(frame, std::exchange(is_behind_, false) ? all : rects);
    }
  }
  void convert_here(const ImageView& frame, std::span<const PixelRect> rects) {
    bool reaches_edge = false;
    for (const PixelRect& rect : rects) {
      const PixelRect aligned = chroma_aligned(rect, frame);
      convert_to_yuv420(frame, aligned, view_of(picture_));
      changed_.add(aligned.x_px, aligned.y_px, aligned.width_px, aligned.height_px);
      reaches_edge = reaches_edge || aligned.x_px + aligned.width_px == frame.width_px ||
                     aligned.y_px + aligned.height_px == frame.height_px;
    }
    if (reaches_edge) extend(picture_, encoder_.format());
  }
  /// Makes the next frame a key frame of libavcodec's encoder.
  void hand_over() {
    is_handed_over_ = true;
    is_behind_ = true;
    if (!libav_encoder_) libav_encoder_ = libav_chunk_encoder(encoder_);
    libav_encoder_->begin(next_frame_);
  }
  /// libavcodec's encoder is the faster one if more than a twentieth of the macroblocks, and more
  /// than a few, have to be transformed (tests/benchmark/encoders.md).
  bool changes_too_much() const {
    constexpr std::int64_t kOneIn = 20;
    constexpr std::int64_t kFew = 64;
    const std::int64_t macroblocks = std::int64_t{picture_.width_mb()} * picture_.height_mb();
    return may_hand_over_ &&
           transformed_ > std::max(kFew, macroblocks / kOneIn) * encoder_.frames_per_chunk();
  }

  const VideoEncoder& encoder_;
  bool may_hand_over_;
  h264::Picture picture_;
  h264::MacroblockSet changed_;
  h264::PictureEncoder coder_;
  std::int64_t next_frame_ = 0;
  EncodedChunk chunk_;
  std::int64_t transformed_ = 0;  // macroblocks of the chunk's P pictures
  bool is_handed_over_ = false;   // to libavcodec's encoder
  bool is_behind_ = false;        // picture_ lacks frames that only libavcodec's encoder took
  std::unique_ptr<ChunkEncoder> libav_encoder_;  // made when it is first needed
};

}  // namespace

YuvView<std::uint8_t> view_of(h264::Picture& picture) {
  const auto plane = [&](int number) -> PlaneView<std::uint8_t> {
    return {picture.plane(number), picture.stride_bytes(number)};
  };
  return {plane(0), plane(1), plane(2)};
}

std::unique_ptr<ChunkEncoder> h264_chunk_encoder(const VideoEncoder& encoder,
                                                 const h264::ParameterSets& sets, int qp,
                                                 bool may_hand_over) {
  return std::make_unique<H264ChunkEncoder>(encoder, sets, qp, may_hand_over);
}

}  // namespace piblocks
