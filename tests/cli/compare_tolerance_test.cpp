// compare: masks of some pictures and as pictures, shares, what looks alike; values that are wrong.
#include <algorithm>

#include "cli/compare_fixture.hpp"

namespace piblocks {
namespace {
namespace fs = std::filesystem;
using testing_support::file_of;
using testing_support::HandMadePng;
using testing_support::PngColour;

class CompareToleranceTest : public CompareFixture {
 protected:
  int code(const Arguments& arguments) const {
    const CommandResult result = compare(arguments);
    if (result.exit_code == 2) ADD_FAILURE() << result.err;
    return result.exit_code;
  }
  /// What is wrong with these options.
  void expect_wrong(const Arguments& sides, const Arguments& options,
                    const std::string& message) const {
    expect_refusal(Arguments{"compare"} + sides + options, message);
  }
  /// A pixel differs in each of three pictures, at the same place.
  void write_folders() const {
    for (const char* name : {"1.png", "2.png", "sub/1.png"}) {
      write_grey(std::string("a/") + name, 100);
      write_grey(std::string("b/") + name, 100, {{4, 6, 200}});
    }
  }
  /// The names of pictures that differ outside of these masks.
  Names left(const Arguments& masks) const {
    Arguments options = {"a", "b"};
    for (const std::string& mask : masks) options = options + Arguments{"--mask", mask};
    const CommandResult result = compare(options);
    EXPECT_EQ(result.err, "");
    Names names;
    for (const std::string& line : lines(result.out)) {
      const std::size_t end = line.find(": 1 pixel differs");
      if (end != std::string::npos) names.push_back(line.substr(0, end));
    }
    EXPECT_EQ(result.exit_code, names.empty() ? 0 : 1);
    return names;
  }
  /// A mask that leaves out these pixels.
  void write_mask(const std::string& name, const std::vector<Spot>& spots,
                  int width_px = 10) const {
    write_grey(name, 0, spots, width_px);
  }
};

TEST_F(CompareToleranceTest, AMaskIsOfThePicturesThatItNames) {
  write_folders();
  EXPECT_EQ(left({}), (Names{"1.png", "2.png", "sub/1.png"}));
  EXPECT_EQ(left({"1x1+4+6"}), Names{});
  EXPECT_EQ(left({"1.png:1x1+4+6"}), (Names{"2.png", "sub/1.png"}));
  EXPECT_EQ(left({"sub/1.png:1x1+4+6"}), (Names{"1.png", "2.png"}));
  EXPECT_EQ(left({"?.png:1x1+4+6"}), Names{"sub/1.png"});
  EXPECT_EQ(left({"[2-9].png:1x1+4+6"}), (Names{"1.png", "sub/1.png"}));
  EXPECT_EQ(left({"sub/*:1x1+4+6"}), (Names{"1.png", "2.png"}));
  EXPECT_EQ(left({"*1.png:1x1+4+6"}), Names{"2.png"}) << "also in folders";
  EXPECT_EQ(left({"*:1x1+4+6"}), Names{});
  EXPECT_EQ(left({"1.png:1x1+4+6", "2.png:1x1+4+6"}), Names{"sub/1.png"});
  EXPECT_EQ(left({"1.png:1x1+4+6", "2.png:1x1+0+0"}), (Names{"2.png", "sub/1.png"}));
}

TEST_F(CompareToleranceTest, TheLastColonEndsTheName) {
  write_grey("a/x:1.png", 100);
  write_grey("b/x:1.png", 100, {{4, 6, 200}});
  EXPECT_EQ(left({"x:1.png:1x1+4+6"}), Names{});
}

TEST_F(CompareToleranceTest, OfTwoFilesBothHaveTheirNames) {
  write_folders();
  for (const std::string name : {"1.png", "2.png", "?.png"}) {
    EXPECT_EQ(code({"a/1.png", "b/2.png", "--mask", name + ":1x1+4+6"}), 0) << name;
  }
  expect_wrong({"a/1.png", "b/2.png"}, {"--mask", "3.png:1x1+4+6"},
               "the mask 3.png:1x1+4+6 hides nothing");
}

TEST_F(CompareToleranceTest, AMaskThatCoversAllOfAPictureIsRefusedWhereItIsOfThatPicture) {
  write_folders();
  write_grey("a/wide.png", 100, {}, 20);
  write_grey("b/wide.png", 100, {}, 20);
  EXPECT_EQ(left({"wide.png:10x10+0+0"}), (Names{"1.png", "2.png", "sub/1.png"}));
  expect_wrong({"a", "b"}, {"--mask", "10x10+0+0"},
               "the masks leave nothing of a picture of 10x10");
  expect_wrong({"a", "b"}, {"--mask", "1.png:5x10+0+0", "--mask", "*.png:5x10+5+0"},
               "the masks leave nothing");
}

TEST_F(CompareToleranceTest, AMaskMayBeAPicture) {
  write_folders();
  write_mask("mask.png", {{4, 6, 255}});
  EXPECT_EQ(left({"mask.png"}), Names{});
  write_mask("mask.png", {{4, 6, 1}});
  EXPECT_EQ(left({"mask.png"}), Names{}) << "whatever is not black";
  EXPECT_EQ(left({"1.png:mask.png"}), (Names{"2.png", "sub/1.png"}));
  write_mask("mask.png", {{4, 5, 255}, {3, 6, 255}, {5, 6, 255}, {4, 7, 255}});
  EXPECT_EQ(left({"mask.png"}), (Names{"1.png", "2.png", "sub/1.png"})) << "all around it";
  const CommandResult result = compare({"a/1.png", "b/1.png", "--mask", "mask.png", "--json", "j"});
  EXPECT_TRUE(contains(contents("j"), R"("masks":[[4,5,1,1],[3,6,1,1],[5,6,1,1],[4,7,1,1]])"));
}

TEST_F(CompareToleranceTest, ATransparentMaskHidesNothingThere) {
  write_folders();
  HandMadePng mask{.width_px = 10, .height_px = 10, .colour = PngColour::rgba};
  const auto write_with_alpha = [&](int alpha) {
    mask.levels.clear();
    for (int i = 0; i < 100; ++i) {
      const bool is_spot = i == 64 || i == 0;  // (4, 6) and a corner
      const int shown = i == 0 ? 255 : alpha;
      for (const int level : {255, 255, 255, is_spot ? shown : 0}) mask.levels.push_back(level);
    }
    write("mask.png", file_of(mask));
  };
  write_with_alpha(0);
  EXPECT_EQ(left({"mask.png"}).size(), 3U);
  write_with_alpha(1);
  EXPECT_EQ(left({"mask.png"}).size(), 0U);
}

TEST_F(CompareToleranceTest, MasksThatMakeNoSenseAreRefused) {
  write_folders();
  write_mask("black.png", {});
  write_mask("wide.png", {{0, 0, 255}}, 11);
  write_grey("white.png", 255);
  write("junk.png", "no picture");
  const Arguments sides = {"a", "b"};
  const std::string form = "must be WxH+X+Y";
  for (const char* text : {"", "10x10", "1x1+0", "x1+0+0", "1x1+0+0+0", "1x1-1-1", "0x1+0+0",
                           "1x0+0+0", "1.5x1+0+0", "1x1+0+-1", "99999x1+0+0", "1.png:10x10",
                           "1.png:", "mask.jpg", "mask.PNG", "1x1+0+0:1.png:2"}) {
    expect_wrong(sides, {std::string("--mask=") + text}, "--mask");
  }
  expect_wrong(sides, {"--mask", "10x10"}, form);
  expect_wrong(sides, {"--mask", ":1x1+0+0"}, "there is no name in front of the colon");
  expect_wrong(sides, {"--mask", "none.png"}, "'none.png'");
  expect_wrong(sides, {"--mask", "junk.png"}, "'junk.png'");
  expect_wrong(sides, {"--mask", "black.png"}, "all of it is black or transparent");
  expect_wrong(sides, {"--mask", "white.png"}, "the masks leave nothing of a picture of 10x10");
  expect_wrong(sides, {"--mask", "wide.png"}, "the mask wide.png is 11x10, and '1.png' is 10x10");
  expect_wrong(sides, {"--mask", "1x1+10+0"}, "lies outside of every picture that is compared");
  expect_wrong(sides, {"--mask", "1.png:1x1+10+0"}, "the mask 1.png:1x1+10+0 hides nothing");
  expect_wrong(sides, {"--mask", "3.png:1x1+0+0"}, "the mask 3.png:1x1+0+0 hides nothing");
  expect_wrong(sides, {"--mask", "1x1+0+0", "--mask", "3.png:1x1+0+0"}, "3.png:1x1+0+0");
}

TEST_F(CompareToleranceTest, AShareOfThePixelsMayBeOff) {
  write_grey("a.png", 100, {}, 100);  // of 1000 pixels
  const auto expect_code = [&](const std::string& share, int expected) {
    EXPECT_EQ(code({"a.png", "b.png", "--max-pixels", share}), expected) << share;
  };
  write_grey("b.png", 100, {{5, 5, 101}}, 100);
  for (const char* share : {"0.1%", "1/10%", "1e-1%", "0.1000001%", "100%", "1"}) {
    expect_code(share, 0);
  }
  for (const char* share : {"0.0999999%", "0%", "0"}) expect_code(share, 1);
  write_grey("b.png", 100, {{5, 5, 101}, {99, 9, 0}}, 100);
  for (const char* share : {"0.2%", "2"}) expect_code(share, 0);
  for (const char* share : {"0.1%", "0.1999%", "1"}) expect_code(share, 1);
  EXPECT_EQ(code({"a.png", "b.png", "--max-pixels", "0.1%", "--max-delta", "1"}), 0);
}

/// The share is of each picture, not of all together.
TEST_F(CompareToleranceTest, AShareIsOfEachPicture) {
  write_folders();
  write_grey("a/large.png", 100, {}, 1000);
  write_grey("b/large.png", 100, {}, 1000);
  EXPECT_EQ(code({"a", "b", "--max-pixels", "1%"}), 0);
  EXPECT_EQ(code({"a", "b", "--max-pixels", "0.9%"}), 1);
}

TEST_F(CompareToleranceTest, WhatLooksAlikeIsAccepted) {
  write_grey("a.png", 100);
  write_grey("b.png", 120);
  const auto accepts = [&](const std::string& threshold) {
    return code({"a.png", "b.png", "--threshold", threshold}) == 0;
  };
  // The root of 0.5053 · 20² / 35215.
  EXPECT_TRUE(accepts("0.0758"));
  EXPECT_FALSE(accepts("0.0757"));
  EXPECT_TRUE(accepts("1"));
  EXPECT_FALSE(accepts("0"));
  EXPECT_TRUE(contains(compare({"a.png", "b.png", "--threshold", "0"}).out, "100 pixels differ"));
}

TEST_F(CompareToleranceTest, SmoothedEdgesAreAcceptedUnlessTheyAreCounted) {
  std::vector<Spot> edge;
  for (int i = 0; i < 50; ++i) edge.push_back({5 + i % 5, i / 5, 255});
  write_grey("a.png", 0, edge);
  edge.push_back({4, 4, 128});
  write_grey("b.png", 0, edge);
  EXPECT_EQ(code({"a.png", "b.png", "--threshold", "0.1"}), 0);
  EXPECT_EQ(code({"a.png", "b.png", "--threshold", "0.1", "--count-antialiasing"}), 1);
  EXPECT_EQ(code({"a.png", "b.png", "--threshold", "0.1", "--hard-delta", "127"}), 1);
  EXPECT_EQ(
      code({"a.png", "b.png", "--threshold", "0.1", "--count-antialiasing", "--max-pixels", "1%"}),
      0);
}

TEST_F(CompareToleranceTest, ColoursOfTransparentPixelsCountUnlessTheyAreIgnored) {
  HandMadePng png{.width_px = 2, .height_px = 1, .colour = PngColour::rgba};
  const auto write_levels = [&](const std::string& name, const std::vector<int>& levels) {
    png.levels = levels;
    write(name, file_of(png));
  };
  write_levels("a.png", {1, 2, 3, 0, 9, 9, 9, 255});
  write_levels("b.png", {4, 5, 6, 0, 9, 9, 9, 255});
  EXPECT_EQ(code({"a.png", "b.png"}), 1);
  const CommandResult ignored = compare({"a.png", "b.png", "--ignore-transparent"});
  EXPECT_EQ(ignored.exit_code, 0);
  EXPECT_TRUE(ignored.out.starts_with("equal: ")) << ignored.out;
  EXPECT_EQ(code({"a.png", "b.png", "--threshold", "0"}), 0) << "both are white on white";
  write_levels("b.png", {1, 2, 3, 1, 9, 9, 9, 255});
  EXPECT_EQ(code({"a.png", "b.png", "--ignore-transparent"}), 1);
}

/// Their colours are compared, whatever the video keeps of them.
TEST_F(CompareToleranceTest, VideosLookAlikeAsPictures) {
  const auto write_video = [&](const std::string& name, char luma, char first_chroma) {
    const std::string chroma(32, char(128));
    write(name, "YUV4MPEG2 W8 H8 F5:1 C420\nFRAME\n" + std::string(64, luma) + first_chroma +
                    chroma.substr(1));
  };
  write_video("a.y4m", 100, char(128));
  write_video("b.y4m", 101, char(128));
  EXPECT_EQ(code({"a.y4m", "b.y4m"}), 1);
  EXPECT_EQ(code({"a.y4m", "b.y4m", "--threshold", "0.01"}), 0);
  const CommandResult seen = compare({"a.y4m", "b.y4m", "--threshold", "0"});
  EXPECT_EQ(seen.exit_code, 1);
  EXPECT_TRUE(contains(seen.out, "first at x=0 y=0 (red)"));
  write_video("c.y4m", 100, char(190));
  EXPECT_EQ(code({"a.y4m", "c.y4m", "--threshold", "0.1", "--count-antialiasing"}), 1);
  EXPECT_EQ(code({"a.y4m", "a.y4m", "--threshold", "0"}), 0);
}

TEST_F(CompareToleranceTest, ReportsSayWhatIsAccepted) {
  write_folders();
  const auto text = [&](const Arguments& options) {
    compare(Arguments{"a", "b", "--json", "j"} + options);
    const std::string json = contents("j");
    const std::string key = "\"tolerance\":\"";
    const std::size_t begin = json.find(key) + key.size();
    return json.substr(begin, json.find('"', begin) - begin);
  };
  EXPECT_EQ(text({}), "Every sample must be equal.");
  EXPECT_EQ(text({"--threshold", "0.1", "--max-pixels", "0.5%"}),
            "Pixels must look alike, by a threshold of 0.1, or be those of smoothed edges, except "
            "in up to 0.5% of the pixels.");
  EXPECT_EQ(text({"--threshold", "0", "--count-antialiasing", "--ignore-transparent"}),
            "Pixels must look alike, by a threshold of 0. Transparent pixels are equal.");
  EXPECT_EQ(text({"--max-delta", "3", "--mask", "1.png:1x1+0+0", "--mask", "2x2+0+0"}),
            "Samples may differ by up to 3 of 255. Masked: 1.png:1x1+0+0, 2x2+0+0.");
}

TEST_F(CompareToleranceTest, ValuesThatMakeNoSenseAreRefused) {
  write_grey("a.png", 100);
  const Arguments sides = {"a.png", "a.png"};
  for (const char* text : {"-0.1", "1.1", "x", "", "nan", "inf", "0.1%", "1/0"}) {
    expect_wrong(sides, {std::string("--threshold=") + text}, "--threshold");
  }
  for (const char* text : {"101%", "-1%", "%", "x%", "1%%", "%1", "1.5", "-1", "", "1e9%"}) {
    expect_wrong(sides, {std::string("--max-pixels=") + text}, "--max-pixels");
  }
  for (const char* text : {"-1", "256", "", "1%", "x"}) {
    expect_wrong(sides, {std::string("--max-delta=") + text}, "--max-delta");
    expect_wrong(sides, {std::string("--hard-delta=") + text}, "--hard-delta");
  }
  expect_wrong(sides, {"--threshold", "0.1", "--max-delta", "0"},
               "--threshold and --max-delta: use one of them");
  expect_wrong(sides, {"--count-antialiasing"}, "--count-antialiasing belongs to --threshold");
  expect_wrong(sides, {"--count-antialiasing", "--max-delta", "3"}, "belongs to --threshold");
}

}  // namespace
}  // namespace piblocks
