// The program as a page calls it: functions with texts and numbers, and files in the page's memory.
// In: the text of a scene file, keys with their texts, places in the film. Out: answers as text,
// pixels, samples, files.
#include <emscripten/emscripten.h>
#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/render.hpp>
#include <piblocks/script.hpp>

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/output_file.hpp"
#include "core/text.hpp"
#include "draw/canvas.hpp"
#include "media/mp4/coded_sound.hpp"
#include "render/renderings.hpp"
#include "web/choices.hpp"
#include "web/facts.hpp"
#include "web/live.hpp"
#include "web/opening.hpp"

namespace piblocks::web {
namespace {

// One page has one film, one picture and one sound.
Screen screen;
std::unique_ptr<LiveScript> live;
std::unique_ptr<LiveSound> sound;
/// What the browser has encoded of it.
std::shared_ptr<CodedSound> coded;
LiveScript::Place place;
/// What the last call has to say; the page reads it before the next one.
std::string answer;

/// Stores what `work` returns in `answer`; if it throws, problems_json() instead.
/// @returns whether it did not throw.
bool store_answer(const auto& work) {
  try {
    answer = work();
    return true;
  } catch (const std::exception& error) {
    answer = problems_json(error);
  }
  return false;
}

const LiveScript& opened() {
  if (!live) throw UsageError("page: no scene is open");
  return *live;
}

/// Shows this place. If it cannot be shown, nothing has happened.
/// @returns the answer of live_show().
std::string show(const LiveScript& from, Picture picture) {
  const std::string what = shown_json(from, picture.place, picture.list);
  screen.update(std::move(picture.list));
  place = picture.place;
  const PixelRect& rect = screen.patch().rect;
  return fmt::format(R"({{"shown":{},"rect":[{},{},{},{}]}})", what, rect.x_px, rect.y_px,
                     rect.width_px, rect.height_px);
}

std::string show(const LiveScript& from, const LiveScript::Place& wanted) {
  return show(from, Picture{wanted, from.picture(wanted)});
}

/// The picture that is shown, in the format that the file's extension names.
std::vector<std::uint8_t> encoded(const std::string& name) {
  const DrawList list = opened().full_picture(place);
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
/// @param settings  over the text: as Request::settings
/// @param places  lines as of live_show(): the first that the scene has is shown, otherwise its
///                start. Nothing is shown if this is empty.
/// @param size  of the picture, as "1080x1920", if the scene fits into it; otherwise its own. Files
///              are of its own size.
/// Answers with {"facts":facts_json(),"picture":as of live_show() or null,"placeProblem":"…",
/// "leftOut":[{"key":…,"item":…,"reason":…}]}.
EMSCRIPTEN_KEEPALIVE bool live_open(const char* text, const char* settings, const char* places,
                                    const char* size) {
  return store_answer([&] {
    OpenedScript opening = open_script({text, settings, places, size});
    const std::string facts = facts_of(opening);
    const bool is_shown = opening.picture.has_value();
    const std::string picture =
        is_shown ? show(*opening.live, *std::move(opening.picture)) : "null";
    if (!is_shown) place = opening.live->place_of_frame(0);
    live = std::move(opening.live);
    sound.reset();
    return opened_json(opening, facts, picture);
  });
}

/// Answers with choices_json() of what is open.
EMSCRIPTEN_KEEPALIVE bool live_choices() {
  return store_answer([] { return choices_json(opened()); });
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
/// @param number, count  the shard; count is 0 for the whole film. Answers with the file's name.
EMSCRIPTEN_KEEPALIVE bool live_render(const char* name, int number, int count) {
  return store_answer([&] {
    RenderJob job{.script = opened().script(), .output = name};
    if (count > 0) job.shard = Shard{number, count};
    render(job, [](const Progress& progress) {
      report(static_cast<double>(progress.frames_done), static_cast<double>(progress.frame_count));
    });
    return job.shard ? shard_name(name, *job.shard) : std::string(name);
  });
}

/// Begins sound for the next live_join().
/// @param codec  as browsers call it: "mp4a.40.2" or "opus". @param config  as Mp4Sound has it
EMSCRIPTEN_KEEPALIVE bool live_begin_sound(const char* codec, const std::uint8_t* config, int size,
                                           int packet_samples, int delay) {
  return store_answer([&] {
    coded = std::make_shared<CodedSound>();
    h264::Mp4Sound& track = coded->track;
    track.codec =
        codec == std::string_view("opus") ? h264::Mp4SoundCodec::opus : h264::Mp4SoundCodec::aac;
    track.config.assign(config, config + size);
    track.packet_samples = packet_samples;
    track.delay = delay;
    return std::string();
  });
}

/// Adds a packet to it.
EMSCRIPTEN_KEEPALIVE bool live_add_sound(const std::uint8_t* packet, int size) {
  return store_answer([&] {
    if (!coded) throw UsageError("page: no sound was begun");
    coded->packets.emplace_back(packet, packet + size);
    return std::string();
  });
}

/// Joins the shards of a rendering, which are files of the page's memory, and the sound that was
/// begun, if any.
EMSCRIPTEN_KEEPALIVE bool live_join(const char* name, int count) {
  return store_answer([&] {
    std::vector<std::string> shards;
    for (int number = 1; number <= count; ++number) {
      shards.push_back(shard_name(name, Shard{number, count}));
    }
    join_with_sound(shards, name, std::exchange(coded, nullptr));
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
