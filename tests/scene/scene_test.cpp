// Scenes that are filled in by hand, past all parsers.
#include <gtest/gtest.h>
#include <piblocks/scene.hpp>

#include <functional>
#include <string>

#include "support/traced_random.hpp"

namespace piblocks {
namespace {

TEST(SceneByHand, IsToldWhatIsWrongWithIt) {
  const Instant start{Rational(1)};
  const Instant end{Rational(2)};
  const auto slow = [&](const Rational& factor) {
    return [=](Scene& s) { s.pacing.slow_motion = {{start, end, factor}}; };
  };
  const auto frozen = [&](const Rational& length_s) {
    return [=](Scene& s) { s.pacing.freezes = {{start, length_s}}; };
  };
  const std::pair<const char*, std::function<void(Scene&)>> cases[] = {
      {"time.slow-motion", slow(0)},
      {"time.slow-motion", slow(-2)},
      {"time.slow-motion", slow(parse_rational("1e320"))},
      {"time.slow-motion", slow(parse_rational("1e-320"))},
      {"time.slow-motion",
       [&](Scene& s) {
         slow(parse_rational("1e-200"))(s);
         s.time.speed = parse_rational("1e200");
       }},
      {"time.slow-motion",
       [&](Scene& s) {
         for (int i = 0; i <= int(kMaxWindows); ++i) {
           s.pacing.slow_motion.push_back({Instant(Rational(i)), Instant(Rational(i + 1)), 2});
         }
       }},
      {"time.ease", [](Scene& s) { s.pacing.ease_s = Rational(-1, 9); }},
      {"time.ease", [](Scene& s) { s.pacing.ease_s = kMaxEase_s + Rational(1, 9); }},
      {"time.freeze", frozen(0)},
      {"time.freeze", frozen(Rational(-1, 3))},
      {"time.freeze",
       [&](Scene& s) {
         s.pacing.freezes.assign(kMaxWindows + 1, Freeze{start, 1});
       }},
      {"show.title", [](Scene& s) { s.show.title = std::string(kMaxLine_bytes + 1, 'a'); }},
      {"show.caption", [](Scene& s) { s.show.caption = std::string(kMaxLine_bytes + 1, 'a'); }},
      {"show.title", [](Scene& s) { s.show.title = "a\tb"; }},
      {"show.title",
       [](Scene& s) {
         s.show.title =
             "a\xff"
             "b";
       }},
      {"show.caption", [](Scene& s) { s.show.caption = "\xcf"; }},
      {"show.logo", [](Scene& s) { s.show.logo = "a\n.png"; }},
      {"show.overlays",
       [](Scene& s) {
         s.show.overlays = {Overlay::time, Overlay::time};
       }},
      {"show.panels",
       [](Scene& s) {
         s.show.panels = {Panel::count, Panel::time, Panel::count};
       }},
      {"golden.frames",
       [](Scene& s) {
         s.golden.frames = {"last", "0", "last"};
       }},
      {"golden.frames",
       [](Scene& s) {
         s.golden.frames = {"0", "lost"};
       }},
  };
  EXPECT_TRUE(problems_of(Scene{}).empty());
  int number = 0;
  for (const auto& [key, spoil] : cases) {
    Scene scene;
    spoil(scene);
    const auto problems = problems_of(scene);
    ASSERT_EQ(problems.size(), 1U) << number;
    EXPECT_EQ(problems.front().key, key) << number;
    ++number;
  }
  Scene scene;
  slow(Rational(1, 1000))(scene);
  scene.pacing.freezes.assign(kMaxWindows, Freeze{start, Rational(1, 1000)});
  scene.show.title = std::string(kMaxLine_bytes, 'a');
  EXPECT_TRUE(problems_of(scene).empty());
}

Rational width_of(const Rational& ratio) {
  const Body blue{.mass = Rational(3, 7), .size = 2};
  const Body red{.mass = *blue.mass * ratio};
  return width_by_mass(blue, red) / 2;
}

TEST(WidthByMass, IsAnEighthMoreForEveryHundred) {
  const Rational eighth(1, 8);
  EXPECT_EQ(width_of(1), 1);
  for (int k = 1; k <= 4; ++k) {
    const Rational hundreds(power(100, static_cast<unsigned long>(k)));
    EXPECT_EQ(width_of(hundreds), 1 + k * eighth) << k;
    EXPECT_EQ(width_of(1 / hundreds), 1 - k * eighth) << k;
  }
  EXPECT_EQ(width_of(Rational(power(10, 5000))), Rational(3, 2));
  EXPECT_EQ(width_of(1 / Rational(power(10, 5000))), Rational(1, 2));
}

TEST(WidthByMass, NeverFallsWhereMassGrows) {
  TracedRandom random(9);
  EXPECT_GT(width_of(Rational(3, 2)), width_of(Rational(32, 25)));
  for (int i = 0; i < 1000; ++i) {
    const Rational one = random.rational(1, 300, 64);
    const Rational more = one * (1 + random.rational(0, 1, 100));
    EXPECT_LE(width_of(one), width_of(more)) << one << ", " << more;
  }
}

}  // namespace
}  // namespace piblocks
