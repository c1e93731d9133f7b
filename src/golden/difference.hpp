// How people are shown differences: in words, in a picture, and in a folder of pictures.
// In: what was found about a frame or about all of them. Out: lines; PNG files of what was
// expected, what was found, and the difference, instead of those of earlier comparisons.
#pragma once

#include <piblocks/compare.hpp>

#include <cstddef>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/file_set.hpp"
#include "core/overwrite_check.hpp"
#include "media/output/bytes.hpp"

namespace piblocks {

/// What is found about a frame: "3 pixels differ, largest delta 200 of 255, first at x=10 y=20
/// (red) …", "missing", or why it cannot be read.
std::string difference_text(const FrameComparison& frame);

/// The frame's name and difference_text(); only the text if it has the name already.
std::string row_text(const FrameComparison& frame);

/// The summary of a comparison: "different: 3 of 12 frames differ, 1 missing".
std::string summary_text(const ComparisonJob& job, const ComparisonResult& result);

/// What the job accepts: "Samples may differ by up to 3 of 255, except in up to 40 pixels."
std::string tolerance_text(const ComparisonJob& job);

inline constexpr std::size_t kMaxRegions = 100;

/// Rectangles around all pixels that differ. They do not touch: those nearer than 16 pixels are
/// joined, and more distant ones where there would be more than kMaxRegions. Takes time in
/// proportion to the pixels.
/// @param deltas  as pixel_deltas() returns them
std::vector<PixelRect> changed_regions(std::span<const std::uint8_t> deltas, int width_px);

/// A PNG file: the reference in pale grey, on white where it is transparent, with red where pixels
/// differ, stronger where they differ more.
/// @param deltas  as pixel_deltas() returns them
Bytes difference_picture(const Image& reference, const std::vector<std::uint8_t>& deltas);

inline constexpr const char* kExpected = "expected";
inline constexpr const char* kActual = "actual";
inline constexpr const char* kDiff = "diff";

struct FramePicture {
  const char* kind;  ///< one of these
  int width_px;
  int height_px;
  Bytes png;  ///< a whole file
};

/// What there is to see of a frame, in the order of the kinds. A PNG file is copied, as far as it
/// can still be read. Nothing if colours of a frame that was compared are not known.
std::vector<FramePicture> pictures_of(const FrameComparison& frame);

/// The name of such a picture in the folder: "sub/7-diff.png". @param key  of the frame
std::string picture_name(const std::string& key, std::string_view kind);

/// Pictures of differences in a folder. Several comparisons may share it: the last one wins.
class DiffPictures {
 public:
  enum class Making { at_once, when_needed };

  /// @param making  when the folder is made: `at_once`, so that a long comparison does not fail at
  ///                its end; or `when_needed`, so that one without differences leaves no folder.
  /// @throws UsageError if the folder cannot be made.
  DiffPictures(std::filesystem::path folder, Making making);

  /// Writes a picture, under a temporary name until finish(), which throws if this fails.
  void add(const std::string& key, std::string_view kind, ByteSpan png);
  /// Leaves out the pictures of a frame again.
  void drop(const std::string& key);
  /// Number of frames.
  std::size_t count() const noexcept { return names_.size(); }
  /// Gives the pictures their names, and removes those of earlier comparisons, which carry a mark.
  /// Waits while another comparison does the same.
  /// @throws UsageError if a picture would replace a file that no comparison has written; IoError
  void finish();

 private:
  FileSet& files_of(const std::filesystem::path& name);
  bool is_new(const std::filesystem::path& name) const;

  std::filesystem::path folder_;
  Making making_;
  std::exception_ptr failure_;                             // the first
  std::map<std::filesystem::path, FileSet> files_;         // by subfolder
  std::map<std::string, std::vector<std::string>> names_;  // by the keys of the frames
};

/// Enters the pictures of such a folder as files that are written; all files of it if it is made
/// when it is needed. @param option  that names it, for messages
void claim_diff_folder(OverwriteCheck& check, const std::string& option, const std::string& folder,
                       DiffPictures::Making making);

}  // namespace piblocks
