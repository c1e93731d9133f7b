// MP4 files of H.264 without sound.
#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <cstdint>
#include <memory>

#include "core/output_file.hpp"
#include "h264/mp4_writer.hpp"
#include "media/libav/av_module.hpp"
#include "media/mp4/h264_chunk.hpp"
#include "media/output/output_kinds.hpp"

namespace piblocks {
namespace {

class Mp4File final : public FrameSink {
 public:
  Mp4File(const std::string& name, const H264Stream& stream, std::int64_t frames)
      : file_(name),
        writer_(track_of(stream, frames),
                [this](std::uint64_t offset, ByteSpan bytes) { file_.write_at(offset, bytes); }) {}

  void append(const EncodedChunk& chunk) override {
    counter_.take(chunk);
    for (const Packet& packet : chunk) writer_.append(packet.bytes, packet.key_frame);
  }
  void finish() override {
    writer_.finish();
    file_.finish();
  }

 private:
  static h264::Mp4Track track_of(const H264Stream& stream, std::int64_t frames) {
    return {.width_px = stream.config.width_px,
            .height_px = stream.config.height_px,
            .rate = {stream.config.rate_numerator, stream.config.rate_denominator},
            .headers = stream.headers,
            .max_pictures = frames,
            // A chunk that is handed over has one more. No chunk but the last is shorter than half.
            .max_key_frames = std::min(frames, 4 * (frames / stream.frames_per_chunk + 1))};
  }

  OutputFile file_;
  h264::Mp4Writer writer_;
  FrameCounter counter_;
};

std::unique_ptr<ChunkEncoder> load_successor(const VideoFormat& format,
                                             const h264::Config& config) {
  try {
    return av_module().h264_successor(format, config);
  } catch (const MediaError&) {
    return nullptr;  // the module is not installed
  }
}

}  // namespace

Output mp4_output(const OutputRequest& request) {
  if (request.sound || !is_builtin(request.settings)) return av_module().mp4_output(request);
  check_duration_of_frame(request.format.frame_rate);
  const auto stream = std::make_shared<const H264Stream>(request.format, request.settings);
  return {.frames_per_chunk = stream->frames_per_chunk,
          .signature = "mp4 by " + stream->signature(),
          .make_encoder = [stream] { return h264_chunk_encoder(*stream, load_successor); },
          .open =
              [name = request.name, stream](const Opening& opening) {
                return std::make_unique<Mp4File>(name, *stream, opening.frames);
              },
          .notes = h264_notes(request.format)};
}

}  // namespace piblocks
