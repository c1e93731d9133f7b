#include "core/text.hpp"

#include <gtest/gtest.h>

#include <random>
#include <string_view>

namespace piblocks {
namespace {

TEST(Printable, KeepsText) {
  for (const char* text : {"", "a.mp4", "π … 🙂", "C:\\x1b", "\"<&>'", "\xef\xbf\xbd"}) {
    EXPECT_EQ(printable(text), text);
  }
}

TEST(Printable, EscapesWhatATerminalObeys) {
  EXPECT_EQ(printable("\x1b[2J\a\r\n\t\x7f"), "\\x1b[2J\\x07\\x0d\\n\\t\\x7f");
  EXPECT_EQ(printable(std::string_view("a\0b", 3)), "a\\x00b");
  EXPECT_EQ(printable("\u009b31m \u0085"), "\\u{9b}31m \\u{85}");
  EXPECT_EQ(printable("\u202egpj.exe \u2066 \u2028"), "\\u{202e}gpj.exe \\u{2066} \\u{2028}");
}

TEST(WithShortWords, KeepsBothEndsOfALongWord) {
  const std::string long_path = "/a/" + std::string(295, 'b') + "'";
  EXPECT_EQ(with_short_words("cannot open '" + long_path), "cannot open '" + long_path);
  EXPECT_EQ(with_short_words("no " + std::string(1000, '9') + "x: what"),
            "no " + std::string(100, '9') + "[… 803 bytes …]" + std::string(97, '9') + "x: what");
  EXPECT_EQ(with_short_words(""), "");
  std::string pis;
  for (int i = 0; i < 300; ++i) pis += "\u03c0";
  for (const std::string& text :
       {pis, "x" + pis, std::string(5000, '\xff'), std::string(5000, '\x80'), pis + '\xcf'}) {
    EXPECT_LT(with_short_words(text).size(), 250U);
    EXPECT_TRUE(is_utf8(with_short_words(text)) || !is_utf8(text));
  }
}

TEST(Utf8, IsTold) {
  for (const char* text : {"", "a", "π … 🙂", "\xef\xbf\xbd"})
    EXPECT_TRUE(is_utf8(text)) << text;
  for (const char* text : {"a\xff"
                           "b",
                           "\xcf", "\xc0\x9b", "\xed\xa0\x80", "π\x80"}) {
    EXPECT_FALSE(is_utf8(text)) << printable(text);
  }
}

TEST(Utf8, HasAStepForEveryText) {
  EXPECT_EQ(step_bytes("aπ"), 1U);
  EXPECT_EQ(step_bytes("πa"), 2U);
  EXPECT_EQ(step_bytes("🙂"), 4U);
  for (const char* text : {"\xff",
                           "\xff"
                           "a",
                           "\xcf", "\x80π"})
    EXPECT_EQ(step_bytes(text), 1U);
}

TEST(Blanks, BetweenWordsAreSingle) {
  EXPECT_EQ(with_single_blanks("  a  bc π "), "a bc π");
  EXPECT_EQ(with_single_blanks("a bc"), "a bc");
  for (const char* blank : {"", " ", "    "}) EXPECT_EQ(with_single_blanks(blank), "");
}

TEST(Printable, EscapesBytesThatAreNoUtf8) {
  EXPECT_EQ(printable("\xff\x80"), "\\xff\\x80");
  EXPECT_EQ(printable("\xc0\x9b"), "\\xc0\\x9b") << "too long a form";
  EXPECT_EQ(printable("\xe0\x82\x9b"), "\\xe0\\x82\\x9b");
  EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80") << "surrogate";
  EXPECT_EQ(printable("\xf4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80") << "above U+10FFFF";
  EXPECT_EQ(printable("\xcf"), "\\xcf") << "cut off";
  EXPECT_EQ(printable("\xcfx"), "\\xcfx");
}

/// Whatever the bytes, what is printed has no control characters, and stays as it is.
TEST(Printable, IsSafeAndStableForRandomBytes) {
  std::mt19937 random(31415);
  for (int round = 0; round < 2000; ++round) {
    std::string bytes(random() % 12, ' ');
    for (char& c : bytes) c = static_cast<char>(random() % 256);
    const std::string text = printable(bytes);
    EXPECT_EQ(printable(text), text);
    for (std::size_t i = 0; i < text.size(); ++i) {
      const auto byte = static_cast<unsigned char>(text[i]);
      EXPECT_FALSE(byte < 0x20 || byte == 0x7f);
      const bool starts_c1 = byte == 0xc2 && static_cast<unsigned char>(text.at(i + 1)) < 0xa0;
      EXPECT_FALSE(starts_c1);
    }
  }
}

std::string base64_of(std::string_view text) {
  return base64({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

// RFC 4648, section 10.
TEST(Base64, HasTheTextsOfTheStandard) {
  EXPECT_EQ(base64_of(""), "");
  EXPECT_EQ(base64_of("f"), "Zg==");
  EXPECT_EQ(base64_of("fo"), "Zm8=");
  EXPECT_EQ(base64_of("foo"), "Zm9v");
  EXPECT_EQ(base64_of("foobar"), "Zm9vYmFy");
}

TEST(Base64, HasAllDigitsAndPiecesThatMakeTheWhole) {
  EXPECT_EQ(base64_of("\xfb\xef\xbe\xff\xff\xff"), "++++////");
  EXPECT_EQ(base64_of("pieces") + base64_of("of th"), base64_of("piecesof th"));
  EXPECT_NE(base64_of("piec") + base64_of("es"), base64_of("pieces"));
}

TEST(Text, JsonStringsEscapeWhatWouldEndThem) {
  EXPECT_EQ(json_text(""), R"("")");
  EXPECT_EQ(json_text("π \"a\" \\ b"), R"("π \"a\" \\ b")");
  EXPECT_EQ(json_text("a\nb\t\x01"), R"("a\nb\u0009\u0001")");
  EXPECT_EQ(json_text("</script>"), R"("\u003c/script>")");
}

TEST(Shortened, KeepsTheBeginningOfWhatWouldFillTheScreen) {
  EXPECT_EQ(shortened(""), "");
  const std::string sixty(60, 'x');
  EXPECT_EQ(shortened(sixty), sixty);
  EXPECT_EQ(shortened(sixty + "y"), std::string(40, 'x') + "… (61 bytes)");
  std::string greek;
  for (int i = 0; i < 100; ++i) greek += "π";
  EXPECT_EQ(shortened(greek), greek.substr(0, 80) + "… (200 bytes)");
  EXPECT_EQ(shortened(std::string(61, '\xff')).substr(40), "… (61 bytes)");
}

TEST(Text, IsRoundedDown) {
  for (const auto& [value, text] : {std::pair(2.0, "2"),
                                    {2.9657, "2.965"},
                                    {0.99999, "0.9999"},
                                    {13.1, "13.1"},
                                    {1000.9, "1000"},
                                    {123456.7, "123456"},
                                    {1e100, "1e+100"},
                                    {0.00012347, "0.0001234"},
                                    {9.9999e-7, "9.999e-07"}}) {
    EXPECT_EQ(rounded_down(value), text);
  }
}

}  // namespace
}  // namespace piblocks
