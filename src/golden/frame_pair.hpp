// Two frames of a comparison: read, and compared with each other.
// In: PNG files or frames of videos. Out: what is found about them, with the pictures for reports.
#pragma once

#include <fmt/format.h>
#include <piblocks/compare.hpp>

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "golden/picture_list.hpp"
#include "media/pixels/frame_reader.hpp"

namespace piblocks {

/// What one side has at a step: a frame, a frame that cannot be read, or none.
struct Fetched {
  bool is_there = false;
  std::string name = {};                    ///< for people
  std::string key = {};                     ///< for file names
  std::string path = {};                    ///< of the PNG file that is this frame
  std::string problem = {};                 ///< why it cannot be read
  std::shared_ptr<FrameReader> frame = {};  ///< stands at the frame, if it could be read

  bool is_read() const { return is_there && problem.empty(); }
};

Fetched fetch_picture(const ListedPicture& picture);

/// The key of a frame of a video.
inline std::string frame_key(std::int64_t number) { return fmt::format("frame-{:06}", number); }

struct PictureSize {
  int width_px = 0;
  int height_px = 0;

  friend bool operator==(const PictureSize&, const PictureSize&) = default;
};

/// A row of a comparison, before it has a number. Its functions own what they need.
struct ComparedPair {
  FrameComparison row;
  bool has_reference = false;
  bool has_actual = false;
  bool is_compared = false;
  /// Of the job, that hide a part of the pictures; all that concern them if they are not compared.
  std::vector<std::size_t> mask_indices = {};
  std::size_t held_bytes = 0;  ///< by the functions, about
};

/// Adds a reason why a frame cannot be read. The same reason on both sides is said once.
void add_unreadable(FrameComparison& row, const std::string& problem);

/// @throws UsageError as compare()
ComparedPair compare_frames(const Fetched& reference, const Fetched& actual,
                            const ComparisonJob& job);

/// Reads and compares two files. Of files with the same bytes only one is inflated.
/// @param in_threads  whether two threads read them
/// @throws UsageError as compare()
ComparedPair compare_pictures(const ListedPicture& reference, const ListedPicture& actual,
                              bool in_threads, const ComparisonJob& job);

/// The comparison of this pair alone, as compare_files() makes it.
/// @throws UsageError as compare_files()
ComparisonResult compare_pair(const Fetched& reference, const Fetched& actual,
                              const ComparisonJob& job,
                              const std::function<void(const FrameComparison&)>& on_frame);

}  // namespace piblocks
