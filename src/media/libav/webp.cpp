// Animated WebP without loss: https://developers.google.com/speed/webp/docs/riff_container
// libwebp compresses the images, through libavcodec. Its other encoder there, libwebp_anim, keeps
// all frames until the end, and has them one after the other.
#include <fmt/format.h>

#include <algorithm>

#include "media/libav/av.hpp"
#include "media/libav/encoder_setup.hpp"
#include "media/output/animated_output.hpp"
#include "media/pixels/rgb24.hpp"

namespace piblocks {
namespace {

constexpr const char* kEncoder = "libwebp";
constexpr int kWebpMaxSide_px = 16383;  // libwebp's
constexpr int kMaxDuration_ms = (1 << 24) - 1;
constexpr std::size_t kWebpHead_bytes = 16;  // of an image, before its picture

/// For pictures of one size.
AvCodecContextPtr open_webp_encoder(const PixelRect& rect) {
  const AVCodec* const codec = avcodec_find_encoder_by_name(kEncoder);
  auto context = own_av<AvCodecContextPtr>(avcodec_alloc_context3(codec), kEncoder);
  context->width = rect.width_px;
  context->height = rect.height_px;
  context->pix_fmt = AV_PIX_FMT_BGRA;
  context->time_base = {1, 1};
  context->thread_count = 1;
  set_option(*context, "lossless", "1");
  check_av(avcodec_open2(context.get(), codec, nullptr), "open encoder", kEncoder);
  return context;
}

/// An image is the contents of a chunk ANMF, whose duration WebpSink fills in.
class WebpEncoder final : public AnimationEncoder {
 public:
  using AnimationEncoder::AnimationEncoder;

 private:
  Bytes encode_image(const ChangedPicture& picture) override {
    constexpr std::uint8_t kReplace = 2;  // else it is blended with what is there
    PixelRect rect = picture.changed();
    const auto make_even = [](int& at, int& size) {  // as places have to be
      size += at % 2;
      at -= at % 2;
    };
    make_even(rect.x_px, rect.width_px);
    make_even(rect.y_px, rect.height_px);
    Bytes image;
    for (const int value :
         {rect.x_px / 2, rect.y_px / 2, rect.width_px - 1, rect.height_px - 1, 0}) {
      append_little_endian(image, std::uint64_t(value), 3);
    }
    image.push_back(picture.view().has_alpha ? kReplace : 0);
    append_compressed(image, *pixels_of(picture, rect));
    return image;
  }
  /// Unless they have alpha, pixels that have not changed are transparent.
  static AvFramePtr pixels_of(const ChangedPicture& picture, const PixelRect& rect) {
    const ImageView view = picture.view();
    auto frame = own_av<AvFramePtr>(av_frame_alloc(), "picture");
    frame->width = rect.width_px;
    frame->height = rect.height_px;
    frame->format = AV_PIX_FMT_BGRA;
    check_av(av_frame_get_buffer(frame.get(), 0), "allocate", "picture");
    for (int i = 0; i < rect.height_px; ++i) {
      std::uint8_t* pixel = frame->data[0] + std::ptrdiff_t{i} * frame->linesize[0];
      pack_row_rgba(view, rect, rect.y_px + i, pixel);
      const std::uint8_t* const marks = picture.marks(rect.y_px + i) + rect.x_px;
      for (int x = 0; x < rect.width_px; ++x, pixel += 4) {
        std::swap(pixel[0], pixel[2]);
        if (!view.has_alpha && marks[x] == 0) std::fill_n(pixel, 4, std::uint8_t{0});
      }
    }
    return frame;
  }
  /// The compressed picture without the header of a file.
  static void append_compressed(Bytes& image, const AVFrame& frame) {
    constexpr std::size_t kHeader_bytes = 12;
    const AvCodecContextPtr encoder = open_webp_encoder({0, 0, frame.width, frame.height});
    const auto packet = own_av<AvPacketPtr>(av_packet_alloc(), "packet");
    check_av(avcodec_send_frame(encoder.get(), &frame), "encode a frame with", kEncoder);
    check_av(avcodec_receive_packet(encoder.get(), packet.get()), "encode a frame with", kEncoder);
    append(image, ByteSpan(packet->data, std::size_t(packet->size)).subspan(kHeader_bytes));
  }
};

/// @param contents  of an even size, as libwebp's are
void append_riff_chunk(Bytes& bytes, std::string_view type, ByteSpan contents) {
  append(bytes, type);
  append_little_endian(bytes, contents.size(), 4);
  append(bytes, contents);
}

class WebpSink final : public AnimationSink {
 public:
  explicit WebpSink(const OutputRequest& request) : AnimationSink(request, kWebpHead_bytes) {
    constexpr std::uint64_t kAnimation = 0x02;
    constexpr std::uint64_t kAlpha = 0x10;  // of images
    Bytes canvas;
    append_little_endian(canvas, kAnimation | kAlpha, 4);
    append_little_endian(canvas, std::uint64_t(request.format.width_px - 1), 3);
    append_little_endian(canvas, std::uint64_t(request.format.height_px - 1), 3);
    Bytes animation;
    append_little_endian(animation, 0, 4);  // no background
    append_little_endian(animation, std::uint64_t(plays()), 2);
    Bytes bytes;
    piblocks::append(bytes, std::string_view("RIFF\0\0\0\0WEBP", 12));  // write_end(): the size
    append_riff_chunk(bytes, "VP8X", canvas);
    append_riff_chunk(bytes, "ANIM", animation);
    write(bytes);
  }

 private:
  void write_image(Bytes image, std::int64_t first, std::int64_t end) override {
    constexpr std::ptrdiff_t kDuration_at = 12;
    Bytes duration;
    append_little_endian(duration, ticks_of(first, end, 1000), 3);
    std::ranges::copy(duration, image.begin() + kDuration_at);
    Bytes bytes;
    append_riff_chunk(bytes, "ANMF", image);
    write(bytes);
  }
  void write_end() override {
    Bytes size;
    append_little_endian(size, size_bytes_ - 8, 4);
    file().write_at(4, size);
  }
  void write(ByteSpan bytes) {
    constexpr std::uint64_t kMaxFile_bytes = 0xFFFFFFF6 + 8ULL;
    size_bytes_ += bytes.size();
    if (size_bytes_ > kMaxFile_bytes) {
      throw MediaError(
          fmt::format("webp: '{}' would exceed 4 GiB, where WebP ends", request().name));
    }
    file().write(bytes);
  }

  std::uint64_t size_bytes_ = 0;
};

}  // namespace

Output webp_output(const OutputRequest& request) {
  constexpr std::int64_t kFramesPerChunk = 50;
  const VideoFormat& format = request.format;
  Problems problems;
  if (avcodec_find_encoder_by_name(kEncoder) == nullptr) {
    problems.add("webp: cannot find encoder 'libwebp' in libavcodec; write *.apng or *.gif");
  }
  if (std::max(format.width_px, format.height_px) > kWebpMaxSide_px) {
    problems.add(fmt::format("webp: size {}x{} is out of range: use sides of 1 to {}",
                             format.width_px, format.height_px, kWebpMaxSide_px));
  }
  if (format.frame_rate > kMaxFrameRate_webp || 1000 / format.frame_rate > kMaxDuration_ms) {
    problems.add(
        fmt::format("webp: frame rate {} is out of range: use {} or less, down to a frame in {} s",
                    format.frame_rate.get_str(), kMaxFrameRate_webp, kMaxDuration_ms / 1000));
  }
  problems.check();
  const std::int64_t longest = Integer(floor(kMaxDuration_ms * format.frame_rate / 1000)).get_si();
  return animated_output<WebpEncoder, WebpSink>(
      request, kFramesPerChunk, longest, "webp by libavcodec " + version_text(avcodec_version()));
}

}  // namespace piblocks
