// The rows of a comparison, counted in one place for pictures, videos and hashes; files of hashes
// (read_framehash), and their rows.
// In: what was found about a frame, or two files of hashes. Out: the row with its number, and the
// counts of all.
#pragma once

#include <piblocks/compare.hpp>

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "golden/frame_pair.hpp"

namespace piblocks {

using OnFrame = std::function<void(const FrameComparison&)>;

class Rows {
 public:
  Rows(const ComparisonJob& job, OnFrame on_frame)
      : job_(job), on_frame_(std::move(on_frame)), hides_(job.masks.size()) {}

  /// Numbers the row, counts it, and hands it on.
  void take(ComparedPair pair);

  /// Notes why a side has no frame, or why no picture has a partner. The first reason stays.
  void set_problem(const std::string& problem) {
    if (result_.problem.empty()) result_.problem = problem;
  }
  void set_note(const std::string& note) { result_.note = note; }
  /// The result. A comparison in which a side has no frame is never equal.
  /// @throws UsageError if a mask lies outside of every picture.
  ComparisonResult finish();

 private:
  void check_masks() const;

  const ComparisonJob& job_;
  OnFrame on_frame_;
  std::vector<bool> hides_;  // of each mask: a part of some picture
  bool is_compared_ = false;
  ComparisonResult result_;
  std::int64_t number_ = 0;
};

/// Whether it is a file of frame hashes, as FFmpeg's framehash and framemd5 muxers write them, by
/// the file extension.
bool is_framehash(const std::string& name);

struct FramehashFile {
  std::vector<std::string> header;  ///< its lines, without the one that names the software
  std::vector<std::string> frames;  ///< a line each, without blanks
};

/// @throws IoError if it cannot be read, is not such a file, or has more than kMaxHashes lines.
FramehashFile read_framehash(const std::string& path);

/// Compares line by line. @throws UsageError if one is no file of hashes, by its name, or the job
/// has a tolerance or masks.
void compare_hashes(const ComparisonJob& job, Rows& rows);

}  // namespace piblocks
