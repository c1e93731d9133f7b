#include <piblocks/error.hpp>

#include <utility>

#include "media/libav/av.hpp"
#include "screen/contenders.hpp"

extern "C" {
#include <libavutil/opt.h>
}

namespace piblocks::benchmark {
namespace {

using Options = std::vector<std::pair<const char*, std::string>>;

AvCodecContextPtr open_x264(const Options& options) {
  const AVCodec* const codec = avcodec_find_encoder_by_name("libx264");
  if (codec == nullptr) throw MediaError("libx264 is not in libavcodec");
  auto context = own_av<AvCodecContextPtr>(avcodec_alloc_context3(codec), codec->name);
  context->width = kScreenWidth_px;
  context->height = kScreenHeight_px;
  context->pix_fmt = AV_PIX_FMT_YUV420P;
  context->time_base = {1, kPicturesPerSecond};
  context->framerate = {kPicturesPerSecond, 1};
  context->gop_size = 600;
  context->thread_count = 1;
  context->color_range = AVCOL_RANGE_MPEG;
  for (const auto& [name, value] : options) {
    check_av(av_opt_set(context->priv_data, name, value.c_str(), 0), "set", name);
  }
  check_av(avcodec_open2(context.get(), codec, nullptr), "open encoder", codec->name);
  return context;
}

class X264Encoder : public PictureEncoder {
 public:
  explicit X264Encoder(const Options& options)
      : context_(open_x264(options)),
        frame_(own_av<AvFramePtr>(av_frame_alloc(), "frame")),
        packet_(own_av<AvPacketPtr>(av_packet_alloc(), "packet")) {}

  std::span<const std::uint8_t> encode(const Picture& picture) override {
    lend(picture);
    check_av(avcodec_send_frame(context_.get(), frame_.get()), "encode", "a picture");
    av_packet_unref(packet_.get());
    check_av(avcodec_receive_packet(context_.get(), packet_.get()), "encode without delay",
             "a picture");
    return {packet_->data, std::size_t(packet_->size)};
  }

 private:
  /// Without a buffer of its own, the frame would be copied by libavcodec.
  void lend(const Picture& picture) {
    av_frame_unref(frame_.get());
    auto* const samples = const_cast<std::uint8_t*>(picture.y());
    frame_->buf[0] = av_buffer_create(
        samples, picture.samples.size(), [](void*, std::uint8_t*) {}, nullptr,
        AV_BUFFER_FLAG_READONLY);
    frame_->format = AV_PIX_FMT_YUV420P;
    frame_->width = kScreenWidth_px;
    frame_->height = kScreenHeight_px;
    frame_->pts = pts_++;
    frame_->data[0] = samples;
    frame_->data[1] = const_cast<std::uint8_t*>(picture.cb());
    frame_->data[2] = const_cast<std::uint8_t*>(picture.cr());
    frame_->linesize[0] = kScreenWidth_px;
    frame_->linesize[1] = frame_->linesize[2] = kScreenWidth_px / 2;
  }

  AvCodecContextPtr context_;
  AvFramePtr frame_;
  AvPacketPtr packet_;
  std::int64_t pts_ = 0;
};

/// "x264 core 164 r3095 baee400", as its streams say.
std::string x264_version() {
  const Picture black = {.samples = std::vector<std::uint8_t>(Picture::kLuma / 2 * 3),
                         .changed = {}};
  X264Encoder encoder({{"preset", "ultrafast"}, {"tune", "zerolatency"}});
  const auto unit = encoder.encode(black);
  const std::string bytes(unit.begin(), unit.end());
  const std::size_t at = bytes.find("x264 - core");
  return at == std::string::npos ? "x264" : bytes.substr(at, bytes.find(" - H.264", at) - at);
}

Contender x264(const std::string& name, const std::string& settings, const Options& options) {
  Contender contender = {
      .name = name, .version = x264_version(), .settings = settings, .has_qp = true, .make = {}};
  contender.make = [options](int qp) {
    Options all = options;
    all.emplace_back("qp", std::to_string(qp));
    return std::make_unique<X264Encoder>(all);
  };
  return contender;
}

}  // namespace

std::vector<Contender> x264_contenders() {
  silence_av();
  // Without tune zerolatency, even ultrafast gives each picture one call later.
  const Options ultrafast = {{"preset", "ultrafast"}, {"tune", "zerolatency"}};
  const Options animation = {{"preset", "veryfast"}, {"tune", "animation,zerolatency"}};
  Contender crf =
      x264("libx264 ultrafast CRF 18", "preset ultrafast; tune zerolatency; CRF 18", {});
  crf.has_qp = false;
  crf.make = [ultrafast](int) {
    Options all = ultrafast;
    all.emplace_back("crf", "18");
    return std::make_unique<X264Encoder>(all);
  };
  return {x264("libx264 ultrafast", "preset ultrafast; tune zerolatency; constant QP", ultrafast),
          x264("libx264 veryfast animation",
               "preset veryfast; tune animation and zerolatency; constant QP", animation),
          std::move(crf)};
}

}  // namespace piblocks::benchmark
