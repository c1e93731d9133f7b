#include "media/libav/video_encoder.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <new>
#include <span>
#include <utility>

#include "h264/nal_unit.hpp"
#include "media/pixels/yuv.hpp"

namespace piblocks {
namespace {

AVRational to_av(const Rational& value) {
  return {int(value.get_num().get_si()), int(value.get_den().get_si())};
}

void set_picture_format(AVCodecContext& context, const VideoFormat& format,
                        AVPixelFormat pixel_format) {
  context.width = format.width_px;
  context.height = format.height_px;
  context.pix_fmt = pixel_format;
  context.sample_aspect_ratio = {1, 1};
  context.colorspace = AVCOL_SPC_BT709;
  context.color_primaries = AVCOL_PRI_BT709;
  context.color_trc = AVCOL_TRC_BT709;
  context.color_range = AVCOL_RANGE_MPEG;
  context.chroma_sample_location = AVCHROMA_LOC_LEFT;
}

/// The headers that a context or parameters have.
ByteSpan extradata(const auto& stream) {
  return {stream.extradata, std::size_t(stream.extradata_size)};
}

template <typename Sample>
YuvView<Sample> view_of(const AVFrame& picture) {
  const auto plane = [&](int number) -> PlaneView<Sample> {
    return {reinterpret_cast<Sample*>(picture.data[number]), picture.linesize[number]};
  };
  return {plane(0), plane(1), plane(2), plane(3)};
}

void set_headers(AVCodecParameters& stream, ByteSpan headers) {
  void* const copy = av_mallocz(headers.size() + AV_INPUT_BUFFER_PADDING_SIZE);
  if (copy == nullptr) throw std::bad_alloc();
  stream.extradata = static_cast<std::uint8_t*>(copy);
  stream.extradata_size = int(headers.size());
  std::ranges::copy(headers, stream.extradata);
}

void convert_rect(const ImageView& frame, const PixelRect& rect, const AVFrame& picture) {
  if (picture.format == AV_PIX_FMT_YUV420P) {
    convert_to_yuv420(frame, chroma_aligned(rect, frame), view_of<std::uint8_t>(picture));
  } else if (picture.format == AV_PIX_FMT_YUVA420P) {
    convert_to_yuva420(frame, chroma_aligned(rect, frame), view_of<std::uint8_t>(picture));
  } else {
    convert_to_yuva444p10(frame, rect, view_of<std::uint16_t>(picture));
  }
}

/// Room for a picture of the stream, with the stream's tags.
AvFramePtr allocate_picture(const AVCodecParameters& stream) {
  auto picture = own_av<AvFramePtr>(av_frame_alloc(), "picture");
  picture->width = stream.width;
  picture->height = stream.height;
  picture->format = stream.format;
  picture->colorspace = stream.color_space;
  picture->color_primaries = stream.color_primaries;
  picture->color_trc = stream.color_trc;
  picture->color_range = stream.color_range;
  picture->chroma_location = stream.chroma_location;
  check_av(av_frame_get_buffer(picture.get(), 0), "allocate", "picture");
  return picture;
}

class LibavChunkEncoder final : public ChunkEncoder {
 public:
  LibavChunkEncoder(std::shared_ptr<const VideoEncoder> encoder, std::string method)
      : ChunkEncoder(encoder->format()),
        encoder_(std::move(encoder)),
        method_(std::move(method)),
        picture_(allocate_picture(*encoder_->stream().parameters)),
        packet_(own_av<AvPacketPtr>(av_packet_alloc(), "packet")) {}
  void begin(std::int64_t first_frame) override {
    context_ = encoder_->open();
    first_frame_ = first_frame;
    frames_ = 0;
  }
  void encode() override {
    picture_->pict_type = frames_ == 0 ? AV_PICTURE_TYPE_I : AV_PICTURE_TYPE_NONE;
    picture_->pts = frames_++;
    send(picture_.get());
  }
  EncodedChunk finish() override {
    send(nullptr);
    // As libx264 sets them for B-frames. But if a chunk is shorter than the delay of these, libx264
    // starts it late, and the packet before it would seem to last for several frames.
    std::int64_t dts = first_frame_ - context_->has_b_frames;
    for (Packet& packet : chunk_) packet.dts = dts++;
    context_.reset();
    return std::exchange(chunk_, {});
  }
  std::string method() const override { return method_; }

 private:
  void convert(const ImageView& frame, std::span<const PixelRect> rects) override {
    // Allocates only if the encoder still uses the last picture. libx264 copies it.
    check_av(av_frame_make_writable(picture_.get()), "refill", "picture");
    for (const PixelRect& rect : rects) convert_rect(frame, rect, *picture_);
  }
  /// Gives a picture, or null for the end, to the encoder, and takes its packets.
  void send(const AVFrame* picture) {
    check_av(avcodec_send_frame(context_.get(), picture), "encode a frame with",
             context_->codec->name);
    while (true) {
      const int code = avcodec_receive_packet(context_.get(), packet_.get());
      if (code == AVERROR(EAGAIN) || code == AVERROR_EOF) return;
      check_av(code, "encode a frame with", context_->codec->name);

      ByteSpan bytes(packet_->data, std::size_t(packet_->size));
      // libx264 signs the first picture of every encoder with 600 bytes. One copy in the video is
      // enough.
      const bool is_h264 = context_->codec_id == AV_CODEC_ID_H264;
      if (is_h264 && first_frame_ > 0 && chunk_.empty()) bytes = h264::without_user_data(bytes);
      chunk_.push_back({.bytes = {bytes.begin(), bytes.end()},
                        .pts = first_frame_ + packet_->pts,
                        .key_frame = (packet_->flags & AV_PKT_FLAG_KEY) != 0});
      if (picture_->format == AV_PIX_FMT_YUVA420P) {
        std::size_t size = 0;
        const std::uint8_t* const alpha =
            av_packet_get_side_data(packet_.get(), AV_PKT_DATA_MATROSKA_BLOCKADDITIONAL, &size);
        chunk_.back().bytes = with_alpha({bytes, {alpha, alpha == nullptr ? 0 : size}});
      }
      av_packet_unref(packet_.get());
    }
  }

  std::shared_ptr<const VideoEncoder> encoder_;
  std::string method_;
  AvFramePtr picture_;  // kept, since a frame changes little of it
  AvCodecContextPtr context_;
  std::int64_t first_frame_ = 0;
  std::int64_t frames_ = 0;
  AvPacketPtr packet_;
  EncodedChunk chunk_;
};

}  // namespace

VideoEncoder::VideoEncoder(const VideoFormat& format, EncoderSetup setup)
    : format_(format),
      setup_(std::move(setup)),
      stream_{to_av(format.frame_rate),
              own_av<AvParametersPtr>(avcodec_parameters_alloc(), "stream parameters")} {
  try {
    const AvCodecContextPtr first = open_unchecked();
    check_av(avcodec_parameters_from_context(stream_.parameters.get(), first.get()),
             "describe the stream of", name());
    if (first->codec_id == AV_CODEC_ID_AV1 && first->extradata_size == 0) take_headers(*first);
  } catch (const Error& error) {
    throw UsageError(fmt::format("{}; usable here: {}", error.what(),
                                 fmt::join(usable_encoders(setup_.alternatives), ", ")));
  }
}

/// libaom gives the stream's headers only beside its first packet.
void VideoEncoder::take_headers(AVCodecContext& context) const {
  const AvFramePtr picture = allocate_picture(*stream_.parameters);
  for (int plane = 0; plane < 3; ++plane) {
    const int rows = plane == 0 ? picture->height : picture->height / 2;
    std::fill_n(picture->data[plane], std::ptrdiff_t{rows} * picture->linesize[plane], 128);
  }
  picture->pts = 0;
  const auto packet = own_av<AvPacketPtr>(av_packet_alloc(), "packet");
  check_av(avcodec_send_frame(&context, picture.get()), "encode a frame with", name());
  check_av(avcodec_send_frame(&context, nullptr), "encode a frame with", name());
  check_av(avcodec_receive_packet(&context, packet.get()), "encode a frame with", name());
  std::size_t size = 0;
  const std::uint8_t* const headers =
      av_packet_get_side_data(packet.get(), AV_PKT_DATA_NEW_EXTRADATA, &size);
  if (headers == nullptr) {
    throw MediaError(fmt::format("video: encoder '{}' does not tell its headers", name()));
  }
  set_headers(*stream_.parameters, {headers, size});
}

std::string VideoEncoder::signature() const {
  return fmt::format("{}, libavcodec {}, {:02x}", name(), version_text(avcodec_version()),
                     fmt::join(extradata(*stream_.parameters), ""));
}

AvCodecContextPtr VideoEncoder::open() const {
  AvCodecContextPtr context = open_unchecked();
  if (context->extradata_size > 0 &&
      !std::ranges::equal(extradata(*context), extradata(*stream_.parameters))) {
    throw MediaError(
        fmt::format("video: cannot join the chunks of encoder '{}': their headers differ", name()));
  }
  return context;
}

AvCodecContextPtr VideoEncoder::open_unchecked() const {
  auto context = own_av<AvCodecContextPtr>(avcodec_alloc_context3(setup_.codec), name());
  set_picture_format(*context, format_, setup_.pixel_format);
  context->framerate = stream_.frame_rate;
  context->time_base = av_inv_q(stream_.frame_rate);
  // Never reached: the last chunk of a video may be one and a half times as long as the others.
  context->gop_size = 2 * setup_.frames_per_chunk;
  // Threads inside an encoder may change its output. Chunks run in parallel instead.
  context->thread_count = 1;
  context->flags =
      int(AV_CODEC_FLAG_GLOBAL_HEADER | AV_CODEC_FLAG_CLOSED_GOP | AV_CODEC_FLAG_BITEXACT);
  setup_.apply(*context);
  check_av(avcodec_open2(context.get(), setup_.codec, nullptr), "open encoder", name());
  return context;
}

VideoStream h264_stream(const VideoFormat& format, ByteSpan headers, int level_idc) {
  const auto context = own_av<AvCodecContextPtr>(avcodec_alloc_context3(nullptr), "H.264");
  set_picture_format(*context, format, AV_PIX_FMT_YUV420P);
  context->codec_type = AVMEDIA_TYPE_VIDEO;
  context->codec_id = AV_CODEC_ID_H264;
  context->profile = FF_PROFILE_H264_CONSTRAINED_BASELINE;
  context->level = level_idc;
  VideoStream stream{to_av(format.frame_rate),
                     own_av<AvParametersPtr>(avcodec_parameters_alloc(), "stream parameters")};
  check_av(avcodec_parameters_from_context(stream.parameters.get(), context.get()),
           "describe the stream of", "H.264");
  set_headers(*stream.parameters, headers);
  return stream;
}

std::unique_ptr<ChunkEncoder> libav_chunk_encoder(std::shared_ptr<const VideoEncoder> encoder,
                                                  std::string method) {
  return std::make_unique<LibavChunkEncoder>(std::move(encoder), std::move(method));
}

Bytes with_alpha(const PictureAndAlpha& both) {
  Bytes bytes(both.picture.begin(), both.picture.end());
  append(bytes, both.alpha);
  append_little_endian(bytes, both.alpha.size(), 4);
  return bytes;
}

PictureAndAlpha without_alpha(ByteSpan bytes) {
  const std::size_t coded = bytes.size() < 4 ? 0 : bytes.size() - 4;
  const std::size_t alpha = from_little_endian(bytes.subspan(coded));
  if (bytes.size() < 4 || alpha > coded) {
    throw MediaError("video: a packet is cut off where its transparency should be");
  }
  return {bytes.first(coded - alpha), bytes.subspan(coded - alpha, alpha)};
}

}  // namespace piblocks
