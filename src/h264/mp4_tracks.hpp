// What an MP4 file says of its tracks: its index, the box moov (ISO/IEC 14496-12, -14 and -15, for
// captions 3GPP TS 26.245, and for Opus its encapsulation).
// In: what is known of pictures, packets of sound and captions. Out: the index up to the sizes of
// the pictures, and the boxes of other tracks. The caller writes these sizes, and the boxes behind
// them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "h264/mp4_boxes.hpp"
#include "h264/mp4_writer.hpp"

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

/// The most bytes that begin within a second.
class SecondWatch {
 public:
  /// @param samples  that begin in a second
  explicit SecondWatch(std::int64_t samples) : samples_(static_cast<std::size_t>(samples)) {}
  void take(std::uint64_t size_bytes) {
    sizes_.push_back(size_bytes);
    sum_ += size_bytes;
    if (sizes_.size() > samples_) {
      sum_ -= sizes_.front();
      sizes_.pop_front();
    }
    most_ = std::max(most_, sum_);
  }
  std::uint64_t most_bytes() const noexcept { return most_; }

 private:
  std::size_t samples_;
  std::deque<std::uint64_t> sizes_;
  std::uint64_t sum_ = 0;
  std::uint64_t most_ = 0;
};

/// The packets, in order.
struct SoundTables {
  std::vector<std::uint32_t> sizes = {};
  std::vector<SampleChunk> chunks = {};
};

/// trak, of at least one packet. @param movie_scale  units of the movie a second
std::vector<std::uint8_t> make_sound_track(const Mp4Sound& sound, const SoundTables& tables,
                                           std::int64_t movie_scale);
/// The size of the largest.
std::uint64_t sound_track_room(const Mp4Sound& sound, std::uint64_t max_chunks);
/// How long it is heard, in units of the movie, rounded up.
std::uint64_t sound_duration(const Mp4Sound& sound, std::int64_t movie_scale);
/// An encoder may add one packet to those that hold all samples.
std::uint64_t max_packets(const Mp4Sound& sound);

/// The samples, one behind the other. Before the first text comes an empty one.
class TextTrack {
 public:
  /// @param captions  in order, of a track of so many pictures or fewer
  TextTrack(const TrackFacts& pictures, std::span<const Mp4Caption> captions);

  const std::vector<std::uint8_t>& data() const noexcept { return data_; }
  /// trak. @param id  of the track. @param offset  of data() in the file
  /// @param pictures  that the file has
  std::vector<std::uint8_t> make(std::uint64_t id, std::uint64_t offset,
                                 std::int64_t pictures) const;
  /// The size of the largest.
  std::uint64_t room() const;

 private:
  const TrackFacts& track_;
  std::vector<std::int64_t> starts_;  // of the samples, in pictures
  std::vector<std::uint32_t> sizes_;
  std::vector<std::uint8_t> data_;
};

}  // namespace piblocks::h264
