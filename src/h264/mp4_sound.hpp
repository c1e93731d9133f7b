// The track of sound of an MP4 file (ISO/IEC 14496-12 and -14, and for Opus its encapsulation).
// In: what is known of it, and where its packets are. Out: its box, trak.
#pragma once

#include <cstdint>
#include <vector>

#include "h264/mp4_boxes.hpp"
#include "h264/mp4_writer.hpp"

namespace piblocks::h264 {

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

}  // namespace piblocks::h264
