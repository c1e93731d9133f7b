#include <fmt/format.h>
#include <piblocks/script.hpp>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <optional>

#include "cli/command.hpp"
#include "cli/comparison.hpp"
#include "cli/exit_code.hpp"
#include "cli/golden_actions.hpp"
#include "cli/golden_folder.hpp"
#include "cli/progress.hpp"
#include "cli/scene_options.hpp"
#include "cli/stop_on_signals.hpp"
#include "cli/text_output.hpp"
#include "cli/tolerance_options.hpp"
#include "core/overwrite_check.hpp"
#include "core/text.hpp"
#include "render/references.hpp"
#include "scene/shipped_scenes.hpp"

namespace piblocks::cli {
namespace fs = std::filesystem;
namespace {

/// @throws UsageError if one of the options is given that only pictures in a folder have.
void refuse_folder_options(const Command& options) {
  const auto refuse = [&](const char* option) {
    if (!options.is_given(option)) return;
    throw UsageError(fmt::format("{} is about pictures in a folder: it needs --against", option));
  };
  for (const ToleranceOption& option : kToleranceOptions) refuse(option.name);
  for (const char* const option : {"--report", "--report-in-one-file", "--junit", "--json",
                                   "--quiet", "--missing", "--accepted", "--remove-unused"}) {
    refuse(option);
  }
}

std::vector<References> references_of(const Command& options) {
  refuse_folder_options(options);
  if (!options.is_given("--dir")) {
    throw UsageError(
        "golden: missing the folder of the references: --dir DIR for scenes, --against DIR for a "
        "folder of pictures");
  }
  const std::string folder = *options.text("--dir");
  std::vector<References> all;
  std::vector<std::string> problems;
  for (const std::string& scene : options.texts("SCENE")) {
    try {
      ScriptBuilder builder;
      read_scene(builder, scene);
      if (const auto frames = options.text("--frames")) {
        builder.set("--frames", "golden.frames", *frames);
      }
      all.emplace_back(fs::path(scene).stem(), builder, folder);
    } catch (const UsageError& error) {
      std::ranges::move(error.lines(), std::back_inserter(problems));
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

/// Acts on the references of one scene. Prints a failure, so that the other scenes have their turn.
/// @param where  begins each message.
/// @param code   is raised to the exit code of the failure, if that is more severe.
template <typename Act>
std::optional<GoldenResult> attempt(const Act& act, const References& references,
                                    const std::string& where, const std::stop_token& stop,
                                    int& code) {
  try {
    ProgressReport report(references.name(), false, {.delay = std::chrono::seconds(1)});
    return act(
        references, [&](const Progress& progress) { report.update(progress); }, stop);
  } catch (const UsageError& error) {
    for (const std::string& problem : error.lines()) say("piblocks: {}{}\n", where, problem);
    code = worse_exit_code(code, kWrongUsage);
  } catch (const Error& error) {
    if (stop.stop_requested()) throw;
    say("piblocks: {}{}\n", where, error.what());
    code = worse_exit_code(code, kFailed);
  }
  return std::nullopt;
}

/// @throws ExitError with the most severe code
template <typename Act>
void run_each(const std::vector<References>& all, TextOutput& out, const Act& act) {
  const StopOnSignals signals;
  int code = 0;
  for (const References& references : all) {
    const std::string where = all.size() > 1 ? references.name() + ": " : "";
    const auto result = attempt(act, references, where, signals.token(), code);
    if (!result) continue;
    for (const std::string& line : result->lines) out.line(printable(line));
    out.flush();
    code = worse_exit_code(code, result->exit_code);
  }
  out.finish();
  if (code != 0) throw ExitError(code);
}

/// @throws UsageError if an option is about scenes.
bool is_about_folder(const Command& options) {
  if (!options.is_given("--against")) return false;
  for (const char* const option : {"--dir", "--frames"}) {
    if (!options.is_given(option)) continue;
    throw UsageError(fmt::format(
        "{} is for scenes, --against for a folder of pictures; use one of them", option));
  }
  return true;
}

void run_check(const Command& options) {
  if (is_about_folder(options)) return check_folder(options);
  const std::vector<References> all = references_of(options);
  TextOutput out;
  check_diff(options, all);
  const fs::path scratch = temporary_folder();
  run_each(all, out,
           [&](const References& references, const OnProgress& on_progress,
               const std::stop_token& stop) {
             return check_golden(references, scratch, options.text("--diff"), on_progress, stop);
           });
}

/// @tparam kWrite  writes the references of one scene, kWriteFolder those of pictures.
template <auto kWrite, auto kWriteFolder>
void run_write(const Command& options) {
  if (is_about_folder(options)) return kWriteFolder(options);
  const std::vector<References> all = references_of(options);
  TextOutput out;
  check_references(options, all);
  run_each(all, out, kWrite);
}

/// An action with what all of them have.
Command add_action(Command& golden, const char* name, const char* help,
                   void (*run)(const Command& options)) {
  Command command = golden.add_command(name, help);
  command.add_arguments("SCENE",
                        "Scene files, or names that 'piblocks scenes' lists; [golden] in them\n"
                        "says which pictures are kept. With --against, a folder of PNG files");
  command.add_value("--dir", "DIR", "The folder of the references of scenes");
  command.add_value("--against", "DIR", "The folder of the references of a folder of pictures");
  command.add_value("--frames", "T,…",
                    "Instants kept as pictures, instead of the scene's: 3.5, last, #K");
  command.on_run([=] { run(command); });
  return command;
}

}  // namespace

void define_golden(Command& command) {
  command.require_command();
  Command record = add_action(command, "record", "Add the references that are missing",
                              run_write<record_golden, record_folder>);
  record.add_flag("--missing", "Also if other pictures are not equal to their references");
  define_tolerance(record);
  Command check = add_action(command, "check", "Compare with references; writes none", run_check);
  define_tolerance(check);
  define_reports(check);
  Command approve = add_action(command, "approve", "Replace references, and tell what changes",
                               run_write<approve_golden, approve_folder>);
  approve.add_value("--accepted", "FILE", "Only the pictures in this list, which a report makes");
  approve.add_flag("--remove-unused", "Remove references that have no picture");
  define_tolerance(approve);
  command.set_footer(
      "Every scene is reported, whatever is found about the others. The exit code of check is "
      "that\n"
      "of the first line that holds:\n"
      "  5  a reference cannot be read, or a scene cannot be drawn\n"
      "  4  a frame or a reference is missing, new, or of another size\n"
      "  1  a frame or a picture is different (or pictures of it could not be written)\n"
      "  3  a scene has no references\n"
      "  0  all is equal\n"
      "record ends with 0 if all references are there now, and with the code of check if those "
      "that\n"
      "are there are not what is drawn: then it adds nothing. approve ends with 0 if it has "
      "replaced\n"
      "them. 2 is wrong usage, and 1 a failure, as of all commands.\n\n"
      "With --against, SCENE is one folder of pictures, of any program. Behind it, 'approve' "
      "takes\n"
      "names of pictures; its --accepted takes the list that the page of --report makes. Exit "
      "codes\n"
      "are those of 'piblocks compare'. Tolerances and masks of 'record' and 'approve' are kept\n"
      "beside the references for later commands.\n\n"
      "Examples:\n"
      "  piblocks golden record scenes/*.toml --dir golden\n"
      "  piblocks golden check scenes/*.toml --dir golden --diff differences\n"
      "  piblocks golden check shots --against references --report report.html\n"
      "  piblocks golden approve shots --against references login.png");
}

}  // namespace piblocks::cli
