#include "cli/golden_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <system_error>
#include <vector>

#include "cli/comparison.hpp"
#include "cli/exit_code.hpp"
#include "cli/stop_on_signals.hpp"
#include "cli/text_output.hpp"
#include "core/input_file.hpp"
#include "core/output_file.hpp"
#include "core/text.hpp"
#include "golden/difference.hpp"
#include "golden/picture_list.hpp"

namespace piblocks::cli {
namespace fs = std::filesystem;
namespace {

/// The pictures, the references and what is accepted.
struct FolderComparison {
  explicit FolderComparison(const Command& command)
      : arguments(command.texts("SCENE")),
        pictures(arguments.front()),
        references(*command.text("--against")),
        settings(command, references),
        job{references, pictures} {
    std::error_code error;
    if (!fs::is_directory(pictures, error)) {
      throw UsageError(fmt::format("golden: '{}' is no folder of pictures", pictures.string()));
    }
    const bool is_there = fs::exists(fs::symlink_status(references, error));
    if (is_picture_pattern(references) || (is_there && !fs::is_directory(references, error))) {
      throw UsageError(
          fmt::format("golden: '{}' is no folder; --against takes the folder of the references",
                      references.string()));
    }
    if (lies_in(references, pictures) || lies_in(pictures, references)) {
      throw UsageError(
          fmt::format("golden: '{}' and '{}' must not contain each other; choose another folder "
                      "for the references",
                      pictures.string(), references.string()));
    }
    settings.apply_to(job);
  }

  /// @throws UsageError if anything follows the folder
  void refuse_names() const {
    if (arguments.size() == 1) return;
    throw UsageError(
        fmt::format("golden: unexpected argument '{}': --against takes one folder of "
                    "pictures; only 'approve' takes names behind it",
                    arguments[1]));
  }

  std::vector<std::string> arguments;
  fs::path pictures;
  fs::path references;
  GoldenSettings settings;
  ComparisonJob job;
};

/// What is found about a picture, after its pixels are gone.
struct Row {
  std::string name;
  Outcome outcome;
  std::string actual;  // the file; empty if there is none that can be read
  std::string text;
};

std::vector<Row> compared(const FolderComparison& folder) {
  const StopOnSignals signals;
  std::vector<Row> rows;
  const auto result = compare_files(
      folder.job,
      [&](const FrameComparison& frame) {
        rows.push_back({frame.key, frame.outcome, frame.actual_path, difference_text(frame)});
      },
      signals.token());
  if (result.actual_frames == 0) {
    throw ExitError(kUnreadable,
                    fmt::format("golden: there is no picture in '{}'", folder.pictures.string()));
  }
  return rows;
}

/// @throws ExitError if one of these pictures cannot be read: nothing has been done about it
void check_readable(const std::vector<Row>& rows) {
  const auto unread = std::ranges::count_if(rows, [](const Row& row) {
    return row.outcome == Outcome::unreadable && row.actual.empty();
  });
  if (unread == 0) return;
  throw ExitError(kUnreadable,
                  fmt::format("golden: {} cannot be read", counted(unread, "picture")));
}

void copy_to_references(const FolderComparison& folder, const Row& row) {
  write_file(folder.references / row.name, whole_file(row.actual, "golden"));
}

void remove_reference(const fs::path& path) {
  std::error_code error;
  fs::remove(path, error);
  if (!error) return;
  throw IoError(fmt::format("golden: cannot remove '{}': {}", path.string(), error.message()));
}

/// The names behind the folder, and those of a list that a report has made.
std::set<std::string> chosen_names(const Command& command, const FolderComparison& folder) {
  std::set<std::string> names(folder.arguments.begin() + 1, folder.arguments.end());
  const auto list = command.text("--accepted");
  if (!list) return names;
  std::error_code error;
  const bool is_there = fs::exists(*list, error);
  const std::vector<std::string> lines = lines_of(*list, "golden");
  names.insert(lines.begin(), lines.end());
  names.erase("");
  if (!names.empty()) return names;
  throw UsageError(is_there ? fmt::format("golden: '{}' has no names", *list)
                            : fmt::format("golden: there is no list '{}'", *list));
}

/// The rows to act on. @throws UsageError for names that no row has
std::vector<Row> chosen_rows(const std::vector<Row>& rows, const std::set<std::string>& names) {
  std::set<std::string> left = names;
  std::vector<Row> chosen;
  for (const Row& row : rows) {
    const bool is_named = left.erase(row.name) + left.erase(printable(row.name)) > 0;
    if (is_named || (names.empty() && row.outcome > Outcome::accepted)) chosen.push_back(row);
  }
  if (left.empty()) return chosen;
  throw UsageError(
      fmt::format("golden: there is no picture '{}'; names are paths in the folder of pictures",
                  fmt::join(left, "', '")));
}

}  // namespace

void check_folder(const Command& command) {
  const FolderComparison folder(command);
  folder.refuse_names();
  run_comparison(command, folder.job, [&](const ComparisonResult& result) {
    std::vector<std::string> notes;
    if (result.reference_frames == 0) {
      notes.emplace_back("'golden record' makes references of all pictures");
    } else if (const auto unused = result.count(Outcome::missing); unused > 0) {
      notes.push_back(
          fmt::format("{} without a picture; 'golden approve --remove-unused' removes {}",
                      counted(unused, "reference"), unused == 1 ? "it" : "them"));
    }
    const std::string& theirs = folder.settings.recorded_with();
    if (result.worst() > Outcome::accepted && !theirs.empty() && theirs != library_versions()) {
      notes.push_back(fmt::format(
          "the references were recorded with {}; this machine has {}, so text and edges "
          "may differ",
          theirs, library_versions()));
    }
    return notes;
  });
}

void record_folder(const Command& command) {
  const FolderComparison folder(command);
  folder.refuse_names();
  TextOutput out;
  int code = 0;
  std::int64_t recorded = 0;
  const std::vector<Row> rows = compared(folder);
  for (const Row& row : rows) {
    const bool is_obstacle = row.outcome > Outcome::accepted && row.outcome != Outcome::added &&
                             row.outcome != Outcome::missing;
    if (!is_obstacle || command.is_given("--missing")) continue;
    code = worse_exit_code(code, exit_code_of(row.outcome));
    out.line(printable(fmt::format("{}: {}", row.name, row.text)));
  }
  if (code != 0) {
    out.finish();
    throw ExitError(code,
                    "golden: nothing is recorded, since the pictures above are not equal to their "
                    "references, or cannot be read; --missing records the new ones, 'golden "
                    "approve' replaces references");
  }
  for (const Row& row : rows) {
    if (row.outcome != Outcome::added || row.actual.empty()) continue;
    copy_to_references(folder, row);
    ++recorded;
  }
  using Versions = GoldenSettings::Versions;
  const bool is_first = std::ranges::count(rows, Outcome::added, &Row::outcome) == std::ssize(rows);
  folder.settings.write(is_first ? Versions::of_this_machine : Versions::as_before);
  for (const Row& row : rows) {
    if (row.outcome != Outcome::unreadable) continue;
    out.line(printable(fmt::format("{}: left as it is ({})", row.name, row.text)));
  }
  out.line(fmt::format("recorded: {}", counted(recorded, "new reference")));
  out.finish();
  check_readable(rows);
}

void approve_folder(const Command& command) {
  const FolderComparison folder(command);
  const std::set<std::string> names = chosen_names(command, folder);
  TextOutput out;
  std::int64_t replaced = 0;
  std::int64_t added = 0;
  std::set<std::string> removed;
  const std::vector<Row> rows = chosen_rows(compared(folder), names);
  for (const Row& row : rows) {
    const char* done = nullptr;
    if (!row.actual.empty() && row.outcome != Outcome::equal) {
      copy_to_references(folder, row);
      const bool is_new = row.outcome == Outcome::added;
      ++(is_new ? added : replaced);
      done = is_new ? "added" : "replaced";
    } else if (row.outcome == Outcome::missing && command.is_given("--remove-unused")) {
      remove_reference(folder.references / row.name);
      removed.insert(row.name);
      done = "removed";
    }
    if (done == nullptr && row.outcome == Outcome::equal) continue;
    out.line(printable(
        fmt::format("{}: {} ({})", row.name, done != nullptr ? done : "left as it is", row.text)));
    out.flush();  // what is done is said, also if the next one fails
  }
  using Versions = GoldenSettings::Versions;
  folder.settings.write(names.empty() ? Versions::of_this_machine : Versions::as_before, removed);
  out.line(
      fmt::format("approved: {} replaced, {} added, {} removed", replaced, added, removed.size()));
  out.finish();
  check_readable(rows);
}

}  // namespace piblocks::cli
