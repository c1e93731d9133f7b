#include <fmt/format.h>

#include <cstdint>
#include <limits>
#include <memory>

#include "h264/bit_stream.hpp"
#include "media/libav/h264_chunk.hpp"
#include "media/libav/video_encoder.hpp"
#include "media/libav/video_file.hpp"
#include "media/output/output_kinds.hpp"

namespace piblocks {
namespace {

/// The quantiser of our own encoder; src/h264/README.md has the measurements.
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
    return h264::read_parameter_sets({stream.extradata, std::size_t(stream.extradata_size)});
  } catch (const h264::HeaderError& error) {
    if (is_asked_for) throw UsageError(error.what());
    return std::nullopt;
  }
}

/// The encoders of a file. The functions of an output share them.
struct Encoders {
  Encoders(const OutputRequest& request, const Container& container, EncoderSetup setup)
      : pictures(request.format, std::move(setup)) {
    if (request.sound) sound.emplace(container.sound, *request.sound);
  }

  VideoEncoder pictures;
  std::optional<SoundEncoder> sound;
};

Output encoded_output(const OutputRequest& request, const Container& container,
                      const std::shared_ptr<const Encoders>& encoders) {
  const auto& [pictures, sound] = *encoders;
  Output output = {.frames_per_chunk = pictures.frames_per_chunk(),
                   .signature = fmt::format("{} by {}", container.muxer, pictures.signature()),
                   .make_encoder = [encoders] { return libav_chunk_encoder(encoders->pictures); },
                   .open =
                       [name = request.name, &container, encoders] {
                         return open_video_file(name, container, encoders->pictures,
                                                encoders->sound ? &*encoders->sound : nullptr);
                       }};
  if (sound) {
    output.signature += ", sound by " + sound->signature();
    output.encode_sound = [encoders](SampleSource& samples) {
      return encoders->sound->encode(samples);
    };
  }
  return output;
}

/// H.264 in MP4 or MOV, with slices of our own if the stream can have them.
Output h264_output(const OutputRequest& request, const Container& container) {
  check_duration_of_frame(request.format.frame_rate);
  const auto encoders = std::make_shared<const Encoders>(
      request, container,
      h264_setup(request.format, settings_of_stream(request.settings), container.encoders));
  Output output = encoded_output(request, container, encoders);
  if (const auto sets = sets_for_damage(encoders->pictures, request.settings)) {
    output.signature += fmt::format(", changes at QP {}", kQp);
    const bool may_hand_over = request.settings.encoder != kDamage;
    output.make_encoder = [encoders, sets = *sets, may_hand_over] {
      return h264_chunk_encoder(encoders->pictures, sets, kQp, may_hand_over);
    };
  }
  return output;
}

}  // namespace

Output mp4_output(const OutputRequest& request) { return h264_output(request, kMp4); }

Output mov_output(const OutputRequest& request) {
  if (!request.format.has_alpha && request.settings.encoder != kProres) {
    return h264_output(request, kMov);
  }
  check_duration_of_frame(request.format.frame_rate);
  return encoded_output(request, kMov,
                        std::make_shared<const Encoders>(
                            request, kMov, prores_setup(request.format, request.settings)));
}

Output webm_output(const OutputRequest& request) {
  return encoded_output(request, kWebm,
                        std::make_shared<const Encoders>(
                            request, kWebm, webm_setup(request.format, request.settings)));
}

}  // namespace piblocks
