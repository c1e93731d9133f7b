#include <fmt/format.h>
#include <piblocks/canvas.hpp>
#include <piblocks/composition.hpp>
#include <piblocks/error.hpp>
#include <piblocks/png.hpp>
#include <piblocks/render.hpp>
#include <piblocks/schedule.hpp>

#include <string_view>
#include <utility>

#include "core/ending.hpp"
#include "core/output_file.hpp"
#include "render/film.hpp"
#include "render/logo.hpp"
#include "render/shutter.hpp"

namespace piblocks {
namespace {

std::vector<std::uint8_t> draw_png(const DrawList& list) {
  Canvas canvas(list.width_px, list.height_px,
                list.background ? Ground::opaque : Ground::transparent);
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

/// As in the video when it first shows this instant; 1 where it never does.
Rational slower_at(const Scene& scene, const CollisionLog& log, const Rational& time) {
  const Pacing& pacing = scene.pacing;
  if (!pacing.automatic_slow_motion && pacing.slow_motion.empty()) return 1;
  const Schedule schedule(scene, log);
  const auto video_s = schedule.first_shown(time);
  return video_s ? schedule.at(*video_s).slower : Rational(1);
}

DrawList picture_of(const Scene& scene, const Instant& instant) {
  const std::unique_ptr<CollisionLog> log = make_collision_log(scene.system);
  TimedState at = state_at(*log, instant);
  const Rational time = to_rational(at.time);
  const Composition composition(scene, *log, read_logo(scene));
  return composition.frame({std::move(at.state), time, slower_at(scene, *log, time)},
                           expose_still(scene, *log, time));
}

DrawList picture_of(const Storyboard& story, const Instant& instant) {
  const Film film(story);
  return film.frame(frame_at(film, instant));
}

}  // namespace

void render_still(const Script& script, const Instant& instant, const std::string& output,
                  const std::stop_token& stop) {
  Draw* const draw = drawing_for(output);
  const DrawList list =
      std::visit([&](const auto& any) { return picture_of(any, instant); }, script);
  OutputFile file(output);
  const std::vector<std::uint8_t> picture = draw(list);
  if (stop.stop_requested()) throw Interrupted("still: interrupted");
  file.write(picture);
  file.finish();
}

}  // namespace piblocks
