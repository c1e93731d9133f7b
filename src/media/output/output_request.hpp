// What an output is set up with, and what several kinds of output check.
// In: the arguments of set_up_output(), and later chunks. Out: an error if a size or an order is
// wrong.
#pragma once

#include <piblocks/error.hpp>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "media/output/frame_sink.hpp"

namespace piblocks {

/// The arguments of set_up_output(), already known to be in range.
struct OutputRequest {
  std::string name;
  VideoFormat format;
  EncoderSettings settings;
  std::optional<SoundFormat> sound = {};
};

/// Collects everything that is wrong, to report it at once.
class Problems {
 public:
  /// @param problem  empty if nothing is wrong.
  void add(std::string problem) {
    if (!problem.empty()) problems_.push_back(std::move(problem));
  }
  /// @throws UsageError if anything is wrong.
  void check() const {
    if (!problems_.empty()) throw UsageError(problems_);
  }

 private:
  std::vector<std::string> problems_;
};

/// Empty if both sides are even, as 4:2:0 needs; else what is wrong and which size to use.
/// @param what  what needs it, such as "H.264 in 4:2:0".
std::string odd_size_problem(const VideoFormat& format, const std::string& what);

/// Checks that an output gets every frame once and in order.
class FrameCounter {
 public:
  /// @throws MediaError if the chunk does not start where the last one ended.
  void take(const EncodedChunk& chunk);
  std::int64_t frames() const noexcept { return frames_; }

 private:
  std::int64_t frames_ = 0;
};

}  // namespace piblocks
