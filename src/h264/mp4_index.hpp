// The index of an MP4 file: the box moov (ISO/IEC 14496-12 and -15).
// In: what is known of the pictures. Out: the index up to their sizes. The caller writes these, and
// the boxes of other tracks behind them.
#pragma once

#include <cstdint>
#include <vector>

namespace piblocks::h264 {

/// What is known of the pictures' track before they are.
struct TrackFacts {
  std::int64_t width_px;
  std::int64_t height_px;
  std::int64_t time_scale;        ///< units a second, also of the movie
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
  std::uint64_t max_second_bytes = 0;     ///< the most that begin within a second
  std::vector<std::uint32_t> key_frames;  ///< their numbers, from 1
  std::vector<std::uint64_t> chunks;      ///< where they begin in the file
};

/// What is known of the whole file.
struct MovieFacts {
  std::uint64_t duration;          ///< of the longest track
  std::uint64_t tracks = 1;        ///< how many; that of the pictures is the first
  std::uint64_t others_bytes = 0;  ///< of the boxes of the others
};

/// moov up to the sizes of the pictures. @param tables  of at least one picture
std::vector<std::uint8_t> make_index(const TrackFacts& track, const PictureTables& tables,
                                     const MovieFacts& movie);
/// The size of its largest, for max_pictures pictures and max_key_frames key frames.
std::uint64_t index_room(const TrackFacts& track);

}  // namespace piblocks::h264
