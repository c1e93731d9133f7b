#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "h264/bit_stream.hpp"
#include "media/libav/damage_chunk.hpp"
#include "media/libav/video_chunk.hpp"
#include "media/libav/video_encoder.hpp"
#include "media/libav/video_file.hpp"
#include "media/output/output_kinds.hpp"

namespace piblocks {
namespace {

/// Of our own encoder; src/h264/README.md has the measurements.
constexpr int kQp = 14;

/// In MP4 and MOV, libavformat 59 counts time in units of one over the frame rate's numerator,
/// which it doubles up to 10,000, and has 31 bits for the duration of a frame (movenc.c).
/// @throws UsageError if a frame lasts longer.
void check_duration_of_frame(const Rational& frame_rate) {
  constexpr int kFewestUnits = 10'000;
  const Integer longest = std::numeric_limits<std::int32_t>::max() - 1;
  Integer units_per_s = frame_rate.get_num();
  while (units_per_s < kFewestUnits) units_per_s *= 2;
  if (units_per_s / frame_rate <= longest) return;
  const Integer longest_s = longest / units_per_s;
  throw UsageError(
      fmt::format("output: frame rate {} is too low for *.mp4 and *.mov: a frame can last {} s at "
                  "most; use --fps 1/100000 or more, or write *.webm or *.png",
                  frame_rate.get_str(), longest_s.get_str()));
}

/// The settings of the encoder whose headers the stream has.
/// @throws UsageError if a setting is given for our own encoder.
EncoderSettings settings_of_stream(const EncoderSettings& settings) {
  if (settings.encoder != kDamage) return settings;
  Problems problems;
  if (settings.crf) problems.add(no_crf(kDamage));
  if (settings.preset) problems.add(no_preset(kDamage));
  problems.check();
  return {};
}

/// The parameter sets that slices of our own need; nothing if the stream gets none.
/// @throws UsageError if such slices are asked for, but the stream cannot have them.
std::optional<h264::ParameterSets> sets_for_damage(const VideoEncoder& encoder,
                                                   const EncoderSettings& settings) {
  const bool is_asked_for = settings.encoder == kDamage;
  if (!is_asked_for && (settings.encoder || settings.crf || settings.preset)) return std::nullopt;
  const AVCodecParameters& stream = encoder.parameters();
  try {
    return h264::read_parameter_sets(
        {stream.extradata, static_cast<std::size_t>(stream.extradata_size)});
  } catch (const h264::HeaderError& error) {
    if (is_asked_for) throw UsageError(error.what());
    return std::nullopt;
  }
}

/// A stream of libavcodec's, and one of sound if it is asked for.
class EncodedOutput : public Output {
 public:
  EncodedOutput(const OutputRequest& request, const Container& container, CodecChoice choice)
      : name_(request.name), container_(container), encoder_(request.format, std::move(choice)) {
    if (request.sound) sound_.emplace(container.sound, *request.sound);
  }
  std::int64_t frames_per_chunk() const override { return encoder_.frames_per_chunk(); }
  std::unique_ptr<ChunkEncoder> make_encoder() const override {
    return std::make_unique<VideoChunkEncoder>(encoder_);
  }
  std::string signature() const override {
    std::string signature = fmt::format("{} by {}", container_.muxer, encoder_.signature());
    if (sound_) signature += ", sound by " + sound_->signature();
    return signature;
  }
  std::unique_ptr<PacketSource> encode_sound(SampleSource& samples) const override {
    return sound_ ? sound_->encode(samples) : Output::encode_sound(samples);
  }
  std::unique_ptr<FrameSink> open() const override {
    return open_video_file(name_, encoder_, container_, sound_ ? &*sound_ : nullptr);
  }

 protected:
  const VideoEncoder& encoder() const noexcept { return encoder_; }

 private:
  std::string name_;
  const Container& container_;
  VideoEncoder encoder_;
  std::optional<SoundEncoder> sound_;
};

/// H.264 in MP4 or MOV, with slices of our own if the stream can have them.
class H264Output final : public EncodedOutput {
 public:
  H264Output(const OutputRequest& request, const Container& container)
      : EncodedOutput(
            request, container,
            h264_choice(request.format, settings_of_stream(request.settings), container.encoders)),
        sets_(sets_for_damage(encoder(), request.settings)),
        when_too_much_(request.settings.encoder == kDamage ? WhenTooMuch::go_on
                                                           : WhenTooMuch::leave_to_stream_encoder) {
  }
  std::unique_ptr<ChunkEncoder> make_encoder() const override {
    if (!sets_) return EncodedOutput::make_encoder();
    return std::make_unique<DamageChunkEncoder>(encoder(), *sets_, kQp, when_too_much_);
  }
  std::string signature() const override {
    const std::string signature = EncodedOutput::signature();
    return sets_ ? fmt::format("{}, changes at QP {}", signature, kQp) : signature;
  }

 private:
  std::optional<h264::ParameterSets> sets_;
  WhenTooMuch when_too_much_;
};

}  // namespace

std::unique_ptr<Output> mp4_output(const OutputRequest& request) {
  check_duration_of_frame(request.format.frame_rate);
  return std::make_unique<H264Output>(request, kMp4);
}

std::unique_ptr<Output> mov_output(const OutputRequest& request) {
  check_duration_of_frame(request.format.frame_rate);
  const bool is_prores = request.format.has_alpha || request.settings.encoder == kProres;
  if (!is_prores) return std::make_unique<H264Output>(request, kMov);
  return std::make_unique<EncodedOutput>(request, kMov,
                                         prores_choice(request.format, request.settings));
}

std::unique_ptr<Output> webm_output(const OutputRequest& request) {
  return std::make_unique<EncodedOutput>(request, kWebm,
                                         webm_choice(request.format, request.settings));
}

}  // namespace piblocks
