// What a comparison leaves behind for people and for other programs.
// In: the comparison of every frame, in order. Out: a folder of pictures, a page, lists for
// programs.
#pragma once

#include <piblocks/compare.hpp>

#include <memory>
#include <string>

#include "golden/difference.hpp"

namespace piblocks {

class Report {
 public:
  virtual ~Report() = default;
  virtual void add(const FrameComparison& frame) = 0;
  /// Completes the report. @throws IoError
  virtual void finish(const ComparisonJob& job, const ComparisonResult& result) = 0;
};

/// Three PNG files of each of the first kMaxShown frames that are different, as picture_name()
/// names them. finish() makes them appear, and removes those of earlier comparisons, which carry a
/// mark.
/// @throws UsageError if the folder cannot be made, or by finish() if a picture would replace a
///         file that no comparison has written.
std::unique_ptr<Report> diff_folder(const std::string& folder);

enum class ReportForm {
  with_folder,  ///< pictures are in folder_of_report(), as in a diff_folder()
  one_file      ///< needs nothing else; held in memory until it is finished
};

/// An HTML page: every frame that is not equal, the most severe outcomes first, with pictures of
/// the first kMaxShown. @throws UsageError if it cannot be written, or as diff_folder().
std::unique_ptr<Report> html_report(const std::string& path, ReportForm form);

/// "sub/report-files" for "sub/report.html".
std::string folder_of_report(const std::string& path);

/// A test case for every row, in the XML of JUnit: an error if it is unreadable, a failure if it is
/// not accepted for another reason.
/// @throws UsageError if it cannot be written.
std::unique_ptr<Report> junit_report(const std::string& path);

/// An object of JSON with the counts and all rows; rectangles are [x, y, width, height].
/// @throws UsageError if it cannot be written.
std::unique_ptr<Report> json_report(const std::string& path);

}  // namespace piblocks
