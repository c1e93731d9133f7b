#include <fmt/format.h>
#include <piblocks/encode.hpp>
#include <piblocks/error.hpp>
#include <piblocks/render.hpp>

#include <algorithm>
#include <map>
#include <string_view>
#include <utility>

#include "core/output_file.hpp"
#include "core/text.hpp"
#include "draw/canvas.hpp"
#include "draw/montage.hpp"
#include "draw/number_text.hpp"
#include "physics/blocks.hpp"
#include "render/film.hpp"
#include "render/renderings.hpp"
#include "scene/schedule.hpp"

namespace piblocks {
namespace {

using Bytes = std::vector<std::uint8_t>;
using Draw = Bytes(const DrawList& list);

Bytes draw_png(const DrawList& list) {
  Canvas canvas(list.width_px, list.height_px,
                list.background ? Background::opaque : Background::transparent);
  canvas.paint(list);
  return encode_png(canvas.view());
}

Bytes draw_page_png(const DrawList& page) { return encode_png(draw_pixels(page).view()); }

/// @param command  named in messages, with the endings as its help lists them.
Draw* drawing_for(std::string_view output, Draw* png, const char* command, const char* endings) {
  if (output == "-" || has_ending(output, ".png")) return png;
  if (has_ending(output, ".svg")) return draw_svg;
  if (has_ending(output, ".pdf")) return draw_pdf;
  throw UsageError(
      fmt::format("{}: '{}' has no known ending; use {}, or - for PNG on standard output", command,
                  output, endings));
}

/// @param draw  returns the bytes of the picture.
void write_picture(const std::string& output, const char* command, const std::stop_token& stop,
                   const auto& draw) {
  OutputFile file(output);
  const Bytes picture = draw();
  if (stop.stop_requested()) throw Interrupted(fmt::format("{}: interrupted", command));
  file.write(picture);
  file.finish();
}

FilmRun run_of(const Scene& scene) {
  require_valid(problems_of(scene));
  return {scene, make_collision_log(scene.system), FilmUse::pictures};
}

DrawList picture_of(const Scene& scene, const Instant& instant) {
  const FilmRun run = run_of(scene);
  return run.picture(still_time(scene, run.log(), time_of(instant, run.log())));
}

DrawList picture_of(const Storyboard& story, const Instant& instant) {
  const Film film(story);
  return film.frame(frame_at(film, instant));
}

/// A4, landscape, in points, and in pixels of 200 to the inch.
constexpr int kPageWidth_pt = 842;
constexpr int kPageHeight_pt = 595;
constexpr int kPageWidth_px = 2339;
constexpr int kPageHeight_px = 1654;

/// Significant digits of a time.
constexpr int kUsualDigits = 6;
constexpr int kMostDigits = 40;
/// Zeros before the first digit of a time. A smaller one is written with a power of ten.
constexpr int kMostZeros = 10;

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
std::vector<std::string> time_texts(const std::vector<Rational>& times) {
  std::vector<std::string> texts;
  for (int digits = kUsualDigits; digits <= kMostDigits; ++digits) {
    texts.clear();
    std::map<std::string, Rational> written;
    bool are_distinct = true;
    for (const Rational& time : times) {
      texts.push_back(time_text(time, digits));
      are_distinct &= written.try_emplace(texts.back(), time).first->second == time;
    }
    if (are_distinct) break;
  }
  return texts;
}

void check_count(std::size_t pictures) {
  if (pictures >= 1 && pictures <= std::size_t{kMaxSheetPictures}) return;
  throw UsageError(fmt::format("sheet: {} pictures: use 1 to {}", pictures, kMaxSheetPictures));
}

}  // namespace

DrawList still_picture(const Script& script, const Instant& instant) {
  return std::visit([&](const auto& any) { return picture_of(any, instant); }, script);
}

void render_still(const Script& script, const Instant& instant, const std::string& output,
                  const std::stop_token& stop) {
  Draw* const draw = drawing_for(output, draw_png, "still", ".png, .svg, .pdf");
  const DrawList list = still_picture(script, instant);
  write_picture(output, "still", stop, [&] { return draw(list); });
}

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
  const FilmRun run = run_of(scene);
  std::vector<Rational> times;
  times.reserve(instants.size());
  for (const Instant& instant : instants) times.push_back(time_of(instant, run.log()));
  const std::vector<std::string> texts = time_texts(times);
  std::vector<CaptionedPicture> pictures;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const Integer count = run.log().state_at(times[i]).count;
    pictures.push_back({run.picture({times[i]}), fmt::format("time {}, count {}", texts[i],
                                                             count_text(count, scene.show.base))});
  }
  return pictures;
}

void render_sheet(const Scene& scene, const std::vector<Instant>& instants,
                  const std::string& output, const std::stop_token& stop) {
  Draw* const draw = drawing_for(output, draw_page_png, "sheet", ".pdf, .png, .svg");
  check_count(instants.size());
  const bool is_png = draw == draw_page_png;
  std::vector<CaptionedPicture> pictures = sheet_pictures(scene, instants);
  write_picture(output, "sheet", stop, [&] {
    return draw(arrange(std::move(pictures), is_png ? kPageWidth_px : kPageWidth_pt,
                        is_png ? kPageHeight_px : kPageHeight_pt));
  });
}

}  // namespace piblocks
