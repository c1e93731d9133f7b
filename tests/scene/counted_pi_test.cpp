// How pi comes into the count, in words.
#include "scene/counted_pi.hpp"

#include <gtest/gtest.h>

#include "support/traced_random.hpp"

namespace piblocks {
namespace {

std::string half_turn(const Rational& ratio) {
  TwoBlocks system;
  system.red.mass = ratio;
  return half_turn_text(system);
}

TEST(CountedPi, HalfATurnHasSoManyAngles) {
  EXPECT_EQ(half_turn(100), "π/θ ≈ 10π = 31.4…");
  EXPECT_EQ(half_turn(10'000'000'000), "π/θ ≈ 100,000π = 314,159.2…");
  EXPECT_EQ(half_turn(4), "π/θ = 6.7…") << "π / arctan 1/2 = 6.776";
  EXPECT_EQ(half_turn(Rational(1, 2)), "π/θ = 3.2…") << "π / arctan √2 = 3.2885";
  EXPECT_EQ(half_turn(196), "π/θ = 44.0…") << "14π = 43.98, but the blocks meet 44 times";
  for (const Rational& ratio : {Rational(1), Rational(3), Rational(1, 3)}) {
    EXPECT_EQ(half_turn(ratio), "") << "π/θ is 4, 6 or 3";
  }
  EXPECT_EQ(half_turn(1'000'000'000'000), "") << "too many to read";
  TwoBlocks thrown = article_blocks(2);
  thrown.blue.velocity = 1;
  EXPECT_EQ(half_turn_text(thrown), "");
  TwoBlocks touching = article_blocks(2);
  touching.wall_face = touching.blue.position - touching.blue.width / 2;
  EXPECT_EQ(half_turn_text(touching), "");
  TwoBlocks lossy = article_blocks(2);
  lossy.wall_restitution = Rational(1, 2);
  EXPECT_EQ(half_turn_text(lossy), "");
}

TEST(CountedPi, TheWholePartIsTheCount) {
  TracedRandom random(31);
  for (int i = 0; i < 300; ++i) {
    TwoBlocks system;
    const Rational root = random.rational(4, 2000, 1);
    system.red.mass = i % 2 == 0 ? Rational(root * root) : random.rational(1, 100'000, 100);
    if (half_turn_text(system).empty()) continue;
    std::string text = half_turn_text(system);
    text = text.substr(text.rfind("= ") + 2);
    EXPECT_EQ(text.substr(0, text.find('.')), with_thousands_separators(count_collisions(system)));
  }
}

}  // namespace
}  // namespace piblocks
