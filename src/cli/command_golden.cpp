#include <fmt/format.h>
#include <piblocks/canvas.hpp>
#include <piblocks/compare_files.hpp>

#include <algorithm>
#include <filesystem>
#include <thread>

#include "cli/commands.hpp"
#include "cli/exit_code.hpp"
#include "cli/options.hpp"
#include "cli/stop_on_signals.hpp"
#include "core/output_file.hpp"
#include "core/unfinished.hpp"
#include "golden/describe.hpp"
#include "golden/reports.hpp"
#include "render/references.hpp"

namespace piblocks::cli {
namespace fs = std::filesystem;
namespace {

struct GoldenOptions {
  const CLI::Option* scenes;
  const CLI::Option* folder;
  const CLI::Option* frames;
  const CLI::Option* diff;
};

int processors() { return static_cast<int>(std::max(1U, std::thread::hardware_concurrency())); }

std::vector<References> references_of(const GoldenOptions& options) {
  std::vector<References> all;
  std::vector<std::string> problems;
  for (const std::string& scene : options.scenes->results()) {
    try {
      all.emplace_back(scene, *text_of(*options.folder), text_of(*options.frames).value_or(""));
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

/// Prints what differs from a reference. False if anything does.
bool compare_file(const fs::path& reference, const fs::path& actual, Report* report) {
  const ComparisonJob job{reference, actual};
  const auto on_frame = [&](const FrameComparison& frame) {
    if (frame.is_accepted) return;
    fmt::print("{}: {}: {}\n", reference.filename().string(), frame.name, describe(frame));
    if (report != nullptr) report->add(frame);
  };
  const ComparisonResult result = compare_files(job, on_frame);
  if (!result.mismatch.empty()) {
    fmt::print("{}: {}\n", reference.filename().string(), result.mismatch);
  }
  if (report != nullptr) report->finish(job, result);
  return result.verdict == Verdict::equal;
}

/// Says so if the references were painted by something else, which is why they may differ.
void note_fingerprint(const References& references) {
  if (!references.exist()) return;
  const std::string theirs = references.fingerprint();
  const std::string ours = painter_fingerprint();
  if (theirs == ours) return;
  fmt::print("{}: the references were painted by {}; this is {}\n", references.name(),
             theirs.empty() ? "something unnamed" : theirs, ours);
}

bool check(const References& references, const GoldenOptions& options,
           const std::stop_token& stop) {
  const fs::path folder = *text_of(*options.folder);
  const Unfinished scratch(fs::temp_directory_path() / "piblocks-golden", Unfinished::Kind::folder);
  references.render_into(scratch.path(), processors(), stop);
  const auto diff = text_of(*options.diff);
  bool is_equal = true;
  for (const std::string& file : references.files()) {
    if (!fs::exists(folder / file)) {
      throw ExitCode(kMissingReference,
                     fmt::format("golden: there is no reference '{}'; see 'piblocks golden record'",
                                 (folder / file).string()));
    }
    const auto report = diff ? diff_folder(fs::path(*diff) / fs::path(file).stem()) : nullptr;
    is_equal &= compare_file(folder / file, scratch.path() / file, report.get());
  }
  note_fingerprint(references);
  fmt::print("{}: {}\n", references.name(), is_equal ? "equal" : "different");
  return is_equal;
}

void run_check(const GoldenOptions& options) {
  const StopOnSignals signals;
  bool is_equal = true;
  for (const References& references : references_of(options)) {
    is_equal &= check(references, options, signals.token());
  }
  if (!is_equal) throw ExitCode(kDifferent);
}

/// Hashes come last: where they are, all is.
void replace(const References& references, const fs::path& folder, const fs::path& scratch) {
  const std::vector<std::string> files = references.files();
  for (auto file = files.rbegin(); file != files.rend(); ++file) {
    fs::rename(scratch / *file, folder / *file);
  }
  sync_folder(folder);
}

void run_record(const GoldenOptions& options) {
  const StopOnSignals signals;
  const fs::path folder = *text_of(*options.folder);
  const std::vector<References> all = references_of(options);
  for (const References& references : all) {
    if (!references.exist()) continue;
    throw UsageError(
        fmt::format("golden: '{}' has references; replace them by 'piblocks golden "
                    "approve'",
                    references.name()));
  }
  MadeFolders made(folder);
  for (const References& references : all) {
    const Unfinished scratch(folder / "golden", Unfinished::Kind::folder);
    references.render_into(scratch.path(), processors(), signals.token());
    replace(references, folder, scratch.path());
    made.keep();
    fmt::print("{}: recorded\n", references.name());
  }
}

void run_approve(const GoldenOptions& options) {
  const StopOnSignals signals;
  const fs::path folder = *text_of(*options.folder);
  const std::vector<References> all = references_of(options);
  MadeFolders made(folder);
  for (const References& references : all) {
    const Unfinished scratch(folder / "golden", Unfinished::Kind::folder);
    references.render_into(scratch.path(), processors(), signals.token());
    bool is_equal = true;
    for (const std::string& file : references.files()) {
      const bool is_there = fs::exists(folder / file);
      if (!is_there) fmt::print("{}: new\n", file);
      is_equal &= is_there && compare_file(folder / file, scratch.path() / file, nullptr);
    }
    note_fingerprint(references);
    replace(references, folder, scratch.path());
    made.keep();
    fmt::print("{}: {}\n", references.name(), is_equal ? "equal" : "replaced");
  }
}

GoldenOptions add_options(CLI::App& command, bool with_diff) {
  return {command.add_option("SCENE")
              ->description("Scene files; [golden] in them says which pictures are kept")
              ->required()
              ->expected(1, -1)
              ->allow_extra_args()
              ->option_text("..."),
          add_value_option(command, "--dir", "DIR", "The folder of the references").required(),
          &add_value_option(command, "--frames", "T,…",
                            "Instants kept as pictures, instead of the scene's: times, last, #K"),
          with_diff ? &add_value_option(command, "--diff", "DIR",
                                        "Write expected, difference and actual of pictures")
                    : nullptr};
}

void add_action(CLI::App& golden, const char* name, const char* help,
                void (*run)(const GoldenOptions&)) {
  CLI::App* command = golden.add_subcommand(name, help);
  const GoldenOptions options = add_options(*command, run == run_check);
  command->callback([=] { run(options); });
}

}  // namespace

void add_golden(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("golden", "Hold scenes to references: record, check, approve");
  command->require_subcommand(1);
  add_action(*command, "record", "Keep references of scenes that have none", run_record);
  add_action(*command, "check", "Compare scenes with their references; writes none", run_check);
  add_action(*command, "approve", "Replace references, and tell what changes", run_approve);
  command->footer(
      "Exit codes of check: 0 equal, 1 different, 2 wrong usage, 3 no references.\n\n"
      "Examples:\n"
      "  piblocks golden record scenes/*.toml --dir golden\n"
      "  piblocks golden check scenes/*.toml --dir golden --diff differences");
}

}  // namespace piblocks::cli
