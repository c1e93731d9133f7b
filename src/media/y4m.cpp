#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <cstring>

#include "media/sink_kinds.hpp"
#include "media/stream_sink.hpp"
#include "media/yuv420.hpp"

namespace piblocks {
namespace {

/// A frame is 3 MB at 1080p: few of them wait for their turn to be written.
constexpr std::int64_t kFramesPerChunk = 4;

/// 420mpeg2 is 4:2:0 with chroma sited left. There is no tag for the matrix; readers take BT.709
/// for HD sizes.
std::string file_header(const VideoFormat& format) {
  return fmt::format("YUV4MPEG2 W{} H{} F{}:{} Ip A1:1 C420mpeg2 XCOLORRANGE=LIMITED\n",
                     format.width_px, format.height_px, format.frame_rate.get_num().get_str(),
                     format.frame_rate.get_den().get_str());
}

std::vector<std::uint8_t> encode(const ImageView& frame, const std::string& header) {
  const std::ptrdiff_t width = frame.width_px;
  const std::ptrdiff_t pixels = width * frame.height_px;
  std::vector<std::uint8_t> bytes(header.size() + static_cast<std::size_t>(pixels / 2 * 3));
  std::memcpy(bytes.data(), header.data(), header.size());

  std::uint8_t* y = bytes.data() + header.size();
  const YuvView picture{.y = y,
                        .cb = y + pixels,
                        .cr = y + pixels + pixels / 4,
                        .y_stride_bytes = width,
                        .cb_stride_bytes = width / 2,
                        .cr_stride_bytes = width / 2};
  convert_to_yuv420(frame, {0, 0, frame.width_px, frame.height_px}, picture);
  return bytes;
}

}  // namespace

std::unique_ptr<FrameSink> open_y4m(const SinkRequest& request) {
  const std::string problem = odd_size_problem(request.format, "y4m in 4:2:0");
  if (!problem.empty()) throw UsageError(problem);

  const auto encode_frame = [first_header = file_header(request.format) + "FRAME\n"](
                                const ImageView& frame, std::span<const PixelRect> /*changed*/,
                                std::int64_t number) {
    return encode(frame, number == 0 ? first_header : "FRAME\n");
  };
  return std::make_unique<StreamSink>(request, kFramesPerChunk, encode_frame);
}

}  // namespace piblocks
