#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <cstdint>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/output_file.hpp"
#include "media/damage_chunk.hpp"
#include "media/find_encoder.hpp"
#include "media/output_kinds.hpp"
#include "media/sound_stream.hpp"
#include "media/video_chunk.hpp"
#include "media/video_encoder.hpp"

extern "C" {
#include <libavutil/opt.h>
}

namespace piblocks {
namespace {

class Mp4Sink final : public FrameSink {
 public:
  /// @param sound  of the second stream, if there is one.
  Mp4Sink(const std::string& name, const VideoEncoder& encoder, const SoundEncoder* sound);

  void take_sound(PacketSource& sound) override;
  void append(const EncodedChunk& chunk) override;
  void finish() override;

 private:
  void add_stream();
  void write_header();
  void write(const Packet& packet);
  void check_index() const;

  std::string name_;
  const VideoEncoder& encoder_;
  TemporaryFile file_;
  AvOutputPtr muxer_;  // after file_: closed before the file is removed
  AvPacketPtr packet_;
  std::optional<SoundStream> sound_;
  FrameCounter counter_;
  std::int64_t packets_ = 0;
};

/// A muxer that writes to `path`. The protocol's name keeps libav from taking a colon in the path
/// for one.
AvOutputPtr open_muxer(const std::string& path, const std::string& name) {
  const std::string url = "file:" + path;
  AVFormatContext* allocated = nullptr;
  check_av(avformat_alloc_output_context2(&allocated, nullptr, "mp4", url.c_str()), "open", name);
  AvOutputPtr muxer(allocated);
  check_av(avio_open(&muxer->pb, url.c_str(), AVIO_FLAG_WRITE), "open", name);
  return muxer;
}

Mp4Sink::Mp4Sink(const std::string& name, const VideoEncoder& encoder, const SoundEncoder* sound)
    : name_(name),
      encoder_(encoder),
      file_(name),
      muxer_(open_muxer(file_.path(), name_)),
      packet_(own_av<AvPacketPtr>(av_packet_alloc(), "packet")) {
  add_stream();
  if (sound != nullptr) sound_.emplace(*sound, *muxer_, name_);
  write_header();
}

void Mp4Sink::take_sound(PacketSource& sound) {
  if (!sound_) return FrameSink::take_sound(sound);
  sound_->take(sound);
}

void Mp4Sink::add_stream() {
  AVStream* stream = avformat_new_stream(muxer_.get(), nullptr);
  if (stream == nullptr) throw std::bad_alloc();
  check_av(avcodec_parameters_copy(stream->codecpar, &encoder_.parameters()),
           "describe the stream of", name_);
  stream->time_base = av_inv_q(encoder_.frame_rate());
  stream->avg_frame_rate = encoder_.frame_rate();
  stream->r_frame_rate = encoder_.frame_rate();
  stream->sample_aspect_ratio = {1, 1};
}

void Mp4Sink::write_header() {
  // Neither the library's version nor the time of day: equal frames give equal bytes.
  muxer_->flags |= AVFMT_FLAG_BITEXACT;
  check_av(av_opt_set(muxer_->priv_data, "movflags", "+faststart", 0), "set up the muxer of",
           name_);
  check_av(avformat_write_header(muxer_.get(), nullptr), "write the header of", name_);
}

void Mp4Sink::append(const EncodedChunk& chunk) {
  counter_.take(chunk);
  for (const Packet& packet : chunk) write(packet);
}

void Mp4Sink::write(const Packet& packet) {
  if (sound_) sound_->write_until(packet.dts, av_inv_q(encoder_.frame_rate()));
  av_packet_unref(packet_.get());
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-const-cast): the muxer only reads what has no owner
  packet_->data = const_cast<std::uint8_t*>(packet.bytes.data());
  packet_->size = static_cast<int>(packet.bytes.size());
  packet_->pts = packet.pts;
  packet_->dts = packet.dts;
  packet_->duration = 1;
  packet_->flags = packet.key_frame ? AV_PKT_FLAG_KEY : 0;
  packet_->stream_index = 0;
  av_packet_rescale_ts(packet_.get(), av_inv_q(encoder_.frame_rate()),
                       muxer_->streams[0]->time_base);
  check_av(av_write_frame(muxer_.get(), packet_.get()), "write to", name_);
  ++packets_;
}

/// Where the pictures begin, if boxes fill the file and those of the pictures are the last.
/// ISO/IEC 14496-12, 4.2: a box begins with its size, four letters, and the size in 64 bits if 1
/// stands in place of it.
std::optional<std::int64_t> start_of_pictures(AVIOContext& file) {
  const std::int64_t end = avio_size(&file);
  std::int64_t at = 0;
  for (int boxes = 0; boxes < 8 && avio_seek(&file, at, SEEK_SET) == at; ++boxes) {
    std::int64_t size = avio_rb32(&file);
    const bool is_last = avio_rl32(&file) == MKTAG('m', 'd', 'a', 't');
    if (size == 1) size = static_cast<std::int64_t>(avio_rb64(&file));
    if (is_last) return at + size == end ? std::optional(avio_tell(&file)) : std::nullopt;
    if (size < 8 || size > end - at) return std::nullopt;
    at += size;
  }
  return std::nullopt;
}

/// Whether the indices name these numbers of packets, one by one from there to the end, in whatever
/// order the streams take turns.
bool is_complete(std::span<AVStream* const> streams, std::span<const std::int64_t> packets,
                 std::int64_t start, std::int64_t end) {
  if (streams.size() != packets.size()) return false;
  std::vector<int> next(streams.size(), 0);
  for (std::size_t i = 0; i < streams.size(); ++i) {
    if (avformat_index_get_entries_count(streams[i]) != packets[i]) return false;
  }
  bool found = true;
  while (found) {
    found = false;
    for (std::size_t i = 0; i < streams.size(); ++i) {
      while (next[i] < packets[i]) {
        const AVIndexEntry* const entry = avformat_index_get_entry(streams[i], next[i]);
        if (entry->pos != start) break;
        start += entry->size;
        ++next[i];
        found = true;
      }
    }
  }
  return start == end;
}

/// Reads the index back: short of memory, libavformat may leave something out of it and report
/// nothing.
void Mp4Sink::check_index() const {
  const AvInputPtr file = open_av_input(file_.path());
  const AVCodecParameters& written = encoder_.parameters();
  const auto is_ours = [&](const AVCodecParameters& read) {
    return read.codec_id == written.codec_id &&
           (read.extradata_size > 0) == (written.extradata_size > 0);
  };
  const auto start = start_of_pictures(*file->pb);
  std::vector<std::int64_t> packets = {packets_};
  if (sound_) packets.push_back(sound_->packets());
  const std::span streams(file->streams, file->nb_streams);
  if (!start || streams.empty() || !is_ours(*streams[0]->codecpar) ||
      !is_complete(streams, packets, *start, avio_size(file->pb))) {
    throw MediaError(fmt::format("video: the index of '{}' was not written whole", name_));
  }
}

void Mp4Sink::finish() {
  if (sound_) sound_->write_all();
  check_av(av_write_trailer(muxer_.get()), "write the index of", name_);
  avio_flush(muxer_->pb);
  check_av(muxer_->pb->error, "write to", name_);
  check_av(avio_closep(&muxer_->pb), "close", name_);
  check_index();
  file_.commit();
}

/// What it quantises by; src/media/README.md has the measurements.
constexpr int kQp = 14;

/// Those of the encoder whose headers the stream has.
/// @throws UsageError if something else is said to an encoder of our own.
EncoderSettings settings_of_stream(const EncoderSettings& settings) {
  if (settings.encoder != kDamage) return settings;
  std::vector<std::string> problems;
  if (settings.crf) problems.emplace_back("video: encoder 'damage' has no crf; leave it out");
  if (settings.preset) {
    problems.emplace_back("video: encoder 'damage' has no presets; leave the preset out");
  }
  if (!problems.empty()) throw UsageError(std::move(problems));
  return {};
}

/// What slices of our own have to fit, if the stream is to have such.
/// @throws UsageError if it is to, but cannot.
std::optional<h264::ParameterSets> sets_for_damage(const VideoEncoder& encoder,
                                                   const EncoderSettings& settings) {
  const bool is_asked_for = settings.encoder == kDamage;
  if (!is_asked_for && (settings.encoder || settings.crf || settings.preset)) return std::nullopt;
  const AVCodecParameters& stream = encoder.parameters();
  try {
    return h264::read_parameter_sets(
        {stream.extradata, static_cast<std::size_t>(stream.extradata_size)});
  } catch (const MediaError& error) {
    if (is_asked_for) throw UsageError(error.what());
    return std::nullopt;
  }
}

class Mp4Output final : public Output {
 public:
  explicit Mp4Output(const OutputRequest& request)
      : name_(request.name),
        encoder_(request.format, settings_of_stream(request.settings)),
        sets_(sets_for_damage(encoder_, request.settings)),
        when_too_much_(request.settings.encoder == kDamage ? WhenTooMuch::go_on
                                                           : WhenTooMuch::leave_to_stream_encoder) {
    if (request.sound) sound_.emplace(kAac, *request.sound);
  }
  std::int64_t frames_per_chunk() const override { return encoder_.frames_per_chunk(); }
  std::unique_ptr<ChunkEncoder> make_encoder() const override {
    if (sets_) return std::make_unique<DamageChunkEncoder>(encoder_, *sets_, kQp, when_too_much_);
    return std::make_unique<VideoChunkEncoder>(encoder_);
  }
  std::string signature() const override {
    std::string text = "mp4 by " + encoder_.signature();
    if (sets_) text += fmt::format(", changes at QP {}", kQp);
    if (sound_) text += ", sound by " + sound_->signature();
    return text;
  }
  std::unique_ptr<PacketSource> encode_sound(SampleSource& samples) const override {
    return sound_ ? sound_->encode(samples) : Output::encode_sound(samples);
  }
  std::unique_ptr<FrameSink> open() const override {
    return std::make_unique<Mp4Sink>(name_, encoder_, sound_ ? &*sound_ : nullptr);
  }

 private:
  std::string name_;
  VideoEncoder encoder_;
  std::optional<h264::ParameterSets> sets_;
  WhenTooMuch when_too_much_;
  std::optional<SoundEncoder> sound_;
};

}  // namespace

std::unique_ptr<Output> mp4_output(const OutputRequest& request) {
  return std::make_unique<Mp4Output>(request);
}

}  // namespace piblocks
