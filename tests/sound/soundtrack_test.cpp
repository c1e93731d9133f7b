// The soundtrack as a whole: where clacks begin, how high it gets, and what it costs.
#include "sound/soundtrack.hpp"

#include <gtest/gtest.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

#include "sound/true_peak.hpp"
#include "support/article_scene.hpp"

namespace piblocks {
namespace {
using testing_support::article_scene;
using testing_support::true_peak;

constexpr double kRate_hz = Soundtrack::kRate_hz;

struct Track {
  std::vector<double> left;
  std::vector<double> right;
};

Track track_of(const Scene& scene, const std::vector<Stretch>& stretches,
               const Rational& duration_s, std::size_t block = 1000) {
  const auto log = make_pair_log(scene.system);
  Soundtrack soundtrack(
      {Voice{.scene = scene, .log = *log, .stretches = stretches, .end_s = duration_s}},
      duration_s);
  Track track;
  std::vector<float> samples(2 * block);
  while (const std::size_t count = soundtrack.read(samples)) {
    for (std::size_t i = 0; i < count; ++i) {
      track.left.push_back(double(samples[2 * i]));
      track.right.push_back(double(samples[2 * i + 1]));
    }
  }
  return track;
}

/// The first sample of a window that is higher than half of its highest.
double onset(const std::vector<double>& samples, std::size_t begin, std::size_t end) {
  double high = 0;
  for (std::size_t i = begin; i < end; ++i) high = std::max(high, std::fabs(samples[i]));
  for (std::size_t i = begin; i < end; ++i) {
    if (std::fabs(samples[i]) > high / 2) return double(i);
  }
  return -1;
}

TEST(Soundtrack, BeginsEachClackAtItsCollision) {
  for (int digits = 1; digits <= 3; ++digits) {
    // So slow that no clack rings into the next.
    const Rational speed(1, digits == 3 ? 400 : 8);
    const Scene scene = article_scene(digits);
    const auto log = make_pair_log(scene.system);
    const Rational begin = digits == 3 ? Rational("348/100") : Rational(1);
    const Rational duration_s = digits == 3 ? 16 : 90;
    const Track track = track_of(scene, {{0, begin, speed}}, duration_s);
    int heard = 0;
    double quiet_since = 0;
    for (Integer index = 1; index <= log->last(); ++index) {
      const double at =
          (log->blocks_collision(index).time.hi - to_double(begin)) / to_double(speed) * kRate_hz;
      if (at < 0 || at + 100 > double(track.left.size())) continue;
      if (at - quiet_since > 400) {
        const auto window = std::size_t(at);
        EXPECT_NEAR(onset(track.left, window - 40, window + 40), at, 1) << index.get_str();
        ++heard;
      }
      quiet_since = at;
    }
    EXPECT_GE(heard, digits == 1 ? 2 : 20);
  }
}

TEST(Soundtrack, IsSilentWithoutACollision) {
  Scene scene = article_scene(3);
  scene.system.bodies[1].velocity[0] = 1;
  const Track track = track_of(scene, {{0, 0, 1}}, 3);
  EXPECT_EQ(track.left, std::vector<double>(3 * 48000, 0.0));
  // And before the first one, and while the film stands still.
  const Track early = track_of(article_scene(3), {{0, 0, 1}, {1, 1, 0}}, 4);
  EXPECT_EQ(early.right, std::vector<double>(4 * 48000, 0.0));
}

TEST(Soundtrack, NeverClips) {
  for (int digits : {1, 3, 4, 9, 100}) {
    for (const Rational& speed : {Rational(1), Rational(1, 30), Rational(-1)}) {
      const Rational begin = speed == 1 ? 0 : speed < 0 ? 7 : Rational(345, 100);
      const Track track = track_of(article_scene(digits), {{0, begin, speed}}, 7);
      for (const auto& channel : {track.left, track.right}) {
        EXPECT_LT(20 * std::log10(true_peak(channel)), -2.4) << digits << " at " << speed.get_str();
      }
    }
  }
}

/// A ten-thousandth of the article's first collision, at both edges of the view.
TEST(Soundtrack, PlaysTheWeakestClackAloud) {
  Scene scene = article_scene(1);
  scene.system.bodies[0].velocity[0] = Rational(-9999, 10000);
  scene.system.bodies[1].position[0] = Rational(30001, 10000);  // they meet at time 1, at 1.5
  for (const Rational& low : {Rational(3, 2), Rational(-5, 2)}) {
    scene.view.x = {low, low + 4};
    const Track track = track_of(scene, {{0, 0, 1}}, Rational(5, 4));
    for (const auto& channel : {track.left, track.right}) {
      const double peak_db = 20 * std::log10(std::ranges::max(channel));
      EXPECT_GE(peak_db, -14);
      EXPECT_LT(peak_db, -10);
    }
  }
}

TEST(Soundtrack, IsToTheSideWhereItHappens) {
  Scene scene = article_scene(1);
  constexpr std::size_t kBlocks = 2 * 48000;  // the blocks meet in the middle
  constexpr std::size_t kWall = 7 * 24000;
  scene.view.x = {Rational(-1, 10), Rational(61, 10)};
  const Track track = track_of(scene, {{0, 0, 1}}, 6);
  const auto energy = [](const std::vector<double>& samples, std::size_t at) {
    double sum = 0;
    for (std::size_t i = at; i < at + 4000; ++i) sum += samples[i] * samples[i];
    return sum;
  };
  const double aside = energy(track.left, kWall - 10) / energy(track.right, kWall - 10);
  EXPECT_GT(aside, 1.8);
  EXPECT_LT(aside, 1.995);  // 3 dB
  const double ratio = energy(track.left, kBlocks - 10) / energy(track.right, kBlocks - 10);
  EXPECT_LT(ratio, 2);
  EXPECT_GT(ratio, 0.5);
}

TEST(Soundtrack, SlowMotionMovesClacksApartAndLeavesEachAsItIs) {
  const Track normal = track_of(article_scene(1), {{0, 0, 1}}, 5);
  const Track slow = track_of(article_scene(1), {{0, 0, Rational(1, 2)}}, 9);
  for (std::size_t i = 0; i < 40000; ++i) {
    ASSERT_NEAR(slow.left[4 * 48000 - 30 + i], normal.left[2 * 48000 - 30 + i], 1e-7) << i;
  }
}

TEST(Soundtrack, DoesNotDependOnHowItIsRead) {
  const Track one = track_of(article_scene(5), {{0, 3, 1}}, 1, 1);
  const Track all = track_of(article_scene(5), {{0, 3, 1}}, 1, 100000);
  EXPECT_EQ(one.left, all.left);
  EXPECT_EQ(one.right, all.right);
}

TEST(Soundtrack, EndsWithoutAClick) {
  // 2 ms after the first clack.
  const Track track = track_of(article_scene(3), {{0, 0, 1}}, Rational(2002, 1000));
  EXPECT_EQ(track.left.size(), 96096u);
  EXPECT_LT(std::fabs(track.left.back()), 1e-4);
  EXPECT_LT(std::fabs(track.left[track.left.size() - 3]), 1e-3);
}

TEST(Soundtrack, RefusesStretchesThatAreNotInOrder) {
  for (const std::vector<Stretch>& stretches :
       {std::vector<Stretch>{}, {{1, 0, 1}}, {{0, 0, 1}, {Rational(3, 2), 2, 1}, {1, 1, -1}}}) {
    EXPECT_THROW(track_of(article_scene(3), stretches, 3), UsageError);
  }
}

TEST(Soundtrack, TakesScenesAtTheLimits) {
  Scene corner = article_scene(20);
  corner.system.bodies[0].position[0] = Rational(1, 2);
  Scene light = article_scene(1);
  light.system.bodies[1].mass = Rational(1, 1000000);
  Scene huge = article_scene(1);
  huge.system.bodies[1].mass = power(2, 1999);
  Scene heavy = article_scene(3);
  heavy.system.bodies[0].mass = power(10, 400);
  heavy.system.bodies[1].mass = power(10, 404);
  for (const Scene& scene : {corner, light, huge, heavy}) {
    const Track track = track_of(scene, {{0, 0, 1}}, 6);
    EXPECT_TRUE(std::ranges::all_of(track.left, [](double x) { return std::fabs(x) <= 1; }));
    EXPECT_GT(std::ranges::max(track.left), 0.01);
  }
}

}  // namespace
}  // namespace piblocks
