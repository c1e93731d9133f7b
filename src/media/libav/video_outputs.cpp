#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <memory>
#include <utility>
#include <vector>

#include "h264/parameter_sets.hpp"
#include "media/libav/video_encoder.hpp"
#include "media/libav/video_file.hpp"
#include "media/mp4/h264_chunk.hpp"

namespace piblocks {
namespace {

/// Adds the sound to an output that has all else but its sink.
Output with_file(Output output, const OutputRequest& request, const Container& container,
                 std::shared_ptr<const VideoStream> stream) {
  std::shared_ptr<const SoundEncoder> sound;
  if (request.sound) sound = std::make_shared<const SoundEncoder>(container.sound, *request.sound);
  output.signature = fmt::format("{} by {}", container.muxer, output.signature);
  output.open = [name = request.name, &container, stream = std::move(stream),
                 sound](const Opening& /*opening*/) {
    return open_video_file(name, container, *stream, sound.get());
  };
  if (sound) {
    output.signature += ", sound by " + sound->signature();
    output.encode_sound = [sound](SampleSource& samples) { return sound->encode(samples); };
  }
  return output;
}

Output encoded_output(const OutputRequest& request, const Container& container,
                      EncoderSetup setup) {
  const auto encoder = std::make_shared<const VideoEncoder>(request.format, std::move(setup));
  return with_file({.frames_per_chunk = encoder->frames_per_chunk(),
                    .signature = encoder->signature(),
                    .make_encoder = [encoder] { return libav_chunk_encoder(encoder); }},
                   request, container, {encoder, &encoder->stream()});
}

/// H.264 in MP4 or MOV: our own, unless something is asked for that only libavcodec's encoders do.
/// @param kinds  of the encoders that may be asked for
Output h264_output(const OutputRequest& request, const Container& container,
                   const std::vector<EncoderKind>& kinds) {
  check_duration_of_frame(request.format.frame_rate);
  if (!is_builtin(request.settings)) {
    EncoderSetup setup = h264_setup(request.format, request.settings, kinds);
    Output output = encoded_output(request, container, std::move(setup));
    output.notes = h264_notes(request.format);
    return output;
  }
  const auto pictures = std::make_shared<const H264Stream>(request.format, request.settings);
  return with_file(
      {.frames_per_chunk = pictures->frames_per_chunk,
       .signature = pictures->signature(),
       .make_encoder = [pictures] { return h264_chunk_encoder(*pictures, h264_successor); },
       .notes = h264_notes(request.format)},
      request, container,
      std::make_shared<const VideoStream>(
          h264_stream(request.format, pictures->headers, pictures->level_idc)));
}

}  // namespace

Output mp4_output_by_libav(const OutputRequest& request) {
  return h264_output(request, kMp4, {EncoderKind::h264});
}

Output mov_output(const OutputRequest& request) {
  if (!request.format.has_alpha && request.settings.encoder != kProres) {
    return h264_output(request, kMov, {EncoderKind::h264, EncoderKind::prores});
  }
  check_duration_of_frame(request.format.frame_rate);
  return encoded_output(request, kEditorMov, prores_setup(request.format, request.settings));
}

Output webm_output(const OutputRequest& request) {
  return encoded_output(request, kWebm, webm_setup(request.format, request.settings));
}

std::unique_ptr<ChunkEncoder> h264_successor(const VideoFormat& format,
                                             const h264::Config& config) {
  try {
    const auto encoder =
        std::make_shared<const VideoEncoder>(format, h264_setup(format, {}, {EncoderKind::h264}));
    const AVCodecParameters& parameters = *encoder->stream().parameters;
    const ByteSpan headers(parameters.extradata, std::size_t(parameters.extradata_size));
    if (!h264::may_follow(headers, config)) return nullptr;
    return libav_chunk_encoder(encoder, encoder->name());
  } catch (const UsageError&) {
    return nullptr;  // there is no encoder
  }
}

}  // namespace piblocks
