#include "media/libav/sound_stream.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <new>
#include <utility>

#include "media/libav/av_module.hpp"
#include "media/libav/encoder_setup.hpp"
#include "media/output/output_kinds.hpp"

namespace piblocks {
namespace {

constexpr int kChannels = 2;

const AVCodec* find(const SoundCodec& codec) {
  const AVCodec* const found = avcodec_find_encoder_by_name(codec.name);
  if (found != nullptr) return found;
  throw UsageError(fmt::format(
      "sound: libavcodec has no encoder '{}'; leave the sound out, or write *.wav", codec.name));
}

class SoundPackets final : public PacketSource {
 public:
  SoundPackets(AvCodecContextPtr context, SampleSource& samples)
      : context_(std::move(context)),
        samples_(samples),
        frame_(own_av<AvFramePtr>(av_frame_alloc(), "frame")),
        packet_(own_av<AvPacketPtr>(av_packet_alloc(), "packet")),
        block_(std::size_t(context_->frame_size) * kChannels) {}

  std::optional<Packet> next() override {
    int code = 0;
    while ((code = avcodec_receive_packet(context_.get(), packet_.get())) == AVERROR(EAGAIN)) {
      send_samples();
    }
    if (code == AVERROR_EOF) return std::nullopt;
    check_av(code, "encode with", context_->codec->name);
    const std::uint8_t* const bytes = packet_->data;
    return Packet{
        .bytes = {bytes, bytes + packet_->size}, .pts = packet_->pts, .dts = packet_->pts};
  }

 private:
  void send_samples() {
    const std::size_t count = samples_.read(block_);
    if (count == 0) {
      check_av(avcodec_send_frame(context_.get(), nullptr), "encode with", context_->codec->name);
      return;
    }
    av_frame_unref(frame_.get());
    frame_->format = context_->sample_fmt;
    frame_->nb_samples = int(count);
    frame_->sample_rate = context_->sample_rate;
    check_av(av_channel_layout_copy(&frame_->ch_layout, &context_->ch_layout), "describe", "sound");
    check_av(av_frame_get_buffer(frame_.get(), 0), "allocate", "sound");
    if (context_->sample_fmt == AV_SAMPLE_FMT_FLT) {
      std::copy_n(block_.begin(), count * kChannels, reinterpret_cast<float*>(frame_->data[0]));
    } else {
      for (std::size_t i = 0; i < count * kChannels; ++i) {
        reinterpret_cast<float*>(frame_->data[i % kChannels])[i / kChannels] = block_[i];
      }
    }
    frame_->pts = next_;
    next_ += std::int64_t(count);
    check_av(avcodec_send_frame(context_.get(), frame_.get()), "encode with",
             context_->codec->name);
  }

  AvCodecContextPtr context_;
  SampleSource& samples_;
  AvFramePtr frame_;
  AvPacketPtr packet_;
  std::vector<float> block_;
  std::int64_t next_ = 0;
};

}  // namespace

SoundEncoder::SoundEncoder(const SoundCodec& codec, SoundFormat format)
    : settings_(codec),
      format_(std::move(format)),
      codec_(find(codec)),
      parameters_(own_av<AvParametersPtr>(avcodec_parameters_alloc(), "parameters")) {
  const AvCodecContextPtr context = open();
  check_av(avcodec_parameters_from_context(parameters_.get(), context.get()), "describe",
           codec_->name);
  if (settings_.is_pcm) parameters_->frame_size = kPcmPacket_pairs;
}

AvCodecContextPtr SoundEncoder::open() const {
  auto context = own_av<AvCodecContextPtr>(avcodec_alloc_context3(codec_), codec_->name);
  context->sample_rate = format_.rate_hz;
  context->sample_fmt = settings_.format;
  av_channel_layout_default(&context->ch_layout, kChannels);
  context->bit_rate = settings_.bit_rate;
  if (settings_.bit_rate == 0) {
    context->flags |= AV_CODEC_FLAG_QSCALE;
    context->global_quality = int(settings_.quality * FF_QP2LAMBDA);
  }
  if (settings_.option != nullptr) set_option(*context, settings_.option, settings_.value);
  context->time_base = {1, format_.rate_hz};
  context->thread_count = 1;
  // Leaves the library's version out of the stream.
  context->flags |= AV_CODEC_FLAG_GLOBAL_HEADER | AV_CODEC_FLAG_BITEXACT;
  check_av(avcodec_open2(context.get(), codec_, nullptr), "open encoder", codec_->name);
  return context;
}

std::string SoundEncoder::signature() const {
  return fmt::format("{} at {} bit/s and quality {}, libavcodec {}", codec_->name,
                     settings_.bit_rate, settings_.quality, version_text(avcodec_version()));
}

std::unique_ptr<PacketSource> SoundEncoder::encode(SampleSource& samples) const {
  if (settings_.is_pcm) return pcm_packets(samples);
  return std::make_unique<SoundPackets>(open(), samples);
}

AacSound aac_sound(const SoundFormat& format) {
  const auto encoder = std::make_shared<const SoundEncoder>(kAac, format);
  const AVCodecParameters& parameters = encoder->parameters();
  return {
      .signature = encoder->signature(),
      .track = {.rate_hz = format.rate_hz,
                .config = {parameters.extradata, parameters.extradata + parameters.extradata_size},
                .packet_samples = encoder->packet_size(),
                .delay = parameters.initial_padding,
                .samples = format.size},
      .encode = [encoder](SampleSource& samples) { return encoder->encode(samples); }};
}

SoundStream::SoundStream(const SoundEncoder& encoder, AVFormatContext& muxer, bool from_zero,
                         std::string name)
    : encoder_(encoder),
      shift_(from_zero ? encoder.parameters().initial_padding : 0),
      muxer_(muxer),
      name_(std::move(name)),
      stream_(avformat_new_stream(&muxer, nullptr)),
      packet_(own_av<AvPacketPtr>(av_packet_alloc(), "packet")) {
  if (stream_ == nullptr) throw std::bad_alloc();
  check_av(avcodec_parameters_copy(stream_->codecpar, &encoder_.parameters()),
           "describe the sound of", name_);
  stream_->time_base = {1, encoder_.format().rate_hz};
}

bool SoundStream::fetch() {
  if (!next_ && source_ != nullptr) next_ = source_->next();
  return next_.has_value();
}

void SoundStream::write_until(std::int64_t time, AVRational time_base) {
  const AVRational samples = {1, encoder_.format().rate_hz};
  while (fetch() && av_compare_ts(next_->dts + shift_, samples, time, time_base) <= 0) write();
}

void SoundStream::write_all() {
  while (fetch()) write();
  if (is_whole_ || encoder_.format().size == 0) return;
  throw MediaError(
      fmt::format("sound: cannot write to '{}': the end of the sound is missing", name_));
}

void SoundStream::write() {
  av_packet_unref(packet_.get());
  packet_->data = next_->bytes.data();
  packet_->size = int(next_->bytes.size());
  packet_->pts = next_->pts + shift_;
  packet_->dts = next_->dts + shift_;
  // Silence fills up the last packet and is not counted.
  const std::int64_t whole = encoder_.packet_size();
  const std::int64_t size = encoder_.format().size;
  packet_->duration =
      next_->pts < 0 ? whole : std::clamp<std::int64_t>(size - next_->pts, 1, whole);
  is_whole_ = next_->pts >= size - whole;
  packet_->flags = AV_PKT_FLAG_KEY;
  packet_->stream_index = stream_->index;
  av_packet_rescale_ts(packet_.get(), {1, encoder_.format().rate_hz}, stream_->time_base);
  check_av(av_write_frame(&muxer_, packet_.get()), "write to", name_);
  ++packets_;
  next_.reset();
}

}  // namespace piblocks
