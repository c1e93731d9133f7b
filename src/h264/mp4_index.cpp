#include "h264/mp4_index.hpp"

#include <algorithm>
#include <initializer_list>
#include <span>
#include <string_view>

namespace piblocks::h264 {
namespace {

using Bytes = std::span<const std::uint8_t>;

constexpr std::uint64_t kSecondRun_bytes = 12;  // of stsc, if the last chunk is shorter
/// mvhd, tkhd and mdhd are longer by 12 bytes with durations of 64 bits, elst by 8.
constexpr std::uint64_t kLongDurations_bytes = 3 * 12 + 8;

/// The index without the sizes of the pictures, which follow it.
class Index : private BoxWriter {
 public:
  Index(const TrackFacts& track, const PictureTables& tables)
      : BoxWriter(4 * static_cast<std::uint64_t>(tables.pictures)),
        track_(track),
        tables_(tables),
        duration_(static_cast<std::uint64_t>(tables.pictures * track.picture_duration)),
        has_long_duration_(duration_ >= kMax32) {  // kMax32 itself means "unknown"
    last_box("moov", [&] {
      put_movie();
      last_box("trak", [&] {
        put_track();
        last_box("mdia", [&] {
          put_media();
          last_box("minf", [&] {
            put_media_information();
            last_box("stbl", [&] { put_tables(); });
          });
        });
      });
    });
  }
  using BoxWriter::bytes;

 private:
  void put_versioned_times(std::initializer_list<std::uint64_t> between) {
    const int size_bytes = has_long_duration_ ? 8 : 4;
    for (int i = 0; i < 2; ++i) put(0, size_bytes);  // times of creation and change
    put_all(between);
    put(duration_, size_bytes);
  }
  void put_version(std::uint64_t flags = 0) {
    put(has_long_duration_ ? 1 << 24 | flags : flags, 4);
  }
  void put_unit_matrix() { put_all({65536, 0, 0, 0, 65536, 0, 0, 0, 1 << 30}); }

  void put_movie() {
    box("mvhd", [&] {
      put_version();
      put_versioned_times({static_cast<std::uint64_t>(track_.time_scale)});
      put_all({0x10000, 0x1000000, 0, 0});  // rate 1, volume 1
      put_unit_matrix();
      put_zeros(24);
      put(2, 4);  // next_track_ID
    });
  }
  void put_track() {
    box("tkhd", [&] {
      put_version(3);               // enabled, in the movie
      put_versioned_times({1, 0});  // track_ID
      put_zeros(16);
      put_unit_matrix();
      put_all({static_cast<std::uint64_t>(track_.width_px) << 16,
               static_cast<std::uint64_t>(track_.height_px) << 16});
    });
    box("edts", [&] {
      box("elst", [&] {
        const int size_bytes = has_long_duration_ ? 8 : 4;
        put_version();
        put(1, 4);
        put(duration_, size_bytes);
        put(0, size_bytes);  // media_time
        put(0x10000, 4);     // media_rate 1
      });
    });
  }
  void put_media() {
    box("mdhd", [&] {
      put_version();
      put_versioned_times({static_cast<std::uint64_t>(track_.time_scale)});
      put(0x55c40000, 4);  // language "und"
    });
    box("hdlr", [&] {
      put_zeros(8);
      put("vide");
      put_zeros(12);
      put(std::string_view("VideoHandler\0", 13));
    });
  }
  void put_media_information() {
    box("vmhd", [&] { put_all({1, 0, 0}); });
    box("dinf", [&] {
      box("dref", [&] {
        put_all({0, 1});
        box("url ", [&] { put(1, 4); });  // the data are in this file
      });
    });
  }
  void put_tables() {
    const auto pictures = static_cast<std::uint64_t>(tables_.pictures);
    box("stsd", [&] {
      put_all({0, 1});
      box("avc1", [&] { put_sample_entry(); });
    });
    const auto units = static_cast<std::uint64_t>(track_.picture_duration);
    box("stts", [&] { put_all({0, 1, pictures, units}); });
    // Without stss, all pictures are key frames.
    if (tables_.key_frames.size() < pictures) {
      box("stss", [&] {
        put_all({0, tables_.key_frames.size()});
        for (const std::uint32_t number : tables_.key_frames) put(number, 4);
      });
    }
    put_chunks(pictures);
    last_box("stsz", [&] { put_all({0, 0, pictures}); });
  }
  void put_chunks(std::uint64_t pictures) {
    const std::uint64_t chunks = tables_.chunks.size();
    const auto usual = static_cast<std::uint64_t>(track_.chunk_pictures);
    const std::uint64_t last = pictures - (chunks - 1) * usual;
    const bool is_last_shorter = chunks > 1 && last < usual;
    box("stsc", [&] {
      put_all({0, is_last_shorter ? 2U : 1U, 1, chunks > 1 ? usual : last, 1});
      if (is_last_shorter) put_all({chunks, last, 1});
    });
    const bool is_far = tables_.chunks.back() > kMax32;
    box(is_far ? "co64" : "stco", [&] {
      put_all({0, chunks});
      for (const std::uint64_t offset : tables_.chunks) put(offset, is_far ? 8 : 4);
    });
  }
  void put_sample_entry() {
    put_zeros(6);
    put(1, 2);  // data_reference_index
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
    box("btrt", [&] { put_all({0, mean_rate_bps(), mean_rate_bps()}); });
  }
  /// Rounded down.
  std::uint64_t mean_rate_bps() const {
    const double rate_bps = 8.0 * static_cast<double>(tables_.data_bytes) *
                            static_cast<double>(track_.time_scale) / static_cast<double>(duration_);
    return static_cast<std::uint64_t>(std::min(rate_bps, static_cast<double>(kMax32)));
  }

  const TrackFacts& track_;
  const PictureTables& tables_;
  std::uint64_t duration_;
  bool has_long_duration_;
};

}  // namespace

std::vector<std::uint8_t> make_index(const TrackFacts& track, const PictureTables& tables) {
  return Index(track, tables).bytes();
}

std::uint64_t index_room(const TrackFacts& track) {
  const std::int64_t chunks = (track.max_pictures - 1) / track.chunk_pictures + 1;
  // One chunk and no key frame: its stss is empty, not left out.
  const std::vector<std::uint8_t> least =
      make_index(track, {.pictures = 1, .data_bytes = 0, .key_frames = {}, .chunks = {0}});
  return least.size() + kSecondRun_bytes + kLongDurations_bytes +
         8 * static_cast<std::uint64_t>(chunks) +
         4 * static_cast<std::uint64_t>(track.max_key_frames);
}

}  // namespace piblocks::h264
