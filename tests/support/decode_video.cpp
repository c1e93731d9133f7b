#include "support/decode_video.hpp"

#include <piblocks/error.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include "media/libav/av.hpp"
#include "media/libav/av_versions.hpp"

extern "C" {
#include <libavutil/pixdesc.h>
}

namespace piblocks::testing_support {
namespace {

using AvInputPtr = std::unique_ptr<AVFormatContext, AvDeleter<avformat_close_input>>;

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

std::uint32_t to_rgb(double y, double cb, double cr) {
  const double luma = (y - 16) * 255 / 219;
  const double blue = (cb - 128) * 255 / 224 * 1.8556;
  const double red = (cr - 128) * 255 / 224 * 1.5748;
  const auto level = [](double value) {
    return static_cast<std::uint32_t>(std::lround(std::clamp(value, 0.0, 255.0)));
  };
  const double green = (0.2126 * red + 0.0722 * blue) / 0.7152;
  return 0xff000000 | level(luma + red) << 16 | level(luma - green) << 8 | level(luma + blue);
}

/// Chroma at a full-resolution pixel: sited left, so on even columns and between rows.
double chroma_at(const AVFrame& frame, int plane, int x, int y) {
  const int columns = frame.width / 2;
  const int rows = frame.height / 2;
  const auto sample = [&](int column, int row) -> double {
    return frame.data[plane][std::clamp(row, 0, rows - 1) * frame.linesize[plane] +
                             std::min(column, columns - 1)];
  };
  const auto at_row = [&](int row) {
    const double left = sample(x / 2, row);
    return x % 2 == 0 ? left : (left + sample(x / 2 + 1, row)) / 2;
  };
  return 0.75 * at_row(y / 2) + 0.25 * at_row(y % 2 == 0 ? y / 2 - 1 : y / 2 + 1);
}

Pixels rgb_of(const AVFrame& frame) {
  Pixels pixels(frame.width, frame.height);
  for (int y = 0; y < frame.height; ++y) {
    const std::uint8_t* row = frame.data[0] + y * frame.linesize[0];
    for (int x = 0; x < frame.width; ++x) {
      if (frame.format == AV_PIX_FMT_RGB24) {
        const std::uint8_t* rgb = row + 3 * x;
        pixels.at(x, y) = 0xff000000u | static_cast<std::uint32_t>(rgb[0]) << 16 |
                          static_cast<std::uint32_t>(rgb[1]) << 8 | rgb[2];
      } else {
        pixels.at(x, y) = to_rgb(row[x], chroma_at(frame, 1, x, y), chroma_at(frame, 2, x, y));
      }
    }
  }
  return pixels;
}

DecodedFrame decoded_frame(const AVFrame& frame, const AVStream& stream) {
  if (frame.format != AV_PIX_FMT_YUV420P && frame.format != AV_PIX_FMT_RGB24) {
    throw MediaError("decode: the pixel format is neither yuv420p nor rgb24");
  }
  DecodedFrame decoded{
      .time_s = Rational(frame.best_effort_timestamp) * to_rational(stream.time_base),
      .key_frame = is_key_frame(frame),
      .rgb = rgb_of(frame),
      .luma = {}};
  for (int y = 0; y < frame.height && frame.format == AV_PIX_FMT_YUV420P; ++y) {
    const std::uint8_t* row = frame.data[0] + y * frame.linesize[0];
    decoded.luma.insert(decoded.luma.end(), row, row + frame.width);
  }
  return decoded;
}

AvInputPtr open_input(const std::filesystem::path& path) {
  AVFormatContext* allocated = nullptr;
  const std::string url = "file:" + path.string();
  check_av(avformat_open_input(&allocated, url.c_str(), nullptr, nullptr), "open", url);
  return AvInputPtr(allocated);
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

DecodedStream decode_video(const std::filesystem::path& path,
                           const std::function<void(DecodedFrame&&)>& take) {
  silence_av();
  const AvInputPtr input = open_input(path);
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
      take(decoded_frame(*frame, stream));
    }
  };
  while (av_read_frame(input.get(), packet.get()) >= 0) {
    if (packet->stream_index == index) {
      result.packets.push_back({packet->pts, packet->dts, static_cast<std::size_t>(packet->size),
                                (packet->flags & AV_PKT_FLAG_KEY) != 0});
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
