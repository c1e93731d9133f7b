#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/script.hpp>

#include <utility>

#include "cli/command.hpp"
#include "cli/live_page.hpp"
#include "cli/options.hpp"
#include "cli/scene_options.hpp"
#include "cli/stop_on_signals.hpp"
#include "core/output_file.hpp"
#include "core/overwrite_check.hpp"
#include "core/stop.hpp"
#include "core/text.hpp"
#include "render/film.hpp"
#include "scene/scene_keys.hpp"

namespace piblocks::cli {
namespace {

void check_page_options(const Command& options) {
  const std::string output = output_of(options);
  if (output != "-" && !has_ending(output, ".html")) {
    throw UsageError(fmt::format(
        "output: cannot write a page to '{}'; use NAME.html, or - for standard output", output));
  }
  refuse_terminal(options);
}

/// What 'piblocks render' would refuse, and files that a page cannot read.
void check_page_scene(const Script& script) {
  for (const Scene* scene : scenes_of(script)) {
    if (scene->show.logo.empty()) continue;
    throw UsageError(fmt::format("show.logo: a page cannot read the file '{}'; leave the logo out",
                                 scene->show.logo));
  }
  const Film film(script);
}

void run_page(const Command& options, const SceneOptions& scene) {
  check_page_options(options);
  const Script script = scene.script();
  scene.check_output(script);
  check_page_scene(script);
  const LivePage page = find_live_page();
  OverwriteCheck check;
  check.reads("the live page", page.file);
  scene.check_output(script, std::move(check));
  const StopOnSignals signals;
  OutputFile out(output_of(options));
  write_page(page, scene_toml(script), out);
  check_stop(signals.token());
  out.finish();
  note_convention(script);
  note_contrast(script);
}

}  // namespace

void define_page(Command& command) {
  SceneOptions scene(command);
  command.add_required_value("-o,--output", "OUT", "NAME.html, or - (standard output)");
  scene.add_picture();
  scene.add_show();
  scene.add_exposure();
  scene.add_timing();
  scene.add_sound();
  command.set_footer(
      "'piblocks render -o NAME.html' writes a page with the video instead.\n\n"
      "Examples:\n"
      "  piblocks page -o live.html\n"
      "  piblocks page lecture --digits 4 -o lecture.html");
  command.on_run([=] { run_page(command, scene); });
}

}  // namespace piblocks::cli
