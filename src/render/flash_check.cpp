#include "render/flash_check.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <optional>

#include "draw/canvas.hpp"
#include "render/flash_meter.hpp"

namespace piblocks {

void check_flashes(const Film& film, int most, const std::stop_token& stop) {
  const View& view = film.view();
  const double frames_per_s = to_double(view.frame_rate);
  FlashMeter meter(view.width_px, view.height_px, frames_per_s, most);
  Canvas canvas(view.width_px, view.height_px, view.background);
  std::optional<Flashing> first;
  Flashing worst;
  for (std::int64_t frame = 0; frame < film.frame_count(); ++frame) {
    if (stop.stop_requested()) throw Interrupted("render: interrupted");
    const std::span<const PixelRect> changed = canvas.update(film.frame(frame));
    const std::optional<Flashing> found = meter.take(canvas.view(), changed);
    if (!found) continue;
    if (!first) first = found;
    worst = std::max(worst, *found, [](const auto& a, const auto& b) { return a.share < b.share; });
  }
  if (!first) return;
  throw UsageError(fmt::format(
      "render: the film would flash more than {} times within a second, first at {:.3f} s, and at "
      "{:.3f} s on {:.0f} % of a field of sight ({:.0f} % are harmless, WCAG 2.3.1); expose frames "
      "for longer (--shutter 1), slow the film down (--slow-motion auto, --speed), or show it "
      "smaller in the frame",
      most, double(first->frame) / frames_per_s, double(worst.frame) / frames_per_s,
      100 * worst.share, 100 * kMostFlashing));
}

}  // namespace piblocks
