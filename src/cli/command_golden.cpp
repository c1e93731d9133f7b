#include <fmt/format.h>
#include <piblocks/compare.hpp>
#include <piblocks/script.hpp>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <system_error>

#include "cli/command.hpp"
#include "cli/options.hpp"
#include "cli/scene_options.hpp"
#include "cli/shipped_scenes.hpp"
#include "cli/stop_on_signals.hpp"
#include "cli/text_output.hpp"
#include "core/output_file.hpp"
#include "core/overwrite_check.hpp"
#include "core/text.hpp"
#include "draw/canvas.hpp"
#include "golden/reports.hpp"
#include "render/references.hpp"

namespace piblocks::cli {
namespace fs = std::filesystem;
namespace {

std::vector<References> references_of(const Command& options) {
  std::vector<References> all;
  std::vector<std::string> problems;
  for (const std::string& scene : options.texts("SCENE")) {
    try {
      ScriptBuilder builder;
      read_scene(builder, scene);
      if (const auto frames = options.text("--frames")) {
        builder.set("--frames", "golden.frames", *frames);
      }
      all.emplace_back(fs::path(scene).stem(), builder, *options.text("--dir"));
    } catch (const UsageError& error) {
      problems.insert(problems.end(), error.problems().begin(), error.problems().end());
    }
  }
  for (auto one = all.begin(); one != all.end(); ++one) {
    const auto same = [&](const References& other) { return other.name() == one->name(); };
    if (std::find_if(all.begin(), one, same) == one) continue;
    problems.push_back(fmt::format("golden: two scenes have the name '{}'", one->name()));
  }
  if (!problems.empty()) throw UsageError(std::move(problems));
  return all;
}

void claim_inputs(OverwriteCheck& check, const Command& options,
                  const std::vector<References>& all) {
  for (const std::string& scene : options.texts("SCENE")) claim_scene(check, scene);
  for (const References& references : all) claim_logos(check, references.script());
  check.writes_standard_output();
}

/// Where the differences from a reference go. Those of hashes are no pictures.
std::optional<fs::path> diff_folder_of(const Command& options, const std::string& file) {
  const auto diff = options.text("--diff");
  if (!diff || !has_ending(file, ".png")) return std::nullopt;
  return fs::path(*diff) / fs::path(file).stem();
}

/// @throws UsageError if differences would replace a reference or an input.
void check_diff(const Command& options, const std::vector<References>& all) {
  OverwriteCheck check;
  claim_inputs(check, options, all);
  check.reads_folder("the folder of the references", *options.text("--dir"));
  if (const auto diff = options.text("--diff")) claim_diff_folder(check, *diff);
  for (const References& references : all) {
    for (const std::string& file : references.files()) {
      if (const auto folder = diff_folder_of(options, file)) claim_diff_folder(check, *folder);
    }
  }
  check.check();
}

/// @throws UsageError if references would replace an input.
void check_references(const Command& options, const std::vector<References>& all) {
  OverwriteCheck check;
  claim_inputs(check, options, all);
  for (const References& references : all) {
    for (const std::string& file : references.files()) check.writes("--dir", references.path(file));
  }
  check.check();
}

/// @throws UsageError if a picture that would be replaced belongs to no references.
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

/// Prints what differs from a reference. False if anything does.
bool compare_file(const fs::path& reference, const fs::path& actual, Report* report,
                  TextOutput& out) {
  const ComparisonJob job{reference, actual};
  const auto on_frame = [&](const FrameComparison& frame) {
    if (frame.is_accepted) return;
    out.format_line("{}: {}: {}", reference.filename().string(), frame.name,
                    difference_text(frame));
    if (report != nullptr) report->add(frame);
  };
  const ComparisonResult result = compare_files(job, on_frame);
  if (!result.mismatch.empty()) {
    out.format_line("{}: {}", reference.filename().string(), result.mismatch);
  }
  if (report != nullptr) report->finish(job, result);
  return result.verdict == Verdict::equal;
}

/// Says so if the references were painted by something else, which is why they may differ.
void note_fingerprint(const References& references, TextOutput& out) {
  if (!references.exist()) return;
  const std::string theirs = references.fingerprint();
  const std::string ours = painter_fingerprint();
  if (theirs == ours) return;
  out.format_line("{}: the references were painted by {}; this is {}", references.name(),
                  theirs.empty() ? "something unnamed" : theirs, ours);
}

/// Hands on at once what it says of one scene.
void conclude(const References& references, const char* verdict, TextOutput& out) {
  out.format_line("{}: {}", references.name(), verdict);
  out.flush();
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

bool check(const References& references, const Command& options, TextOutput& out,
           const std::stop_token& stop) {
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
    const auto folder = diff_folder_of(options, file);
    const auto report = folder ? diff_folder(*folder) : nullptr;
    is_equal &= compare_file(references.path(file), scratch.path() / file, report.get(), out);
  }
  note_fingerprint(references, out);
  conclude(references, is_equal ? "equal" : "different", out);
  return is_equal;
}

void run_check(const Command& options) {
  const std::vector<References> all = references_of(options);
  TextOutput out("-");
  check_diff(options, all);
  const StopOnSignals signals;
  bool is_equal = true;
  for (const References& references : all) {
    is_equal &= check(references, options, out, signals.token());
  }
  out.finish();
  if (!is_equal) throw ExitError(kDifferent);
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

void run_record(const Command& options) {
  const std::vector<References> all = references_of(options);
  TextOutput out("-");
  check_references(options, all);
  for (const References& references : all) {
    if (references.exist()) {
      throw UsageError(
          fmt::format("golden: '{}' has references; replace them by 'piblocks golden approve'",
                      references.name()));
    }
    check_pictures(references);
  }
  const StopOnSignals signals;
  for (const References& references : all) {
    FileSet files(references.folder(), references.name() + ".golden");
    render_into(files, references, signals.token());
    files.commit();
    conclude(references, "recorded", out);
  }
  out.finish();
}

void approve(const References& references, TextOutput& out, const std::stop_token& stop) {
  FileSet files(references.folder(), references.name() + ".golden");
  const fs::path found = render_into(files, references, stop);
  bool is_equal = true;
  for (const std::string& file : references.files()) {
    const bool is_there = references.has(file);
    if (!is_there) out.format_line("{}: new", file);
    is_equal &= is_there && compare_file(references.path(file), found / file, nullptr, out);
  }
  note_fingerprint(references, out);
  files.commit();
  conclude(references, is_equal ? "equal" : "replaced", out);
}

void run_approve(const Command& options) {
  const std::vector<References> all = references_of(options);
  TextOutput out("-");
  check_references(options, all);
  for (const References& references : all) check_pictures(references);
  const StopOnSignals signals;
  for (const References& references : all) approve(references, out, signals.token());
  out.finish();
}

void add_action(Command& golden, const char* name, const char* help,
                void (*run)(const Command& options)) {
  Command command = golden.add_command(name, help);
  command.add_arguments("SCENE",
                        "Scene files, or names that 'piblocks scenes' lists; [golden] in them\n"
                        "says which pictures are kept");
  command.add_required_value("--dir", "DIR", "The folder of the references");
  command.add_value("--frames", "T,…",
                    "Instants kept as pictures, instead of the scene's: 3.5, last, #K");
  if (run == run_check) {
    command.add_value("--diff", "DIR", "Write expected, difference and actual of pictures");
  }
  command.on_run([=] { run(command); });
}

}  // namespace

void add_golden(Command& app) {
  Command command = app.add_command("golden", "Hold scenes to references: record, check, approve");
  command.require_command();
  add_action(command, "record", "Keep references of scenes that have none", run_record);
  add_action(command, "check", "Compare scenes with their references; writes none", run_check);
  add_action(command, "approve", "Replace references, and tell what changes", run_approve);
  command.set_footer(
      "Exit codes of check: 0 equal, 1 different, 2 wrong usage, 3 no references.\n\n"
      "Examples:\n"
      "  piblocks golden record scenes/*.toml --dir golden\n"
      "  piblocks golden check scenes/*.toml --dir golden --diff differences");
}

}  // namespace piblocks::cli
