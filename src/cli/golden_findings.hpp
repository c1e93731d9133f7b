// What is found about the references of one scene, for people.
// In: the files of the references, compared one after the other. Out: lines, the most severe ones
// first; a summary.
#pragma once

#include <piblocks/compare.hpp>

#include <array>
#include <cstdint>
#include <filesystem>
#include <stop_token>
#include <string>
#include <vector>

#include "golden/difference.hpp"
#include "golden/shown_frames.hpp"

namespace piblocks::cli {

class GoldenFindings {
 public:
  /// Compares a reference with what is drawn now, in lines that name the file once.
  /// @param pictures  takes expected, difference and actual of a picture that differs, or nullptr.
  void compare(const std::filesystem::path& reference, const std::filesystem::path& actual,
               DiffPictures* pictures, const std::stop_token& stop);
  /// A file that cannot be compared. @param what  the line without the file's name.
  void add(Outcome outcome, const std::string& file, const std::string& what);

  Outcome worst() const;
  /// "equal", "different", "incomplete" if references are missing and nothing else is found, or
  /// "unreadable".
  const char* outcome() const;
  /// The first of the most severe ones, and how many more there are.
  std::vector<std::string> lines() const { return shown_.all(); }
  /// "236 of 489 frames differ, 1 of 4 pictures differ"; empty if all is equal.
  std::string counts() const;
  /// Frames of the film whose hashes are not those of the references.
  const std::vector<std::int64_t>& changed_frames() const noexcept { return changed_frames_; }

 private:
  using Counts = std::array<std::int64_t, kOutcomes>;

  void compare_hashes(const ComparisonJob& job, const std::string& file,
                      const std::stop_token& stop);
  void compare_pictures(const ComparisonJob& job, const std::string& file, DiffPictures* pictures,
                        const std::stop_token& stop);

  Counts frames_ = {};    // by outcome
  Counts pictures_ = {};  // by outcome; of everything else, such as unreadable files
  std::vector<std::int64_t> changed_frames_;
  ShownLines shown_;
};

}  // namespace piblocks::cli
