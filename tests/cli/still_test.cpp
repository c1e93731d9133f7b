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
  output_of({"still", "--at", "3", "--theme", "article", "--size", "1x1", "-o", "small.png"});
  expect_png(contents("small.png"), 1, 1);
  output_of({"still", "--at", "3", "--theme", "article", "--size", "16384x2", "-o", "wide.png"});
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
  EXPECT_TRUE(contains(svg, "<svg"));
  EXPECT_TRUE(contains(svg, "viewBox=\"0 0 320 180\""));
  output_of({"still", "--at", "3", "-o", "still.pdf"});
  EXPECT_TRUE(contents("still.pdf").starts_with("%PDF-"));
}

TEST_F(StillTest, VectorFilesAreSharpAndSaySo) {
  const auto picture = [&](const std::string& name, const Arguments& more) {
    const CommandResult result =
        piblocks(Arguments{"still", "--size", "320x180", "-o", name, "--at", "4"} + more);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return std::pair{contents(name), result.err};
  };
  for (const char* name : {"still.svg", "still.pdf"}) {
    for (const Arguments& scene : {Arguments{}, Arguments{"row"}, Arguments{"touch"}}) {
      const auto [sharp, silence] = picture(name, scene + Arguments{"--shutter", "0"});
      const auto [exposed, note] = picture(name, scene + Arguments{"--shutter", "1"});
      EXPECT_EQ(exposed, sharp) << name;
      EXPECT_EQ(silence, "");
      EXPECT_EQ(note,
                "piblocks: note: SVG, PDF and sheets have no motion blur: moving bodies are "
                "sharp, at the instant\n");
    }
  }
}

TEST_F(StillTest, ExposureDependsOnRateAndSpeed) {
  const auto picture = [&](const Arguments& more) {
    return output_of(
        Arguments{"still", "--at", "4", "--theme", "article", "--size", "320x180", "-o", "-"} +
        more);
  };
  const std::string half = picture({"--shutter", "0.5"});
  EXPECT_NE(half, picture({}));
  EXPECT_EQ(picture({"--shutter", "0"}), picture({}));
  EXPECT_EQ(half, picture({"--shutter", "1", "--fps", "120"}));
  EXPECT_EQ(half, picture({"--shutter", "1", "--speed", "1/2"}));
  EXPECT_NE(half, picture({"--shutter", "0.5", "--speed", "2"}));
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
  EXPECT_EQ(entries(), (Names{"other.txt", "still.png"}));
}

TEST_F(StillTest, SaysWhatAFrameHasNoRoomFor) {
  const auto expect = [&](const char* size, const Arguments& show, const std::string& message) {
    expect_refusal(
        Arguments{"still", "--at", "3", "--theme", "article", "-o", "a.png", "--size", size} + show,
        message);
  };
  expect("120x12", {"--show", "time"},
         "show: 'time' leaves too little room for the blocks in 120x12; leave");
  expect("16000x119", {"--title", "fi"},
         "show.title: 'fi' cannot be read in a frame of 16000x119; leave it out, or make the frame "
         "120 pixels high or more");
  expect("119x16000", {"--title", "fi"}, "make the frame 120 pixels wide or more");
  expect("64x36", {"--show", "masses,ruler"},
         "show.overlays: the mass '1 kg' does not fit on its block");
  expect("400x60", {"--panels", "time"}, "show.panels: a diagram does not fit into 400x60");
  expect("40x1000", {"--show", "ruler"}, "show.overlays: the ruler has no room");
}

TEST_F(StillTest, RefusesTextThatNeedsShaping) {
  const Arguments still{"still", "--at", "3", "-o", "a.png"};
  expect_refusal(still + Arguments{"--title", "שלום"},
                 "show.title: 'ש' (U+05E9) is in a script that needs shaping");
  expect_refusal(still + Arguments{"--caption", "e\u0301"},
                 "show.caption: U+0301 is a combining mark");
  output_of(still + Arguments{"--title", "Où se cache π ? Два блока, Δύο"});
}

/// Any still is a picture.
TEST_F(StillTest, LogosOfAnyShapeAreShownOrRefused) {
  const auto logo = [&](const std::string& size, const Arguments& more = {}) {
    output_of(
        Arguments{"still", "--at", "3", "--theme", "article", "--size", size, "-o", size + ".png"} +
        more);
    return Arguments{"still", "--at",  "3",      "--theme",    "article",
                     "-o",    "a.png", "--logo", size + ".png"};
  };
  const std::string plain =
      output_of({"still", "--at", "3", "--theme", "article", "--size", "640x360", "-o", "-"});
  for (const char* size : {"1x1", "3x2", "640x360", "4000x3000", "16x1", "1x16"}) {
    const Arguments still = logo(size);
    output_of(still + Arguments{"--size", "640x360"});
    EXPECT_NE(contents("a.png"), plain) << size;
  }
  output_of(logo("64x36", {"--transparent"}) + Arguments{"--size", "640x360", "--transparent"});
  std::filesystem::remove(folder_ / "a.png");
  expect_refusal(logo("1x4000") + Arguments{"--size", "640x360"},
                 "show.logo: a picture of 1x4000 would be 0.0x32.4 pixels here");
  expect_refusal(logo("640x360") + Arguments{"--size", "30x16"}, "show.logo: a picture of 640x360");
}

TEST_F(StillTest, AColourThatIsHardToSeeIsSaidAndDrawn) {
  const Arguments still{"still",   "--at", "3",     "--size",   "64x36",   "--background",
                        "#fdf6e3", "-o",   "a.png", "--accent", "#9a5300", "--blue-color"};
  EXPECT_EQ(piblocks(still + Arguments{"#268bd2"}).err, "");
  const CommandResult pale = piblocks(still + Arguments{"#fdf6e3"});
  EXPECT_EQ(pale.exit_code, 0);
  EXPECT_EQ(pale.err,
            "piblocks: note: blue.color = #fdf6e3: its contrast to the background #fdf6e3 is 1.0; "
            "a body needs 2\n");
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
