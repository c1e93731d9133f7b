// MP4 files of our own encoder, and sound for them that was encoded elsewhere.
#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include "core/output_file.hpp"
#include "media/libav/av_module.hpp"
#include "media/mp4/coded_sound.hpp"
#include "media/mp4/h264_chunk.hpp"
#include "media/output/output_kinds.hpp"

namespace piblocks {
namespace {

/// What a file is made of. The functions of an output share it.
struct Parts {
  explicit Parts(const OutputRequest& request)
      : pictures(request.format, request.settings), captions(request.captions) {
    if (!request.sound) return;
    if (request.sound->coded) {
      sound_track = request.sound->coded->track;
      sound_track->rate_hz = request.sound->rate_hz;
      sound_track->samples = request.sound->size;
    } else {
      sound = av_module().aac_sound(*request.sound);
      sound_track = sound->track;
    }
  }
  std::string signature() const {
    const std::string name = "mp4 by " + pictures.signature();
    return sound ? name + ", sound by " + sound->signature : name;
  }

  H264Stream pictures;
  std::optional<AacSound> sound;  // that is still to be encoded
  std::optional<h264::Mp4Sound> sound_track;
  std::vector<Caption> captions;
};

h264::Mp4Track track_of(const Parts& parts, std::int64_t frames) {
  const H264Stream& stream = parts.pictures;
  h264::Mp4Track track{
      .width_px = stream.config.width_px,
      .height_px = stream.config.height_px,
      .rate = {stream.config.rate_numerator, stream.config.rate_denominator},
      .headers = stream.headers,
      .max_pictures = frames,
      // A chunk that is handed over has one more. No chunk but the last is shorter than half.
      .max_key_frames = std::min(frames, 4 * (frames / stream.frames_per_chunk + 1))};
  track.sound = parts.sound_track;
  for (const auto& [frame, text] : parts.captions) track.captions.push_back({frame, text});
  return track;
}

class Mp4File final : public FrameSink {
 public:
  Mp4File(std::string name, std::shared_ptr<const Parts> parts, std::int64_t frames)
      : name_(std::move(name)),
        parts_(std::move(parts)),
        file_(name_),
        writer_(track_of(*parts_, frames),
                [this](std::uint64_t offset, ByteSpan bytes) { file_.write_at(offset, bytes); }) {}

  void take_sound(PacketSource& sound) override {
    if (!parts_->sound_track) return FrameSink::take_sound(sound);
    sound_ = &sound;
  }
  void append(const EncodedChunk& chunk) override {
    counter_.take(chunk);
    if (sound_ != nullptr) append_sound_before(counter_.frames());
    for (const Packet& packet : chunk) writer_.append(packet.bytes, packet.key_frame);
  }
  void finish() override {
    while (sound_ != nullptr && next_sound()) append_sound();
    if (parts_->sound_track && heard_ < parts_->sound_track->samples) {
      throw MediaError(
          fmt::format("sound: cannot write to '{}': the end of the sound is missing", name_));
    }
    writer_.finish();
    file_.finish();
  }

 private:
  const std::optional<Packet>& next_sound() {
    if (!packet_) packet_ = sound_->next();
    return packet_;
  }
  void append_sound() {
    writer_.append_sound(packet_->bytes);
    heard_ = packet_->pts + parts_->sound_track->packet_samples;
    packet_.reset();
  }
  /// Packets that begin before this frame is shown.
  void append_sound_before(std::int64_t frame) {
    const Rational begin = Rational(to_integer(frame)) * parts_->sound_track->rate_hz /
                           parts_->pictures.format.frame_rate;
    while (next_sound() && to_integer(packet_->pts) < begin) append_sound();
  }

  std::string name_;
  std::shared_ptr<const Parts> parts_;
  OutputFile file_;
  h264::Mp4Writer writer_;
  FrameCounter counter_;
  PacketSource* sound_ = nullptr;
  std::optional<Packet> packet_;  // of sound, the next one
  std::int64_t heard_ = 0;        // samples that are in the file
};

class CodedPackets final : public PacketSource {
 public:
  CodedPackets(const CodedSound& sound, const SoundFormat& format)
      : sound_(sound), end_(format.size) {}

  std::optional<Packet> next() override {
    const std::int64_t time =
        static_cast<std::int64_t>(next_) * sound_.track.packet_samples - sound_.track.delay;
    if (time >= end_ || next_ == sound_.packets.size()) return std::nullopt;
    return Packet{.bytes = sound_.packets[next_++], .pts = time, .dts = time};
  }

 private:
  const CodedSound& sound_;
  std::int64_t end_;
  std::size_t next_ = 0;
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

std::unique_ptr<PacketSource> packets_of(const CodedSound& sound, const SoundFormat& format) {
  return std::make_unique<CodedPackets>(sound, format);
}

Output mp4_output(const OutputRequest& request) {
  if (!is_builtin(request.settings)) {
    if (request.captions.empty()) return av_module().mp4_output(request);
    throw UsageError(
        "output: captions inside an MP4 need the encoder builtin; leave out either --captions or "
        "crf, preset, encoder and smallest");
  }
  check_duration_of_frame(request.format.frame_rate);
  const auto parts = std::make_shared<const Parts>(request);
  Output output{
      .frames_per_chunk = parts->pictures.frames_per_chunk,
      .signature = parts->signature(),
      .make_encoder = [parts] { return h264_chunk_encoder(parts->pictures, load_successor); },
      .open = [name = request.name, parts](const Opening& opening) -> std::unique_ptr<FrameSink> {
        return std::make_unique<Mp4File>(name, parts, opening.frames);
      },
      .notes = h264_notes(request.format)};
  if (parts->sound) {
    output.encode_sound = [parts](SampleSource& samples) { return parts->sound->encode(samples); };
  }
  return output;
}

}  // namespace piblocks
