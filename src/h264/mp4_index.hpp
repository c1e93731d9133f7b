// The index of an MP4 file with one track of H.264: the box moov (ISO/IEC 14496-12 and -15).
// In: what is known of the track and of its pictures. Out: the index but for the sizes of the
// pictures, which are its last bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

namespace piblocks::h264 {

/// Boxes, of which MP4 files consist (ISO/IEC 14496-12, 4.2), one in another: a size, four letters,
/// a content. Numbers have their highest byte first.
class BoxWriter {
 public:
  explicit BoxWriter(std::uint64_t later_bytes) : later_bytes_(later_bytes) {}

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

  template <typename Fill>
  void box(std::string_view type, const Fill& fill) {
    sized_box(type, 0, fill);
  }
  /// A box that ends the index: its size includes what the caller writes behind all boxes.
  template <typename Fill>
  void last_box(std::string_view type, const Fill& fill) {
    sized_box(type, later_bytes_, fill);
  }

  const std::vector<std::uint8_t>& bytes() const noexcept { return bytes_; }

 private:
  template <typename Fill>
  void sized_box(std::string_view type, std::uint64_t later_bytes, const Fill& fill) {
    const std::size_t start = bytes_.size();
    put(0, 4);
    put(type);
    fill();
    const std::uint64_t size = bytes_.size() - start + later_bytes;
    for (std::size_t i = 0; i < 4; ++i) {
      bytes_[start + i] = static_cast<std::uint8_t>(size >> (24 - 8 * i));
    }
  }

  std::vector<std::uint8_t> bytes_;
  std::uint64_t later_bytes_;
};

/// The greatest number of 32 bits.
inline constexpr std::uint64_t kMax32 = std::numeric_limits<std::uint32_t>::max();

/// What is known of a track before its pictures are.
struct TrackFacts {
  std::int64_t width_px;
  std::int64_t height_px;
  std::int64_t time_scale;        ///< units a second
  std::int64_t picture_duration;  ///< a picture's duration
  std::int64_t max_pictures;
  std::int64_t max_key_frames;
  std::int64_t chunk_pictures;             ///< of each chunk but the last
  std::vector<std::uint8_t> sequence_set;  ///< parameter sets: NAL units
  std::vector<std::uint8_t> picture_set;
};

/// What is known of the pictures.
struct PictureTables {
  std::int64_t pictures = 0;
  std::uint64_t data_bytes = 0;
  std::vector<std::uint32_t> key_frames;  ///< their numbers, from 1
  std::vector<std::uint64_t> chunks;      ///< where they begin in the file
};

/// moov without the sizes of the pictures. 4 bytes for each picture have to follow.
/// @param tables  of at least one picture.
std::vector<std::uint8_t> make_index(const TrackFacts& track, const PictureTables& tables);
/// The size of the largest index, for max_pictures pictures and max_key_frames key frames.
std::uint64_t index_room(const TrackFacts& track);

}  // namespace piblocks::h264
