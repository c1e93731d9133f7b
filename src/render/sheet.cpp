#include <fmt/format.h>
#include <piblocks/canvas.hpp>
#include <piblocks/composition.hpp>
#include <piblocks/error.hpp>
#include <piblocks/png.hpp>
#include <piblocks/render.hpp>
#include <piblocks/sheet.hpp>
#include <piblocks/timeline.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>
#include <utility>

#include "core/ending.hpp"
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

/// Of a time.
constexpr int kUsualDigits = 6;
constexpr int kMostDigits = 17;

struct Paper {
  int width_px;
  int height_px;
  Bytes (*draw)(const Sheet& sheet);
};

Paper paper_for(std::string_view output) {
  if (output == "-" || has_ending(output, ".png")) {
    return {kPageWidth_px, kPageHeight_px,
            [](const Sheet& sheet) { return encode_png(draw_pixels(sheet).view()); }};
  }
  if (has_ending(output, ".svg")) return {kPageWidth_pt, kPageHeight_pt, draw_svg};
  if (has_ending(output, ".pdf")) return {kPageWidth_pt, kPageHeight_pt, draw_pdf};
  throw UsageError(fmt::format(
      "sheet: '{}' has no known ending; use .pdf, .png, .svg, or - for PNG on standard output",
      output));
}

/// With so many significant digits, but no zeros behind the last one.
std::string time_text(double time, int digits) {
  const double exponent = time == 0 ? 0 : std::floor(std::log10(std::abs(time)));
  const int decimals = std::max(0, digits - 1 - static_cast<int>(exponent));
  std::string text = fmt::format("{:.{}f}", time, decimals);
  if (text.find('.') == std::string::npos) return text;
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

/// As short as can be where different times are still written differently.
std::vector<std::string> time_texts(const std::vector<TimedState>& states) {
  std::vector<std::string> texts;
  for (int digits = kUsualDigits; digits <= kMostDigits; ++digits) {
    texts.clear();
    std::map<std::string, double> times;
    bool are_distinct = true;
    for (const TimedState& at : states) {
      texts.push_back(time_text(at.time.hi, digits));
      are_distinct &= times.try_emplace(texts.back(), at.time.hi).first->second == at.time.hi;
    }
    if (are_distinct) break;
  }
  return texts;
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
  std::vector<TimedState> states;
  states.reserve(instants.size());
  for (const Instant& instant : instants) states.push_back(state_at(*log, instant));
  const std::vector<std::string> times = time_texts(states);
  std::vector<CaptionedPicture> pictures;
  for (std::size_t i = 0; i < states.size(); ++i) {
    const TimedState& at = states[i];
    pictures.push_back(
        {composition.frame({at.state, to_rational(at.time)}),
         fmt::format("time {}, count {}", times[i], with_thousands_separators(at.state.count))});
  }
  OutputFile file(output);
  const Bytes page = paper.draw(arrange(std::move(pictures), paper.width_px, paper.height_px));
  if (stop.stop_requested()) throw Interrupted("sheet: interrupted");
  file.write(page);
  file.finish();
}

}  // namespace piblocks
