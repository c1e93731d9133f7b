// The digit margin and its diagram against MPFR: places of its marks, its words, scenes that it
// refuses, room.
#include "draw/panels/digit_margin.hpp"

#include <gtest/gtest.h>
#include <mpfr.h>
#include <piblocks/error.hpp>
#include <piblocks/script.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "draw/composition.hpp"
#include "draw/font.hpp"
#include "draw/look.hpp"

namespace piblocks {
namespace {

using Settings = std::vector<std::pair<const char*, std::string>>;

constexpr mpfr_prec_t kBits = 400;

/// A number of MPFR, rounded to nearest.
struct Float {
  Float() { mpfr_init2(value, kBits); }
  ~Float() { mpfr_clear(value); }
  Float(const Float&) = delete;
  Float& operator=(const Float&) = delete;
  mpfr_t value;
};

/// pi/s, pi/theta, and the least pi of one more collision over s, less the whole part of pi/s.
struct Expected {
  Expected(int base, int digits) {
    Float scale;
    Float theta;
    mpfr_ui_pow_ui(scale.value, static_cast<unsigned long>(base),
                   static_cast<unsigned long>(digits - 1), MPFR_RNDN);
    mpfr_ui_div(theta.value, 1, scale.value, MPFR_RNDN);
    mpfr_atan(theta.value, theta.value, MPFR_RNDN);
    Float pi;
    mpfr_const_pi(pi.value, MPFR_RNDN);
    mpfr_mul(fraction.value, pi.value, scale.value, MPFR_RNDN);
    mpfr_get_z(whole.get_mpz_t(), fraction.value, MPFR_RNDD);
    mpfr_div(rays.value, pi.value, theta.value, MPFR_RNDN);
    mpfr_sub(excess.value, rays.value, fraction.value, MPFR_RNDN);
    mpfr_sub_z(fraction.value, fraction.value, whole.get_mpz_t(), MPFR_RNDN);
    mpfr_sub_z(rays.value, rays.value, whole.get_mpz_t(), MPFR_RNDN);
    mpfr_mul_z(least.value, theta.value, Integer(whole + 1).get_mpz_t(), MPFR_RNDN);
    mpfr_mul(least.value, least.value, scale.value, MPFR_RNDN);
    mpfr_sub_z(least.value, least.value, whole.get_mpz_t(), MPFR_RNDN);
  }
  /// Digits after the point of a number from 0 to 1.
  static std::string digits_of(const Float& number, int base, std::size_t count) {
    Float rest;
    mpfr_set(rest.value, number.value, MPFR_RNDN);
    std::string digits;
    while (digits.size() < count) {
      mpfr_mul_si(rest.value, rest.value, base, MPFR_RNDN);
      const long digit = mpfr_get_si(rest.value, MPFR_RNDD);
      digits += Integer(digit).get_str(base);
      mpfr_sub_si(rest.value, rest.value, digit, MPFR_RNDN);
    }
    return digits;
  }

  Integer whole;
  Float fraction;
  Float rays;  ///< less the whole part
  Float excess;
  Float least;
};

double nearest(const Float& number) { return mpfr_get_d(number.value, MPFR_RNDN); }

TEST(DigitMargin, AgreesWithMpfr) {
  for (const int base : {2, 3, 7, 10, 16, 36}) {
    for (int digits = 1; digits <= 22; ++digits) {
      const DigitMargin found(base, static_cast<unsigned long>(digits - 1));
      const Expected expected(base, digits);
      EXPECT_EQ(found.whole(), expected.whole);
      const auto expect_near = [&](const Rational& value, double number) {
        EXPECT_NEAR(to_double(value), number, 1e-15 * std::abs(number)) << base << ' ' << digits;
      };
      expect_near(found.fraction(), nearest(expected.fraction));
      expect_near(found.excess(), nearest(expected.excess));
      EXPECT_EQ(found.is_wrong(), nearest(expected.rays) > 1) << base << ' ' << digits;
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

Scene scene_of(const Settings& settings) {
  ScriptBuilder builder;
  builder.set("test", "view.theme", "lecture");
  builder.set("test", "show.panels", "certainty");
  for (const auto& [key, text] : settings) builder.set("test", key, text);
  return builder.build_scene();
}

/// What the panel shows.
struct Figure {
  explicit Figure(const Settings& settings, const Rational& time = 0) {
    const Scene scene = scene_of(settings);
    const auto log = make_pair_log(scene.system);
    const DrawList list = Composition(scene, *log).frame({log->state_at(time), time});
    for (const DrawItem& item : list.items) {
      const auto* plate = std::get_if<PlateItem>(&item);
      if (plate == nullptr || plate->id < ItemId::panels) continue;
      bounds = plate->bounds;
      items = plate->plate->items;
      ++plates;
    }
    const Palette palette = palette_of(scene.view.theme);
    for (const DrawItem& item : items) {
      if (const auto* text = std::get_if<TextItem>(&item)) texts.push_back(*text);
      const auto* path = std::get_if<PathItem>(&item);
      if (path == nullptr) continue;
      paths.push_back(*path);
      const Rect& box = path->points.bounds();
      if (path->fill == palette.accent && path->points.view().size() == 4) bands.push_back(box);
      if (path->stroke && box.height == 0 && box.width > 0) lines.push_back(box);
    }
  }
  /// All that is written, from item to item.
  std::string words() const {
    std::string all;
    for (const TextItem& text : texts) all += text.text + ' ';
    return all;
  }
  bool says(const std::string& text) const { return words().find(text) != std::string::npos; }

  Rect bounds;
  std::size_t plates = 0;
  std::vector<DrawItem> items;
  std::vector<PathItem> paths;
  std::vector<TextItem> texts;
  std::vector<Rect> bands;  ///< from pi/s to pi/theta
  std::vector<Rect> lines;
};

class MarginBases : public testing::TestWithParam<int> {};

TEST_P(MarginBases, MarksAreWhereTheyBelong) {
  for (int digits = 1; digits <= 20; ++digits) {
    const Figure figure({{"base", std::to_string(GetParam())}, {"digits", std::to_string(digits)}});
    const Expected expected(GetParam(), digits);
    const double fraction = nearest(expected.fraction);
    const double excess = nearest(expected.excess);
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
    EXPECT_TRUE(three.says(text)) << text << " in " << three.words();
  }
  const Figure twenty(Settings{{"digits", "20"}});
  for (const char* text : {"…932,384", "…932,385", "18", "20", "626433…", "nines"}) {
    EXPECT_TRUE(twenty.says(text)) << text << " in " << twenty.words();
  }
  const Figure binary({{"digits", "5"}, {"base", "2"}});
  for (const char* text : {"110010 ", "110011 ", "11.0010 ", "111011…", "010000…", "ones"}) {
    EXPECT_TRUE(binary.says(text)) << text << " in " << binary.words();
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
  EXPECT_EQ(early.plates, 1U);
  EXPECT_TRUE(early.items == late.items);
}

TEST(MarginPanel, RefusesScenesThatDoNotCountPi) {
  for (const Settings& settings :
       {Settings{{"mass-ratio", "50"}}, Settings{{"mass-ratio", "10"}},
        Settings{{"mass-ratio", "1/100"}},
        Settings{{"digits", "3"}, {"base", "3"}, {"red.mass", "100"}},
        Settings{{"digits", "3"}, {"blue.velocity", "1"}},
        Settings{{"digits", "3"}, {"red.velocity", "1"}, {"time.to", "1"}},
        Settings{{"digits", "3"}, {"blue.position", "1/2"}}}) {
    try {
      const Figure figure(settings);
      ADD_FAILURE() << settings.front().second;
    } catch (const UsageError& error) {
      const std::string message = error.what();
      EXPECT_EQ(message.find("show.panels: the diagram 'certainty'"), 0U) << message;
      EXPECT_NE(message.find("leave it out"), std::string::npos) << message;
      EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    }
  }
}

TEST(MarginPanel, RefusesWhatIsTooSmallToRead) {
  try {
    const Figure figure({{"digits", "3"}, {"show.panels", "certainty,velocity,time,unfolded"}});
    ADD_FAILURE();
  } catch (const UsageError& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.find("show.panels: "), 0U) << message;
    EXPECT_NE(message.find("make the frame larger"), std::string::npos) << message;
  }
}

Rect box_of(const TextItem& text, const Fonts& fonts) {
  return {text.origin.x, text.origin.y - 0.74 * text.size_px,
          fonts.of(text.face).width_em(text.text) * text.size_px, 0.95 * text.size_px};
}

bool holds(const Rect& outer, const Rect& inner) {
  return inner.x >= outer.x && inner.right() <= outer.right() && inner.y >= outer.y &&
         inner.bottom() <= outer.bottom();
}

bool overlap(const Rect& a, const Rect& b) {
  constexpr double kTouch_px = 0.5;
  return a.x < b.right() - kTouch_px && b.x < a.right() - kTouch_px &&
         a.y < b.bottom() - kTouch_px && b.y < a.bottom() - kTouch_px;
}

class MarginShapes : public testing::TestWithParam<const char*> {};

TEST_P(MarginShapes, HoldThePanelWithoutOverlaps) {
  const Fonts fonts;
  for (const char* base : {"2", "7", "10", "16"}) {
    for (int digits = 1; digits <= 20; ++digits) {
      SCOPED_TRACE(std::string("base ") + base + ", digits " + std::to_string(digits));
      const Figure figure(
          {{"base", base}, {"digits", std::to_string(digits)}, {"view.size", GetParam()}});
      for (const PathItem& path : figure.paths) {
        EXPECT_TRUE(holds(figure.bounds, path.points.bounds()));
      }
      for (std::size_t i = 0; i < figure.texts.size(); ++i) {
        const Rect box = box_of(figure.texts[i], fonts);
        EXPECT_TRUE(holds(figure.bounds, box)) << figure.texts[i].text;
        for (const Rect& band : figure.bands) {
          EXPECT_FALSE(overlap(box, band)) << figure.texts[i].text;
        }
        for (std::size_t k = 0; k < i; ++k) {
          EXPECT_FALSE(overlap(box, box_of(figure.texts[k], fonts)))
              << figure.texts[i].text << " and " << figure.texts[k].text;
        }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Aspects, MarginShapes,
                         testing::Values("1280x720", "3840x2160", "1080x1920", "1080x1080",
                                         "2560x1080", "1440x1080"));

}  // namespace
}  // namespace piblocks
