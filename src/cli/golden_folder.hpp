// Pictures of any program, held to references in a folder: 'golden check DIR --against REFS'.
// In: options. Out: lines, reports, references; the tolerance, kept beside the references.
#pragma once

#include <piblocks/compare.hpp>

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "cli/command.hpp"

namespace piblocks::cli {

/// Versions of what paints on this machine, without the fonts that scenes have.
std::string library_versions();

/// What is accepted: options of the command line, and those that are kept beside the references. If
/// the command line has any but masks, it replaces all that are kept but masks.
class GoldenSettings {
 public:
  /// @throws IoError; UsageError if the file has anything else, or if a mask of the command line
  ///         cannot be kept
  GoldenSettings(const Command& given, const std::filesystem::path& references);

  /// Gives the job its tolerance and its masks. Of kept masks none has to hide anything: pictures
  /// may have gone or changed since. @throws UsageError
  void apply_to(ComparisonJob& job) const;
  /// library_versions() where they were recorded; empty if it is not known.
  const std::string& recorded_with() const noexcept { return versions_; }

  enum class Versions { of_this_machine, as_before };
  /// Keeps the options and comments, and versions if they are known.
  /// @param removed  names of pictures whose masks are kept no longer
  void write(Versions versions, const std::set<std::string>& removed = {}) const;

 private:
  void read(const std::string& line);
  std::vector<std::string> texts(const std::string& option) const;
  /// Makes paths relative to the references, so that they hold wherever a command is given.
  /// @throws UsageError if a mask cannot be kept
  std::vector<std::string> relative_to_references(std::vector<std::string> masks) const;

  const Command& given_;
  std::filesystem::path path_;
  std::string versions_;
  std::vector<std::string> comments_;
  OptionMap kept_;
  bool replaces_;
};

/// Compares the pictures with the references, and writes none. @throws ExitError
void check_folder(const Command& command);
/// Adds references that are missing. Without --missing, those that are there must be accepted.
/// @throws ExitError
void record_folder(const Command& command);
/// Replaces references, all that are not accepted or those that are named.
void approve_folder(const Command& command);

}  // namespace piblocks::cli
