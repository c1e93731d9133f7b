// Lines of text and mathematics: where their parts are, and that no ink leaves its extent.
#include "draw/formula.hpp"

#include <gtest/gtest.h>
#include <piblocks/error.hpp>

#include <string>
#include <vector>

#include "draw/extent.hpp"
#include "draw/found_items.hpp"

namespace piblocks {
namespace {

constexpr double kSize_px = 100;
constexpr double kRounding_em = 1e-9;

class Formulas : public testing::Test {
 protected:
  double width_em(Face face, const std::string& text) const {
    return fonts_.of(face).width_em(text);
  }
  static std::vector<DrawItem> items_in(const Formula& formula) {
    std::vector<DrawItem> items;
    formula.add_to(items, ItemId::title, {0, 0}, kSize_px, Color{});
    return items;
  }
  static std::vector<TextItem> texts_of(const Formula& formula) {
    return items_of<TextItem>(items_in(formula), ItemId::title);
  }
  static Rect root_sign_of(const Formula& formula) {
    return items_of<PathItem>(items_in(formula), ItemId::title).at(0).points.bounds();
  }

  Fonts fonts_;
  FormulaSetter set_{fonts_, Face::text};
};

TEST_F(Formulas, AreAsWideAsTheirParts) {
  EXPECT_NEAR(set_.text("mirrors").width_em(), width_em(Face::text, "mirrors"), kRounding_em);
  EXPECT_NEAR(set_.digits("31").width_em(), width_em(Face::digits, "31"), kRounding_em);
  const Formula sum = set_.text("2") + set_.italic("θ");
  EXPECT_NEAR(sum.width_em(), set_.text("2").width_em() + set_.italic("θ").width_em(),
              kRounding_em);
  const std::vector<TextItem> texts = texts_of(sum);
  ASSERT_EQ(texts.size(), 2U);
  EXPECT_EQ(texts[0].origin.x, 0);
  EXPECT_NEAR(texts[1].origin.x, kSize_px * set_.text("2").width_em(), 1e-6);
  EXPECT_EQ(texts[1].origin.y, texts[0].origin.y);
  EXPECT_EQ(Formula().width_em(), 0);
}

/// Whatever the bytes, measuring ends.
TEST_F(Formulas, RefuseWhatIsNotUtf8) {
  const std::string wrong =
      "a\xff"
      "b";
  for (const Face face : {Face::article, Face::text, Face::math}) {
    EXPECT_THROW(Font(face).width_em(wrong), DrawError);
    EXPECT_THROW(TextWidths(Font(face), wrong), DrawError);
  }
  EXPECT_THROW(set_.text(wrong), DrawError);
  const Fonts fonts;
  EXPECT_THROW(FormulaSetter(fonts, Face::text).italic(wrong), DrawError);
  EXPECT_GT(TextWidths(fonts.of(Face::digits), "ab").width_em(wrong), 0);
}

TEST_F(Formulas, HaveRisingIds) {
  const Formula formula = set_.root(set_.lowered(set_.italic("m"), set_.text("1"))) +
                          set_.text(" v² and 10⁻³") + set_.italic("v");
  const std::vector<DrawItem> items = items_in(formula);
  EXPECT_GT(items.size(), 4U);
  for (std::size_t n = 0; n < items.size(); ++n) {
    EXPECT_EQ(id_of(items[n]), nth(ItemId::title, n));
  }
}

TEST_F(Formulas, RaiseAndLowerSmallerParts) {
  const Formula base = set_.text("10");
  const Formula script = set_.text("7");
  for (const auto& [formula, up_em] :
       {std::pair{set_.raised(base, script), 0.4}, {set_.lowered(base, script), -0.18}}) {
    const std::vector<TextItem> texts = texts_of(formula);
    ASSERT_EQ(texts.size(), 2U);
    EXPECT_EQ(texts[0].size_px, kSize_px);
    EXPECT_NEAR(texts[1].size_px, 0.65 * kSize_px, 1e-6);
    EXPECT_NEAR(texts[1].origin.y, -up_em * kSize_px, 1e-6);
    EXPECT_NEAR(texts[1].origin.x, base.width_em() * kSize_px, 1e-6);
    EXPECT_GE(formula.width_em(), base.width_em() + 0.65 * script.width_em());
    EXPECT_LT(formula.width_em(), base.width_em() + 0.65 * script.width_em() + 0.1);
  }
}

TEST_F(Formulas, SetScriptsOfUnicodeAsRealOnes) {
  const std::vector<TextItem> texts = texts_of(set_.text("2×10⁻¹², m₁v₂²"));
  std::vector<std::string> shown;
  for (const TextItem& text : texts) shown.push_back(text.text);
  EXPECT_EQ(shown, (std::vector<std::string>{"2×10", "−12", ", m", "1", "v", "2", "2"}));
  for (const TextItem& text : texts) {
    EXPECT_EQ(text.size_px < kSize_px, text.origin.y != 0) << text.text;
  }
  EXPECT_LT(texts[1].origin.y, 0) << "raised";
  EXPECT_GT(texts[3].origin.y, 0) << "lowered";
}

TEST_F(Formulas, RootsHaveABarOverTheirContent) {
  const Formula square = set_.raised(set_.italic("x"), set_.text("2"));
  const Formula ratio = set_.lowered(set_.italic("m"), set_.text("1")) + set_.text("/M");
  for (const Formula& content : {set_.italic("m"), set_.italic("M"), square, ratio}) {
    const Formula root = set_.root(content);
    const Rect sign = root_sign_of(root);
    EXPECT_GE(sign.x, 0);
    EXPECT_LE(sign.right(), kSize_px * root.width_em() + 1e-6);
    for (const TextItem& text : texts_of(root)) {
      const double right = text.origin.x + width_em(text.face, text.text) * text.size_px;
      EXPECT_LE(right, sign.right()) << text.text;
      const double height_em = text.text == "2" || text.text == "/M" ? 0.7 : 0.44;
      EXPECT_LT(sign.y, text.origin.y - height_em * text.size_px) << text.text;
    }
    EXPECT_GT(root.width_em(), content.width_em());
  }
  EXPECT_LT(root_sign_of(set_.root(square)).y, root_sign_of(set_.root(set_.italic("x"))).y)
      << "higher over what is raised";
}

TEST_F(Formulas, SetLettersInItalicsAndTheRestUpright) {
  for (const char* letter : {"m", "M", "h", "θ", "π"}) {
    const std::vector<TextItem> texts = texts_of(set_.italic(letter));
    ASSERT_EQ(texts.size(), 1U);
    EXPECT_EQ(texts[0].face, Face::math);
    EXPECT_NE(texts[0].text, letter);
  }
  for (const char* other : {"1", "=", "Ж"}) {
    const std::vector<TextItem> texts = texts_of(set_.italic(other));
    ASSERT_EQ(texts.size(), 1U);
    EXPECT_EQ(texts[0].face, Face::text);
    EXPECT_EQ(texts[0].text, other);
  }
}

TEST_F(Formulas, LackingCharactersAreOfTheArticlesFont) {
  const Font& lato = fonts_.of(Face::text);
  const std::string line = "a∀ორb";
  const auto runs = lato.runs(line);
  ASSERT_EQ(runs.size(), 3U);
  EXPECT_EQ(runs[0].text, "a");
  EXPECT_EQ(runs[0].font, &lato);
  EXPECT_EQ(runs[1].text, "∀ორ");
  EXPECT_EQ(runs[1].font->face(), Face::article);
  EXPECT_EQ(runs[2].text, "b");
  EXPECT_NEAR(
      lato.width_em(line),
      width_em(Face::text, "a") + width_em(Face::article, "∀ორ") + width_em(Face::text, "b"), 1e-3);
}

TEST_F(Formulas, DigitsAreEquallyWide) {
  for (const Face face : {Face::article, Face::text, Face::digits}) {
    for (char digit = '1'; digit <= '9'; ++digit) {
      EXPECT_EQ(width_em(face, {digit}), width_em(face, "0")) << digit;
    }
  }
}

// ---- ink

/// The pixels that are not white.
Rect ink_of(const TextItem& text, int side_px) {
  const auto words = painted({side_px, side_px, Color{255, 255, 255}, {text}});
  Rect ink;
  for (int i = 0; i < side_px * side_px; ++i) {
    if ((words[std::size_t(i)] & 0xFFFFFF) == 0xFFFFFF) continue;
    const Rect here{double(i % side_px), double(i / side_px), 1, 1};
    ink = ink.width == 0 ? here : ink | here;
  }
  return ink;
}

std::string utf8_of(char32_t code) {
  const auto byte = [](char32_t value) { return static_cast<char>(value); };
  if (code < 0x80) return {byte(code)};
  if (code < 0x800) return {byte(0xC0 | code >> 6), byte(0x80 | (code & 0x3F))};
  const std::string tail{byte(0x80 | ((code >> 6) & 0x3F)), byte(0x80 | (code & 0x3F))};
  if (code < 0x10000) return byte(0xE0 | code >> 12) + tail;
  return std::string{byte(0xF0 | code >> 18), byte(0x80 | ((code >> 12) & 0x3F))} + tail;
}

struct Codes {
  char32_t first;
  char32_t last;
};

/// Of those that fit: those in no font are left out.
std::vector<std::string> characters_of(const Font& font, std::initializer_list<Codes> blocks) {
  std::vector<std::string> characters;
  for (const auto& [first, last] : blocks) {
    for (char32_t code = first; code <= last; ++code) {
      const std::string character = utf8_of(code);
      try {
        font.check(character, "test");
        characters.push_back(character);
      } catch (const std::exception&) {
        continue;
      }
    }
  }
  return characters;
}

void expect_ink_in_extent(const Fonts& fonts, Face face, const std::string& character) {
  constexpr int kSide_px = 150;
  const TextItem text{ItemId::title, {50, 90}, character, 50, {}, face};
  const Rect ink = ink_of(text, kSide_px);
  const Rect extent = extent_of(text, 0, fonts.of(face).width_em(character));
  EXPECT_TRUE(ink.width == 0 || extent.whole_pixels().holds(ink))
      << character << " of face " << int(face) << ": from " << (ink.x - 50) / 50 << ", "
      << (90 - ink.y) / 50 << " to " << (ink.right() - 50) / 50 << ", " << (90 - ink.bottom()) / 50;
}

TEST_F(Formulas, InkOfTextIsInItsExtent) {
  for (const Face face : {Face::article, Face::text, Face::digits}) {
    const auto characters = characters_of(fonts_.of(face), {{0x20, 0x24F},
                                                            {0x370, 0x45F},
                                                            {0x1E00, 0x1EFF},
                                                            {0x2010, 0x2044},
                                                            {0x2070, 0x209C},
                                                            {0x2190, 0x21FF},
                                                            {0x2200, 0x22FF},
                                                            {0x2308, 0x230B}});
    EXPECT_GT(characters.size(), 800U);
    for (const std::string& character : characters) expect_ink_in_extent(fonts_, face, character);
  }
}

/// The letters of formulas. Root signs are drawn as paths: the font's own hangs far below the line.
TEST_F(Formulas, InkOfMathematicsIsInItsExtent) {
  const auto letters =
      characters_of(fonts_.of(Face::math), {{0x1D468, 0x1D49B}, {0x1D736, 0x1D74E}});
  EXPECT_EQ(letters.size(), 77U);
  for (const std::string& letter : letters) expect_ink_in_extent(fonts_, Face::math, letter);
}

}  // namespace
}  // namespace piblocks
