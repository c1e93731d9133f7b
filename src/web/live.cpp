// The program in a page: a film that is changed and looked at again and again.
// In: the text of a scene file, keys with their texts, instants. Out: pixels, files in the memory
// of the page, what is wrong.
#include <emscripten/emscripten.h>
#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/instant.hpp>
#include <piblocks/render.hpp>
#include <piblocks/script.hpp>

#include <algorithm>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "draw/canvas.hpp"
#include "render/film.hpp"
#include "scene/run_log.hpp"

namespace piblocks::web {
namespace {

/// Settings are lines KEY=TEXT, and win over the text of the scene file.
Script read_script(std::string_view text, std::string_view settings) {
  ScriptBuilder builder;
  builder.read_text("scene", text);
  while (!settings.empty()) {
    const std::string_view line = settings.substr(0, settings.find('\n'));
    settings.remove_prefix(std::min(line.size() + 1, settings.size()));
    const std::size_t equals = line.find('=');
    if (equals == std::string_view::npos) {
      throw UsageError(fmt::format("setting '{}': must be KEY=TEXT", line));
    }
    const std::string key(line.substr(0, equals));
    builder.set(key, key, std::string(line.substr(equals + 1)));
  }
  return builder.build();
}

/// A scene's run, or the film of a storyboard.
using Shown = std::variant<FilmRun, Film>;

Shown show(const Script& script) {
  if (const auto* const scene = std::get_if<Scene>(&script)) {
    return FilmRun(*scene, RunLog(*scene), FilmUse::pictures);
  }
  return Film(script);
}

/// The film that the page shows, and its picture.
class Live {
 public:
  explicit Live(Script script)
      : script_(std::move(script)),
        shown_(show(script_)),
        canvas_(view().width_px, view().height_px, view().background) {}

  const Script& script() const { return script_; }
  const View& view() const { return view_of(script_); }
  const Timeline* timeline() const {
    const auto* const run = std::get_if<FilmRun>(&shown_);
    return run == nullptr ? nullptr : &run->timeline();
  }
  /// The pixels that `piblocks still` has at this instant, row by row without gaps.
  const std::uint8_t* paint(const Instant& instant) {
    canvas_.update(picture(instant));
    return canvas_.view().row(0);
  }

 private:
  DrawList picture(const Instant& instant) const {
    if (const auto* const run = std::get_if<FilmRun>(&shown_)) {
      return run->still(time_of(instant, run->timeline()));
    }
    const Film& film = std::get<Film>(shown_);
    return film.frame(frame_at(film, instant));
  }

  Script script_;
  Shown shown_;
  Canvas canvas_;
};

/// One page has one film.
std::unique_ptr<Live> live;
/// What the last call has to say; the page reads it before the next one.
std::string answer;

/// @param work  returns the answer.
/// @returns whether nothing was wrong; else the answer is what was, a line for each problem.
bool answers(const auto& work) {
  try {
    answer = work();
    return true;
  } catch (const std::exception& error) {
    answer = error.what();
    return false;
  }
}

const Live& opened() {
  if (!live) throw UsageError("no scene is open");
  return *live;
}

std::string facts_of(const Live& film) {
  std::string facts =
      fmt::format("width {}\nheight {}\n", film.view().width_px, film.view().height_px);
  if (const Timeline* const log = film.timeline()) {
    facts += fmt::format("collisions {}\n", log->size().get_str());
  }
  return facts;
}

}  // namespace
}  // namespace piblocks::web

using namespace piblocks;
using namespace piblocks::web;

extern "C" {

/// What the last call has to say.
EMSCRIPTEN_KEEPALIVE const char* live_answer() { return answer.c_str(); }

/// Opens a scene or storyboard; if something is wrong, that before stays. Answers with lines
/// "NAME VALUE": width, height, collisions (of a scene).
EMSCRIPTEN_KEEPALIVE bool live_open(const char* text, const char* settings) {
  return answers([&] {
    auto made = std::make_unique<Live>(read_script(text, settings));
    live = std::move(made);
    return facts_of(*live);
  });
}

/// The pixels of an instant, in 4 bytes each (blue, green, red, alpha); null if something is wrong.
EMSCRIPTEN_KEEPALIVE const std::uint8_t* live_paint(const char* instant) {
  const std::uint8_t* pixels = nullptr;
  answers([&] {
    opened();
    pixels = live->paint(parse_instant(instant));
    return std::string();
  });
  return pixels;
}

/// Writes the picture of an instant to a file of the page's memory, as `piblocks still` does.
EMSCRIPTEN_KEEPALIVE bool live_still(const char* instant, const char* file) {
  return answers([&] {
    render_still(opened().script(), parse_instant(instant), file);
    return std::string();
  });
}

/// Renders the film, or a share of it, to a file of the page's memory.
/// @param number, count  the shard; count is 1 for the whole film
EMSCRIPTEN_KEEPALIVE bool live_render(const char* file, int number, int count) {
  return answers([&] {
    RenderJob job{.script = opened().script(), .output = file};
    if (count > 1) job.shard = Shard{number, count};
    return fmt::format("frames {}\n", render(job, [](const Progress&) {}).frame_count);
  });
}
}
