#include <fmt/format.h>
#include <piblocks/encode.hpp>
#include <piblocks/error.hpp>
#include <piblocks/render.hpp>
#include <piblocks/two_blocks.hpp>

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

#include "core/output_file.hpp"
#include "core/stop.hpp"
#include "core/text.hpp"
#include "draw/canvas.hpp"
#include "draw/montage.hpp"
#include "draw/number_text.hpp"
#include "physics/problems.hpp"
#include "render/film.hpp"
#include "render/renderings.hpp"
#include "scene/run_log.hpp"
#include "scene/schedule.hpp"

namespace piblocks {
namespace {

using Bytes = std::vector<std::uint8_t>;
using Draw = Bytes(const DrawList& list, const std::stop_token& stop);

Bytes draw_page_png(const DrawList& page, const std::stop_token& /*stop*/) {
  return encode_png(draw_pixels(page).view());
}

/// @param command  named in messages, with the endings as its help lists them.
Draw* drawing_for(std::string_view output, Draw* png, const char* command, const char* endings) {
  if (output == "-" || has_ending(output, ".png")) return png;
  if (has_ending(output, ".svg"))
    return [](const auto& list, const auto&) { return draw_svg(list); };
  if (has_ending(output, ".pdf"))
    return [](const auto& list, const auto&) { return draw_pdf(list); };
  throw UsageError(
      fmt::format("{}: '{}' has no known ending; use {}, or - for PNG on standard output", command,
                  output, endings));
}

void write_picture(OutputFile& file, const Bytes& picture, const std::stop_token& stop) {
  check_stop(stop);
  file.write(picture);
  file.finish();
}

/// A4, landscape, in points, and in pixels of 200 to the inch.
constexpr int kPageWidth_pt = 842;
constexpr int kPageHeight_pt = 595;
constexpr int kPageWidth_px = 2339;
constexpr int kPageHeight_px = 1654;

void check_count(std::size_t pictures) {
  if (pictures >= 1 && pictures <= std::size_t{kMaxSheetPictures}) return;
  throw UsageError(fmt::format("sheet: {} pictures: use 1 to {}", pictures, kMaxSheetPictures));
}

std::vector<Instant> spread_over_time(const Span& span, int pictures) {
  std::vector<Instant> instants = {span.from};
  for (int i = 1; i < pictures; ++i) {
    instants.emplace_back(Rational(span.from + (span.to - span.from) * i / (pictures - 1)));
  }
  return instants;
}

/// The collisions of a span: all after `before`, up to `last`.
struct ShownCollisions {
  Integer before;
  Integer last;

  Integer size() const { return last > before ? Integer(last - before) : 0; }
};

std::vector<Instant> spread_over_count(const Span& span, const ShownCollisions& shown,
                                       int pictures) {
  std::vector<Instant> instants = {span.from};
  for (int i = 1; i < pictures; ++i) {
    const Rational collisions = Rational(shown.size() * i) / (pictures - 1);
    instants.push_back(
        Instant::collision(shown.before + floor(Rational(collisions + Rational(1, 2)))));
  }
  return instants;
}

/// Two blocks, whose collisions all happen at once.
bool goes_through_corner(const Log& log) {
  return log.pair() != nullptr && corner_of(log.pair()->blocks());
}

/// @throws UsageError if the run has not as many different counts.
void check_spread_over_count(const Log& log, const ShownCollisions& shown, int pictures) {
  if (goes_through_corner(log)) {
    throw UsageError(
        "sheet: cannot space pictures by count, since all collisions happen at once; use --by "
        "time");
  }
  if (shown.size() + 1 >= pictures) return;
  throw UsageError(fmt::format(
      "sheet: cannot space {} pictures by count, since the scene shows {} collisions; use --frames "
      "{} or fewer, or --by time",
      pictures, shown.size().get_str(), Integer(shown.size() + 1).get_str()));
}

/// By count if pictures at equal times would miss the turn, where collisions are densest.
Spacing usual_spacing(const Log& log, const Span& span, const ShownCollisions& shown,
                      int pictures) {
  const std::optional<Rational> turn = turn_of(log);
  const bool shows_turn = turn && span.from <= *turn && *turn <= span.to;
  const bool is_enough = shown.size() + 1 >= pictures && !goes_through_corner(log);
  return shows_turn && is_enough ? Spacing::count : Spacing::time;
}

std::vector<Instant> spread_over(const Scene& scene, const Log& log, const Spread& spread) {
  const auto& [pictures, by] = spread;
  check_count(pictures < 0 ? 0 : static_cast<std::size_t>(pictures));
  const Span span = span_of(scene, log);
  if (by == Spacing::time) return spread_over_time(span, pictures);
  const ShownCollisions shown{log.count_at(span.from), log.count_at(span.to)};
  if (by == Spacing::count) check_spread_over_count(log, shown, pictures);
  return by.value_or(usual_spacing(log, span, shown, pictures)) == Spacing::count
             ? spread_over_count(span, shown, pictures)
             : spread_over_time(span, pictures);
}

/// Significant digits of a time.
constexpr int kUsualDigits = 6;
constexpr int kMostDigits = 40;
/// A number whose first digit is at this decimal place or further right is written with a power of
/// ten.
constexpr int kFirstDecimalOfPowers = 5;
/// A time that looks like another is written from the turn if it is so many times nearer to it than
/// to 0.
constexpr int kNearTurn = 1000;

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
  const bool is_short = exponent > -kFirstDecimalOfPowers && exponent < kMostDigits;
  const long unit = is_short ? 0 : exponent;
  const Rational scaled = time / power_of_ten(unit);
  const int decimals = static_cast<int>(std::max(0L, digits - 1 - (exponent - unit)));
  std::string text = fixed_text(scaled, decimals);
  drop_last_zeros(text);
  return is_short ? text : fmt::format("{}×{}", text, power_text(unit));
}

/// "turn − 0.3"
std::string text_from_turn(const Rational& after_turn, int digits) {
  if (after_turn == 0) return "turn";
  return fmt::format("turn {} {}", after_turn < 0 ? "−" : "+", time_text(abs(after_turn), digits));
}

/// A time, and how it is written.
struct WrittenTime {
  Rational time;
  std::optional<Rational> turn;  ///< of the run
  bool is_from_turn = false;
  int digits = kUsualDigits;

  std::string text() const {
    return is_from_turn ? text_from_turn(time - *turn, digits) : time_text(time, digits);
  }
  bool is_near_turn() const { return turn && abs(Rational(time - *turn)) * kNearTurn < abs(time); }
};

/// Writes it more exactly; false if it is exact enough.
bool refine(WrittenTime& written) {
  if (written.digits == kMostDigits) return false;
  if (!written.is_from_turn && written.is_near_turn()) {
    written.is_from_turn = true;
  } else {
    ++written.digits;
  }
  return true;
}

/// Writes times that differ but look alike more exactly; false if there are none.
bool refine_clashes(std::vector<WrittenTime>& all, std::vector<std::string>& texts) {
  using Extremes = std::pair<Rational, Rational>;
  std::map<std::string, Extremes> times_by_text;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Rational& time = all[i].time;
    Extremes& seen = times_by_text.try_emplace(texts[i], time, time).first->second;
    seen = {std::min(seen.first, time), std::max(seen.second, time)};
  }
  bool is_refined = false;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto& [least, greatest] = times_by_text.at(texts[i]);
    if (least == greatest || !refine(all[i])) continue;
    is_refined = true;
    texts[i] = all[i].text();
  }
  return is_refined;
}

/// What is written below the pictures of a sheet: the time of each, as short as can be where
/// different times are still written differently: "t = 3.5", or "t = turn − 2.1×10⁻⁷" if the
/// instant is named so, if times near the turn look alike otherwise, or if the picture itself has
/// the time. Empty where the picture has it and there is no turn.
/// @param times  of the instants, in their order
std::vector<std::string> sheet_captions(const Scene& scene, const Log& log,
                                        const std::vector<Instant>& instants,
                                        const std::vector<Rational>& times) {
  const std::optional<Rational> turn = turn_of(log);
  const bool picture_has_time = scene.show.has(Overlay::time);
  if (picture_has_time && !turn) return std::vector<std::string>(times.size());
  std::vector<WrittenTime> all;
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const bool is_from_turn = picture_has_time || instants[i].anchor == Instant::Anchor::turn;
    all.push_back({times[i], turn, is_from_turn});
    texts.push_back(all.back().text());
  }
  while (refine_clashes(all, texts)) {
  }
  for (std::string& text : texts) text.insert(0, "t = ");
  return texts;
}

/// Until the latest of these.
std::vector<std::string> notes_until(const Log& log, const std::vector<Instant>& instants) {
  Integer last;
  for (const Instant& instant : instants) {
    last = std::max(last, log.count_at(time_of(instant, log)));
  }
  const auto note = tie_note(log, last);
  return note ? std::vector{*note} : std::vector<std::string>();
}

}  // namespace

std::vector<std::uint8_t> draw_png(const DrawList& list, const std::stop_token& stop) {
  Canvas canvas(list.width_px, list.height_px,
                list.background ? Background::opaque : Background::transparent);
  canvas.listen(stop);
  canvas.paint(list);
  return encode_png(canvas.view());
}

DrawList still_picture(const Film& film, const Instant& instant) {
  if (film.scene() != nullptr) return film.scene()->runs().front().still(instant);
  return film.frame(frame_at(film, instant));
}

DrawList still_picture(const Script& script, const Instant& instant, const std::stop_token& stop) {
  const auto* const scene = std::get_if<Scene>(&script);
  return scene != nullptr ? run_of(*scene, stop).still(instant)
                          : still_picture(Film(script, {FilmUse::pictures, stop}), instant);
}

std::vector<std::string> render_still(const Script& script, const Instant& instant,
                                      const std::string& output, const std::stop_token& stop) {
  Draw* const draw = drawing_for(output, draw_png, "still", ".png, .svg, .pdf");
  OutputFile file(output);
  const auto* const scene = std::get_if<Scene>(&script);
  if (scene == nullptr) {
    write_picture(file, draw(still_picture(script, instant, stop), stop), stop);
    return {};
  }
  const FilmRun run = run_of(*scene, stop);
  write_picture(file, draw(run.still(instant), stop), stop);
  return notes_until(run.log(), {instant});
}

std::vector<Instant> spread_instants(const Scene& scene, int pictures, std::optional<Spacing> by) {
  require_valid(problems_of(scene));
  return spread_over(scene, *log_of(scene), {pictures, by});
}

std::vector<CaptionedPicture> sheet_pictures(const FilmRun& run,
                                             const std::vector<Instant>& instants,
                                             const OnProgress& on_progress,
                                             const std::stop_token& stop) {
  std::vector<Rational> times;
  times.reserve(instants.size());
  for (const Instant& instant : instants) times.push_back(time_of(instant, run.log()));
  const std::vector<std::string> captions = sheet_captions(run.scene(), run.log(), instants, times);
  std::vector<CaptionedPicture> pictures;
  Progress progress{0, static_cast<std::int64_t>(times.size())};
  std::vector<DrawList> stills = run.stills(times, [&] {
    check_stop(stop);
    ++progress.frames_done;
    if (on_progress) on_progress(progress);
  });
  for (std::size_t i = 0; i < times.size(); ++i) {
    pictures.push_back({std::move(stills[i]), captions[i]});
  }
  return pictures;
}

std::vector<std::string> render_sheet(const Scene& scene, const SheetInstants& instants,
                                      const std::string& output, const OnProgress& on_progress,
                                      const std::stop_token& stop) {
  Draw* const draw = drawing_for(output, draw_page_png, "sheet", ".pdf, .png, .svg");
  const auto* const named = std::get_if<std::vector<Instant>>(&instants);
  if (named != nullptr) check_count(named->size());
  const FilmRun run = run_of(scene, stop);
  OutputFile file(output);
  const std::vector<Instant> shown =
      named != nullptr ? *named : spread_over(scene, run.log(), std::get<Spread>(instants));
  std::vector<CaptionedPicture> pictures = sheet_pictures(run, shown, on_progress, stop);
  const bool is_png = draw == draw_page_png;
  const DrawList page = arrange(std::move(pictures), is_png ? kPageWidth_px : kPageWidth_pt,
                                is_png ? kPageHeight_px : kPageHeight_pt);
  write_picture(file, draw(page, stop), stop);
  return notes_until(run.log(), shown);
}

}  // namespace piblocks
