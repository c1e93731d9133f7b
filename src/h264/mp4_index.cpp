#include "h264/mp4_index.hpp"

#include <algorithm>
#include <array>
#include <span>

#include "h264/mp4_boxes.hpp"

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
    const Head head{1, time_scale, duration_, duration_, 0, "vide", "VideoHandler"};
    const auto put_pictures = [&] {
      put_track_header(head, 0, 0, static_cast<std::uint64_t>(track.width_px),
                       static_cast<std::uint64_t>(track.height_px));
      const auto put_kind = [&] { box("vmhd", [&] { put_all({1, 0, 0}); }); };
      put_track(
          head, put_kind, [&] { put_tables(sizes_bytes); }, sizes_bytes);
    };
    const auto put_all_tracks = [&] {
      put_movie(time_scale, movie.duration, movie.tracks + 1);
      box("trak", put_pictures, sizes_bytes);
    };
    box("moov", put_all_tracks, sizes_bytes + movie.others_bytes);
  }
  using BoxWriter::bytes;

 private:
  void put_tables(std::uint64_t sizes_bytes) {
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
    const std::uint64_t chunks = tables_.chunks.size();
    const auto usual = static_cast<std::uint64_t>(track_.chunk_pictures);
    const std::uint64_t last = pictures - (chunks - 1) * usual;
    const std::array runs = {ChunkRun{1, chunks > 1 ? usual : last}, ChunkRun{chunks, last}};
    put_chunks(std::span(runs).first(chunks > 1 && last < usual ? 2 : 1), tables_.chunks);
    box(
        "stsz",
        [&] {
          put_all({0, 0, pictures});
        },
        sizes_bytes);
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

}  // namespace piblocks::h264
