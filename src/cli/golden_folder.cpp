#include "cli/golden_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <set>
#include <sstream>
#include <string_view>
#include <system_error>
#include <vector>

#include "cli/comparison.hpp"
#include "cli/exit_code.hpp"
#include "cli/stop_on_signals.hpp"
#include "cli/text_output.hpp"
#include "cli/tolerance_options.hpp"
#include "core/input_file.hpp"
#include "core/output_file.hpp"
#include "core/text.hpp"
#include "draw/canvas.hpp"
#include "golden/difference.hpp"

namespace piblocks::cli {
namespace fs = std::filesystem;
namespace {

/// Beside the references: a comment that says what paints on this machine, and options.
constexpr const char* kSettings = "piblocks-golden.txt";
constexpr std::string_view kPainter = "# recorded beside ";

/// What paints on this machine, without the fonts that scenes have.
std::string painter() {
  const std::string all = painter_fingerprint();
  return all.substr(0, all.find(", fonts"));
}

bool is_tolerance_option(const std::string& name) {
  return std::ranges::any_of(kToleranceOptions, [&](const char* one) { return one == name; });
}

/// Whether the option has no value.
bool is_flag(const std::string& name) {
  return name == "--count-antialiasing" || name == "--ignore-transparent";
}

/// Whether there is any of the options but masks.
bool has_tolerance(const Command& command) {
  return std::ranges::any_of(kToleranceOptions, [&](const std::string& name) {
    return name != "--mask" && command.is_given(name);
  });
}

/// The lines of a text file; none if it is not there. @throws IoError
std::vector<std::string> lines_of(const fs::path& path) {
  std::error_code error;
  if (fs::status(path, error).type() == fs::file_type::not_found) return {};
  refuse_pipe(path, "golden");
  std::ifstream file(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) {
    if (line.ends_with('\r')) line.pop_back();  // written or checked out on Windows
    lines.push_back(line);
  }
  if (file.bad() || !file.eof()) {
    throw IoError(fmt::format("golden: cannot read '{}'", path.string()));
  }
  return lines;
}

/// Options of the command line, and before them those that are kept beside the references. If the
/// command line has any but masks, it replaces all that are kept but masks.
class FolderOptions final : public OptionTexts {
 public:
  FolderOptions(const Command& given, const fs::path& references)
      : given_(given), path_(references / kSettings), replaces_(has_tolerance(given)) {
    for (const std::string& line : lines_of(path_)) read(line);
  }

  bool is_given(const std::string& option) const override { return !texts(option).empty(); }
  std::optional<std::string> text(const std::string& option) const override {
    const std::vector<std::string> all = texts(option);
    return all.empty() ? std::nullopt : std::optional(all.front());
  }
  std::vector<std::string> texts(const std::string& option) const override {
    std::vector<std::string> all = given_.texts(option);
    const auto kept = kept_.find(option);
    if (kept == kept_.end() || (replaces_ && option != "--mask")) return all;
    all.insert(all.end(), kept->second.begin(), kept->second.end());
    return all;
  }
  const std::string& recorded_beside() const noexcept { return painter_; }

  /// Keeps the options, and says what paints here.
  /// @param removed  names of pictures whose masks are kept no longer
  void write(const std::set<std::string>& removed = {}) const {
    std::string text = fmt::format("{}{}\n", kPainter, painter());
    for (const std::string option : kToleranceOptions) {
      std::vector<std::string> values = texts(option);
      std::ranges::sort(values);
      values.erase(std::unique(values.begin(), values.end()), values.end());
      std::erase_if(values, [&](const std::string& value) {
        const std::size_t end = value.rfind(':');
        return end != std::string::npos && removed.contains(value.substr(0, end));
      });
      for (const std::string& value : values) {
        text += is_flag(option) ? option : fmt::format("{}={}", option, value);
        text += '\n';
      }
    }
    OutputFile file(path_.string(), OutputFile::Contents::text);
    file.write(text);
    file.finish();
  }

 private:
  void read(const std::string& line) {
    if (line.starts_with(kPainter)) painter_ = line.substr(kPainter.size());
    if (line.empty() || line.starts_with('#')) return;
    const std::size_t end = line.find('=');
    const std::string name = line.substr(0, end);
    if (!is_tolerance_option(name)) {
      throw UsageError(fmt::format("golden: '{}' has '{}'; it may have {}", path_.string(),
                                   shortened(line), fmt::join(kToleranceOptions, ", ")));
    }
    const bool has_value = end != std::string::npos;
    if (has_value == is_flag(name)) {
      throw UsageError(fmt::format("golden: '{}' has '{}'; {} has {}", path_.string(),
                                   shortened(line), name, has_value ? "no value" : "a value"));
    }
    std::vector<std::string>& values = kept_[name];
    values.push_back(has_value ? line.substr(end + 1) : "true");
    if (values.size() > 1 && name != "--mask") {
      throw UsageError(fmt::format("golden: '{}' has {} twice", path_.string(), name));
    }
  }

  const Command& given_;
  fs::path path_;
  std::string painter_;
  std::map<std::string, std::vector<std::string>> kept_;
  bool replaces_;
};

bool lies_in(const fs::path& path, const fs::path& folder) {
  std::error_code error;
  const fs::path relative = fs::relative(fs::weakly_canonical(path, error), folder, error);
  return !error && !relative.empty() && *relative.begin() != "..";
}

/// The pictures, the references and what is accepted.
struct Folder {
  explicit Folder(const Command& command)
      : arguments(command.texts("SCENE")),
        pictures(arguments.front()),
        references(*command.text("--against")),
        options(command, references),
        job{references, pictures} {
    std::error_code error;
    if (!fs::is_directory(pictures, error)) {
      throw UsageError(fmt::format("golden: '{}' is no folder of pictures", pictures.string()));
    }
    if (lies_in(references, pictures) || lies_in(pictures, references)) {
      throw UsageError(fmt::format(
          "golden: of '{}' and '{}' one lies in the other; put the references elsewhere",
          pictures.string(), references.string()));
    }
    read_tolerance(options, job);
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
  FolderOptions options;
  ComparisonJob job;
};

/// What is found about a picture, after its pixels are gone.
struct Row {
  std::string name;
  Outcome outcome;
  std::string actual;  // the file; empty if there is none that can be read
  std::string text;
};

std::vector<Row> compared(const Folder& folder) {
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

void copy_to_references(const Folder& folder, const Row& row) {
  constexpr std::size_t kAny = std::size_t{1} << 40;
  const std::vector<std::uint8_t> bytes = bytes_of_file(row.actual, kAny);
  if (bytes.empty()) throw IoError(fmt::format("golden: cannot read '{}'", row.actual));
  OutputFile file((folder.references / row.name).string());
  file.write(bytes);
  file.finish();
}

/// The names behind the folder, and those of a list that a report has made.
std::set<std::string> chosen_names(const Command& command, const Folder& folder) {
  std::set<std::string> names(folder.arguments.begin() + 1, folder.arguments.end());
  const auto list = command.text("--accepted");
  if (!list) return names;
  const std::vector<std::string> lines = lines_of(*list);
  names.insert(lines.begin(), lines.end());
  names.erase("");
  if (names.empty()) {
    throw UsageError(fmt::format("golden: '{}' has no names, or is not there", *list));
  }
  return names;
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
  throw UsageError(fmt::format("golden: there is no picture '{}'", fmt::join(left, "', '")));
}

}  // namespace

void check_folder(const Command& command) {
  const Folder folder(command);
  folder.refuse_names();
  run_comparison(command, folder.job, [&](const ComparisonResult& result) {
    std::vector<std::string> notes;
    if (const std::int64_t unused = result.count(Outcome::missing); unused > 0) {
      notes.push_back(
          fmt::format("{} without a picture; 'golden approve --remove-unused' removes what is not "
                      "used any more",
                      counted(unused, "reference")));
    }
    const std::string& theirs = folder.options.recorded_beside();
    if (result.worst() > Outcome::accepted && !theirs.empty() && theirs != painter()) {
      notes.push_back(
          fmt::format("the references were recorded beside {}; this machine has {}, "
                      "which may be why text and edges differ",
                      theirs, painter()));
    }
    return notes;
  });
}

void record_folder(const Command& command) {
  const Folder folder(command);
  folder.refuse_names();
  TextOutput out;
  int code = 0;
  std::int64_t recorded = 0;
  const std::vector<Row> rows = compared(folder);
  for (const Row& row : rows) {
    const bool is_found = row.outcome > Outcome::accepted && row.outcome != Outcome::added &&
                          row.outcome != Outcome::missing;
    if (!is_found || command.is_given("--missing")) continue;
    code = worse_exit_code(code, kExitCodes.at(static_cast<std::size_t>(row.outcome)));
    out.line(printable(fmt::format("{}: {}", row.name, row.text)));
  }
  if (code != 0) {
    out.finish();
    throw ExitError(code,
                    "golden: nothing is recorded, since references are not what is there now; "
                    "--missing adds those that are missing, 'golden approve' replaces the others");
  }
  for (const Row& row : rows) {
    if (row.outcome != Outcome::added || row.actual.empty()) continue;
    copy_to_references(folder, row);
    ++recorded;
  }
  folder.options.write();
  for (const Row& row : rows) {
    if (row.outcome != Outcome::unreadable) continue;
    out.line(printable(fmt::format("{}: left as it is ({})", row.name, row.text)));
  }
  out.line(fmt::format("recorded: {}", counted(recorded, "new reference")));
  out.finish();
  check_readable(rows);
}

void approve_folder(const Command& command) {
  const Folder folder(command);
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
      fs::remove(folder.references / row.name);
      removed.insert(row.name);
      done = "removed";
    }
    if (done != nullptr) out.line(printable(fmt::format("{}: {} ({})", row.name, done, row.text)));
    if (done == nullptr && row.outcome != Outcome::equal) {
      out.line(printable(fmt::format("{}: left as it is ({})", row.name, row.text)));
    }
  }
  folder.options.write(removed);
  out.line(
      fmt::format("approved: {} replaced, {} added, {} removed", replaced, added, removed.size()));
  out.finish();
  check_readable(rows);
}

}  // namespace piblocks::cli
