// The digit margin and its diagram against MPFR: places of its marks, its words, scenes that it
// refuses, room.
#include "draw/panels/digit_margin.hpp"

#include <boost/multiprecision/mpfr.hpp>
#include <gtest/gtest.h>
#include <mpfr.h>
#include <piblocks/error.hpp>

#include <cmath>
#include <string>
#include <vector>

#include "draw/composed_pictures.hpp"
#include "draw/look.hpp"
#include "support/contains.hpp"
#include "support/message_of.hpp"

namespace piblocks {
namespace {
using testing_support::contains;
using testing_support::message_of;

using Real = boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<120>,
                                           boost::multiprecision::et_off>;

/// pi/s, pi/theta, and the least pi of one more collision over s, less the whole part of pi/s.
struct Expected {
  Expected(int base, int digits) {
    const Real scale = pow(Real(base), digits - 1);
    const Real theta = atan(1 / scale);
    const Real pi = 4 * atan(Real(1));
    const Real floored = floor(pi * scale);
    mpfr_get_z(whole.get_mpz_t(), floored.backend().data(), MPFR_RNDN);
    fraction = pi * scale - floored;
    rays = pi / theta - floored;
    excess = rays - fraction;
    least = theta * (floored + 1) * scale - floored;
  }
  /// Digits after the point of a number from 0 to 1.
  static std::string digits_of(Real rest, int base, std::size_t count) {
    std::string digits;
    while (digits.size() < count) {
      rest *= base;
      digits += Integer(static_cast<long>(floor(rest))).get_str(base);
      rest -= floor(rest);
    }
    return digits;
  }

  Integer whole;
  Real fraction;
  Real rays;  ///< less the whole part
  Real excess;
  Real least;
};

TEST(DigitMargin, AgreesWithMpfr) {
  for (const int base : {2, 3, 7, 10, 16, 36}) {
    for (int digits = 1; digits <= 22; ++digits) {
      const DigitMargin found(base, static_cast<unsigned long>(digits - 1));
      const Expected expected(base, digits);
      EXPECT_EQ(found.whole(), expected.whole);
      const auto expect_near = [&](const Rational& value, double number) {
        EXPECT_NEAR(to_double(value), number, 1e-15 * std::abs(number)) << base << ' ' << digits;
      };
      expect_near(found.fraction(), double(expected.fraction));
      expect_near(found.excess(), double(expected.excess));
      EXPECT_EQ(found.is_wrong(), double(expected.rays) > 1) << base << ' ' << digits;
      EXPECT_EQ(found.following(20), Expected::digits_of(expected.fraction, base, 20));
      if (digits > 1) {
        EXPECT_EQ(found.needed(20), Expected::digits_of(expected.least, base, 20));
      }
      EXPECT_EQ(found.is_wrong(), base == 7 && digits == 2);
    }
  }
}

/// Counterexamples to Galperin's conjecture in other bases: counts that exceed the digits of pi.
TEST(DigitMargin, KnowsTheCountsThatAreWrong) {
  for (int base = kMinBase; base <= kMaxBase; ++base) {
    for (int digits = 1; digits <= 12; ++digits) {
      const DigitMargin found(base, static_cast<unsigned long>(digits - 1));
      const Integer count = count_collisions(article_system(digits, base));
      EXPECT_EQ(count, found.whole() + (found.is_wrong() ? 1 : 0)) << base << ' ' << digits;
      const bool is_known = base == 6 || base == 7 || base == 14 || base == 21 || base == 28;
      EXPECT_EQ(found.is_wrong(), digits == 2 && is_known) << base << ' ' << digits;
    }
  }
}

TEST(DigitMargin, CountsNines) {
  for (const int base : {2, 10, 16, 36}) {
    for (int digits = 1; digits <= 40; ++digits) {
      const DigitMargin found(base, static_cast<unsigned long>(digits - 1));
      const std::string needed = found.needed(found.nines() + 1);
      const char nine = Integer(base - 1).get_str(base).front();
      EXPECT_EQ(needed.find_first_not_of(nine), found.nines()) << base << ' ' << digits;
      if (base == 10 && digits > 1) {
        EXPECT_EQ(found.nines(), static_cast<std::size_t>(digits - 2));
      }
    }
  }
}

/// What the panel shows.
struct Figure : Shown {
  explicit Figure(const Settings& settings, const Rational& time = 0)
      : Shown(
            Pictures(scene_with(Settings{{"view.theme", "lecture"}, {"show.panels", "certainty"}} +
                                settings))
                .at(time)) {
    const Palette palette = palette_of(Theme::lecture);
    for (const PathItem& path : paths) {
      const Rect& box = path.points.bounds();
      if (path.fill == palette.accent && path.points.view().size() == 4) bands.push_back(box);
      if (path.stroke && box.height == 0 && box.width > 0) lines.push_back(box);
    }
  }
  bool says(const std::string& text) const { return contains(words(" "), text); }

  std::vector<Rect> bands;  ///< from pi/s to pi/theta
  std::vector<Rect> lines;
};

class MarginBases : public testing::TestWithParam<int> {};

TEST_P(MarginBases, MarksAreWhereTheyBelong) {
  for (int digits = 1; digits <= 20; ++digits) {
    const Figure figure({{"base", std::to_string(GetParam())}, {"digits", std::to_string(digits)}});
    const Expected expected(GetParam(), digits);
    const double fraction = double(expected.fraction);
    const double excess = double(expected.excess);
    const Rect& line = figure.lines.at(0);
    const Rect& band = figure.bands.at(0);
    EXPECT_NEAR(band.x, line.x + fraction * line.width, 1e-6) << digits;
    EXPECT_NEAR(band.width, excess * line.width, 1e-6) << digits;
  }
}

INSTANTIATE_TEST_SUITE_P(OfTheCount, MarginBases, testing::Values(2, 10, 16));

TEST(MarginPanel, SaysWhichDigitsWouldBeNeeded) {
  const Figure three(Settings{{"digits", "3"}});
  for (const char* text :
       {"314 ", "315 ", "100 π", "314.159…", "314.169…", "0.0105", "9895…", "1592…", "nines"}) {
    EXPECT_TRUE(three.says(text)) << text << " in " << three.words(" ");
  }
  const Figure twenty(Settings{{"digits", "20"}});
  for (const char* text : {"…932,384", "…932,385", "18", "20", "626433…", "nines"}) {
    EXPECT_TRUE(twenty.says(text)) << text << " in " << twenty.words(" ");
  }
  const Figure binary({{"digits", "5"}, {"base", "2"}});
  for (const char* text : {"110010 ", "110011 ", "11.0010 ", "111011…", "010000…", "ones"}) {
    EXPECT_TRUE(binary.says(text)) << text << " in " << binary.words(" ");
  }
  EXPECT_TRUE(Figure(Settings{{"digits", "5"}, {"base", "16"}}).says("digits f"));
}

TEST(MarginPanel, SaysThatEqualMassesEndExactlyAtFour) {
  const Figure one(Settings{{"digits", "1"}});
  EXPECT_TRUE(one.says("exactly"));
  EXPECT_FALSE(one.says("nines"));
  EXPECT_NEAR(one.bands.at(0).x + one.bands[0].width, one.lines.at(0).x + one.lines[0].width, 1e-6);
}

TEST(MarginPanel, ShowsADigitThatIsWrong) {
  const Figure figure({{"digits", "2"}, {"base", "7"}});
  EXPECT_TRUE(figure.says("Here the last one is"));
  const double middle = figure.lines.at(0).x + figure.lines[0].width / 2;
  EXPECT_LT(figure.bands.at(0).x, middle);
  EXPECT_GT(figure.bands[0].x + figure.bands[0].width, middle);
}

TEST(MarginPanel, IsOnePlateThatNeverChanges) {
  const Figure early(Settings{{"digits", "3"}});
  const Figure late(Settings{{"digits", "3"}}, 9);
  EXPECT_EQ(early.plates.size(), 1U);
  EXPECT_TRUE(early.plates == late.plates);
}

TEST(MarginPanel, RefusesScenesThatDoNotCountPi) {
  for (const Settings& settings :
       {Settings{{"mass-ratio", "50"}}, Settings{{"mass-ratio", "10"}},
        Settings{{"mass-ratio", "1/100"}},
        Settings{{"digits", "3"}, {"base", "3"}, {"red.mass", "100"}},
        Settings{{"digits", "3"}, {"blue.velocity", "1"}},
        Settings{{"digits", "3"}, {"red.velocity", "1"}, {"time.to", "1"}},
        Settings{{"digits", "3"}, {"blue.position", "1/2"}}}) {
    const std::string message = message_of<UsageError>([&] { Figure{settings}; });
    EXPECT_EQ(message.find("show.panels: the diagram 'certainty'"), 0U) << message;
    EXPECT_TRUE(contains(message, "leave it out"));
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

TEST(MarginPanel, RefusesWhatIsTooSmallToRead) {
  const std::string message = message_of<UsageError>([] {
    Figure({{"digits", "3"}, {"show.panels", "certainty,velocity,time,unfolded"}});
  });
  EXPECT_EQ(message.find("show.panels: "), 0U) << message;
  EXPECT_TRUE(contains(message, "make the frame larger"));
}

class MarginShapes : public testing::TestWithParam<const char*> {};

TEST_P(MarginShapes, HoldThePanelWithoutOverlaps) {
  const Fonts fonts;
  for (const char* base : {"2", "7", "10", "16"}) {
    for (int digits = 1; digits <= 20; ++digits) {
      SCOPED_TRACE(std::string("base ") + base + ", digits " + std::to_string(digits));
      const Figure figure(
          {{"base", base}, {"digits", std::to_string(digits)}, {"view.size", GetParam()}});
      const Rect& bounds = figure.plates.front().bounds;
      const std::vector<Box> boxes = boxes_of(figure.texts, fonts);
      EXPECT_EQ(text_problem(boxes, bounds), "");
      for (const PathItem& path : figure.paths) EXPECT_TRUE(bounds.holds(path.points.bounds()));
      for (const Rect& band : figure.bands) {
        for (const Box& box : boxes) EXPECT_FALSE(overlap(box, band)) << box.what;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Aspects, MarginShapes,
                         testing::Values("1280x720", "3840x2160", "1080x1920", "1080x1080",
                                         "2560x1080", "1440x1080"));

}  // namespace
}  // namespace piblocks
