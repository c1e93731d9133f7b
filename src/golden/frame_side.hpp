// One side of a comparison: its frames, one step after the other.
// In: PNG files with the steps at which they stand, or a video, which has a frame at every step.
// Out: the frames, read when they are fetched.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "golden/frame_pair.hpp"
#include "golden/picture_list.hpp"

namespace piblocks {

/// The key of a frame of a video.
inline std::string frame_key(std::int64_t number) { return fmt::format("frame-{:06}", number); }

class FrameSide {
 public:
  virtual ~FrameSide() = default;
  /// The step at which the next frame stands; nothing after the last. A video may turn out to have
  /// none there.
  virtual std::optional<std::int64_t> next_step() const = 0;
  /// Goes to that step and reads its frame, which stays until the next call.
  /// @throws IoError, MediaError once a stop has been requested: then the frame has no problem.
  virtual Fetched fetch() = 0;
  /// Whether frames after one that cannot be read can be fetched.
  virtual bool goes_on_after_failure() const = 0;
};

struct PlacedPicture {
  std::int64_t step = 0;
  ListedPicture picture;
};

/// @param pictures  in the order of their steps
std::unique_ptr<FrameSide> picture_side(std::vector<PlacedPicture> pictures);

/// @param path  of any file that libavformat reads; opened when the first frame is fetched.
std::unique_ptr<FrameSide> video_side(const std::string& path, const std::stop_token& stop);

}  // namespace piblocks
