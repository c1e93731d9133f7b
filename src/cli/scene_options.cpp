#include "cli/scene_options.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/script.hpp>

#include <array>
#include <iostream>
#include <utility>

#include "cli/text_output.hpp"
#include "draw/look.hpp"
#include "scene/shipped_scenes.hpp"
#include "scene/toml_file.hpp"

namespace piblocks::cli {
namespace {

constexpr const char* kScene = "SCENE";
constexpr const char* kStandardInput = "standard input";

bool is_standard_input(const std::string& scene) { return scene == "-"; }

std::string text_of_standard_input() {
  std::string text = read_toml_text(std::cin, kStandardInput);
  if (!text.empty()) return text;
  // The default scene would hide that the program before the pipe has failed.
  throw SceneError("scene: standard input is empty; leave '-' out for the default scene");
}

/// A list of names with line breaks after commas.
std::string in_lines(std::string names) {
  constexpr std::size_t kLongest = 72;
  for (std::size_t begin = 0; names.size() - begin > kLongest;) {
    const std::size_t space = names.rfind(' ', begin + kLongest);
    if (space == std::string::npos || space <= begin) break;
    names[space] = '\n';
    begin = space + 1;
  }
  return names;
}

}  // namespace

SceneOptions::SceneOptions(Command command) : command_(std::move(command)) {
  command_.add_optional_argument(kScene,
                                 "Scene file, a name that 'piblocks scenes' lists, or - (standard\n"
                                 "input); without it, two blocks that count three digits");
  add_key("digits", "--digits", "D", "Count this many digits of pi: m_red = 100^(D-1) m_blue");
  add_key("base", "--base", "B",
          "Write counts in this base, 2 to 36 (default 10); then D digits\n"
          "are those of m_red = B^(2(D-1)) m_blue");
  add_key("mass-ratio", "--mass-ratio", "R", "m_red / m_blue, exactly: 16, 2.5, 1/3, 100^7");
  add_key("restitution", "--restitution", "E",
          "Coefficient of restitution of blocks and wall, 0 to 1:\n"
          "speed after a collision / speed before it (default 1: elastic)");
  add_flag({"time.allow-uncertain", "--allow-uncertain", "true"},
           "Show bodies also after the time from which rounding may\nchange which of them collide");
}

void SceneOptions::add_key(const std::string& key, const std::string& option,
                           const std::string& placeholder, const std::string& help) {
  keys_.push_back({key, option});
  command_.add_value(option, placeholder, help);
}

void SceneOptions::add_text(const std::string& key, const std::string& option,
                            const std::string& placeholder, const std::string& help) {
  keys_.push_back({key, option});
  command_.add_text(option, placeholder, help);
}

void SceneOptions::add_flag(const Key& flag, const std::string& help) {
  keys_.push_back(flag);
  command_.add_flag(flag.option, help);
}

void SceneOptions::add_size() {
  add_key("view.size", "--size", "WxH", "Frame size in pixels (default 1920x1080)");
}

void SceneOptions::add_picture() {
  add_size();
  add_flag({"view.background", "--transparent", "transparent"},
           "No background: another picture can be put behind");
  add_flag({"view.background", "--opaque", "opaque"}, "Force a background");
}

void SceneOptions::add_span() {
  add_key("time.from", "--from", "T",
          "First instant shown: 3.5, turn-0.3, last+1, #314\n(default 0)");
  add_key("time.to", "--to", "T", "End, as such an instant (default last+1.5)");
}

void SceneOptions::add_exposure() {
  add_key(
      "view.shutter", "--shutter", "X",
      "Motion blur: the share of the time between two frames for\nwhich each is exposed, 0 to 1 "
      "(default: 1/2 in the\nlecture themes, else 0)");
  add_key("view.fps", "--fps", "N|N/D", "Frames per second (default 60)");
  add_key("time.speed", "--speed", "X", "Simulation time per second of video (default 1)");
}

void SceneOptions::add_timing() {
  add_span();
  add_key("time.duration", "--duration", "S", "Length of the video in seconds; sets the speed");
  add_text("time.slow-motion", "--slow-motion", "auto|FROM:TO:N",
           "Windows in which time runs N times slower, separated by\ncommas; FROM and TO as 3.2, "
           "turn-0.3, last+1, #314");
  add_key("time.ease", "--ease", "S",
          "Slow motion sets in and ends over S seconds (default 0.5,\n0 = at once)");
  add_text("time.freeze", "--freeze", "AT:S",
           "Instants, as above, at which the picture stands still for S s");
  add_key("time.hold-start", "--hold-start", "S", "Show the first picture for S s more");
  add_key("time.hold-end", "--hold-end", "S", "Let the picture stand at its end for S s more");
  add_flag({"time.loop", "--loop", "true"},
           "Play forwards and backwards, so that the video repeats");
}

void SceneOptions::add_sound() {
  add_flag({"sound.on", "--sound", "true"},
           "A clack at every collision, in MP4, MOV, WebM and HTML; other\n"
           "outputs leave the sound of a scene out");
  add_flag({"sound.on", "--no-sound", "false"}, "Switch the sound of the scene off");
}

void SceneOptions::add_show() {
  add_key("view.theme", "--theme", "NAME",
          "Colours and layout (default lecture-light):\n" + theme_names());
  add_key("view.background", "--background", "COLOR",
          "Colour behind everything, as '#fdf6e3'; what the following\n"
          "options do not set suits it");
  add_key("view.colors.ink", "--ink", "COLOR", "Colour of text, walls and floor");
  add_key("view.colors.accent", "--accent", "COLOR", "Colour of what is lit or marks the present");
  add_key("blue.color", "--blue-color", "COLOR", "Colour of blue");
  add_key("red.color", "--red-color", "COLOR", "Colour of red");
  add_text("show.overlays", "--show", "NAMES",
           "What is drawn over the scene, with commas, or none:\n" + overlay_names() +
               "\n(default: digits of pi, and in the lecture themes masses)");
  add_text("show.panels", "--panels", "NAMES",
           "Diagrams below it, with commas:\n" + in_lines(panel_names()));
  add_text("show.title", "--title", "TEXT", "A title line");
  add_text("show.caption", "--caption", "TEXT", "A caption line");
  add_text("show.logo", "--logo", "FILE.png", "Picture in the lower right corner");
  add_flag({"show.hits", "--no-hits", "false"}, "No marks where the blocks hit");
  add_key("show.loupe", "--loupe", "auto|stage|off|FROM:TO:ZOOM",
          "An inset that enlarges the gap between wall and red: where it is\n"
          "small, by powers of ten; the same across most of the frame, above\n"
          "low blocks; or from FROM to TO by ZOOM. Of other blocks on a line,\n"
          "the gap that closes first from FROM on. FROM and TO as 3.2,\n"
          "turn-0.3, last+1, #314");
  add_flag({"red.width", "--width-by-mass", "by-mass"}, "Make red as wide as its mass suggests");
}

bool SceneOptions::has_scene() const { return command_.is_given(kScene); }

Scene SceneOptions::scene() const {
  const Script made = script();
  if (const auto* scene = std::get_if<Scene>(&made)) return *scene;
  throw UsageError(fmt::format("'{}' is a storyboard; '{}' takes a scene without [[part]]",
                               *command_.text(kScene), command_.name()));
}

Script SceneOptions::script(const std::vector<SceneDefault>& defaults,
                            const std::string& origin) const {
  constexpr std::array<std::array<const char*, 3>, 6> kExclusiveOptions = {
      {{"--digits", "--mass-ratio", "the mass of red"},
       {"--speed", "--duration", "the speed"},
       {"--transparent", "--opaque", "the background"},
       {"--transparent", "--background", "the background"},
       {"--opaque", "--background", "the background"},
       {"--sound", "--no-sound", "the sound"}}};
  for (const auto& [first, second, what] : kExclusiveOptions) {
    if (!command_.is_given(first) || !command_.is_given(second)) continue;
    throw UsageError(fmt::format("{} and {} both set {}; give one of them", first, second, what));
  }
  ScriptBuilder builder;
  if (const auto scene = command_.text(kScene)) {
    is_standard_input(*scene) ? builder.read_text(kStandardInput, text_of_standard_input())
                              : read_scene(builder, *scene);
  }
  for (const auto& [key, text] : defaults) builder.set(origin, key, text);
  for (const auto& [key, option, value] : keys_) {
    if (command_.is_given(option))
      builder.set(option, key, value ? *value : *command_.text(option));
  }
  Script made = builder.build();
  OverwriteCheck check;
  add_inputs(check, made);
  check.writes_standard_output();
  check.check();
  return made;
}

void SceneOptions::add_inputs(OverwriteCheck& check, const Script& script) const {
  const auto scene = command_.text(kScene);
  if (scene && !is_standard_input(*scene)) claim_scene(check, *scene);
  claim_logos(check, script);
}

void SceneOptions::check_output(const Script& script, OverwriteCheck check) const {
  add_inputs(check, script);
  const std::string output = output_of(command_);
  output == "-" ? check.writes_standard_output() : check.writes("--output", output);
  check.check();
}

void add_engine(Command& command) {
  command.add_value("--engine", "NAME",
                    "unfolded: closed form or certified steps (default);\n"
                    "events: the event loop, in double precision");
}

void note_all(const std::vector<std::string>& notes) {
  for (const std::string& note : notes) say("piblocks: note: {}\n", note);
}

void note_convention(const Script& script) { note_all(convention_notes(script)); }

void note_convention_and_contrast(const Script& script) {
  note_convention(script);
  note_all(contrast_notes(script));
}

void note_sharp(const Script& script) {
  const auto is_blurred = [](const Scene* scene) { return scene->view.shutter > 0; };
  if (std::ranges::none_of(scenes_of(script), is_blurred)) return;
  say("piblocks: note: SVG, PDF and sheets have no motion blur: moving bodies are sharp, at the "
      "instant\n");
}

void note_ties(const Log& log, const Integer& last) {
  if (const auto note = tie_note(log, last)) say("piblocks: note: {}\n", *note);
}

}  // namespace piblocks::cli
