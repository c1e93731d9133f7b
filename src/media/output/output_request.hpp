// What an output is set up with, and what every kind of output checks.
// In: the arguments of set_up_output(), the chunks given later. Out: nothing, or the error that a
// wrong size or order deserves.
#pragma once

#include <optional>
#include <string>

#include "media/output/frame_sink.hpp"

namespace piblocks {

/// The arguments of set_up_output(), already known to be in range.
struct OutputRequest {
  std::string name;
  VideoFormat format;
  EncoderSettings settings;
  std::optional<SoundFormat> sound = {};
};

/// Empty if both sides are even, as 4:2:0 needs; else what is wrong and which size to use.
/// @param what the thing that needs it, such as "H.264 in 4:2:0".
std::string odd_size_problem(const VideoFormat& format, const std::string& what);

/// Sees to it that an output gets every frame once and in order.
class FrameCounter {
 public:
  /// @throws MediaError if the chunk does not start where the last one ended.
  void take(const EncodedChunk& chunk);

 private:
  std::int64_t next_frame_ = 0;
};

}  // namespace piblocks
