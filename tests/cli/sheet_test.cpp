// sheet: many pictures on one page.
#include <cstdlib>

#include "cli/cli_fixture.hpp"

namespace piblocks {
namespace {

using SheetTest = CliFixture;

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++count;
  }
  return count;
}

TEST_F(SheetTest, WritesEveryKind) {
  for (const char* name : {"a.pdf", "a.svg", "a.png"}) {
    EXPECT_EQ(output_of({"sheet", "--digits", "2", "-o", name}), "");
    const std::string first = contents(name);
    output_of({"sheet", "--digits", "2", "-o", name});
    EXPECT_TRUE(contents(name) == first) << name << " differs the second time";
  }
  EXPECT_TRUE(contents("a.pdf").starts_with("%PDF-"));
  EXPECT_NE(contents("a.svg").find("viewBox=\"0 0 842 595\""), std::string::npos);
  EXPECT_TRUE(output_of({"sheet", "--digits", "2", "-o", "-"}) == contents("a.png"));
  EXPECT_EQ(entries(), (std::vector<std::string>{"a.pdf", "a.png", "a.svg"}));
}

TEST_F(SheetTest, PutsTimeAndCountBelowEachPicture) {
  if (std::system("command -v pdftotext > /dev/null") != 0) GTEST_SKIP() << "no pdftotext here";
  const auto text_of = [&](const Arguments& options) {
    output_of(Arguments{"sheet", "-o", "a.pdf"} + options);
    const std::string command =
        "pdftotext -layout " + (folder_ / "a.pdf") + " " + (folder_ / "a.txt");
    EXPECT_EQ(std::system(command.c_str()), 0);
    return contents("a.txt");
  };
  write("fast.toml", "time = { to = 3, speed = 10 }\nview.fps = 1\n");
  write("slow.toml", "time.speed = '1/100000'\n");
  const std::string named = text_of({"--at", "0,#1,3.5,last,20"});
  for (const char* caption : {"time 0, count 0", "time 2, count 1", "time 3.5, count 157",
                              "time 12.3375, count 314", "time 20, count 314"}) {
    EXPECT_NE(named.find(caption), std::string::npos) << caption << " is not in " << named;
  }
  EXPECT_EQ(count_of(named, "time "), 5u);
  EXPECT_EQ(count_of(named, "Collisions:"), 5u) << "text stays text";
  EXPECT_EQ(count_of(text_of({}), "time "), 12u);
  const std::string spread = text_of({"--frames", "4", "--to", "3"});
  for (const char* caption : {"time 0,", "time 1,", "time 2,", "time 3,"}) {
    EXPECT_NE(spread.find(caption), std::string::npos) << caption << " is not in " << spread;
  }
  EXPECT_EQ(count_of(text_of({"--frames", "1"}), "time 0, count 0"), 1u);
  // The spread has nothing to do with the frames of a video.
  const std::string fast = text_of({"--frames", "4", "fast.toml"});
  for (const char* caption : {"time 0,", "time 1,", "time 2,", "time 3,"}) {
    EXPECT_NE(fast.find(caption), std::string::npos) << caption << " is not in " << fast;
  }
  EXPECT_EQ(count_of(text_of({"--frames", "4", "slow.toml"}), "time "), 4u);
}

TEST_F(SheetTest, TellsInstantsApart) {
  if (std::system("command -v pdftotext > /dev/null") != 0) GTEST_SKIP() << "no pdftotext here";
  output_of({"sheet", "--digits", "6", "--at", "#157000,#157001,1000000", "-o", "a.pdf"});
  const std::string command =
      "pdftotext -layout " + (folder_ / "a.pdf") + " " + (folder_ / "a.txt");
  EXPECT_EQ(std::system(command.c_str()), 0);
  const std::string text = contents("a.txt");
  EXPECT_EQ(count_of(text, "time 3.4999"), 2u) << text;
  EXPECT_EQ(count_of(text, "time 1000000, count"), 1u) << text;
  const std::size_t first = text.find("time 3.4999");
  const std::size_t second = text.find("time 3.4999", first + 1);
  EXPECT_NE(text.substr(first, text.find(',', first) - first),
            text.substr(second, text.find(',', second) - second));
}

TEST_F(SheetTest, TimesAreExactAndNeverLong) {
  if (std::system("command -v pdftotext > /dev/null") != 0) GTEST_SKIP() << "no pdftotext here";
  output_of({"sheet", "--at=-1e300,1e-50,0.333333333,1/3,123456789012345678.25", "-o", "a.pdf"});
  const std::string command =
      "pdftotext -layout " + (folder_ / "a.pdf") + " " + (folder_ / "a.txt");
  EXPECT_EQ(std::system(command.c_str()), 0);
  const std::string text = contents("a.txt");
  for (const char* caption : {"time −1×10³⁰⁰,", "time 1×10⁻⁵⁰,", "time 0.333333333,",
                              "time 0.3333333333,", "time 123456789012345678,"}) {
    EXPECT_EQ(count_of(text, caption), 1u) << caption << " is not in " << text;
  }
}

TEST_F(SheetTest, TakesTheLargestNumberThereIs) {
  EXPECT_EQ(output_of({"sheet", "--frames", "200", "-o", "a.pdf"}), "");
}

}  // namespace
}  // namespace piblocks
