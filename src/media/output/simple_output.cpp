#include "media/output/simple_output.hpp"

#include <fmt/format.h>

#include "media/pixels/yuv.hpp"

namespace piblocks {
namespace {

class NullEncoder final : public ChunkEncoder {
 public:
  using ChunkEncoder::ChunkEncoder;
  void begin(std::int64_t /*first_frame*/) override {}
  void encode() override {}
  EncodedChunk finish() override { return {}; }

 private:
  void convert(const ImageView& /*frame*/, std::span<const PixelRect> /*rects*/) override {}
};

class NullSink final : public FrameSink {
 public:
  void append(const EncodedChunk& /*chunk*/) override {}
  void finish() override {}
};

/// 420mpeg2 is 4:2:0 with chroma sited left. There is no tag for the matrix; readers take BT.709
/// for HD sizes.
std::string file_header(const VideoFormat& format) {
  return fmt::format("YUV4MPEG2 W{} H{} F{}:{} Ip A1:1 C420mpeg2 XCOLORRANGE=LIMITED\n",
                     format.width_px, format.height_px, format.frame_rate.get_num().get_str(),
                     format.frame_rate.get_den().get_str());
}

class Y4mEncoder final : public PacketPerFrameEncoder {
 public:
  explicit Y4mEncoder(const VideoFormat& format)
      : PacketPerFrameEncoder(format),
        file_header_(file_header(format)),
        width_px_(format.width_px),
        luma_bytes_(std::size_t(format.width_px) * std::size_t(format.height_px)),
        planes_(luma_bytes_ / 2 * 3) {}

 private:
  void convert(const ImageView& frame, std::span<const PixelRect> rects) override {
    std::uint8_t* const y = planes_.data();
    const YuvView<std::uint8_t> picture{.y = {y, width_px_},
                                        .cb = {y + luma_bytes_, width_px_ / 2},
                                        .cr = {y + luma_bytes_ / 4 * 5, width_px_ / 2}};
    for (const PixelRect& rect : rects) {
      convert_to_yuv420(frame, chroma_aligned(rect, frame), picture);
    }
  }
  Bytes encode_picture(std::int64_t number, bool /*is_first*/) override {
    const std::string header = (number == 0 ? file_header_ : "") + "FRAME\n";
    Bytes bytes;
    bytes.reserve(header.size() + planes_.size());
    append(bytes, header);
    append(bytes, planes_);
    return bytes;
  }

  std::string file_header_;
  std::ptrdiff_t width_px_;
  std::size_t luma_bytes_;
  Bytes planes_;  // Y, Cb, Cr
};

}  // namespace

void PacketPerFrameEncoder::encode() {
  const std::int64_t number = next_frame_++;
  chunk_.push_back({.bytes = encode_picture(number, chunk_.empty()), .pts = number, .dts = number});
}

void StreamSink::append(const EncodedChunk& chunk) {
  counter_.take(chunk);
  for (const Packet& packet : chunk) file_.write(packet.bytes);
}

void StreamSink::finish() {
  if (write_trailer_) write_trailer_(file_, counter_.frames());
  file_.finish();
}

Output null_output(const OutputRequest& request) {
  return {
      .frames_per_chunk = 64,
      .signature = "null",
      .make_encoder = [format = request.format] { return std::make_unique<NullEncoder>(format); },
      .open = [] { return std::make_unique<NullSink>(); }};
}

Output y4m_output(const OutputRequest& request) {
  Problems problems;
  problems.add(odd_size_problem(request.format, "y4m in 4:2:0"));
  problems.check();
  // A frame has 3 MB at 1080p: as few as possible wait to be written.
  return stream_output<Y4mEncoder>(request, 1, "y4m");
}

}  // namespace piblocks
