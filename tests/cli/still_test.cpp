// still: one picture in each of its forms.
#include <chrono>

#include "cli/cli_fixture.hpp"

namespace piblocks {
namespace {

using StillTest = CliFixture;

constexpr const char* kPngSignature = "\x89PNG\r\n\x1a\n";

/// A big-endian number of four bytes, as in a PNG file.
unsigned big_endian(const std::string& bytes, std::size_t at) {
  unsigned value = 0;
  for (std::size_t i = at; i < at + 4; ++i) {
    value = value << 8 | static_cast<unsigned char>(bytes.at(i));
  }
  return value;
}

void expect_png(const std::string& bytes, unsigned width_px, unsigned height_px) {
  ASSERT_TRUE(bytes.starts_with(kPngSignature));
  EXPECT_EQ(big_endian(bytes, 16), width_px);
  EXPECT_EQ(big_endian(bytes, 20), height_px);
}

TEST_F(StillTest, PngHasTheSizeAskedFor) {
  EXPECT_EQ(output_of({"still", "--at", "3", "-o", "default.png"}), "");
  expect_png(contents("default.png"), 1920, 1080);
  output_of({"still", "--at", "3", "--size", "65x37", "-o", "odd.png"});
  expect_png(contents("odd.png"), 65, 37);
  output_of({"still", "--at", "3", "--size", "1x1", "-o", "small.png"});
  expect_png(contents("small.png"), 1, 1);
  output_of({"still", "--at", "3", "--size", "16384x2", "-o", "wide.png"});
  expect_png(contents("wide.png"), 16384, 2);
}

TEST_F(StillTest, StandardOutputGetsTheBytesOfTheFile) {
  const Arguments still{"still", "--at", "#100", "--size", "320x180", "-o"};
  output_of(still + Arguments{"still.png"});
  EXPECT_EQ(output_of(still + Arguments{"-"}), contents("still.png"));
}

TEST_F(StillTest, SvgAndPdfAreVectorPictures) {
  output_of({"still", "--at", "3", "--size", "320x180", "-o", "still.svg"});
  const std::string svg = contents("still.svg");
  EXPECT_NE(svg.find("<svg"), std::string::npos);
  EXPECT_NE(svg.find("viewBox=\"0 0 320 180\""), std::string::npos);
  output_of({"still", "--at", "3", "-o", "still.pdf"});
  EXPECT_TRUE(contents("still.pdf").starts_with("%PDF-"));
}

TEST_F(StillTest, InstantsNamedTwoWaysGiveOnePicture) {
  const auto picture = [&](const std::string& instant) {
    return output_of({"still", "--digits", "1", "--at", instant, "--size", "320x180", "-o", "-"});
  };
  EXPECT_EQ(picture("5"), picture("last"));
  EXPECT_EQ(picture("5"), picture("#3"));
  EXPECT_EQ(picture("3.5"), picture("7/2"));
  EXPECT_NE(picture("3.5"), picture("3"));
}

TEST_F(StillTest, ReplacesAFileAndKeepsItsNeighbours) {
  write("still.png", "old");
  write("other.txt", "x");
  output_of({"still", "--at", "-1", "--size", "32x18", "-o", "still.png"});
  expect_png(contents("still.png"), 32, 18);
  EXPECT_EQ(entries(), (std::vector<std::string>{"other.txt", "still.png"}));
}

/// A still of 20 digits is not 3e19 collisions away. The bound only tells seconds from years.
TEST_F(StillTest, TakesNoLongerForMoreDigits) {
  for (const char* digits : {"3", "9", "20"}) {
    const auto start = std::chrono::steady_clock::now();
    output_of({"still", "--digits", digits, "--at", "last", "-o", "still.png"});
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10)) << digits;
  }
}

}  // namespace
}  // namespace piblocks
