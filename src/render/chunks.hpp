// How the frames of a rendering are cut into chunks.
// In: the number of frames. Out: where each chunk begins and ends.
#pragma once

#include <algorithm>
#include <cstdint>

namespace piblocks {

/// Consecutive frames that are encoded together. Chunk k begins at frame k * frames_per_chunk; the
/// last has from half of that length to one and a half, so that no worker is left with a mere few
/// frames.
struct Chunks {
  std::int64_t frame_count;
  std::int64_t frames_per_chunk;

  std::int64_t count() const {
    if (frame_count == 0) return 0;
    return std::max<std::int64_t>(1, (frame_count + frames_per_chunk / 2) / frames_per_chunk);
  }
  /// The first frame of a chunk; of the one after the last, the number of frames.
  std::int64_t begin(std::int64_t chunk) const {
    return chunk == count() ? frame_count : chunk * frames_per_chunk;
  }
  std::int64_t end(std::int64_t chunk) const { return begin(chunk + 1); }
  /// How many chunks end before this frame.
  std::int64_t ended_by(std::int64_t frame) const {
    return frame >= frame_count ? count() : std::min(frame / frames_per_chunk, count() - 1);
  }
};

}  // namespace piblocks
