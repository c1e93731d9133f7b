#include "h264/mp4_sound.hpp"

#include <algorithm>
#include <numeric>

namespace piblocks::h264 {
namespace {

constexpr std::uint64_t kId = 2;

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
    const Head head{kId,
                    static_cast<std::uint64_t>(sound.rate_hz),
                    sound_duration(sound, movie_scale),
                    media_duration_,
                    delay,
                    "soun",
                    "SoundHandler"};
    box("trak", [&] {
      put_track_header(head, 256, 0, 0, 0);
      put_track(
          head, [&] { box("smhd", [&] { put_zeros(8); }); }, [&] { put_tables(); });
    });
  }
  using BoxWriter::bytes;

 private:
  void put_tables() {
    const std::uint64_t packets = tables_.sizes.size();
    box("stsd", [&] {
      put_all({0, 1});
      box(is_opus() ? "Opus" : "mp4a", [&] { put_sample_entry(); });
    });
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
    put_zeros(6);
    put(1, 2);  // data_reference_index
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
    put(kId, 2);                                  // ES_ID
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
  std::uint64_t rate_bps(std::uint64_t bytes, std::uint64_t samples) const {
    return std::min(8 * bytes * static_cast<std::uint64_t>(sound_.rate_hz) / samples, kMax32);
  }
  std::uint64_t mean_rate_bps() const {
    return rate_bps(std::accumulate(tables_.sizes.begin(), tables_.sizes.end(), std::uint64_t{0}),
                    std::max<std::uint64_t>(media_duration_, 1));
  }
  /// In any second, which has so many packets or fewer.
  std::uint64_t max_rate_bps() const {
    const auto whole = static_cast<std::size_t>(sound_.packet_samples);
    const std::size_t window = (static_cast<std::size_t>(sound_.rate_hz) + whole - 1) / whole;
    std::uint64_t most = 0;
    std::uint64_t bytes = 0;
    for (std::size_t i = 0; i < tables_.sizes.size(); ++i) {
      bytes += tables_.sizes[i];
      if (i >= window) bytes -= tables_.sizes[i - window];
      most = std::max(most, bytes);
    }
    return std::min(8 * most, kMax32);
  }

  const Mp4Sound& sound_;
  const SoundTables& tables_;
  std::uint64_t media_duration_;
};

}  // namespace

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

}  // namespace piblocks::h264
