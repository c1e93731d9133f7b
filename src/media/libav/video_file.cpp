#include "media/libav/video_file.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <fstream>
#include <new>
#include <optional>
#include <utility>

#include "core/output_file.hpp"
#include "h264/levels.hpp"
#include "h264/mp4_writer.hpp"
#include "h264/parameter_sets.hpp"
#include "media/mp4/h264_chunk.hpp"
#include "media/output/output_kinds.hpp"

extern "C" {
#include <libavutil/opt.h>
}

namespace piblocks {
namespace {

/// Where the data of the pictures begins, if boxes fill the file and mdat is the last.
/// ISO/IEC 14496-12, 4.2: a box begins with its size and four letters; after 1, a size of 64 bits.
std::optional<std::int64_t> start_of_pictures(AVIOContext& file) {
  const std::int64_t end = avio_size(&file);
  std::int64_t at = 0;
  for (int boxes = 0; boxes < 8 && avio_seek(&file, at, SEEK_SET) == at; ++boxes) {
    std::int64_t size = avio_rb32(&file);
    const bool is_last = avio_rl32(&file) == MKTAG('m', 'd', 'a', 't');
    if (size == 1) size = std::int64_t(avio_rb64(&file));
    if (is_last) return at + size == end ? std::optional(avio_tell(&file)) : std::nullopt;
    if (size < 8 || size > end - at) return std::nullopt;
    at += size;
  }
  return std::nullopt;
}

/// Whether the indices list these numbers of packets, which fill the file from `start` to its end.
bool is_complete(const AVFormatContext& file, std::span<const std::int64_t> packets,
                 std::int64_t start) {
  if (file.nb_streams != packets.size()) return false;
  std::vector<std::pair<std::int64_t, std::int64_t>> found;  // where they begin and end
  for (std::size_t i = 0; i < packets.size(); ++i) {
    AVStream* const stream = file.streams[i];
    if (avformat_index_get_entries_count(stream) != packets[i]) return false;
    for (int entry = 0; entry < packets[i]; ++entry) {
      const AVIndexEntry& packet = *avformat_index_get_entry(stream, entry);
      found.emplace_back(packet.pos, packet.pos + packet.size);
    }
  }
  std::ranges::sort(found);
  for (const auto& [begin, end] : found) {
    if (std::exchange(start, end) != begin) return false;
  }
  return start == avio_size(file.pb);
}

bool is_whole_mov(AVFormatContext& file, std::span<const std::int64_t> packets) {
  const auto start = start_of_pictures(*file.pb);
  return start && is_complete(file, packets, *start);
}

/// Whether as many packets of each stream can be read as were written.
bool is_whole_webm(AVFormatContext& file, std::span<const std::int64_t> packets) {
  std::vector<std::int64_t> left(packets.begin(), packets.end());
  const auto packet = own_av<AvPacketPtr>(av_packet_alloc(), "packet");
  int code = 0;
  while ((code = av_read_frame(&file, packet.get())) >= 0) {
    const auto stream = std::size_t(packet->stream_index);
    if (stream >= left.size()) return false;
    --left[stream];
    av_packet_unref(packet.get());
  }
  return code == AVERROR_EOF && std::ranges::count(left, 0) == std::ssize(left);
}

/// "file:" keeps libav from reading a protocol out of a path with a colon.
AvOutputPtr open_muxer(const std::string& path, const std::string& name, const char* format) {
  const std::string url = "file:" + path;
  AVFormatContext* allocated = nullptr;
  check_av(avformat_alloc_output_context2(&allocated, nullptr, format, url.c_str()), "open", name);
  AvOutputPtr muxer(allocated);
  check_av(avio_open(&muxer->pb, url.c_str(), AVIO_FLAG_WRITE), "open", name);
  return muxer;
}

class VideoFile final : public FrameSink {
 public:
  /// @param sound  of the second stream, if there is one.
  VideoFile(const std::string& name, const Container& container, const VideoStream& stream,
            const SoundEncoder* sound)
      : name_(name),
        stream_(stream),
        container_(container),
        file_(name),
        muxer_(open_muxer(file_.path(), name_, container.muxer)),
        packet_(own_av<AvPacketPtr>(av_packet_alloc(), "packet")) {
    add_stream();
    if (stream.parameters->codec_id == AV_CODEC_ID_H264) {
      levels_.emplace(stream.parameters->width, stream.parameters->height,
                      h264::PictureRate{stream.frame_rate.num, stream.frame_rate.den},
                      h264::profile_idc({stream.parameters->extradata,
                                         std::size_t(stream.parameters->extradata_size)}));
    }
    if (sound != nullptr) sound_.emplace(*sound, *muxer_, container_.sound_from_zero, name_);
    write_header();
  }

  void take_sound(PacketSource& sound) override {
    if (!sound_) return FrameSink::take_sound(sound);
    sound_->take(sound);
  }
  void append(const EncodedChunk& chunk) override {
    counter_.take(chunk);
    for (const Packet& packet : chunk) write(packet);
  }
  void finish() override {
    if (sound_) sound_->write_all();
    check_av(av_write_trailer(muxer_.get()), "write the index of", name_);
    avio_flush(muxer_->pb);
    check_av(muxer_->pb->error, "write to", name_);
    check_av(avio_closep(&muxer_->pb), "close", name_);
    check();
    if (levels_ && levels_->level() != nullptr) raise_level(levels_->level()->idc);
    file_.commit();
  }

 private:
  void add_stream() {
    AVStream* stream = avformat_new_stream(muxer_.get(), nullptr);
    if (stream == nullptr) throw std::bad_alloc();
    check_av(avcodec_parameters_copy(stream->codecpar, stream_.parameters.get()),
             "describe the stream of", name_);
    stream->time_base = av_inv_q(stream_.frame_rate);
    stream->avg_frame_rate = stream_.frame_rate;
    stream->r_frame_rate = stream_.frame_rate;
    stream->sample_aspect_ratio = {1, 1};
  }
  void write_header() {
    // Leaves out the library's version and the time of day.
    muxer_->flags |= AVFMT_FLAG_BITEXACT;
    check_av(av_opt_set(muxer_->priv_data, container_.index_option, container_.index_value, 0),
             "set up the muxer of", name_);
    if (container_.time_scale_option != nullptr) {
      // Those of the pictures: milliseconds would round the duration.
      check_av(av_opt_set_int(muxer_->priv_data, container_.time_scale_option,
                              h264::mp4_time_scale(stream_.frame_rate.num), 0),
               "set up the muxer of", name_);
    }
    check_av(avformat_write_header(muxer_.get(), nullptr), "write the header of", name_);
  }
  void write(const Packet& packet) {
    if (sound_) sound_->write_until(packet.dts, av_inv_q(stream_.frame_rate));
    av_packet_unref(packet_.get());
    ByteSpan picture = packet.bytes;
    if (stream_.parameters->format == AV_PIX_FMT_YUVA420P) {
      const PictureAndAlpha both = without_alpha(packet.bytes);
      picture = both.picture;
      if (!both.alpha.empty()) add_alpha(both.alpha);
    }
    if (levels_) levels_->take(std::ssize(picture));
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-const-cast): the muxer only reads what has no owner
    packet_->data = const_cast<std::uint8_t*>(picture.data());
    packet_->size = int(picture.size());
    packet_->pts = packet.pts;
    packet_->dts = packet.dts;
    packet_->duration = 1;
    packet_->flags = packet.key_frame ? AV_PKT_FLAG_KEY : 0;
    packet_->stream_index = 0;
    av_packet_rescale_ts(packet_.get(), av_inv_q(stream_.frame_rate),
                         muxer_->streams[0]->time_base);
    check_av(av_write_frame(muxer_.get(), packet_.get()), "write to", name_);
  }
  /// Reads the file back: without memory, libavformat may leave something out and not report it.
  void check() const {
    const AvInputPtr file = open_av_input(file_.path());
    const AVCodecParameters& written = *stream_.parameters;
    const auto is_ours = [&](const AVCodecParameters& read) {
      return read.codec_id == written.codec_id &&
             (read.extradata_size > 0) == (written.extradata_size > 0);
    };
    std::vector<std::int64_t> packets = {counter_.frames()};
    if (sound_) packets.push_back(sound_->packets());
    if (file->nb_streams != packets.size() || !is_ours(*file->streams[0]->codecpar) ||
        !container_.is_whole(*file, packets)) {
      // A demuxer may take a failed read for the end.
      check_av_read(std::min(file->pb->error, 0), "read back", name_);
      throw MediaError(fmt::format("video: the index of '{}' was not written whole", name_));
    }
  }
  /// Writes a higher level into the headers. They were written before the pictures were known.
  void raise_level(int level_idc) const {
    if (level_idc <= stream_.parameters->level) return;
    constexpr std::size_t kStart_bytes = 65536;  // the headers are the first thing in the index
    std::fstream file(file_.path(), std::ios::in | std::ios::out | std::ios::binary);
    std::string start(kStart_bytes, '\0');
    file.read(start.data(), std::ssize(start));
    file.clear();
    // ISO/IEC 14496-15, 5.3.3.1: four bytes with the level, four more, the sequence parameter set.
    const std::size_t at = start.find("avcC\x01");
    if (at == std::string::npos) {
      throw MediaError(fmt::format("video: cannot find the headers in '{}'", name_));
    }
    for (const std::size_t level : {at + 4 + 3, at + 4 + 8 + 3}) {
      file.seekp(std::streamoff(level)).put(static_cast<char>(level_idc));
    }
    if (!file.flush()) throw IoError(fmt::format("output: cannot write to '{}'", name_));
  }
  void add_alpha(ByteSpan alpha) {
    std::uint8_t* const data =
        av_packet_new_side_data(packet_.get(), AV_PKT_DATA_MATROSKA_BLOCKADDITIONAL, alpha.size());
    if (data == nullptr) throw std::bad_alloc();
    std::ranges::copy(alpha, data);
  }

  std::string name_;
  const VideoStream& stream_;
  const Container& container_;
  TemporaryFile file_;
  AvOutputPtr muxer_;  // after file_: closed before the file is removed
  AvPacketPtr packet_;
  std::optional<SoundStream> sound_;
  FrameCounter counter_;
  std::optional<h264::LevelWatch> levels_;  // of H.264
};

constexpr Container mp4_or_mov(const char* muxer, const SoundCodec& sound) {
  return {.muxer = muxer,
          .index_option = "movflags",
          .index_value = "+faststart",
          .time_scale_option = "movie_timescale",
          .is_whole = is_whole_mov,
          .sound = sound};
}

constexpr Container kMov = mp4_or_mov("mov", kAac);
/// For ProRes.
constexpr Container kEditorMov = mp4_or_mov("mov", kPcm);
constexpr Container kWebm = {.muxer = "webm",
                             .index_option = "cues_to_front",
                             .index_value = "1",
                             .is_whole = is_whole_webm,
                             .sound = kOpus,
                             .sound_from_zero = true};

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

const Container kMp4 = mp4_or_mov("mp4", kAac);

std::unique_ptr<FrameSink> open_video_file(const std::string& name, const Container& container,
                                           const VideoStream& pictures, const SoundEncoder* sound) {
  return std::make_unique<VideoFile>(name, container, pictures, sound);
}

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
