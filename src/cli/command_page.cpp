#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/script.hpp>
#include <piblocks/version.hpp>

#include <array>
#include <cerrno>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <utility>

#include "cli/command.hpp"
#include "cli/scene_options.hpp"
#include "cli/stop_on_signals.hpp"
#include "core/descriptor.hpp"
#include "core/output_file.hpp"
#include "core/overwrite_check.hpp"
#include "core/own_binary.hpp"
#include "core/stop.hpp"
#include "core/text.hpp"
#include "render/film.hpp"
#include "scene/scene_keys.hpp"

namespace piblocks::cli {
namespace fs = std::filesystem;
namespace {

constexpr const char* kPageFile = "piblocks.html";
constexpr std::string_view kMadeBy = R"(<meta name="generator" content="piblocks )";
constexpr std::string_view kScene = R"(<script id="opened-scene" type="application/json">)";
constexpr std::string_view kNoScene = "null";
constexpr std::string_view kSceneEnd = "</script>";

/// One file with the program in it, as scripts/web builds it.
struct LivePage {
  std::string file;
  std::string html;
  std::size_t scene_begin = 0;  ///< bytes before kNoScene
};

std::string read_page(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::string text;
  std::array<char, 1 << 16> piece{};
  while (in.read(piece.data(), piece.size()) || in.gcount() > 0) {
    text.append(piece.data(), static_cast<std::size_t>(in.gcount()));
  }
  if (!in.eof()) throw IoError(error_text(errno));
  return text;
}

/// Where the text behind the one mark begins. @throws IoError unless the mark is there once
std::size_t behind(std::string_view mark, std::string_view html) {
  const std::size_t at = html.find(mark);
  if (at == std::string_view::npos) throw IoError(fmt::format("it has no '{}'", mark));
  if (html.find(mark, at + 1) != std::string_view::npos) {
    throw IoError(fmt::format("it has several '{}'", mark));
  }
  return at + mark.size();
}

/// @throws IoError that says why the file is not the page of this version
LivePage read_live_page(const fs::path& file) {
  LivePage page{.file = file, .html = read_page(file)};
  const std::string_view html = page.html;
  const std::string_view made_by = html.substr(behind(kMadeBy, html));
  const std::string_view version = made_by.substr(0, made_by.find('"'));
  if (version != kVersion) {
    throw IoError(fmt::format("it is of version {}, not {}", version, kVersion));
  }
  page.scene_begin = behind(kScene, html);
  const std::string_view rest = html.substr(page.scene_begin);
  if (!rest.starts_with(kNoScene) || !rest.substr(kNoScene.size()).starts_with(kSceneEnd)) {
    throw IoError("it opens a scene already");
  }
  return page;
}

/// The live page of this version: beside the folder of the program, in the source tree if the
/// program lies where it was built, or where the build was to install it.
/// @throws IoError that lists these places and what is wrong in each
LivePage find_live_page() {
  std::string reasons;
  for (const fs::path& place : places_of_installed(
           PIBLOCKS_PREFIX, fs::path(PIBLOCKS_PAGE_FOLDER) / kPageFile, PIBLOCKS_PAGE_FROM_BUILD)) {
    const fs::path file = place.lexically_normal();
    try {
      return read_live_page(file);
    } catch (const IoError& error) {
      reasons +=
          fmt::format("{} '{}': {}", reasons.empty() ? ":" : ";", file.string(), error.what());
    }
  }
  throw IoError(
      "page: cannot read the live page; install one of this version, or build it by scripts/web" +
      reasons);
}

/// Writes the page so that it opens this scene. @param toml  in UTF-8
/// @throws IoError, ReaderGone as OutputFile::write()
void write_page(const LivePage& page, std::string_view toml, OutputFile& out) {
  const std::string_view html = page.html;
  out.write(html.substr(0, page.scene_begin));
  out.write(fmt::format(R"({{"text":{}}})", json_text(toml)));
  out.write(html.substr(page.scene_begin + kNoScene.size()));
}

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
  note_convention_and_contrast(script);
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
