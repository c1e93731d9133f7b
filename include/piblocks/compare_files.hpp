// Two pictures, sequences or videos, frame by frame.
// In: two names, and what is accepted. Out: what differs, a call for every frame, and a verdict.
#pragma once

#include <piblocks/compare.hpp>
#include <piblocks/image.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

namespace piblocks {

/// Longest file of hashes that is read, in lines.
inline constexpr std::size_t kMaxHashes = 2'000'000;

struct ComparisonJob {
  std::string reference;  ///< a PNG file, a folder of them, a pattern, a video, or a framehash file
  std::string actual;     ///< the same; a video may be compared with pictures
  Tolerance tolerance = {};
  std::vector<PixelRect> masks = {};  ///< what is in them is not compared
};

/// One frame of both. Valid during the call that it is given to.
struct FrameComparison {
  std::int64_t number = 0;  ///< from 0
  std::string name;         ///< of the reference's frame, for people
  bool is_yuv = false;      ///< whether the samples are Y, Cb and Cr
  /// Nothing where only hashes are known: is_accepted then says whether these are equal.
  std::optional<Difference> difference;
  bool is_accepted = true;
  /// The pictures as they are shown; empty functions where only hashes are known.
  std::function<Image()> reference;
  std::function<Image()> actual;
  /// What pixel_deltas() returns for the samples that were compared.
  std::function<std::vector<std::uint8_t>()> deltas;

  bool is_equal() const noexcept { return difference ? difference->is_equal() : is_accepted; }
};

enum class Verdict { equal, accepted, different, mismatch };

struct ComparisonResult {
  Verdict verdict = Verdict::equal;
  std::string mismatch;               ///< what does not fit: sizes, numbers of frames, rotation
  std::int64_t frames = 0;            ///< that were compared
  std::int64_t different_frames = 0;  ///< that are not equal, accepted or not
  std::int64_t refused_frames = 0;    ///< that are not accepted
};

/// Compares what both have stored wherever their formats are equal, and else the RGB pictures they
/// show. Ends early where sizes do not fit.
/// @param on_frame  called for every frame, in order.
/// @throws UsageError if the job makes no sense; IoError, MediaError if an input cannot be read;
///         Interrupted
ComparisonResult compare_files(const ComparisonJob& job,
                               const std::function<void(const FrameComparison&)>& on_frame,
                               const std::stop_token& stop = {});

/// Whether there is anything of that name to compare with.
bool frames_exist(const std::string& name);

}  // namespace piblocks
