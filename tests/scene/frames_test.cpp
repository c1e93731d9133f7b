#include <gtest/gtest.h>
#include <piblocks/error.hpp>

#include "scene/pacing_fixture.hpp"

namespace piblocks {
namespace {

Scene scene_with(int digits, const char* from, const char* to, const char* speed, const char* fps) {
  return paced_scene(
      {{"time.from", from}, {"time.to", to}, {"time.speed", speed}, {"view.fps", fps}}, digits);
}

TEST(Frames, NumericEndIsExclusive) {
  const Schedule schedule = schedule_of(scene_with(3, "0", "1", "1", "60"));
  EXPECT_EQ(film_frames(schedule), 60);
  EXPECT_EQ(schedule.time_of(0), 0);
  EXPECT_EQ(schedule.time_of(59), Rational(59, 60));
}

TEST(Frames, TimesAreExactAtAnyRate) {
  const Schedule schedule = schedule_of(scene_with(3, "1/3", "100", "1/7", "30000/1001"));
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
  const auto frames = [](const Scene& scene) { return film_frames(schedule_of(scene)); };
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
