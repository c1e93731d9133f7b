#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <memory>
#include <optional>
#include <utility>

#include "h264/parameter_sets.hpp"
#include "media/libav/video_encoder.hpp"
#include "media/libav/video_file.hpp"
#include "media/mp4/h264_chunk.hpp"

namespace piblocks {
namespace {

std::optional<SoundEncoder> sound_encoder(const OutputRequest& request,
                                          const Container& container) {
  if (!request.sound) return std::nullopt;
  return std::optional<SoundEncoder>(std::in_place, container.sound, *request.sound);
}

/// What a file is made of. The functions of an output share it.
struct LibavParts {
  LibavParts(const OutputRequest& request, const Container& container, EncoderSetup setup)
      : pictures(request.format, std::move(setup)), sound(sound_encoder(request, container)) {}

  VideoEncoder pictures;
  std::optional<SoundEncoder> sound;
};

/// The same with pictures by our own encoder.
struct OwnParts {
  OwnParts(const OutputRequest& request, const Container& container)
      : pictures(request.format, request.settings),
        stream(h264_stream(request.format, pictures.headers, pictures.level_idc)),
        sound(sound_encoder(request, container)) {}

  H264Stream pictures;
  VideoStream stream;
  std::optional<SoundEncoder> sound;
};

/// Adds the sound of `parts`, an LibavParts or OwnParts, to an output that has all else but its
/// sink.
template <typename Parts>
Output with_file(Output output, const OutputRequest& request, const Container& container,
                 const std::shared_ptr<const Parts>& parts, const VideoStream& stream) {
  output.signature = fmt::format("{} by {}", container.muxer, output.signature);
  output.open = [name = request.name, &container, parts, &stream](const Opening& /*opening*/) {
    return open_video_file(name, container, stream, parts->sound ? &*parts->sound : nullptr);
  };
  if (parts->sound) {
    output.signature += ", sound by " + parts->sound->signature();
    output.encode_sound = [parts](SampleSource& samples) { return parts->sound->encode(samples); };
  }
  return output;
}

Output encoded_output(const OutputRequest& request, const Container& container,
                      EncoderSetup setup) {
  const auto parts = std::make_shared<const LibavParts>(request, container, std::move(setup));
  return with_file({.frames_per_chunk = parts->pictures.frames_per_chunk(),
                    .signature = parts->pictures.signature(),
                    .make_encoder = [parts] { return libav_chunk_encoder(parts->pictures); },
                    .open = {}},
                   request, container, parts, parts->pictures.stream());
}

/// H.264 in MP4 or MOV: our own, unless something is asked for that only libavcodec's encoders do.
Output h264_output(const OutputRequest& request, const Container& container) {
  check_duration_of_frame(request.format.frame_rate);
  if (!is_builtin(request.settings)) {
    EncoderSetup setup = h264_setup(request.format, request.settings, container.encoders);
    Output output = encoded_output(request, container, std::move(setup));
    output.notes = h264_notes(request.format);
    return output;
  }
  const auto parts = std::make_shared<const OwnParts>(request, container);
  return with_file(
      {.frames_per_chunk = parts->pictures.frames_per_chunk,
       .signature = parts->pictures.signature(),
       .make_encoder = [parts] { return h264_chunk_encoder(parts->pictures, h264_successor); },
       .open = {},
       .notes = h264_notes(request.format)},
      request, container, parts, parts->stream);
}

/// Owns the encoder of the stream that its chunks are made for.
class SuccessorEncoder final : public ChunkEncoder {
 public:
  SuccessorEncoder(const VideoFormat& format, std::unique_ptr<const VideoEncoder> stream)
      : ChunkEncoder(format), stream_(std::move(stream)), encoder_(libav_chunk_encoder(*stream_)) {}

  void begin(std::int64_t first_frame) override { encoder_->begin(first_frame); }
  void encode() override { encoder_->encode(); }
  EncodedChunk finish() override { return encoder_->finish(); }
  std::string method() const override { return stream_->name(); }

 private:
  void convert(const ImageView& frame, std::span<const PixelRect> rects) override {
    encoder_->take(frame, rects);
  }

  std::unique_ptr<const VideoEncoder> stream_;
  std::unique_ptr<ChunkEncoder> encoder_;
};

}  // namespace

Output mp4_output_by_libav(const OutputRequest& request) { return h264_output(request, kMp4); }

Output mov_output(const OutputRequest& request) {
  if (!request.format.has_alpha && request.settings.encoder != kProres) {
    return h264_output(request, kMov);
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
    auto stream =
        std::make_unique<const VideoEncoder>(format, h264_setup(format, {}, {EncoderKind::h264}));
    const AVCodecParameters& parameters = *stream->stream().parameters;
    const ByteSpan headers(parameters.extradata, std::size_t(parameters.extradata_size));
    if (!h264::may_follow(headers, config)) return nullptr;
    return std::make_unique<SuccessorEncoder>(format, std::move(stream));
  } catch (const UsageError&) {
    return nullptr;  // there is no encoder
  }
}

}  // namespace piblocks
