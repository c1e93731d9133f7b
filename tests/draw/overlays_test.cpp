// What overlays say: figures that are right, readable, and named as they look.
#include <gtest/gtest.h>

#include <string>

#include "draw/composed_pictures.hpp"

namespace piblocks {
namespace {

constexpr const char* kAllOverlays = "digits,masses,velocities,energy,momentum,time,ruler";

TEST(Overlays, DigitsLightUpInTheirPlaces) {
  const Pictures pictures(5, {{"show.overlays", "digits"}});
  const auto lit_after = [&](const char* count) {
    const DrawList list = pictures.after(Integer(count));
    return text_of(list, ItemId::lit_count) + "|" + text_of(list, ItemId::count);
  };
  EXPECT_EQ(lit_after("3141"), "|3,141");
  EXPECT_EQ(lit_after("29999"), "|29,999");
  EXPECT_EQ(lit_after("30000"), "3|0,000");
  EXPECT_EQ(lit_after("31000"), "31|,000");
  EXPECT_EQ(lit_after("31407"), "31,4|07");
  EXPECT_EQ(lit_after("31415"), "31,415|");
}

TEST(Overlays, DigitsLightUpInTheirBase) {
  const auto lit_after = [](const char* base, int digits, int count) {
    const Pictures pictures(digits, {{"base", base}, {"show.overlays", "digits"}});
    const DrawList list = pictures.after(count);
    return text_of(list, ItemId::lit_count) + "|" + text_of(list, ItemId::count);
  };
  EXPECT_EQ(lit_after("2", 5, 31), "|11111");
  EXPECT_EQ(lit_after("2", 5, 49), "1100|01") << "a digit may be right too early";
  EXPECT_EQ(lit_after("2", 5, 50), "110010|");
  EXPECT_EQ(lit_after("16", 3, 0x31f), "3|1f");
  EXPECT_EQ(lit_after("16", 3, 0x324), "324|");
}

TEST(Overlays, ReadOutsSayWhatIs) {
  const Pictures pictures(2, {{"show.overlays", "time,energy,momentum,masses,velocities"},
                              {"time.slow-motion", "3:4:10"}});
  const DrawList start = pictures.at(0);
  EXPECT_TRUE(has_text(start, "t = 0.000"));
  EXPECT_TRUE(has_text(start, "Energy: red 50.0000 + blue 0.0000 = 50.0000"));
  EXPECT_TRUE(has_text(start, "Momentum: red −100.000, blue 0.000, sum −100.000"));
  EXPECT_TRUE(has_text(start, "100 kg"));
  EXPECT_TRUE(has_text(start, "−1.00"));
  EXPECT_FALSE(has_text(start, "10× slower"));
  EXPECT_TRUE(has_text(pictures.at(Rational(7, 2), 10), "10× slower"));
  // The first collision, of masses 1 and 100: blue leaves with 200/101, red with -99/101.
  const DrawList first = pictures.after(1);
  EXPECT_TRUE(has_text(first, "Momentum: red −98.020, blue −1.980, sum −100.000"));
  EXPECT_TRUE(has_text(first, "−1.98"));
}

/// While slow motion eases in, in whole numbers that need no more room than those of the windows.
TEST(Overlays, PassingFactorsAreRounded) {
  const auto label = [](const Pictures& pictures, const Rational& slowdown) -> std::string {
    for (const Box& box : boxes_of(pictures.at(0, slowdown))) {
      if (box.what.ends_with("er")) return box.what;
    }
    return "";
  };
  const auto with_windows = [](const char* windows) {
    return Pictures(2, {{"time.slow-motion", windows}});
  };
  const Pictures hundred = with_windows("2:3:100,3:4:7/2,5:6:1/20");
  EXPECT_EQ(label(hundred, Rational(1001, 1000)), "");
  EXPECT_EQ(label(hundred, Rational(8, 5)), "2× slower");
  EXPECT_EQ(label(hundred, Rational(7, 2)), "3.5× slower") << "a window's own factor";
  EXPECT_EQ(label(hundred, Rational(3701, 100)), "37× slower");
  EXPECT_EQ(label(hundred, Rational(999, 10)), "100× slower");
  EXPECT_EQ(label(hundred, Rational(10, 73)), "7× faster");
  EXPECT_EQ(label(hundred, Rational(1, 20)), "20× faster");
  EXPECT_EQ(label(with_windows("auto"), Rational(31415, 100)), "310× slower");
  const Font font;
  for (const char* factor : {"3/2", "2", "9.7", "10", "99.5", "1e7", "1/3", "1e-9"}) {
    const Pictures pictures = with_windows((std::string("2:3:") + factor).c_str());
    const Rational whole = parse_rational(factor);
    const double room_em = font.width_em(label(pictures, whole));
    EXPECT_GT(room_em, 0) << factor;
    for (int i = 1; i < 50; ++i) {
      const std::string text = label(pictures, 1 / (1 + (1 / whole - 1) * i / 50));
      EXPECT_LE(text.empty() ? 0 : font.width_em(text), room_em) << text << " of " << factor;
    }
  }
}

TEST(Overlays, NameNoColourThatIsNotThere) {
  Settings things{{"show.overlays", kAllOverlays}};
  for (const char* panel : {"velocity", "position", "unfolded", "time", "count", "ellipse",
                            "mirrors", "conservation", "certainty"}) {
    things.emplace_back("show.panels", panel);
  }
  for (const char* theme : {"print", "colorblind"}) {
    for (const char* size : {"1920x1080", "1080x1080"}) {
      for (const Setting& thing : things) {
        const Pictures pictures(3, {{"view.size", size}, {"view.theme", theme}, thing});
        for (const Box& box : boxes_of(pictures.at(3))) {
          EXPECT_EQ(box.what.find("red"), std::string::npos) << box.what;
          EXPECT_EQ(box.what.find("blue"), std::string::npos) << box.what;
        }
      }
    }
  }
}

TEST(Overlays, ReadOutsHoldMassesBeyondADouble) {
  const Pictures pictures(200, {{"show.overlays", "energy,momentum,masses"}});
  const DrawList start = pictures.at(0);
  EXPECT_TRUE(has_text(start, "Energy ×10³⁹⁷: red 5.00000 + blue 0.00000 = 5.00000"));
  EXPECT_TRUE(has_text(start, "Momentum ×10³⁹⁸: red −1.00000, blue 0.00000, sum −1.00000"));
  EXPECT_TRUE(has_text(start, "10³⁹⁸ kg"));
}

TEST(Overlays, EnergyIsSharedAtTheTurnOfAnyMass) {
  for (const int digits : {3, 20, 163, 200, 300}) {
    const Pictures pictures(digits, {{"show.overlays", "energy"}});
    const std::string text = text_of(pictures.at(Rational(7, 2)), ItemId::read_outs);
    const double red = number_after(text, "red ");
    const double blue = number_after(text, "blue ");
    // About the turn blue has nearly all of it.
    EXPECT_GT(blue, red) << text;
    EXPECT_NEAR(red + blue, number_after(text, "= "), 2e-5 * (red + blue)) << text;
  }
}

TEST(Overlays, MomentumHoldsAnyMass) {
  for (const char* mass : {"1/10^310", "1/10^200", "10^310"}) {
    const Pictures pictures(1, {{"show.overlays", "momentum,energy"}, {"red.mass", mass}});
    for (const Rational& time : {Rational(0), Rational(3), Rational(9)}) {
      const DrawList list = pictures.at(time);
      for (const Box& box : boxes_of(list)) {
        EXPECT_EQ(box.what.find("nan"), std::string::npos) << box.what;
        EXPECT_EQ(box.what.find("inf"), std::string::npos) << box.what;
      }
    }
    // Blue is at rest at first, and all momentum is red's: of a red so light next to nothing of
    // what blue could have with the same energy.
    const std::string red = std::string(mass).starts_with("1/") ? "0.00000" : "−1.00000";
    const std::string start = text_of(pictures.at(0), nth(ItemId::read_outs, 1));
    EXPECT_NE(start.find("red " + red + ", blue 0.00000, sum " + red), std::string::npos) << start;
  }
}

TEST(Overlays, MakeRoomForInstantsOutsideOfTheSpan) {
  const Pictures pictures(
      3, {{"show.overlays", "time,energy"}, {"view.size", "800x450"}, {"time.to", "5"}});
  const DrawList list = pictures.at(1000000);
  EXPECT_TRUE(has_text(list, "t = 1,000,000.00"));
  EXPECT_EQ(text_problem(boxes_of(list), whole_of(list)), "");
}

TEST(Overlays, AreReadableInSmallFrames) {
  const Pictures pictures(1, {{"show.overlays", "time,energy"}, {"view.size", "320x180"}});
  const DrawList list = pictures.at(1);
  for (const std::size_t n : {0U, 1U}) {
    EXPECT_GE(item_of<TextItem>(list, nth(ItemId::read_outs, n)).size_px, 8) << n;
  }
}

TEST(Overlays, TimeHasTheDecimalsThatTheSpeedNeeds) {
  const auto with = [](const char* key, const char* text) {
    const Pictures pictures(
        3, {{"show.overlays", "time"}, {"time.from", "2.5"}, {"time.to", "3.5"}, {key, text}});
    return text_of(pictures.at(Rational(5, 2)), ItemId::read_outs);
  };
  EXPECT_EQ(with("time.speed", "1/600"), "t = 2.50000");
  EXPECT_EQ(with("time.duration", "600"), "t = 2.50000");
  EXPECT_EQ(with("time.duration", "1"), "t = 2.50");
}

/// A double has no more than 17 digits, and no quarter here.
TEST(Overlays, TimeIsExactHoweverLate) {
  const Pictures pictures(3, {{"show.overlays", "time"}});
  const DrawList list = pictures.at(parse_rational("123456789012345678.25"));
  EXPECT_TRUE(has_text(list, "t = 123,456,789,012,345,678.25"));
}

}  // namespace
}  // namespace piblocks
