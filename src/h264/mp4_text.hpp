// The track of captions of an MP4 file (ISO/IEC 14496-12, 3GPP TS 26.245).
// In: texts, and from which picture on they are shown. Out: its samples, and its box, trak.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "h264/mp4_index.hpp"
#include "h264/mp4_writer.hpp"

namespace piblocks::h264 {

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
