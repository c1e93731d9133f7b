#include "h264/mp4_tracks.hpp"

#include <algorithm>
#include <array>
#include <numeric>

namespace piblocks::h264 {
namespace {

using Bytes = std::span<const std::uint8_t>;

constexpr std::uint64_t kSecondRun_bytes = 12;  // of stsc, if the last chunk is shorter

/// The index without the sizes of the pictures, which follow it, and the other tracks.
class Index : private TrackWriter {
 public:
  Index(const TrackFacts& track, const PictureTables& tables, const MovieFacts& movie)
      : track_(track),
        tables_(tables),
        duration_(static_cast<std::uint64_t>(tables.pictures * track.picture_duration)) {
    const auto time_scale = static_cast<std::uint64_t>(track.time_scale);
    const std::uint64_t sizes_bytes = 4 * static_cast<std::uint64_t>(tables.pictures);
    const Head head{.id = 1,
                    .time_scale = time_scale,
                    .duration = duration_,
                    .media_duration = duration_,
                    .handler = "vide",
                    .name = "VideoHandler",
                    .width_px = static_cast<std::uint64_t>(track.width_px),
                    .height_px = static_cast<std::uint64_t>(track.height_px)};
    const auto put_kind = [&] { box("vmhd", [&] { put_all({1, 0, 0}); }); };
    const auto put_all_tracks = [&] {
      put_movie(time_scale, movie.duration, movie.tracks + 1);
      put_track(
          head, put_kind, [&] { put_tables(sizes_bytes); }, sizes_bytes);
    };
    box("moov", put_all_tracks, sizes_bytes + movie.others_bytes);
  }
  using BoxWriter::bytes;

 private:
  void put_tables(std::uint64_t sizes_bytes) {
    const auto pictures = static_cast<std::uint64_t>(tables_.pictures);
    put_description("avc1", [&] { put_sample_entry(); });
    const auto units = static_cast<std::uint64_t>(track_.picture_duration);
    box("stts", [&] { put_all({0, 1, pictures, units}); });
    // Without stss, all pictures are key frames.
    if (tables_.key_frames.size() < pictures) {
      box("stss", [&] {
        put_all({0, tables_.key_frames.size()});
        for (const std::uint32_t number : tables_.key_frames) put(number, 4);
      });
    }
    const std::uint64_t chunks = tables_.chunks.size();
    const auto usual = static_cast<std::uint64_t>(track_.chunk_pictures);
    const std::uint64_t last = pictures - (chunks - 1) * usual;
    const std::array runs = {ChunkRun{1, chunks > 1 ? usual : last}, ChunkRun{chunks, last}};
    put_chunks(std::span(runs).first(chunks > 1 && last < usual ? 2 : 1), tables_.chunks);
    const auto put_count = [&] { put_all({0, 0, pictures}); };
    box("stsz", put_count, sizes_bytes);
  }
  void put_sample_entry() {
    put_zeros(16);
    put(static_cast<std::uint64_t>(track_.width_px), 2);
    put(static_cast<std::uint64_t>(track_.height_px), 2);
    put_all({0x480000, 0x480000, 0});  // 72 dpi
    put(1, 2);                         // frame_count
    put_zeros(32);                     // compressorname
    put_all({0x18ffff});               // depth
    box("avcC", [&] {
      put(1, 1);
      put(Bytes(track_.sequence_set).subspan(1, 3));  // profile and level
      put(0xffe1, 2);  // lengths of 4 bytes; one sequence parameter set
      put(track_.sequence_set.size(), 2);
      put(Bytes(track_.sequence_set));
      put(1, 1);
      put(track_.picture_set.size(), 2);
      put(Bytes(track_.picture_set));
    });
    box("colr", [&] {
      put("nclx");
      for (int i = 0; i < 3; ++i) put(1, 2);  // BT.709
      put(0, 1);                              // limited range
    });
    box("pasp", [&] { put_all({1, 1}); });
    box("btrt", [&] { put_all({0, max_rate_bps(), mean_rate_bps()}); });
  }
  std::uint64_t max_rate_bps() const { return std::min(8 * tables_.max_second_bytes, kMax32); }
  /// Rounded down.
  std::uint64_t mean_rate_bps() const {
    const double rate_bps = 8.0 * static_cast<double>(tables_.data_bytes) *
                            static_cast<double>(track_.time_scale) / static_cast<double>(duration_);
    return static_cast<std::uint64_t>(std::min(rate_bps, static_cast<double>(kMax32)));
  }

  const TrackFacts& track_;
  const PictureTables& tables_;
  std::uint64_t duration_;
};

constexpr std::uint64_t kSoundId = 2;

std::uint64_t rounded_up(std::int64_t value, std::int64_t factor, std::int64_t divisor) {
  const std::int64_t whole = value / divisor * factor;  // apart, so that no product passes 63 bits
  return static_cast<std::uint64_t>(whole + (value % divisor * factor + divisor - 1) / divisor);
}

class SoundTrack : private TrackWriter {
 public:
  SoundTrack(const Mp4Sound& sound, const SoundTables& tables, std::int64_t movie_scale)
      : sound_(sound), tables_(tables) {
    const auto delay = static_cast<std::uint64_t>(sound.delay);
    media_duration_ = delay + static_cast<std::uint64_t>(sound.samples);
    const Head head{.id = kSoundId,
                    .time_scale = static_cast<std::uint64_t>(sound.rate_hz),
                    .duration = sound_duration(sound, movie_scale),
                    .media_duration = media_duration_,
                    .media_start = delay,
                    .handler = "soun",
                    .name = "SoundHandler",
                    .volume = 256};
    put_track(
        head, [&] { box("smhd", [&] { put_zeros(8); }); }, [&] { put_tables(); });
  }
  using BoxWriter::bytes;

 private:
  void put_tables() {
    const std::uint64_t packets = tables_.sizes.size();
    put_description(is_opus() ? "Opus" : "mp4a", [&] { put_sample_entry(); });
    // The silence that fills up the last packet is not counted.
    const auto whole = static_cast<std::uint64_t>(sound_.packet_samples);
    const std::uint64_t before_last = (packets - 1) * whole;
    const std::uint64_t last = media_duration_ > before_last ? media_duration_ - before_last : 1;
    box("stts", [&] {
      put_all({0, packets > 1 ? 2U : 1U});
      if (packets > 1) put_all({packets - 1, whole});
      put_all({1, last});
    });
    box("sgpd", [&] {
      put(1 << 24, 4);
      put("roll");
      put_all({2, 1});
      put(0x10000 - packets_before(), 2);
    });
    box("sbgp", [&] {
      put(0, 4);
      put("roll");
      put_all({1, packets, 1});
    });
    put_chunks(tables_.chunks);
    put_sizes(tables_.sizes);
  }
  void put_sample_entry() {
    put_zeros(8);
    put(2, 2);   // channels
    put(16, 2);  // the size of a sample, always so
    put(0, 4);
    put(static_cast<std::uint64_t>(sound_.rate_hz) << 16, 4);
    if (is_opus()) {
      box("dOps", [&] { put_opus_header(); });
    } else {
      box("esds", [&] { put_elementary_stream(); });
    }
  }
  bool is_opus() const { return sound_.codec == Mp4SoundCodec::opus; }
  /// That a decoder needs before a packet: one of AAC, 80 ms of Opus.
  std::uint64_t packets_before() const {
    return is_opus() ? rounded_up(sound_.rate_hz, 80, 1000L * sound_.packet_samples) : 1;
  }
  /// The identification header, whose numbers have their lowest byte first there ("Encapsulation of
  /// Opus in ISO Base Media File Format", 4.3.2).
  void put_opus_header() {
    const auto put_reversed = [&](std::size_t at, std::size_t size_bytes) {
      for (std::size_t i = at + size_bytes; i > at; --i) put(sound_.config[i - 1], 1);
    };
    put(0, 1);                 // version
    put(sound_.config[9], 1);  // channels
    put_reversed(10, 2);       // pre-skip
    put_reversed(12, 4);       // rate of the samples before they were encoded
    put_reversed(16, 2);       // gain
    put(0, 1);                 // channel mapping family
  }
  /// ISO/IEC 14496-1, 7.2.6: a tag, the bytes of its content, the content.
  void put_elementary_stream() {
    const std::uint64_t config = sound_.config.size();
    const auto put_tag = [&](std::uint64_t tag, std::uint64_t size) {
      put(tag, 1);
      put(0x808080, 3);  // a size of four bytes, seven bits each
      put(size, 1);
    };
    put(0, 4);
    put_tag(3, 3 + 5 + 13 + 5 + config + 5 + 1);  // ES_Descriptor
    put(kSoundId, 2);                             // ES_ID
    put(0, 1);
    put_tag(4, 13 + 5 + config);  // DecoderConfigDescriptor
    put(0x40, 1);                 // AAC
    put(0x15, 1);                 // AudioStream
    put(0, 3);
    put_all({max_rate_bps(), mean_rate_bps()});
    put_tag(5, config);  // DecoderSpecificInfo
    put(sound_.config);
    put_tag(6, 1);  // SLConfigDescriptor
    put(2, 1);
  }
  std::uint64_t mean_rate_bps() const {
    const auto bytes =
        std::accumulate(tables_.sizes.begin(), tables_.sizes.end(), std::uint64_t{0});
    return std::min(8 * bytes * static_cast<std::uint64_t>(sound_.rate_hz) /
                        std::max<std::uint64_t>(media_duration_, 1),
                    kMax32);
  }
  std::uint64_t max_rate_bps() const {
    SecondWatch seconds((sound_.rate_hz + sound_.packet_samples - 1) / sound_.packet_samples);
    for (const std::uint32_t size : tables_.sizes) seconds.take(size);
    return std::min(8 * seconds.most_bytes(), kMax32);
  }

  const Mp4Sound& sound_;
  const SoundTables& tables_;
  std::uint64_t media_duration_;
};

/// How the texts look (3GPP TS 26.245, 5.16): white, centred below, as high as subtitles are.
void put_text_entry(std::uint64_t width_px, std::uint64_t height_px, TrackWriter& track) {
  track.put(0, 4);     // displayFlags
  track.put(1, 1);     // horizontal: centred
  track.put(0xff, 1);  // vertical: at the bottom
  track.put(0, 4);     // background: none
  track.put(0, 4);     // the box: from above and left
  track.put(height_px, 2);
  track.put(width_px, 2);
  track.put(0, 4);  // style of all characters
  track.put(1, 2);  // font
  track.put(0, 1);
  track.put(std::clamp<std::uint64_t>(height_px / 20, 8, 255), 1);
  track.put(0xffffffff, 4);
  track.box("ftab", [&] {
    track.put(1, 2);
    track.put(1, 2);
    track.put(10, 1);
    track.put("Sans-Serif");
  });
}

}  // namespace

std::vector<std::uint8_t> make_index(const TrackFacts& track, const PictureTables& tables,
                                     const MovieFacts& movie) {
  return Index(track, tables, movie).bytes();
}

std::uint64_t index_room(const TrackFacts& track) {
  const std::int64_t chunks = (track.max_pictures - 1) / track.chunk_pictures + 1;
  // One chunk and no key frame: its stss is empty, not left out.
  const PictureTables least{.pictures = 1, .key_frames = {}, .chunks = {0}};
  return make_index(track, least, {.duration = 0}).size() + kSecondRun_bytes +
         TrackWriter::kLongMovie_bytes + TrackWriter::kLongTrack_bytes +
         8 * static_cast<std::uint64_t>(chunks) +
         4 * static_cast<std::uint64_t>(track.max_key_frames);
}

std::uint64_t sound_duration(const Mp4Sound& sound, std::int64_t movie_scale) {
  return rounded_up(sound.samples, movie_scale, sound.rate_hz);
}

std::uint64_t max_packets(const Mp4Sound& sound) {
  return rounded_up(sound.delay + sound.samples, 1, sound.packet_samples) + 1;
}

std::vector<std::uint8_t> make_sound_track(const Mp4Sound& sound, const SoundTables& tables,
                                           std::int64_t movie_scale) {
  return SoundTrack(sound, tables, movie_scale).bytes();
}

std::uint64_t sound_track_room(const Mp4Sound& sound, std::uint64_t max_chunks) {
  constexpr std::uint64_t kChunk_bytes = 12 + 8;  // of stsc and co64
  return make_sound_track(sound, {.sizes = {0, 0}, .chunks = {}}, 1).size() +
         TrackWriter::kLongTrack_bytes + kChunk_bytes * max_chunks + 4 * max_packets(sound);
}

TextTrack::TextTrack(const TrackFacts& pictures, std::span<const Mp4Caption> captions)
    : track_(pictures) {
  const auto add = [&](std::int64_t start, std::string_view text) {
    BoxWriter sample;
    sample.put(text.size(), 2);
    sample.put(text);
    starts_.push_back(start);
    sizes_.push_back(static_cast<std::uint32_t>(sample.bytes().size()));
    data_.insert(data_.end(), sample.bytes().begin(), sample.bytes().end());
  };
  if (captions.empty() || captions.front().picture > 0) add(0, "");
  for (const Mp4Caption& caption : captions) add(caption.picture, caption.text);
}

std::vector<std::uint8_t> TextTrack::make(std::uint64_t id, std::uint64_t offset,
                                          std::int64_t pictures) const {
  const auto units = [&](std::int64_t count) {
    return static_cast<std::uint64_t>(std::max<std::int64_t>(count, 0) * track_.picture_duration);
  };
  const Head head{.id = id,
                  .time_scale = static_cast<std::uint64_t>(track_.time_scale),
                  .duration = units(pictures),
                  .media_duration = units(pictures),
                  .handler = "sbtl",
                  .name = "SubtitleHandler",
                  .group = 2,
                  .width_px = static_cast<std::uint64_t>(track_.width_px),
                  .height_px = static_cast<std::uint64_t>(track_.height_px)};
  TrackWriter track;
  const auto put_tables = [&] {
    track.put_description("tx3g", [&] { put_text_entry(head.width_px, head.height_px, track); });
    track.box("stts", [&] {
      track.put_all({0, starts_.size()});
      for (std::size_t i = 0; i < starts_.size(); ++i) {
        const std::int64_t end = i + 1 < starts_.size() ? starts_[i + 1] : pictures;
        track.put_all({1, units(end - starts_[i])});
      }
    });
    const SampleChunk chunk{offset, starts_.size()};
    track.put_chunks({&chunk, 1});
    track.put_sizes(sizes_);
  };
  track.put_track(
      head, [&] { track.box("nmhd", [&] { track.put_zeros(4); }); }, put_tables);
  return track.bytes();
}

std::uint64_t TextTrack::room() const {
  return make(3, kMax32 + 1, track_.max_pictures).size() + TrackWriter::kLongTrack_bytes;
}

}  // namespace piblocks::h264
