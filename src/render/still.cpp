#include <fmt/format.h>
#include <piblocks/encode.hpp>
#include <piblocks/error.hpp>
#include <piblocks/render.hpp>

#include <string_view>

#include "core/text.hpp"
#include "core/output_file.hpp"
#include "draw/canvas.hpp"
#include "physics/blocks.hpp"
#include "render/film.hpp"
#include "render/renderings.hpp"
#include "scene/schedule.hpp"

namespace piblocks {
namespace {

std::vector<std::uint8_t> draw_png(const DrawList& list) {
  Canvas canvas(list.width_px, list.height_px,
                list.background ? Background::opaque : Background::transparent);
  canvas.paint(list);
  return encode_png(canvas.view());
}

using Draw = std::vector<std::uint8_t>(const DrawList& list);

Draw* drawing_for(std::string_view output) {
  if (output == "-" || has_ending(output, ".png")) return draw_png;
  if (has_ending(output, ".svg")) return draw_svg;
  if (has_ending(output, ".pdf")) return draw_pdf;
  throw UsageError(fmt::format(
      "still: '{}' has no known ending; use .png, .svg, .pdf, or - for PNG on standard output",
      output));
}

DrawList picture_of(const Scene& scene, const Instant& instant) {
  require_valid(problems_of(scene));
  const FilmRun run(scene, make_collision_log(scene.system), FilmUse::pictures);
  return run.picture(still_time(scene, run.log(), time_of(instant, run.log())));
}

DrawList picture_of(const Storyboard& story, const Instant& instant) {
  const Film film(story);
  return film.frame(frame_at(film, instant));
}

}  // namespace

DrawList still_picture(const Script& script, const Instant& instant) {
  return std::visit([&](const auto& any) { return picture_of(any, instant); }, script);
}

void render_still(const Script& script, const Instant& instant, const std::string& output,
                  const std::stop_token& stop) {
  Draw* const draw = drawing_for(output);
  const DrawList list = still_picture(script, instant);
  OutputFile file(output);
  const std::vector<std::uint8_t> picture = draw(list);
  if (stop.stop_requested()) throw Interrupted("still: interrupted");
  file.write(picture);
  file.finish();
}

}  // namespace piblocks
