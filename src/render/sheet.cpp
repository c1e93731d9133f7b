#include <fmt/format.h>
#include <piblocks/canvas.hpp>
#include <piblocks/composition.hpp>
#include <piblocks/error.hpp>
#include <piblocks/png.hpp>
#include <piblocks/render.hpp>
#include <piblocks/sheet.hpp>
#include <piblocks/timeline.hpp>

#include <string_view>
#include <utility>

#include "core/output_file.hpp"
#include "render/logo.hpp"

namespace piblocks {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// A4, landscape, in points, and in pixels of 200 to the inch.
constexpr int kPageWidth_pt = 842;
constexpr int kPageHeight_pt = 595;
constexpr int kPageWidth_px = 2339;
constexpr int kPageHeight_px = 1654;

struct Paper {
  int width_px;
  int height_px;
  Bytes (*draw)(const Sheet& sheet);
};

Paper paper_for(std::string_view output) {
  if (output == "-" || output.ends_with(".png")) {
    return {kPageWidth_px, kPageHeight_px,
            [](const Sheet& sheet) { return encode_png(draw_pixels(sheet).view()); }};
  }
  if (output.ends_with(".svg")) return {kPageWidth_pt, kPageHeight_pt, draw_svg};
  if (output.ends_with(".pdf")) return {kPageWidth_pt, kPageHeight_pt, draw_pdf};
  throw UsageError(fmt::format(
      "sheet: '{}' has no known ending; use .pdf, .png, .svg, or - for PNG on standard output",
      output));
}

std::string caption(const TimedState& at) {
  return fmt::format("time {:.6g}, count {}", at.time.hi,
                     with_thousands_separators(at.state.count));
}

}  // namespace

std::vector<Instant> spread_instants(const Scene& scene, int count) {
  if (count < 1 || count > kMaxSheetPictures) {
    throw UsageError(fmt::format("sheet: {} pictures: use 1 to {}", count, kMaxSheetPictures));
  }
  const std::unique_ptr<CollisionLog> log = make_collision_log(scene.system);
  Scene plain = scene;
  plain.pacing = {};  // the run from one end to the other, however a video goes through it
  const Timeline timeline(plain, *log);
  const Rational first = timeline.time_of(0);
  const Rational last = timeline.time_of(timeline.frame_count() - 1);
  std::vector<Instant> instants = {first};
  for (int i = 1; i < count; ++i) {
    instants.emplace_back(Rational(first + (last - first) * Rational(i, count - 1)));
  }
  return instants;
}

void render_sheet(const Scene& scene, const std::vector<Instant>& instants,
                  const std::string& output, const std::stop_token& stop) {
  const Paper paper = paper_for(output);
  if (instants.empty() || instants.size() > std::size_t{kMaxSheetPictures}) {
    throw UsageError(
        fmt::format("sheet: {} pictures: use 1 to {}", instants.size(), kMaxSheetPictures));
  }
  const std::unique_ptr<CollisionLog> log = make_collision_log(scene.system);
  const Composition composition(scene, *log, read_logo(scene));
  std::vector<CaptionedPicture> pictures;
  for (const Instant& instant : instants) {
    const TimedState at = state_at(*log, instant);
    pictures.push_back({composition.frame({at.state, to_rational(at.time)}), caption(at)});
  }
  OutputFile file(output);
  const Bytes page = paper.draw(arrange(std::move(pictures), paper.width_px, paper.height_px));
  if (stop.stop_requested()) throw Interrupted("sheet: interrupted");
  file.write(page);
  file.finish();
}

}  // namespace piblocks
