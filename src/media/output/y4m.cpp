#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <string_view>
#include <utility>

#include "media/output/output_kinds.hpp"
#include "media/output/simple_output.hpp"
#include "media/pixels/yuv420.hpp"

namespace piblocks {
namespace {

constexpr std::string_view kFrameHeader = "FRAME\n";

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
  void convert(const ImageView& frame, std::span<const PixelRect> rects) override;
  std::vector<std::uint8_t> encode_picture(std::int64_t number, bool is_first) override;

  std::string file_header_;
  std::ptrdiff_t width_px_;
  std::size_t luma_bytes_;
  std::vector<std::uint8_t> planes_;  // Y, Cb, Cr
};

void Y4mEncoder::convert(const ImageView& frame, std::span<const PixelRect> rects) {
  std::uint8_t* const y = planes_.data();
  const YuvView<std::uint8_t> picture{.y = {y, width_px_},
                                      .cb = {y + luma_bytes_, width_px_ / 2},
                                      .cr = {y + luma_bytes_ / 4 * 5, width_px_ / 2}};
  for (const PixelRect& rect : rects) {
    convert_to_yuv420(frame, chroma_aligned(rect, frame), picture);
  }
}

std::vector<std::uint8_t> Y4mEncoder::encode_picture(std::int64_t number, bool /*is_first*/) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(file_header_.size() + kFrameHeader.size() + planes_.size());
  if (number == 0) bytes.insert(bytes.end(), file_header_.begin(), file_header_.end());
  bytes.insert(bytes.end(), kFrameHeader.begin(), kFrameHeader.end());
  bytes.insert(bytes.end(), planes_.begin(), planes_.end());
  return bytes;
}

}  // namespace

std::unique_ptr<Output> y4m_output(const OutputRequest& request) {
  // A frame has 3 MB at 1080p: as few as possible wait to be written.
  constexpr std::int64_t kFramesPerChunk = 1;
  Problems problems;
  problems.add(odd_size_problem(request.format, "y4m in 4:2:0"));
  problems.check();
  return stream_output<Y4mEncoder>(request, kFramesPerChunk, "y4m");
}

}  // namespace piblocks
