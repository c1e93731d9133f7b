#include <fmt/format.h>
#include <piblocks/script.hpp>

#include <algorithm>
#include <filesystem>

#include "cli/command.hpp"
#include "cli/golden_actions.hpp"
#include "cli/options.hpp"
#include "cli/scene_options.hpp"
#include "cli/shipped_scenes.hpp"
#include "cli/stop_on_signals.hpp"
#include "cli/text_output.hpp"
#include "core/overwrite_check.hpp"
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

/// @throws UsageError if differences would replace a reference or an input.
void check_diff(const Command& options, const std::vector<References>& all) {
  OverwriteCheck check;
  claim_inputs(check, options, all);
  claim_diff(check, all, *options.text("--dir"), options.text("--diff"));
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

void run_check(const Command& options) {
  const std::vector<References> all = references_of(options);
  TextOutput out("-");
  check_diff(options, all);
  const StopOnSignals signals;
  bool is_equal = true;
  for (const References& references : all) {
    is_equal &= check_golden(
        references, options.text("--diff"),
        [&](const std::string& line) { out.format_line("{}", line); }, signals.token());
    out.flush();
  }
  out.finish();
  if (!is_equal) throw ExitError(kDifferent);
}

void run_record(const Command& options) {
  const std::vector<References> all = references_of(options);
  TextOutput out("-");
  check_references(options, all);
  for (const References& references : all) check_unrecorded(references);
  const StopOnSignals signals;
  for (const References& references : all) {
    record_golden(
        references, [&](const std::string& line) { out.format_line("{}", line); }, signals.token());
    out.flush();
  }
  out.finish();
}

void run_approve(const Command& options) {
  const std::vector<References> all = references_of(options);
  TextOutput out("-");
  check_references(options, all);
  for (const References& references : all) check_pictures(references);
  const StopOnSignals signals;
  for (const References& references : all) {
    approve_golden(
        references, [&](const std::string& line) { out.format_line("{}", line); }, signals.token());
    out.flush();
  }
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
