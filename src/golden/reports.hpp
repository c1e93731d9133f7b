// What a comparison leaves behind for people and for other programs.
// In: the comparison of every frame, in order. Out: a folder of pictures, a page, a list of tests.
#pragma once

#include <piblocks/compare.hpp>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/overwrite_check.hpp"
#include "golden/difference.hpp"

namespace piblocks {

class Report {
 public:
  virtual ~Report() = default;
  virtual void add(const FrameComparison& frame) = 0;
  /// Completes the report. @throws IoError
  virtual void finish(const ComparisonJob& job, const ComparisonResult& result) = 0;
};

/// A PNG file of each of the first kMaxShown frames that are different: expected, difference,
/// actual. finish() makes them appear, and removes those of earlier comparisons, which carry a
/// mark.
/// @throws UsageError if the folder cannot be made, or by finish() if a picture would replace a
///         file that no comparison has written.
std::unique_ptr<Report> diff_folder(const std::string& folder);

/// Enters the pictures of such a folder as files that are written.
void claim_diff_folder(OverwriteCheck& check, const std::string& folder);

/// One HTML file that needs nothing else: every frame that is not equal, the most severe outcomes
/// first, with pictures of the first kMaxShown.
/// @throws UsageError if it cannot be written.
std::unique_ptr<Report> html_report(const std::string& path);

/// A test case for every row, in the XML of JUnit: an error if it is unreadable, a failure if it is
/// not accepted for another reason.
/// @throws UsageError if it cannot be written.
std::unique_ptr<Report> junit_report(const std::string& path);

}  // namespace piblocks
