// Streams of the encoder, and libavcodec's decoder for them.
// In: a size, a quantiser, pictures and what changes in them. Out: whether the decoder shows
// exactly the encoder's decoded pictures.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "h264/callers_picture.hpp"
#include "h264/levels.hpp"
#include "h264/parameter_sets.hpp"
#include "h264/picture_encoder.hpp"
#include "media/libav/av.hpp"

namespace piblocks::h264 {

/// The headers of a stream of our own.
struct StreamHeaders {
  explicit StreamHeaders(const Config& stream)
      : config(stream),
        bytes(write_parameter_sets(config,
                                   lowest_level(config.width_px, config.height_px,
                                                {config.rate_numerator, config.rate_denominator})
                                       ->idc)),
        width_mb(macroblocks_along(config.width_px)),
        height_mb(macroblocks_along(config.height_px)) {}

  Config config;
  std::vector<std::uint8_t> bytes;
  int width_mb;
  int height_mb;
};

/// Takes these macroblocks of the next picture.
inline void take(PictureEncoder& encoder, const Picture& source, const MacroblockSet& changed) {
  for (int address = changed.next(0); address >= 0; address = changed.next(address + 1)) {
    const int x_px = 16 * (address % source.width_mb());
    const int y_px = 16 * (address / source.width_mb());
    encoder.take(planes_from(source.planes(), x_px, y_px), {x_px, y_px, 16, 16});
  }
}

inline Bytes encoded_idr(PictureEncoder& encoder, const Picture& source,
                         const MacroblockSet& changed) {
  Bytes unit;
  take(encoder, source, changed);
  encoder.encode_idr(unit);
  return unit;
}

/// The same if all may have changed.
inline Bytes encoded_idr(PictureEncoder& encoder, const Picture& source) {
  MacroblockSet all(source.width_mb(), source.height_mb());
  add(all, 0, 0, 16 * source.width_mb(), 16 * source.height_mb());
  return encoded_idr(encoder, source, all);
}

inline Bytes encoded_p(PictureEncoder& encoder, const Picture& source,
                       const MacroblockSet& changed) {
  Bytes unit;
  take(encoder, source, changed);
  encoder.encode_p(unit);
  return unit;
}

/// A decoder's picture in 4:2:0, valid until its next call.
struct ShownPicture {
  int width;
  int height;
  std::array<const std::uint8_t*, 3> planes;
  std::array<std::ptrdiff_t, 3> strides;
};

/// libavcodec's decoder, which rejects every error.
class StrictDecoder {
 public:
  explicit StrictDecoder(const std::vector<std::uint8_t>& headers) {
    const AVCodec* codec = avcodec_find_decoder(AV_CODEC_ID_H264);
    context_ = own_av<AvCodecContextPtr>(avcodec_alloc_context3(codec), "decoder");
    context_->err_recognition = AV_EF_CRCCHECK | AV_EF_BITSTREAM | AV_EF_BUFFER | AV_EF_EXPLODE |
                                AV_EF_CAREFUL | AV_EF_COMPLIANT | AV_EF_AGGRESSIVE;
    context_->thread_count = 1;
    context_->flags |= AV_CODEC_FLAG_LOW_DELAY;
    context_->apply_cropping = 0;  // predictions use cropped samples too
    context_->extradata =
        static_cast<std::uint8_t*>(av_mallocz(headers.size() + AV_INPUT_BUFFER_PADDING_SIZE));
    std::copy(headers.begin(), headers.end(), context_->extradata);
    context_->extradata_size = static_cast<int>(headers.size());
    check_av(avcodec_open2(context_.get(), codec, nullptr), "open", "decoder");
    frame_ = own_av<AvFramePtr>(av_frame_alloc(), "frame");
    packet_ = own_av<AvPacketPtr>(av_packet_alloc(), "packet");
  }

  /// The picture of one access unit, not cropped; nothing if it is damaged.
  std::optional<ShownPicture> decode(std::vector<std::uint8_t> unit) {
    packet_->size = static_cast<int>(unit.size());
    unit.resize(unit.size() + AV_INPUT_BUFFER_PADDING_SIZE);
    packet_->data = unit.data();
    if (avcodec_send_packet(context_.get(), packet_.get()) < 0) return std::nullopt;
    if (avcodec_receive_frame(context_.get(), frame_.get()) < 0) return std::nullopt;
    const bool is_damaged =
        frame_->decode_error_flags != 0 || (frame_->flags & AV_FRAME_FLAG_CORRUPT) != 0;
    if (is_damaged) return std::nullopt;
    const AVFrame& shown = *frame_;
    return ShownPicture{.width = shown.width,
                        .height = shown.height,
                        .planes = {shown.data[0], shown.data[1], shown.data[2]},
                        .strides = {shown.linesize[0], shown.linesize[1], shown.linesize[2]}};
  }

 private:
  AvCodecContextPtr context_;
  AvFramePtr frame_;
  AvPacketPtr packet_;
};

/// "" if all shown samples are equal, else where the first difference is.
inline std::string difference(const Picture& expected, const ShownPicture& shown) {
  for (std::size_t i = 0; i < 3; ++i) {
    const int plane = static_cast<int>(i);
    const int step = plane == 0 ? 1 : 2;
    for (int y = 0; y < shown.height / step; ++y) {
      const std::uint8_t* const a = expected.plane(plane) + y * expected.stride_bytes(plane);
      const std::uint8_t* const b = shown.planes[i] + y * shown.strides[i];
      for (int x = 0; x < shown.width / step; ++x) {
        if (a[x] != b[x]) {
          return "plane " + std::to_string(plane) + " at " + std::to_string(x) + ", " +
                 std::to_string(y) + ": " + std::to_string(a[x]) + " became " +
                 std::to_string(b[x]);
        }
      }
    }
  }
  return {};
}

}  // namespace piblocks::h264
