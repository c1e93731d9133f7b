// Which text is set letter by letter, and which is refused.
#include <gtest/gtest.h>
#include <piblocks/error.hpp>

#include <array>
#include <string>

#include "draw/font.hpp"
#include "support/contains.hpp"
#include "support/message_of.hpp"

namespace piblocks {
namespace {

/// Of titles.
constexpr std::array kTitleFaces{Face::article, Face::text};

std::string refusal_of(const std::string& text, Face face) {
  return testing_support::message_of<UsageError>([&] { Font(face).check(text, "show.title"); });
}

TEST(Shaping, TakesWhatIsSetLetterByLetter) {
  for (const char* text :
       {"Où se cache π ?", "Zwei Blöcke zählen", "Příliš žluťoučký kůň", "Δύο κύβοι και τοίχος",
        "Ἀρχιμήδης", "Два блока и стена", "√(m₁/m₂) ≤ 10⁻³ · ∑ ∫ ∞ ≈ ± → ∀ε", "Việt Nam",
        "İstanbul", "Երկու", "ორი", "…–—“”„‘’«»", "100 % 5\u202f000"}) {
    for (const Face face : kTitleFaces) EXPECT_EQ(refusal_of(text, face), "") << text;
  }
}

TEST(Shaping, RefusesWhatWouldBeDrawnWrong) {
  const auto expect = [](const char* text, const char* code, const char* reason) {
    for (const Face face : kTitleFaces) {
      const std::string refusal = refusal_of(text, face);
      EXPECT_TRUE(refusal.starts_with("show.title: ")) << refusal;
      EXPECT_TRUE(testing_support::contains(refusal, code));
      EXPECT_TRUE(testing_support::contains(refusal, reason));
      EXPECT_EQ(refusal.find('\n'), std::string::npos);
    }
  };
  constexpr const char* kScript = "is in a script that needs shaping";
  constexpr const char* kMark = "is a combining mark";
  constexpr const char* kControl = "is an instruction for shaping text";
  expect("שלום", "U+05E9", kScript);
  expect("π: مرحبا", "U+0645", kScript);
  expect("नमस्ते", "U+0928", kScript);
  expect("ﻼ", "U+FEFC", kScript);
  expect("ສະບາຍດີ", "U+0EAA", kScript);
  expect("ߒߞߏ", "U+07D2", kScript);
  expect("e\u0301", "U+0301", kMark);
  expect("x\u20D7", "U+20D7", kMark);
  expect("a\u200Db", "U+200D", kControl);
  expect("\u202Eabc", "U+202E", kControl);
  expect("a\u2066b\u2069", "U+2066", kControl);
  expect("co\u00ADop", "U+00AD", kControl);
  expect("\u2764\uFE0F", "U+FE0F", kControl);
  expect("\uFEFFtitle", "U+FEFF", kControl);
}

}  // namespace
}  // namespace piblocks
