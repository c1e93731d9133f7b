#include "support/decode_video.hpp"

#include <piblocks/error.hpp>

#include <cmath>
#include <limits>

#include "media/libav/av.hpp"
#include "media/libav/decoded_frame.hpp"

extern "C" {
#include <libavutil/pixdesc.h>
}

namespace piblocks::testing_support {
namespace {

Rational to_rational(AVRational value) {
  return value.den == 0 ? Rational(0) : Rational(value.num) / value.den;
}

std::string name_of(const char* name) { return name == nullptr ? "?" : name; }

template <typename Tagged>  // AVCodecParameters or AVFrame
ColourTags tags_of(const Tagged& tagged, AVColorSpace matrix) {
  return {.matrix = name_of(av_color_space_name(matrix)),
          .primaries = name_of(av_color_primaries_name(tagged.color_primaries)),
          .transfer = name_of(av_color_transfer_name(tagged.color_trc)),
          .range = name_of(av_color_range_name(tagged.color_range)),
          .chroma_location = name_of(av_chroma_location_name(tagged.chroma_location))};
}

/// rgb_of() is held to exact arithmetic by decoded_rgb_test.cpp.
Pixels pixels_of(const AVFrame& frame, const std::string& path) {
  Pixels pixels(frame.width, frame.height);
  pixels.words = flattened(rgb_of(frame, path)).words;
  return pixels;
}

DecodedFrame decoded_frame(const AVFrame& frame, const AVStream& stream, const std::string& path) {
  return {.time_s = Rational(frame.best_effort_timestamp) * to_rational(stream.time_base),
          .key_frame = is_key_frame(frame),
          .rgb = pixels_of(frame, path)};
}

AvCodecContextPtr open_decoder(const AVStream& stream) {
  const AVCodec* codec = avcodec_find_decoder(stream.codecpar->codec_id);
  if (codec == nullptr) throw MediaError("decode: no decoder for the stream");
  auto context = own_av<AvCodecContextPtr>(avcodec_alloc_context3(codec), codec->name);
  check_av(avcodec_parameters_to_context(context.get(), stream.codecpar), "set up", codec->name);
  context->thread_count = 1;
  check_av(avcodec_open2(context.get(), codec, nullptr), "open decoder", codec->name);
  return context;
}

}  // namespace

bool is_key_frame(const AVFrame& frame) noexcept {
#if LIBAVUTIL_VERSION_INT >= AV_VERSION_INT(58, 29, 100)  // FFmpeg 6.1
  return (frame.flags & AV_FRAME_FLAG_KEY) != 0;
#else
  return frame.key_frame != 0;
#endif
}

DecodedStream decode_video(const std::filesystem::path& path,
                           const std::function<void(DecodedFrame&&)>& take) {
  silence_av();
  const AvInputPtr input = open_av_input(path);
  DecodedStream result;
  if (input->nb_streams > 0) {  // before libavformat has looked at the pictures
    const AVCodecParameters& header = *input->streams[0]->codecpar;
    result.container = tags_of(header, header.color_space);
  }
  check_av(avformat_find_stream_info(input.get(), nullptr), "read", path.string());
  const int index =
      check_av(av_find_best_stream(input.get(), AVMEDIA_TYPE_VIDEO, -1, -1, nullptr, 0),
               "find video in", path.string());
  const AVStream& stream = *input->streams[index];
  result.width_px = stream.codecpar->width;
  result.height_px = stream.codecpar->height;
  result.codec = avcodec_get_name(stream.codecpar->codec_id);
  result.frame_rate = to_rational(stream.avg_frame_rate);
  result.duration_s = Rational(stream.duration) * to_rational(stream.time_base);

  const AvCodecContextPtr decoder = open_decoder(stream);
  const auto frame = own_av<AvFramePtr>(av_frame_alloc(), "frame");
  const auto packet = own_av<AvPacketPtr>(av_packet_alloc(), "packet");
  const auto take_frames = [&] {
    while (true) {
      const int code = avcodec_receive_frame(decoder.get(), frame.get());
      if (code == AVERROR(EAGAIN) || code == AVERROR_EOF) return;
      check_av(code, "decode", path.string());
      result.pictures = tags_of(*frame, frame->colorspace);
      take(decoded_frame(*frame, stream, path));
    }
  };
  while (av_read_frame(input.get(), packet.get()) >= 0) {
    if (packet->stream_index == index) {
      result.packets.push_back({packet->pts, packet->dts});
      check_av(avcodec_send_packet(decoder.get(), packet.get()), "decode", path.string());
      take_frames();
    }
    av_packet_unref(packet.get());
  }
  check_av(avcodec_send_packet(decoder.get(), nullptr), "decode", path.string());
  take_frames();
  return result;
}

DecodedVideo decode_video(const std::filesystem::path& path) {
  DecodedVideo video;
  static_cast<DecodedStream&>(video) =
      decode_video(path, [&](DecodedFrame&& frame) { video.frames.push_back(std::move(frame)); });
  return video;
}

double psnr_db(double mean_squared_error) {
  if (mean_squared_error == 0) return std::numeric_limits<double>::infinity();
  return 10 * std::log10(255.0 * 255.0 / mean_squared_error);
}

double rgb_mean_squared_error(const Pixels& a, const Pixels& b) {
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < a.words.size(); ++i) {
    for (const int shift : {0, 8, 16}) {
      const int difference = static_cast<int>((a.words.at(i) >> shift) & 0xff) -
                             static_cast<int>((b.words.at(i) >> shift) & 0xff);
      sum += difference * difference;
    }
  }
  return static_cast<double>(sum) / (3 * static_cast<double>(a.words.size()));
}

}  // namespace piblocks::testing_support
