#include <fmt/format.h>
#include <piblocks/encode.hpp>
#include <piblocks/error.hpp>
#include <piblocks/render.hpp>

#include <algorithm>
#include <map>
#include <string_view>
#include <utility>

#include "core/text.hpp"
#include "core/output_file.hpp"
#include "draw/canvas.hpp"
#include "draw/composition.hpp"
#include "draw/montage.hpp"
#include "draw/number_text.hpp"
#include "physics/blocks.hpp"
#include "render/film_run.hpp"
#include "render/renderings.hpp"
#include "scene/schedule.hpp"

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
constexpr int kMostDigits = 40;
/// Before the first digit of a time.
constexpr int kMostZeros = 10;

struct Paper {
  int width_px;
  int height_px;
  Bytes (*draw)(const DrawList& page);
};

Paper paper_for(std::string_view output) {
  if (output == "-" || has_ending(output, ".png")) {
    return {kPageWidth_px, kPageHeight_px,
            [](const DrawList& page) { return encode_png(draw_pixels(page).view()); }};
  }
  if (has_ending(output, ".svg")) return {kPageWidth_pt, kPageHeight_pt, draw_svg};
  if (has_ending(output, ".pdf")) return {kPageWidth_pt, kPageHeight_pt, draw_pdf};
  throw UsageError(fmt::format(
      "sheet: '{}' has no known ending; use .pdf, .png, .svg, or - for PNG on standard output",
      output));
}

void drop_last_zeros(std::string& decimal) {
  if (decimal.find('.') == std::string::npos) return;
  decimal.erase(decimal.find_last_not_of('0') + 1);
  if (decimal.back() == '.') decimal.pop_back();
}

/// With so many significant digits, but no zeros behind the last one; a time that is beyond that is
/// written with a power of ten.
std::string time_text(const Rational& time, int digits) {
  // What is rounded to ten times as much keeps a digit more than was asked for.
  const long exponent = time == 0 ? 0 : magnitude_of(abs(time)).exponent;
  const bool is_short = exponent > -kMostZeros && exponent < kMostDigits;
  const long unit = is_short ? 0 : exponent;
  const Rational scaled = unit > 0 ? Rational(time / power(10, static_cast<unsigned long>(unit)))
                                   : Rational(time * power(10, static_cast<unsigned long>(-unit)));
  const int decimals = static_cast<int>(std::max(0L, digits - 1 - (exponent - unit)));
  std::string text = fixed_text(scaled, decimals);
  std::erase(text, ',');  // the count follows behind one
  drop_last_zeros(text);
  return is_short ? text : fmt::format("{}×{}", text, power_text(unit));
}

/// As short as can be where different times are still written differently.
std::vector<std::string> time_texts(const std::vector<FrameState>& pictures) {
  std::vector<std::string> texts;
  for (int digits = kUsualDigits; digits <= kMostDigits; ++digits) {
    texts.clear();
    std::map<std::string, Rational> times;
    bool are_distinct = true;
    for (const FrameState& shown : pictures) {
      texts.push_back(time_text(shown.time, digits));
      are_distinct &= times.try_emplace(texts.back(), shown.time).first->second == shown.time;
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
  require_valid(problems_of(scene));
  const std::unique_ptr<CollisionLog> log = make_collision_log(scene.system);
  const Span span = span_of(scene, *log);
  std::vector<Instant> instants = {span.from};
  for (int i = 1; i < count; ++i) {
    instants.emplace_back(Rational(span.from + (span.to - span.from) * Rational(i, count - 1)));
  }
  return instants;
}

std::vector<CaptionedPicture> sheet_pictures(const Scene& scene,
                                             const std::vector<Instant>& instants) {
  require_valid(problems_of(scene));
  const std::unique_ptr<CollisionLog> log = make_collision_log(scene.system);
  const Composition composition(scene, *log, read_logo(scene));
  std::vector<FrameState> shown;
  shown.reserve(instants.size());
  for (const Instant& instant : instants) {
    const Rational time = time_of(instant, *log);
    shown.push_back({log->state_at(time), time});
  }
  const std::vector<std::string> times = time_texts(shown);
  std::vector<CaptionedPicture> pictures;
  for (std::size_t i = 0; i < shown.size(); ++i) {
    pictures.push_back({composition.frame(shown[i]),
                        fmt::format("time {}, count {}", times[i],
                                    with_thousands_separators(shown[i].state.count))});
  }
  return pictures;
}

void render_sheet(const Scene& scene, const std::vector<Instant>& instants,
                  const std::string& output, const std::stop_token& stop) {
  const Paper paper = paper_for(output);
  if (instants.empty() || instants.size() > std::size_t{kMaxSheetPictures}) {
    throw UsageError(
        fmt::format("sheet: {} pictures: use 1 to {}", instants.size(), kMaxSheetPictures));
  }
  std::vector<CaptionedPicture> pictures = sheet_pictures(scene, instants);
  OutputFile file(output);
  const Bytes page = paper.draw(arrange(std::move(pictures), paper.width_px, paper.height_px));
  if (stop.stop_requested()) throw Interrupted("sheet: interrupted");
  file.write(page);
  file.finish();
}

}  // namespace piblocks
