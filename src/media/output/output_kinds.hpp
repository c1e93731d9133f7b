// The functions that set up each kind of output, and what several of them check.
// In: a request whose name the kind matches. Out: the output, set up but not opened.
#pragma once

#include <piblocks/error.hpp>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "media/output/output.hpp"

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

// All throw UsageError if the kind cannot hold the format or does not take a setting.
// src/media/README.md says what each kind holds.
Output mp4_output(const OutputRequest& request);
Output mov_output(const OutputRequest& request);
Output webm_output(const OutputRequest& request);
Output gif_output(const OutputRequest& request);
Output apng_output(const OutputRequest& request);
Output png_output(const OutputRequest& request);
Output y4m_output(const OutputRequest& request);
/// As FFmpeg's framehash muxer writes rawvideo rgb24 (rgba, if the frames have alpha), but without
/// its #software line.
Output framehash_output(const OutputRequest& request);
Output wav_output(const OutputRequest& request);
/// Takes frames and keeps nothing: what rendering costs without an output.
Output null_output(const OutputRequest& request);

}  // namespace piblocks
