// What differs between the versions of libav that Debian 12 and 13 have: FFmpeg 5.1 to 7.1.
#include "media/libav/av.hpp"

namespace piblocks {

std::span<const AVPixelFormat> pixel_formats_of(const AVCodec& encoder) noexcept {
#if LIBAVCODEC_VERSION_INT >= AV_VERSION_INT(61, 13, 100)  // FFmpeg 7.1
  const void* formats = nullptr;
  int count = 0;
  const int code = avcodec_get_supported_config(nullptr, &encoder, AV_CODEC_CONFIG_PIX_FORMAT, 0,
                                                &formats, &count);
  if (code < 0 || formats == nullptr) return {};
  return {static_cast<const AVPixelFormat*>(formats), static_cast<std::size_t>(count)};
#else
  const AVPixelFormat* const formats = encoder.pix_fmts;
  std::size_t count = 0;
  while (formats != nullptr && formats[count] != AV_PIX_FMT_NONE) ++count;
  return {formats, count};
#endif
}

const std::uint8_t* display_matrix_of(const AVStream& stream) noexcept {
#if LIBAVCODEC_VERSION_INT >= AV_VERSION_INT(60, 29, 100)  // FFmpeg 6.1
  const AVCodecParameters& parameters = *stream.codecpar;
  const AVPacketSideData* const data = av_packet_side_data_get(
      parameters.coded_side_data, parameters.nb_coded_side_data, AV_PKT_DATA_DISPLAYMATRIX);
  return data != nullptr ? data->data : nullptr;
#else
  static constinit const FoundFunction<avformat_function, decltype(av_stream_get_side_data)>
      side_data("av_stream_get_side_data");
  return side_data(&stream, AV_PKT_DATA_DISPLAYMATRIX, nullptr);
#endif
}

}  // namespace piblocks
