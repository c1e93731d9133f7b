// Golden references: record them, check against them, replace them.
// In: the references of a scene. Out: lines of text, files, and whether everything is equal.
#pragma once

#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "core/overwrite_check.hpp"
#include "render/references.hpp"

namespace piblocks::cli {

/// Takes a line about a scene, without its end.
using SayLine = std::function<void(const std::string& line)>;

/// Enters the folder of the references as one that is read, and the pictures of differences as
/// files that are written. @param diff  the folder for these, if there is one.
void claim_diff(OverwriteCheck& check, const std::vector<References>& all,
                const std::string& folder, const std::optional<std::string>& diff);

/// @throws UsageError if a picture that would be replaced belongs to no references.
void check_pictures(const References& references);

/// @throws UsageError if the scene has references, or as check_pictures().
void check_unrecorded(const References& references);

/// Writes the references of a scene that has none: all of them, or none.
void record_golden(const References& references, const SayLine& say, const std::stop_token& stop);

/// Replaces the references of a scene, and says what changes.
void approve_golden(const References& references, const SayLine& say, const std::stop_token& stop);

/// Compares the scene with its references, and says what differs.
/// @param diff  a folder for expected, difference and actual of pictures.
/// @returns whether everything is equal.
/// @throws ExitError if a reference is missing.
bool check_golden(const References& references, const std::optional<std::string>& diff,
                  const SayLine& say, const std::stop_token& stop);

}  // namespace piblocks::cli
