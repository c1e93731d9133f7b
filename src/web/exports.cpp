// The program as a page calls it: functions with texts and numbers, and files in the page's memory.
// In: the text of a scene file, keys with their texts, places in the film. Out: answers as text,
// pixels, samples, files.
#include <emscripten/emscripten.h>
#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/render.hpp>
#include <piblocks/script.hpp>

#include <algorithm>
#include <memory>
#include <new>
#include <string>
#include <string_view>
#include <vector>

#include "core/output_file.hpp"
#include "core/text.hpp"
#include "draw/canvas.hpp"
#include "render/renderings.hpp"
#include "web/facts.hpp"
#include "web/live.hpp"

namespace piblocks::web {
namespace {

std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> parts;
  for (;;) {
    const std::size_t end = text.find(separator);
    parts.emplace_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

/// Settings are lines KEY=TEXT, in which the texts of a list are separated by tabs. They win over
/// the text of the scene file.
Script read_script(std::string_view text, std::string_view settings) {
  if (std::max(text.size(), settings.size()) > kMaxSceneFile_bytes) {
    throw SceneError(fmt::format("scene: longer than {} bytes, the most that a scene file may have",
                                 kMaxSceneFile_bytes));
  }
  ScriptBuilder builder;
  builder.read_text("scene", text);
  for (const std::string& line : split(settings, '\n')) {
    if (line.empty()) continue;
    const std::size_t equals = line.find('=');
    if (equals == std::string::npos) {
      throw UsageError(fmt::format("setting '{}': must be KEY=TEXT", line));
    }
    const std::string key = line.substr(0, equals);
    builder.set(key, key, split(std::string_view(line).substr(equals + 1), '\t'));
  }
  return builder.build();
}

// One page has one film, one picture and one sound.
Screen screen;
std::unique_ptr<LiveScript> live;
std::unique_ptr<LiveSound> sound;
LiveScript::Place place;
/// What the last call has to say; the page reads it before the next one.
std::string answer;

/// Stores what `work` returns in `answer`. If it throws, stores the message instead, a line for
/// each problem. @returns whether it did not throw.
bool store_answer(const auto& work) {
  try {
    answer = work();
    return true;
  } catch (const std::bad_alloc&) {
    answer = "page: there is no memory left for this scene; make the picture smaller";
  } catch (const std::exception& error) {
    answer = error.what();
  }
  return false;
}

const LiveScript& opened() {
  if (!live) throw UsageError("page: no scene is open");
  return *live;
}

/// "frame 12" is a frame of the film, counted from 0; "instant turn-0.3" is any instant.
LiveScript::Place read_place(const LiveScript& from, std::string_view text) {
  constexpr std::string_view kFrame = "frame ";
  constexpr std::string_view kInstant = "instant ";
  if (text.starts_with(kInstant)) {
    return from.place_of(parse_instant(text.substr(kInstant.size())));
  }
  if (!text.starts_with(kFrame))
    throw UsageError(fmt::format("page: '{}' is neither a frame nor an instant", text));
  return from.place_of_frame(std::stoll(std::string(text.substr(kFrame.size()))));
}

/// Shows this place. If it cannot be shown, nothing has happened.
/// @returns the answer of live_show().
std::string show(const LiveScript& from, const LiveScript::Place& wanted) {
  DrawList list = from.picture(wanted);
  const std::string what = shown_json(from, wanted);
  screen.update(std::move(list));
  place = wanted;
  const PixelRect& rect = screen.patch().rect;
  return fmt::format(R"({{"shown":{},"rect":[{},{},{},{}]}})", what, rect.x_px, rect.y_px,
                     rect.width_px, rect.height_px);
}

/// Shows the first of these places that the scene has, otherwise the start.
/// @param problem  is set to what is wrong with the first of them.
std::string show_first(const LiveScript& from, const std::vector<std::string>& places,
                       std::string& problem) {
  for (const std::string& text : places) {
    try {
      return show(from, read_place(from, text));
    } catch (const Error& error) {
      if (problem.empty()) problem = error.what();
    }
  }
  return show(from, from.place_of_frame(0));
}

/// The picture that is shown, in the format that the file's extension names.
std::vector<std::uint8_t> encoded(const std::string& name) {
  const DrawList list = opened().picture(place);
  if (has_ending(name, ".svg")) return draw_svg(list);
  if (has_ending(name, ".pdf")) return draw_pdf(list);
  return draw_png(list, {});
}

/// Tells the page how far a rendering has come.
EM_JS(void, report, (double done, double count), {
  if (Module.onProgress) Module.onProgress(done, count);
});

}  // namespace
}  // namespace piblocks::web

using namespace piblocks;
using namespace piblocks::web;

extern "C" {

/// What the last call has to say.
EMSCRIPTEN_KEEPALIVE const char* live_answer() { return answer.c_str(); }

/// Answers with program_json().
EMSCRIPTEN_KEEPALIVE bool live_program() {
  return store_answer([] { return program_json(); });
}

/// Opens a scene or storyboard and shows it; if something is wrong, the one before stays.
/// @param places  lines as of live_show(): the first that the scene has is shown, otherwise its
///                start. Nothing is shown if this is empty.
/// Answers with {"facts":facts_json(),"picture":as of live_show() or null,"placeProblem":…}.
EMSCRIPTEN_KEEPALIVE bool live_open(const char* text, const char* settings, const char* places) {
  return store_answer([&] {
    auto made = std::make_unique<LiveScript>(read_script(text, settings));
    const std::string facts = facts_json(*made);
    const bool is_shown = std::string_view(places) != "";
    std::string problem;
    const std::string picture = is_shown ? show_first(*made, split(places, '\n'), problem) : "null";
    if (!is_shown) place = made->place_of_frame(0);
    live = std::move(made);
    sound.reset();
    return fmt::format(R"({{"facts":{},"picture":{},"placeProblem":{}}})", facts, picture,
                       json_text(problem));
  });
}

/// Shows "frame 12" of the film, counted from 0, or "instant X", where X is as "3.5", "turn-0.3",
/// "#314" and, of a storyboard, a second of the film. Answers with
/// {"shown":shown_json(),"rect":[x,y,width,height]}; the pixels of this rectangle are at
/// live_pixels(), others have not changed.
EMSCRIPTEN_KEEPALIVE bool live_show(const char* text) {
  return store_answer([&] { return show(opened(), read_place(opened(), text)); });
}

/// Shows the next collision (step 1), or the one before (step -1) and before the first one the
/// start of the film. Answers as live_show(), or with null if there is no such collision.
EMSCRIPTEN_KEEPALIVE bool live_step(int step) {
  return store_answer([&] {
    const auto beside = opened().collision_beside(place, step);
    return beside ? show(opened(), *beside) : std::string("null");
  });
}

/// Red, green, blue and alpha of the rectangle that was shown last.
EMSCRIPTEN_KEEPALIVE const std::uint8_t* live_pixels() { return screen.patch().rgba.data(); }

/// Writes the picture that is shown to a file of the page's memory: `*.png`, `*.svg`, `*.pdf`.
EMSCRIPTEN_KEEPALIVE bool live_save(const char* name) {
  return store_answer([&] {
    write_file(name, encoded(name));
    return std::string();
  });
}

/// Renders the film, or a shard of it, to a file of the page's memory.
/// @param number, count  the shard; count is 1 for the whole film. Answers with the file's name.
EMSCRIPTEN_KEEPALIVE bool live_render(const char* name, int number, int count) {
  return store_answer([&] {
    RenderJob job{.script = opened().script(), .output = name};
    if (count > 1) job.shard = Shard{number, count};
    render(job, [](const Progress& progress) {
      report(static_cast<double>(progress.frames_done), static_cast<double>(progress.frame_count));
    });
    return job.shard ? shard_name(name, *job.shard) : std::string(name);
  });
}

/// Joins the shards of a rendering, which are files of the page's memory.
EMSCRIPTEN_KEEPALIVE bool live_join(const char* name, int count) {
  return store_answer([&] {
    std::vector<std::string> shards;
    for (int number = 1; number <= count; ++number) {
      shards.push_back(shard_name(name, Shard{number, count}));
    }
    join(shards, name);
    return std::string(name);
  });
}

/// Prepares the sound of the film that is open.
EMSCRIPTEN_KEEPALIVE bool live_open_sound() {
  return store_answer([] {
    sound = std::make_unique<LiveSound>(opened().script());
    return std::string();
  });
}

/// Reads up to `count` pairs of samples from pair `first` on. Answers with the number of pairs
/// read, which are at live_samples().
EMSCRIPTEN_KEEPALIVE bool live_read_sound(double first, double count) {
  return store_answer([&] {
    if (!sound) throw UsageError("page: no sound is open");
    sound->read(static_cast<std::int64_t>(first), static_cast<std::int64_t>(count));
    return fmt::format("{}", sound->samples().size() / 2);
  });
}

/// Left and right in turn, as live_read_sound() has read them.
EMSCRIPTEN_KEEPALIVE const float* live_samples() {
  return sound ? sound->samples().data() : nullptr;
}
}
