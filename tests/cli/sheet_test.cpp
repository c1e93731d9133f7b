// sheet: many pictures on one page.
#include <cstdlib>

#include "cli/cli_fixture.hpp"

namespace piblocks {
namespace {

using SheetTest = CliFixture;

TEST_F(SheetTest, WritesEveryKind) {
  for (const char* name : {"a.pdf", "a.svg", "a.png"}) {
    EXPECT_EQ(output_of({"sheet", "--digits", "2", "-o", name}), "");
    const std::string first = contents(name);
    output_of({"sheet", "--digits", "2", "-o", name});
    EXPECT_TRUE(contents(name) == first) << name << " differs the second time";
  }
  EXPECT_TRUE(contents("a.pdf").starts_with("%PDF-"));
  EXPECT_TRUE(contains(contents("a.svg"), "viewBox=\"0 0 842 595\""));
  EXPECT_TRUE(output_of({"sheet", "--digits", "2", "-o", "-"}) == contents("a.png"));
  EXPECT_EQ(entries(), (Names{"a.pdf", "a.png", "a.svg"}));
}

/// The text of the sheet with these options.
class SheetTextTest : public SheetTest {
 protected:
  void SetUp() override {
    if (std::system("command -v pdftotext > /dev/null") != 0) GTEST_SKIP() << "no pdftotext here";
  }
  std::string text_of(const Arguments& options) const {
    output_of(Arguments{"sheet", "--theme", "article", "-o", "a.pdf"} + options);
    // Spaces that are narrower than those between pictures get lost.
    std::string text;
    for (const char c : shell("pdftotext -layout a.pdf -")) {
      if (c == '=' && text.ends_with('t')) text += ' ';
      if (text.ends_with("t =") && c != ' ') text += ' ';
      text += c;
    }
    return text + " ";
  }
  void expect_captions(const Arguments& options, const Arguments& captions) const {
    const std::string text = text_of(options);
    for (const std::string& caption : captions) {
      EXPECT_EQ(count_of(text, caption + "\n") + count_of(text, caption + " "), 1u)
          << caption << " is not in " << text;
    }
    EXPECT_EQ(count_of(text, "t = "), captions.size()) << text;
    EXPECT_EQ(count_of(text, "Collisions:"), captions.size()) << "text stays text: " << text;
  }
};

TEST_F(SheetTextTest, HasTheTimeBelowEachPicture) {
  expect_captions({"--at", "0,#1,3.5,last,20"},
                  {"t = 0", "t = 2", "t = 3.5", "t = 12.3375", "t = 20"});
  EXPECT_EQ(count_of(text_of({}), "t = "), 12u);
  expect_captions({"--frames", "1"}, {"t = 0"});
}

TEST_F(SheetTextTest, SpacesPicturesByTime) {
  write("fast.toml", "time = { to = 3, speed = 10 }\nview.fps = 1\n");
  write("slow.toml", "time.speed = '1/100000'\n");
  const Arguments thirds = {"t = 0", "t = 1", "t = 2", "t = 3"};
  expect_captions({"--frames", "4", "--to", "3"}, thirds);
  // The spread has nothing to do with the frames of a video.
  expect_captions({"--frames", "4", "fast.toml"}, thirds);
  EXPECT_EQ(count_of(text_of({"--frames", "4", "slow.toml"}), "t = "), 4u);
  expect_captions({"--frames", "4", "--to", "6", "--by", "time"},
                  {"t = 0", "t = 2", "t = 4", "t = 6"});
}

TEST_F(SheetTextTest, SpacesPicturesByCountAroundTheTurn) {
  const Arguments counts = {"article", "--digits", "2", "--frames", "4"};
  const std::string text = text_of(counts);
  for (const char* count : {"Collisions:0", "Collisions:10", "Collisions:21", "Collisions:31"}) {
    EXPECT_EQ(count_of(text, count), 1u) << count << " is not in " << text;
  }
  EXPECT_EQ(text_of(counts + Arguments{"--by", "count"}), text);
  EXPECT_NE(text_of(counts + Arguments{"--by", "time"}), text);
  // Each collision once, and what was before them.
  const std::string all = text_of({"article", "--digits", "2", "--frames", "32"});
  for (int count = 0; count <= 31; ++count) {
    const std::string shown = "Collisions:" + std::to_string(count);
    EXPECT_EQ(count_of(all, shown + " ") + count_of(all, shown + "\n"), 1u) << all;
  }
}

TEST_F(SheetTextTest, TellsInstantsApart) {
  const std::string text = text_of({"--digits", "6", "--at", "#157000,#157001,1000000"});
  EXPECT_EQ(count_of(text, "t = turn − "), 2u) << text;
  EXPECT_EQ(count_of(text, "t = 1,000,000"), 1u) << text;
  const std::size_t first = text.find("t = turn");
  const std::size_t second = text.find("t = turn", first + 1);
  EXPECT_NE(text.substr(first, text.find("  ", first) - first),
            text.substr(second, text.find("  ", second) - second));
}

TEST_F(SheetTextTest, TimesAreExactAndNeverLong) {
  expect_captions({"--at=-1e300,1e-50,0.333333333,1/3,123456789012345678.25"},
                  {"t = −1×10³⁰⁰", "t = 1×10⁻⁵⁰", "t = 0.333333333", "t = 0.3333333333",
                   "t = 123,456,789,012,345,678"});
}

TEST_F(SheetTest, TakesTheLargestNumberThereIs) {
  EXPECT_EQ(output_of({"sheet", "--frames", "200", "-o", "a.pdf"}), "");
}

}  // namespace
}  // namespace piblocks
