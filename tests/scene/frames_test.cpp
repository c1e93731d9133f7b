#include <gtest/gtest.h>
#include <piblocks/error.hpp>
#include <piblocks/script.hpp>
#include <piblocks/two_blocks.hpp>

#include "scene/schedule.hpp"

namespace piblocks {
namespace {

Scene scene_with(int digits, const char* from, const char* to, const char* speed, const char* fps) {
  ScriptBuilder builder;
  builder.set("from", "time.from", from);
  builder.set("to", "time.to", to);
  builder.set("speed", "time.speed", speed);
  builder.set("fps", "view.fps", fps);
  Scene scene = builder.build_scene();
  scene.system = article_system(digits);
  return scene;
}

TEST(Frames, NumericEndIsExclusive) {
  const Scene scene = scene_with(3, "0", "1", "1", "60");
  const Schedule schedule = make_schedule(scene, *make_pair_log(scene.system));
  EXPECT_EQ(film_frames(schedule), 60);
  EXPECT_EQ(schedule.time_of(0), 0);
  EXPECT_EQ(schedule.time_of(59), Rational(59, 60));
}

TEST(Frames, TimesAreExactAtAnyRate) {
  const Scene scene = scene_with(3, "1/3", "100", "1/7", "30000/1001");
  const Schedule schedule = make_schedule(scene, *make_pair_log(scene.system));
  EXPECT_EQ(schedule.time_of(12345),
            Rational(1) / 3 + Rational(12345) * Rational(1, 7) * Rational(1001, 30000));
  EXPECT_LT(schedule.time_of(film_frames(schedule) - 1), 100);
  EXPECT_GE(schedule.time_of(film_frames(schedule)), 100);
}

TEST(Frames, EndingWithTheLastCollisionShowsIt) {
  for (int digits = 1; digits <= 12; ++digits) {
    const Scene scene = scene_with(digits, "0", "last", "1", "60");
    const auto log = make_pair_log(scene.system);
    const Schedule schedule = make_schedule(scene, *log);
    const std::int64_t last = film_frames(schedule) - 1;
    EXPECT_EQ(log->blocks_at(schedule.time_of(last)).count, log->last());
    EXPECT_LT(log->blocks_at(schedule.time_of(last - 1)).count, log->last());
  }
}

TEST(Frames, RefusesEmptyAndEndlessSpans) {
  const auto frames = [](const Scene& scene) {
    return film_frames(make_schedule(scene, *make_pair_log(scene.system)));
  };
  EXPECT_THROW(frames(scene_with(3, "50", "last", "1", "60")), UsageError);
  EXPECT_THROW(frames(scene_with(3, "0", "1e9", "1", "60")), UsageError);
  EXPECT_THROW(frames(scene_with(3, "0", "last", "1e-9", "60")), UsageError);
  EXPECT_EQ(frames(scene_with(3, "0", "1000", "1000", "1")), 1);

  Scene receding = scene_with(3, "0", "last", "1", "60");
  receding.system.bodies[1].velocity[0] = 1;
  EXPECT_THROW(frames(receding), UsageError);
}

}  // namespace
}  // namespace piblocks
