// 'piblocks info' and 'piblocks scenes': what there is.
#include <fmt/format.h>
#include <piblocks/compare.hpp>
#include <piblocks/exact.hpp>
#include <piblocks/image.hpp>
#include <piblocks/render.hpp>
#include <piblocks/scene.hpp>
#include <piblocks/script.hpp>
#include <piblocks/two_blocks.hpp>
#include <piblocks/version.hpp>

#include <algorithm>

#include "cli/command.hpp"
#include "cli/text_output.hpp"
#include "draw/canvas.hpp"
#include "media/output/output.hpp"
#include "physics/versions.hpp"
#include "scene/schedule.hpp"
#include "scene/shipped_scenes.hpp"

namespace piblocks::cli {
namespace {

void print_encoders(TextOutput& out, const char* heading, const std::vector<std::string>& encoders,
                    const char* what) {
  out.format_line("{}:", heading);
  for (const std::string& encoder : encoders) out.format_line("  {}", encoder);
  if (encoders.empty()) out.format_line("  none: {} cannot be written", what);
}

void print_limits(TextOutput& out) {
  out.line("limits:");
  out.format_line("  scene file: {} bytes, lists nested {} deep", kMaxSceneFile_bytes,
                  kMaxSceneNesting);
  out.format_line("  digits: {}", kMaxDigits);
  out.format_line("  bases of counts: {} to {}", kMinBase, kMaxBase);
  out.format_line("  numerator or denominator of a number: {} bits", kMaxRationalBits);
  out.format_line("  frame: {} pixels a side, {} in all", kMaxSide_px, kMaxFrame_px);
  out.format_line("  frames per second: {}", kMaxFrameRate);
  out.format_line("  frames of one rendering: {}", kMaxFrames);
  out.format_line("  pictures of a sheet: {}", kMaxSheetPictures);
  out.format_line("  parts of one rendering: {}", kMaxShards);
  out.format_line("  threads: {}", kMaxJobs);
  out.format_line("  rows of a log: {}, more with --limit", kMaxRows);
  out.format_line("  collisions stored by --engine events: {}", kMaxStoredCollisions);
  out.format_line("  bodies: {}, walls: {}", kMaxBodies, kMaxWalls);
  out.format_line(
      "  collisions of bodies: {}; of blocks on a line in rational numbers of at most {} bits",
      kMaxSteppedCollisions, kMaxExactBits);
  out.format_line("  lines of a framehash file: {}", kMaxHashes);
}

void run_info() {
  TextOutput out;
  out.format_line("piblocks {}", kVersion);
  out.line("libraries:");
  for (const std::string& library : physics_library_versions()) out.format_line("  {}", library);
  for (const std::string& library : draw_library_versions()) out.format_line("  {}", library);
  for (const std::string& library : media_library_versions()) out.format_line("  {}", library);
  out.format_line("  fmt {}.{}.{}", FMT_VERSION / 10000, FMT_VERSION / 100 % 100,
                  FMT_VERSION % 100);
  print_encoders(out, "H.264 encoders, the default first", encoder_names(EncoderKind::h264), "MP4");
  print_encoders(out, "WebM encoders, the default first", encoder_names(EncoderKind::webm), "WebM");
  print_encoders(out, "ProRes encoders", encoder_names(EncoderKind::prores),
                 "MOV with transparency");
  print_encoders(out, "sound encoders", encoder_names(EncoderKind::sound), "videos with sound");
  print_limits(out);
  out.finish();
}

void list_scenes() {
  const auto length = [](const ShippedScene& scene) { return scene.name.size(); };
  const std::size_t width = std::ranges::max(shipped_scenes(), {}, length).name.size();
  TextOutput out;
  for (const ShippedScene& scene : shipped_scenes()) {
    out.format_line("{:<{}}  {}", scene.name, width, scene.summary());
  }
  out.finish();
}

}  // namespace

void define_info(Command& command) { command.on_run(run_info); }

void define_scenes(Command& command) {
  command.add_optional_argument("SCENE", "Print the file of this scene, to be saved and edited");
  command.set_footer(
      "A name stands for a scene file in all commands, unless there is a file of this name.\n\n"
      "Examples:\n"
      "  piblocks render lecture -o lecture.mp4\n"
      "  piblocks scenes lecture > my-lecture.toml");
  command.on_run([command] {
    const auto name = command.text("SCENE");
    name ? print_text(find_shipped_scene(*name).text) : list_scenes();
  });
}

}  // namespace piblocks::cli
