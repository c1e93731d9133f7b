// What 'golden' of a folder accepts: options kept beside the references.
// In: the command line, the folder of the references. Out: options; the file that keeps them.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "cli/command.hpp"

namespace piblocks::cli {

/// What paints on this machine, without the fonts that scenes have.
std::string painter();

/// The lines of a text file; none if it is not there. @throws IoError
std::vector<std::string> lines_of(const std::filesystem::path& path);

bool lies_in(const std::filesystem::path& path, const std::filesystem::path& folder);

/// Options of the command line, and before them those that are kept beside the references. If the
/// command line has any but masks, it replaces all that are kept but masks.
class GoldenSettings final : public OptionTexts {
 public:
  /// @throws IoError; UsageError if the file has anything else
  GoldenSettings(const Command& given, const std::filesystem::path& references);

  bool is_given(const std::string& option) const override { return !texts(option).empty(); }
  std::optional<std::string> text(const std::string& option) const override;
  std::vector<std::string> texts(const std::string& option) const override;
  /// painter() where they were recorded; empty if it is not known.
  const std::string& recorded_beside() const noexcept { return painter_; }

  /// Keeps the options, and says what paints here.
  /// @param removed  names of pictures whose masks are kept no longer
  void write(const std::set<std::string>& removed = {}) const;

 private:
  void read(const std::string& line);
  /// Makes paths relative to the references, so that they hold wherever a command is given.
  /// @throws UsageError if a mask is among the references
  void to_references(std::vector<std::string>& masks) const;

  const Command& given_;
  std::filesystem::path path_;
  std::string painter_;
  std::map<std::string, std::vector<std::string>> kept_;
  bool replaces_;
};

}  // namespace piblocks::cli
