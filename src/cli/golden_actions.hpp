// Golden references: record them, check against them, replace them.
// In: the references of a scene. Out: lines of text, files, and what was found.
#pragma once

#include <filesystem>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "core/overwrite_check.hpp"
#include "render/references.hpp"

namespace piblocks::cli {

/// What a command has found or done about the references of one scene.
struct GoldenResult {
  /// Of check: "equal", "different", "incomplete" if some references are missing, "unreadable", or
  /// "no references". Of record: "recorded", "kept" if all were there, or "not recorded". Of
  /// approve: "recorded", "replaced" or "equal".
  std::string outcome;
  int exit_code = 0;  ///< one of those of 'piblocks compare'
  std::vector<std::string> lines = {};
};

/// Enters the folder of the references as one that is read, and the pictures of differences as
/// files that are written. @param diff  the folder for these, if there is one.
void claim_diff(OverwriteCheck& check, const std::vector<References>& all,
                const std::string& folder, const std::optional<std::string>& diff);

/// The folder for temporary files. @throws UsageError if there is none.
std::filesystem::path temporary_folder();

/// Adds the references that the scene does not have, and replaces none. If some are there, they
/// have to be what is drawn now.
/// @throws UsageError if a picture is there, belongs to no references, and is something else.
GoldenResult record_golden(const References& references, const OnProgress& on_progress,
                           const std::stop_token& stop);

/// Replaces the references of a scene, and says what changes.
/// @throws UsageError as record_golden()
GoldenResult approve_golden(const References& references, const OnProgress& on_progress,
                            const std::stop_token& stop);

/// Compares the scene with its references, and says what differs.
/// @param scratch  a folder for temporary files.
/// @param diff     a folder for pictures, which are written to a folder of the scene's name in it:
///                 expected, difference and actual of pictures that differ, and the actual picture
///                 of frames of which only the hash is kept.
GoldenResult check_golden(const References& references, const std::filesystem::path& scratch,
                          const std::optional<std::string>& diff, const OnProgress& on_progress,
                          const std::stop_token& stop);

}  // namespace piblocks::cli
