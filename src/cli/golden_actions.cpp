#include "cli/golden_actions.hpp"

#include <fmt/format.h>
#include <piblocks/compare.hpp>
#include <piblocks/error.hpp>

#include <filesystem>
#include <memory>
#include <system_error>

#include "cli/command.hpp"
#include "core/output_file.hpp"
#include "core/processors.hpp"
#include "core/text.hpp"
#include "draw/canvas.hpp"
#include "golden/reports.hpp"

namespace piblocks::cli {
namespace fs = std::filesystem;
namespace {

/// Where the differences from a reference go. Those of hashes are no pictures.
std::optional<fs::path> diff_folder_of(const std::optional<std::string>& diff,
                                       const std::string& file) {
  if (!diff || !has_ending(file, ".png")) return std::nullopt;
  return fs::path(*diff) / fs::path(file).stem();
}

/// Prints what differs from a reference. False if anything does.
bool compare_file(const fs::path& reference, const fs::path& actual, Report* report,
                  const SayLine& say) {
  const ComparisonJob job{reference, actual};
  const auto on_frame = [&](const FrameComparison& frame) {
    if (frame.is_accepted()) return;
    const std::string file = reference.filename();
    say(frame.name == file ? row_text(frame) : fmt::format("{}: {}", file, row_text(frame)));
    if (report != nullptr) report->add(frame);
  };
  const ComparisonResult result = compare_files(job, on_frame);
  if (report != nullptr) report->finish(job, result);
  return result.worst() == Outcome::equal;
}

/// Says so if the references were painted by something else, which is why they may differ.
void note_fingerprint(const References& references, const SayLine& say) {
  if (!references.exist()) return;
  const std::string theirs = references.fingerprint();
  const std::string ours = painter_fingerprint();
  if (theirs == ours) return;
  say(fmt::format("{}: the references were painted by {}; this is {}", references.name(),
                  theirs.empty() ? "something unnamed" : theirs, ours));
}

/// @throws UsageError
fs::path temporary_folder() {
  std::error_code error;
  fs::path folder = fs::temp_directory_path(error);
  if (!error) return folder;
  throw UsageError(
      fmt::format("golden: cannot use the folder for temporary files, $TMPDIR or /tmp: {}; set "
                  "TMPDIR to one that is there",
                  error.message()));
}

/// Renders new references into `files`, which gives all of them their names, or none.
/// @returns the folder in which they wait.
fs::path render_into(FileSet& files, const References& references, const std::stop_token& stop) {
  const std::vector<std::string> names = references.files();
  fs::path folder;
  // Hashes come last: where they are, all is.
  for (auto name = names.rbegin(); name != names.rend(); ++name) {
    folder = files.add(*name).parent_path();
  }
  references.render_into(folder, processor_count(), stop);
  return folder;
}

}  // namespace

void claim_diff(OverwriteCheck& check, const std::vector<References>& all,
                const std::string& folder, const std::optional<std::string>& diff) {
  check.reads_folder("the folder of the references", folder);
  if (diff) claim_diff_folder(check, *diff);
  for (const References& references : all) {
    for (const std::string& file : references.files()) {
      if (const auto pictures = diff_folder_of(diff, file)) claim_diff_folder(check, *pictures);
    }
  }
}

void check_pictures(const References& references) {
  if (references.exist()) return;
  for (const std::string& file : references.files()) {
    std::error_code none;
    if (!fs::exists(fs::symlink_status(references.path(file), none))) continue;
    throw UsageError(fmt::format(
        "golden: cannot record '{}': '{}' is there, and belongs to no references; move it away",
        references.name(), references.path(file).string()));
  }
}

void check_unrecorded(const References& references) {
  if (references.exist()) {
    throw UsageError(
        fmt::format("golden: '{}' has references; replace them by 'piblocks golden approve'",
                    references.name()));
  }
  check_pictures(references);
}

void record_golden(const References& references, const SayLine& say, const std::stop_token& stop) {
  FileSet files(references.folder(), references.name() + ".golden");
  render_into(files, references, stop);
  files.commit();
  say(fmt::format("{}: recorded", references.name()));
}

void approve_golden(const References& references, const SayLine& say, const std::stop_token& stop) {
  FileSet files(references.folder(), references.name() + ".golden");
  const fs::path found = render_into(files, references, stop);
  bool is_equal = true;
  for (const std::string& file : references.files()) {
    const bool is_there = references.has(file);
    if (!is_there) say(fmt::format("{}: new", file));
    is_equal &= is_there && compare_file(references.path(file), found / file, nullptr, say);
  }
  note_fingerprint(references, say);
  files.commit();
  say(fmt::format("{}: {}", references.name(), is_equal ? "equal" : "replaced"));
}

bool check_golden(const References& references, const std::optional<std::string>& diff,
                  const SayLine& say, const std::stop_token& stop) {
  const Unfinished scratch(temporary_folder() / "piblocks-golden", Unfinished::Kind::folder);
  references.render_into(scratch.path(), processor_count(), stop);
  bool is_equal = true;
  for (const std::string& file : references.files()) {
    if (!references.has(file)) {
      throw ExitError(
          kMissingReference,
          fmt::format("golden: there is no reference '{}'; see 'piblocks golden record'",
                      references.path(file).string()));
    }
    const auto folder = diff_folder_of(diff, file);
    const auto report = folder ? diff_folder(*folder) : nullptr;
    is_equal &= compare_file(references.path(file), scratch.path() / file, report.get(), say);
  }
  note_fingerprint(references, say);
  say(fmt::format("{}: {}", references.name(), is_equal ? "equal" : "different"));
  return is_equal;
}

}  // namespace piblocks::cli
