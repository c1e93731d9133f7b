// Boxes, of which MP4 files consist (ISO/IEC 14496-12, 4.2), and those that all tracks have.
// In: numbers, and functions that put what a box contains. Out: bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

namespace piblocks::h264 {

/// Boxes, one in another: a size, four letters, a content. Numbers have their highest byte first.
class BoxWriter {
 public:
  void put(std::uint64_t value, int size_bytes) {
    for (int shift = 8 * size_bytes - 8; shift >= 0; shift -= 8) {
      bytes_.push_back(static_cast<std::uint8_t>(value >> shift));
    }
  }
  /// Numbers of 32 bits.
  void put_all(std::initializer_list<std::uint64_t> values) {
    for (const std::uint64_t value : values) put(value, 4);
  }
  void put(std::span<const std::uint8_t> bytes) {
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  }
  void put(std::string_view text) {
    for (const char letter : text) put(static_cast<std::uint8_t>(letter), 1);
  }
  void put_zeros(std::size_t count) { bytes_.resize(bytes_.size() + count); }

  /// @param later_bytes  of the content, which the caller writes behind all boxes
  template <typename Fill>
  void box(std::string_view type, const Fill& fill, std::uint64_t later_bytes = 0) {
    const std::size_t start = bytes_.size();
    put(0, 4);
    put(type);
    fill();
    const std::uint64_t size = bytes_.size() - start + later_bytes;
    for (std::size_t i = 0; i < 4; ++i) {
      bytes_[start + i] = static_cast<std::uint8_t>(size >> (24 - 8 * i));
    }
  }

  const std::vector<std::uint8_t>& bytes() const noexcept { return bytes_; }

 private:
  std::vector<std::uint8_t> bytes_;
};

/// The greatest number of 32 bits.
inline constexpr std::uint64_t kMax32 = std::numeric_limits<std::uint32_t>::max();

/// Consecutive samples of a track in the file: packets of sound, or texts.
struct SampleChunk {
  std::uint64_t offset;
  std::uint64_t samples;
};

/// What every track says of itself.
struct Head {
  std::uint64_t id;
  std::uint64_t time_scale;
  std::uint64_t duration;         ///< that is shown, in units of the movie
  std::uint64_t media_duration;   ///< in units of the track
  std::uint64_t media_start = 0;  ///< where in it that begins
  std::string_view handler;
  std::string_view name;
  std::uint64_t volume = 0;  ///< in parts of 256
  std::uint64_t group = 0;   ///< of tracks that stand for each other; 0: none
  std::uint64_t width_px = 0;
  std::uint64_t height_px = 0;
};

/// A run of chunks in stsc.
struct ChunkRun {
  std::uint64_t first;  ///< from 1
  std::uint64_t samples;
};

class TrackWriter : public BoxWriter {
 public:
  // By how much boxes are longer if durations have 64 bits: tkhd, mdhd and elst; mvhd.
  static constexpr std::uint64_t kLongTrack_bytes = 2 * 12 + 8;
  static constexpr std::uint64_t kLongMovie_bytes = 12;

  void put_movie(std::uint64_t time_scale, std::uint64_t duration, std::uint64_t next_id);
  /// trak. @param put_kind  the header of minf. @param put_tables   the content of stbl.
  /// @param later_bytes  of it, behind all boxes
  template <typename PutKind, typename PutTables>
  void put_track(const Head& head, const PutKind& put_kind, const PutTables& put_tables,
                 std::uint64_t later_bytes = 0) {
    const auto put_information = [&] {
      put_kind();
      put_data_reference();
      box("stbl", put_tables, later_bytes);
    };
    const auto put_media = [&] {
      put_media_header(head);
      box("minf", put_information, later_bytes);
    };
    const auto put_all_boxes = [&] {
      put_track_header(head);
      put_edits(head);
      box("mdia", put_media, later_bytes);
    };
    box("trak", put_all_boxes, later_bytes);
  }
  /// stsd of one sample entry. @param put_entry  what it has behind data_reference_index
  template <typename PutEntry>
  void put_description(std::string_view type, const PutEntry& put_entry) {
    box("stsd", [&] {
      put_all({0, 1});
      box(type, [&] {
        put_zeros(6);
        put(1, 2);  // data_reference_index
        put_entry();
      });
    });
  }
  void put_chunks(std::span<const ChunkRun> runs, std::span<const std::uint64_t> offsets);
  void put_chunks(std::span<const SampleChunk> chunks);
  /// stsz
  void put_sizes(std::span<const std::uint32_t> sizes);

 private:
  void put_version(bool has_long_duration, std::uint64_t flags = 0) {
    put(has_long_duration ? 1 << 24 | flags : flags, 4);
  }
  void put_times(std::uint64_t duration, std::initializer_list<std::uint64_t> between);
  void put_track_header(const Head& head);
  void put_unit_matrix() { put_all({65536, 0, 0, 0, 65536, 0, 0, 0, 1 << 30}); }
  void put_edits(const Head& head);
  void put_media_header(const Head& head);
  void put_data_reference();
};

}  // namespace piblocks::h264
