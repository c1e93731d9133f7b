#include "media/video_reader.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <array>

#include "media/av.hpp"

extern "C" {
#include <libavutil/pixdesc.h>
#include <libswscale/swscale.h>
}

namespace piblocks {
namespace {

struct SwsDeleter {
  void operator()(SwsContext* context) const noexcept { sws_freeContext(context); }
};
using SwsPtr = std::unique_ptr<SwsContext, SwsDeleter>;

AvInputPtr open_input(const std::string& path) {
  AvInputPtr input = open_av_input(path);
  check_av_read(avformat_find_stream_info(input.get(), nullptr), "read", path);
  return input;
}

AvCodecContextPtr open_decoder(const AVStream& stream, const std::string& path) {
  const AVCodec* codec = avcodec_find_decoder(stream.codecpar->codec_id);
  if (codec == nullptr) {
    throw MediaError(fmt::format("video: cannot decode '{}': no decoder for {}", path,
                                 avcodec_get_name(stream.codecpar->codec_id)));
  }
  auto context = own_av<AvCodecContextPtr>(avcodec_alloc_context3(codec), codec->name);
  check_av_read(avcodec_parameters_to_context(context.get(), stream.codecpar), "decode", path);
  context->max_pixels = kMaxFrame_px;
  context->err_recognition = AV_EF_EXPLODE;
  context->thread_count = 0;  // as many as there are processors; the pictures are the same
  check_av_read(avcodec_open2(context.get(), codec, nullptr), "decode", path);
  return context;
}

const AVPixFmtDescriptor& descriptor_of(const AVFrame& frame) {
  return *av_pix_fmt_desc_get(static_cast<AVPixelFormat>(frame.format));
}

/// Planes of luma and chroma with 8 bits a sample.
bool is_plain_yuv(const AVPixFmtDescriptor& format) {
  constexpr auto kOther = AV_PIX_FMT_FLAG_RGB | AV_PIX_FMT_FLAG_PAL | AV_PIX_FMT_FLAG_HWACCEL |
                          AV_PIX_FMT_FLAG_BITSTREAM | AV_PIX_FMT_FLAG_ALPHA;
  return format.nb_components == 3 && (format.flags & AV_PIX_FMT_FLAG_PLANAR) != 0 &&
         (format.flags & kOther) == 0 && format.comp[0].depth == 8;
}

Image repeated_planes(const AVFrame& frame, const AVPixFmtDescriptor& format) {
  Image image{frame.width, frame.height, {}};
  image.words.reserve(static_cast<std::size_t>(frame.width) *
                      static_cast<std::size_t>(frame.height));
  for (int y = 0; y < frame.height; ++y) {
    const auto row = [&](int plane, int line) {
      return frame.data[plane] + std::ptrdiff_t{line} * frame.linesize[plane];
    };
    const std::uint8_t* const luma = row(0, y);
    const std::uint8_t* const cb = row(1, y >> format.log2_chroma_h);
    const std::uint8_t* const cr = row(2, y >> format.log2_chroma_h);
    for (int x = 0; x < frame.width; ++x) {
      const int at = x >> format.log2_chroma_w;
      image.words.push_back(0xff000000U | std::uint32_t{luma[x]} << 16 |
                            std::uint32_t{cb[at]} << 8 | cr[at]);
    }
  }
  return image;
}

/// What a player assumes where the file does not say.
int matrix_of(const AVFrame& frame) {
  if (frame.colorspace != AVCOL_SPC_UNSPECIFIED) return frame.colorspace;
  constexpr int kHdLines = 720;
  return frame.height >= kHdLines ? AVCOL_SPC_BT709 : AVCOL_SPC_SMPTE170M;
}

/// @param sws  of the last picture, used again if it suits this one.
Image converted_to_rgb(const AVFrame& frame, SwsPtr& sws) {
  constexpr int kFlags = SWS_BILINEAR | SWS_FULL_CHR_H_INT | SWS_ACCURATE_RND | SWS_BITEXACT;
  sws.reset(sws_getCachedContext(sws.release(), frame.width, frame.height,
                                 static_cast<AVPixelFormat>(frame.format), frame.width,
                                 frame.height, AV_PIX_FMT_BGRA, kFlags, nullptr, nullptr, nullptr));
  if (!sws) throw MediaError("video: cannot convert the pictures to RGB");
  const int* const matrix = sws_getCoefficients(matrix_of(frame));
  constexpr int kOne = 1 << 16;
  sws_setColorspaceDetails(sws.get(), matrix, frame.color_range == AVCOL_RANGE_JPEG ? 1 : 0, matrix,
                           1, 0, kOne, kOne);
  Image image{frame.width, frame.height, {}};
  image.words.resize(static_cast<std::size_t>(frame.width) *
                     static_cast<std::size_t>(frame.height));
  const std::array<std::uint8_t*, 1> data = {reinterpret_cast<std::uint8_t*>(image.words.data())};
  const std::array<int, 1> stride = {4 * frame.width};
  check_av_read(
      sws_scale(sws.get(), frame.data, frame.linesize, 0, frame.height, data.data(), stride.data()),
      "convert", "picture");
  return image;
}

class VideoReader final : public FrameReader {
 public:
  explicit VideoReader(const std::string& path)
      : path_(path),
        input_(open_input(path)),
        stream_(
            check_av_read(av_find_best_stream(input_.get(), AVMEDIA_TYPE_VIDEO, -1, -1, nullptr, 0),
                          "find a video in", path)),
        decoder_(open_decoder(*input_->streams[stream_], path)),
        packet_(own_av<AvPacketPtr>(av_packet_alloc(), "packet")),
        frame_(own_av<AvFramePtr>(av_frame_alloc(), "frame")) {}

  bool next() override;
  std::string layout() const override {
    return is_plain_yuv(descriptor_of(*frame_)) ? descriptor_of(*frame_).name : "rgba";
  }
  Image samples() override {
    const AVPixFmtDescriptor& format = descriptor_of(*frame_);
    return is_plain_yuv(format) ? repeated_planes(*frame_, format) : rgb();
  }
  Image rgb() override { return converted_to_rgb(*frame_, sws_); }
  std::string name() const override { return fmt::format("frame {}", frames_ - 1); }

 private:
  void feed();

  std::string path_;
  AvInputPtr input_;
  int stream_;
  AvCodecContextPtr decoder_;
  AvPacketPtr packet_;
  AvFramePtr frame_;
  SwsPtr sws_;
  std::int64_t frames_ = 0;
};

bool VideoReader::next() {
  while (true) {
    const int code = avcodec_receive_frame(decoder_.get(), frame_.get());
    if (code == AVERROR_EOF) return false;
    if (code == AVERROR(EAGAIN)) {
      feed();
      continue;
    }
    check_av_read(code, "decode", path_);
    ++frames_;
    return true;
  }
}

/// Hands one packet to the decoder, or tells it that there are no more.
void VideoReader::feed() {
  while (true) {
    const int code = av_read_frame(input_.get(), packet_.get());
    if (code == AVERROR_EOF) break;
    check_av_read(code, "read", path_);
    const bool is_video = packet_->stream_index == stream_;
    if (is_video) {
      check_av_read(avcodec_send_packet(decoder_.get(), packet_.get()), "decode", path_);
    }
    av_packet_unref(packet_.get());
    if (is_video) return;
  }
  check_av_read(avcodec_send_packet(decoder_.get(), nullptr), "decode", path_);
}

}  // namespace

std::unique_ptr<FrameReader> decode_video_file(const std::string& path) {
  return std::make_unique<VideoReader>(path);
}

}  // namespace piblocks
