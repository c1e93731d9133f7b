#include <gtest/gtest.h>
#include <piblocks/error.hpp>
#include <piblocks/instant.hpp>
#include <piblocks/timeline.hpp>

namespace piblocks {
namespace {

Scene scene_with(int digits, const char* from, const char* to, const char* speed, const char* fps) {
  SceneBuilder builder;
  builder.set("from", "time.from", from);
  builder.set("to", "time.to", to);
  builder.set("speed", "time.speed", speed);
  builder.set("fps", "view.fps", fps);
  Scene scene = builder.build();
  scene.system = article_system(digits);
  return scene;
}

TEST(Timeline, NumericEndIsExclusive) {
  const Scene scene = scene_with(3, "0", "1", "1", "60");
  const Timeline timeline(scene, *make_collision_log(scene.system));
  EXPECT_EQ(timeline.frame_count(), 60);
  EXPECT_EQ(timeline.time_of(0), 0);
  EXPECT_EQ(timeline.time_of(59), Rational(59, 60));
}

TEST(Timeline, TimesAreExactAtAnyRate) {
  const Scene scene = scene_with(3, "1/3", "100", "1/7", "30000/1001");
  const Timeline timeline(scene, *make_collision_log(scene.system));
  EXPECT_EQ(timeline.time_of(12345),
            Rational(1) / 3 + Rational(12345) * Rational(1, 7) * Rational(1001, 30000));
  EXPECT_LT(timeline.time_of(timeline.frame_count() - 1), 100);
  EXPECT_GE(timeline.time_of(timeline.frame_count()), 100);
}

TEST(Timeline, EndingWithTheLastCollisionShowsIt) {
  for (int digits = 1; digits <= 12; ++digits) {
    const Scene scene = scene_with(digits, "0", "last", "1", "60");
    const auto log = make_collision_log(scene.system);
    const Timeline timeline(scene, *log);
    const std::int64_t last = timeline.frame_count() - 1;
    EXPECT_EQ(state_at(*log, timeline.time_of(last)).count, log->size());
    EXPECT_LT(state_at(*log, timeline.time_of(last - 1)).count, log->size());
  }
}

TEST(Timeline, RefusesEmptyAndEndlessSpans) {
  const auto frames = [](const Scene& scene) {
    return Timeline(scene, *make_collision_log(scene.system)).frame_count();
  };
  EXPECT_THROW(frames(scene_with(3, "50", "last", "1", "60")), UsageError);
  EXPECT_THROW(frames(scene_with(3, "0", "1e9", "1", "60")), UsageError);
  EXPECT_THROW(frames(scene_with(3, "0", "last", "1e-9", "60")), UsageError);
  EXPECT_EQ(frames(scene_with(3, "0", "1000", "1000", "1")), 1);

  Scene receding = scene_with(3, "0", "last", "1", "60");
  receding.system.red.velocity = 1;
  EXPECT_THROW(frames(receding), UsageError);
}

TEST(Instant, ReadsItsThreeForms) {
  EXPECT_EQ(std::get<Rational>(parse_instant("-2.5")), Rational(-5, 2));
  EXPECT_TRUE(std::holds_alternative<LastCollision>(parse_instant("last")));
  EXPECT_EQ(std::get<NthCollision>(parse_instant("#314")).index, 314);
  EXPECT_EQ(std::get<NthCollision>(parse_instant("#31415926535897932384")).index,
            Integer("31415926535897932384"));
  for (const char* text : {"", "#", "#-1", "#1.5", "##1", "# 1", "last+1", "end"}) {
    EXPECT_THROW(parse_instant(text), UsageError) << text;
  }
}

TEST(Instant, NthCollisionHasHappened) {
  const auto log = make_collision_log(article_system(20));
  for (const char* index : {"1", "2", "15707963267948966192", "31415926535897932384"}) {
    const TimedState at = state_at(*log, parse_instant(std::string("#") + index));
    EXPECT_EQ(at.state.count.get_str(), index);
  }
  EXPECT_EQ(state_at(*log, parse_instant("last")).state.count, log->size());
  EXPECT_THROW(state_at(*log, parse_instant("#0")), UsageError);
  EXPECT_THROW(state_at(*log, parse_instant("#31415926535897932385")), UsageError);
}

}  // namespace
}  // namespace piblocks
