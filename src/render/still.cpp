#include <fmt/format.h>
#include <piblocks/encode.hpp>
#include <piblocks/error.hpp>
#include <piblocks/render.hpp>

#include <memory>
#include <optional>
#include <string_view>
#include <utility>

#include "core/output_file.hpp"
#include "core/text.hpp"
#include "draw/canvas.hpp"
#include "draw/montage.hpp"
#include "physics/blocks.hpp"
#include "render/film.hpp"
#include "render/renderings.hpp"
#include "render/sheet_captions.hpp"
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
  return {scene, log_of(scene), FilmUse::pictures};
}

DrawList picture_of(const Scene& scene, const Instant& instant) {
  const FilmRun run = run_of(scene);
  return run.still(time_of(instant, run.log()));
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

ShownCollisions collisions_of(const Span& span, const Log& log) {
  return {log.count_at(span.from), log.count_at(span.to)};
}

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

/// @throws UsageError if the run has not as many different counts.
void check_spread_over_count(const Scene& scene, const ShownCollisions& shown, int pictures) {
  if (!scene.bodies && corner_of(scene.system)) {
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
Spacing usual_spacing(const Scene& scene, const Span& span, const ShownCollisions& shown,
                      int pictures) {
  if (scene.bodies) return Spacing::time;
  const std::optional<Rational> turn = turn_of(scene.system);
  const bool shows_turn = turn && span.from <= *turn && *turn <= span.to;
  const bool is_enough = shown.size() + 1 >= pictures && !corner_of(scene.system);
  return shows_turn && is_enough ? Spacing::count : Spacing::time;
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

std::vector<Instant> spread_instants(const Scene& scene, int pictures, std::optional<Spacing> by) {
  check_count(pictures < 0 ? 0 : static_cast<std::size_t>(pictures));
  require_valid(problems_of(scene));
  const std::unique_ptr<Log> log = log_of(scene);
  const Span span = span_of(scene, *log);
  if (by == Spacing::time) return spread_over_time(span, pictures);
  const ShownCollisions shown = collisions_of(span, *log);
  if (by == Spacing::count) check_spread_over_count(scene, shown, pictures);
  return by.value_or(usual_spacing(scene, span, shown, pictures)) == Spacing::count
             ? spread_over_count(span, shown, pictures)
             : spread_over_time(span, pictures);
}

std::vector<CaptionedPicture> sheet_pictures(const Scene& scene,
                                             const std::vector<Instant>& instants,
                                             const OnProgress& on_progress,
                                             const std::stop_token& stop) {
  const FilmRun run = run_of(scene);
  std::vector<Rational> times;
  times.reserve(instants.size());
  for (const Instant& instant : instants) times.push_back(time_of(instant, run.log()));
  const std::vector<std::string> captions = sheet_captions(scene, instants, times);
  std::vector<CaptionedPicture> pictures;
  Progress progress{0, static_cast<std::int64_t>(times.size())};
  std::vector<DrawList> stills = run.stills(times, [&] {
    if (stop.stop_requested()) throw Interrupted("interrupted");  // nothing has been opened
    ++progress.frames_done;
    if (on_progress) on_progress(progress);
  });
  for (std::size_t i = 0; i < times.size(); ++i) {
    pictures.push_back({std::move(stills[i]), captions[i]});
  }
  return pictures;
}

void render_sheet(const Scene& scene, const std::vector<Instant>& instants,
                  const std::string& output, const OnProgress& on_progress,
                  const std::stop_token& stop) {
  Draw* const draw = drawing_for(output, draw_page_png, "sheet", ".pdf, .png, .svg");
  check_count(instants.size());
  const bool is_png = draw == draw_page_png;
  std::vector<CaptionedPicture> pictures = sheet_pictures(scene, instants, on_progress, stop);
  write_picture(output, "sheet", stop, [&] {
    return draw(arrange(std::move(pictures), is_png ? kPageWidth_px : kPageWidth_pt,
                        is_png ? kPageHeight_px : kPageHeight_pt));
  });
}

}  // namespace piblocks
