// The index of an MP4 file with one track of H.264: the box moov (ISO/IEC 14496-12 and -15).
// In: what is known of the track and of its pictures. Out: the index but for the sizes of the
// pictures, which are its last bytes.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

namespace piblocks::h264 {

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
