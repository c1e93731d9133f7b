// A still is the film's frame: random scenes and storyboards, every kind of instant, rendered whole
// and in parts, pixel by pixel.
#include <gtest/gtest.h>
#include <piblocks/error.hpp>
#include <piblocks/render.hpp>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "draw/found_items.hpp"
#include "media/png/png_reader.hpp"
#include "render/film.hpp"
#include "render/renderings.hpp"
#include "rendered_parts.hpp"
#include "scene/schedule.hpp"
#include "support/article_scene.hpp"
#include "support/temporary_folder.hpp"
#include "support/traced_random.hpp"

namespace piblocks {
namespace {

/// Frames as files, rendered in a number of parts that are joined.
class RenderedFrames {
 public:
  RenderedFrames(const Script& script, int parts) {
    const std::string names = folder_ / "%d.png";
    count_ = join(rendered_parts(parts, {script, names}), names).frame_count;
  }

  std::int64_t count() const { return count_; }
  std::vector<std::uint32_t> pixels(std::int64_t frame) const {
    return read_png(folder_ / (std::to_string(frame + 1) + ".png")).words;
  }

 private:
  testing_support::TemporaryFolder folder_;
  std::int64_t count_ = 0;
};

Instant any_instant(Random& random, const Integer& total) {
  const Rational offset = random.rational(0, 4, 30) - 2;
  switch (random.integer(0, 3)) {
    case 0:
      return random.rational(0, 12, 30);
    case 1:
      return Instant::turn(offset);
    case 2:
      return Instant::last(random.integer(0, 1) == 0 ? Rational(0) : offset);
    default:
      return Instant::collision(1 + total * random.integer(0, 999) / 1000,
                                random.integer(0, 1) == 0 ? Rational(0) : offset);
  }
}

/// Scenes of few frames, with any pacing and shutter.
Scene any_scene(Random& random) {
  Scene scene = testing_support::article_scene(static_cast<int>(random.integer(1, 12)), 96, 54);
  if (random.integer(0, 2) == 0) scene.system.bodies[1].mass = random.rational(1, 5000, 7) + 1;
  scene.view.frame_rate = random.integer(0, 1) == 0 ? Rational(4) : Rational(5000, 1001);
  if (random.integer(0, 1) == 0) scene.view.shutter = Rational(random.integer(1, 4)) / 4;
  scene.show.overlays = {Overlay::time};
  const Integer total = count_collisions(scene.system);
  if (random.integer(0, 2) == 0) scene.time.from = any_instant(random, total);
  if (random.integer(0, 1) == 0) scene.time.to = any_instant(random, total);
  scene.time.speed = Rational(random.integer(1, 8)) / 4;
  Pacing& pacing = scene.pacing;
  if (random.integer(0, 2) == 0) pacing.duration_s = random.rational(4, 16, 9);
  pacing.automatic_slow_motion = random.integer(0, 4) == 0;
  if (random.integer(0, 1) == 0) {
    const Rational from = random.rational(0, 8, 12);
    pacing.slow_motion = {{from, Rational(from + random.rational(0, 3, 8) + Rational(1, 8)), 3}};
  }
  for (std::int64_t i = random.integer(0, 2); i > 0; --i) {
    pacing.freezes.push_back(
        {any_instant(random, total), random.rational(0, 1, 5) + Rational(1, 4)});
  }
  if (random.integer(0, 2) == 0) pacing.hold_start_s = random.rational(0, 1, 3);
  if (random.integer(0, 2) == 0) pacing.hold_end_s = random.rational(0, 1, 3);
  pacing.loop = random.integer(0, 3) == 0;
  return scene;
}

/// Frames at which something begins or ends, and some others.
std::vector<std::int64_t> some_frames(Random& random, const Schedule& schedule, std::int64_t count,
                                      const Rational& rate) {
  std::vector<std::int64_t> frames = {0, count - 1, count / 2};
  for (const Stretch& stretch : schedule.stretches()) {
    const std::int64_t first = ceil(stretch.video_s * rate).get_si();
    frames.insert(frames.end(), {first - 1, first, first + 1});
  }
  for (int i = 0; i < 4; ++i) frames.push_back(random.integer(0, count - 1));
  std::erase_if(frames, [&](std::int64_t frame) { return frame < 0 || frame >= count; });
  // Several steps of an ease begin in one frame.
  std::ranges::sort(frames);
  frames.erase(std::ranges::unique(frames).begin(), frames.end());
  return frames;
}

/// The first frame with the same time; the one that a still of that time is.
std::int64_t first_at(const Schedule& schedule, const Rational& time, std::int64_t count) {
  for (std::int64_t frame = 0; frame < count; ++frame) {
    if (schedule.time_of(frame) == time) return frame;
  }
  return count;
}

std::string described(const Scene& scene) {
  std::string text;
  for (const auto& [key, value] : describe(scene)) text += "\n" + key + " = " + value;
  return text;
}

/// Nothing if the scene has none: its span is empty, or a freeze is outside of it.
std::optional<Film> film_of(const Scene& scene) {
  try {
    return std::optional<Film>(std::in_place, scene);
  } catch (const UsageError&) {
    return std::nullopt;
  }
}

TEST(Still, IsTheFilmsFrameInAnyScene) {
  TracedRandom random(1618);
  int scenes = 0;
  int compared = 0;
  for (int i = 0; scenes < many(50); ++i) {
    ASSERT_LT(i, many(250)) << "too many scenes are refused";
    const Scene scene = any_scene(random);
    const std::optional<Film> film = film_of(scene);
    if (!film) continue;
    ++scenes;
    const Schedule& schedule = *film->segments().front().segment.schedule();
    const std::int64_t count = film->frame_count();
    for (const std::int64_t frame : some_frames(random, schedule, count, scene.view.frame_rate)) {
      const Rational time = schedule.time_of(frame);
      const std::int64_t first = first_at(schedule, time, count);
      const DrawList still = still_picture(scene, time);
      ++compared;
      ASSERT_TRUE(still == film->frame(first) || painted(still) == painted(film->frame(first)))
          << "scene " << i << ", frame " << first << " of " << count << described(scene);
    }
  }
  EXPECT_GT(compared, many(400));
}

/// Cards, single runs and comparisons, with and without fades.
Storyboard any_storyboard(Random& random) {
  Storyboard story;
  story.view = any_scene(random).view;
  for (std::int64_t i = random.integer(1, 4); i > 0; --i) {
    Segment part;
    if (random.integer(0, 2) == 0) {
      part.content = Card{{"Counting"}, random.rational(0, 3, 7) + Rational(1, 4)};
    } else {
      Scenes runs(static_cast<std::size_t>(random.integer(1, 3)), any_scene(random));
      for (Scene& run : runs) run.system = any_scene(random).system;
      part.content = std::move(runs);
    }
    if (!story.segments.empty() && random.integer(0, 1) == 0)
      part.fade_s = random.rational(0, 1, 4);
    story.segments.push_back(std::move(part));
  }
  return story;
}

TEST(Still, IsTheFrameOfAFilmThatIsRenderedInParts) {
  TracedRandom random(2236);
  int films = 0;
  int compared = 0;
  for (int i = 0; films < many(15); ++i) {
    ASSERT_LT(i, many(150)) << "too many films are refused";
    const Script script = i % 2 == 0 ? Script(any_scene(random)) : Script(any_storyboard(random));
    try {
      const Film film(script);
      if (film.frame_count() < 3 || film.frame_count() > 300) continue;
      const RenderedFrames frames(script, static_cast<int>(random.integer(1, 3)));
      ++films;
      ASSERT_EQ(frames.count(), film.frame_count());
      for (int picked = 0; picked < 10; ++picked) {
        std::int64_t frame = random.integer(0, frames.count() - 1);
        Rational instant = frame / view_of(script).frame_rate;  // of a storyboard's video
        if (std::holds_alternative<Scene>(script)) {
          const Schedule& schedule = *film.segments().front().segment.schedule();
          instant = schedule.time_of(frame);
          frame = first_at(schedule, instant, frames.count());
        }
        ++compared;
        ASSERT_TRUE(painted(still_picture(script, instant)) == frames.pixels(frame))
            << "film " << i << ", frame " << frame << " of " << frames.count();
      }
    } catch (const UsageError&) {  // spans without time, fades without room
    }
  }
  EXPECT_EQ(compared, many(150));
}

// Where collisions anchor them, too: what a freeze or an end shows is what a still of it shows.
TEST(Still, OfAnAnchorIsWhereTheFilmStops) {
  for (int digits = 1; digits <= 20; ++digits) {
    Scene scene = testing_support::article_scene(digits, 96, 54);
    scene.view.frame_rate = 4;
    scene.view.shutter = Rational(1, 2);
    scene.time.to = Instant::last();
    scene.pacing.duration_s = 3;
    scene.pacing.hold_end_s = 1;
    const Film film(scene);
    EXPECT_EQ(painted(still_picture(scene, Instant::last())),
              painted(film.frame(film.frame_count() - 1)))
        << digits;
  }
}

// A frame rate of 0 would be divided by.
TEST(Still, RefusesASceneFilledInWrongly) {
  Scene endless;
  endless.view.frame_rate = 0;
  endless.view.shutter = Rational(1, 2);
  EXPECT_THROW(still_picture(endless, Rational(3)), SceneError);
  Scene flat;
  flat.view.x.high = flat.view.x.low;
  EXPECT_THROW(still_picture(flat, Rational(3)), SceneError);
  EXPECT_THROW(sheet_pictures(run_of(flat), {Rational(3)}), SceneError);
  EXPECT_THROW(spread_instants(endless, 3), SceneError);
}

}  // namespace
}  // namespace piblocks
