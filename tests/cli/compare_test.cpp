// compare: what it says, its exit codes, and what it leaves behind.
#include <piblocks/encode.hpp>
#include <sys/mount.h>

#include <algorithm>

#include "cli/compare_fixture.hpp"
#include "support/ordinary_user.hpp"

namespace piblocks {
namespace {
namespace fs = std::filesystem;

/// In 4:2:0 a pixel may have all of its neighbour's chroma instead of its own. That of the red
/// block is the greatest: its red is 125 above its luma.
constexpr const char* kMostChroma = "125";

class CompareTest : public CompareFixture {
 protected:
  void write_picture(const std::string& name, const std::string& size = "160x90") const {
    output_of({"still", "--size", size, "--at", "1", "-o", name});
  }
  /// A second of 12 frames, unless the options say otherwise.
  void render(const std::string& output, const Arguments& more = {}) const {
    Arguments arguments = Arguments{"render", "--quiet", "--size", "160x90", "-o", output} + more;
    for (const auto& [option, value] : {std::pair{"--fps", "12"}, {"--to", "1"}}) {
      if (std::ranges::find(more, option) != more.end()) continue;
      arguments = arguments + Arguments{option, value};
    }
    output_of(arguments);
  }
  void still(const std::string& output, const std::string& instant) const {
    output_of({"still", "--size", "160x90", "--at", instant, "-o", output});
  }
  std::string verdict(const Arguments& arguments, int exit_code) const {
    const CommandResult result = compare(arguments);
    EXPECT_EQ(result.exit_code, exit_code) << result.out << result.err;
    const auto said = lines(result.out);
    return said.empty() ? std::string() : said.back();
  }
};

TEST_F(CompareTest, EveryKindEqualsItself) {
  for (const std::string name : {"a.mp4", "a.y4m", "a.framehash"}) {
    render(name);
    EXPECT_EQ(verdict({name, name}, 0), "equal: 0 of 12 frames differ") << name;
  }
  render("f/%04d.png");
  EXPECT_EQ(verdict({"f", "f/%04d.png"}, 0), "equal: 0 of 12 frames differ");
  EXPECT_EQ(verdict({"f/0003.png", "f/0003.png"}, 0), "equal: 0 of 1 frames differ");
}

TEST_F(CompareTest, NamesTheFrameThatDiffers) {
  render("a/%04d.png");
  fs::copy(folder_ / "a", folder_ / "b");
  still("b/0007.png", "0.51");
  const CommandResult result = compare({"a", "b"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.err, "");
  ASSERT_EQ(lines(result.out).size(), 2U) << result.out;
  EXPECT_TRUE(result.out.starts_with("0007.png: ")) << result.out;
  EXPECT_TRUE(contains(result.out, " pixels differ, largest delta "));
  EXPECT_TRUE(contains(result.out, ", first at x="));
  EXPECT_TRUE(contains(result.out, ", densest 16x16 window at x="));
  EXPECT_TRUE(result.out.ends_with("different: 1 of 12 frames differ\n"));
  EXPECT_EQ(verdict({"a", "b", "--max-delta", "255"}, 0),
            "accepted: 1 of 12 frames differ, 0 beyond tolerance");
  EXPECT_EQ(verdict({"a", "b", "--mask", "159x90+0+0"}, 0),
            "accepted: 0 of 12 frames differ outside of the masks, 1 in them");
  EXPECT_EQ(compare({"a", "b", "--quiet"}).out, "");
}

TEST_F(CompareTest, FindsAnotherVideoAndOtherHashes) {
  render("a.mp4");
  render("b.mp4", {"--from", "1/100"});
  EXPECT_EQ(verdict({"a.mp4", "b.mp4"}, 1), "different: 12 of 12 frames differ");
  EXPECT_TRUE(contains(compare({"a.mp4", "b.mp4"}).out, "frame 0: "));
  render("a.framehash");
  render("b.framehash");
  std::string text = contents("b.framehash");
  text[text.rfind(", ") + 2] = 'x';
  write("b.framehash", text);
  const CommandResult result = compare({"a.framehash", "b.framehash"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.out, "frame 11: different hashes\ndifferent: 1 of 12 frames differ\n");
}

TEST_F(CompareTest, AVideoShowsItsPicturesWithinTolerance) {
  render("a.mp4");
  render("a/%04d.png");
  EXPECT_EQ(compare({"a.mp4", "a"}).exit_code, 1);
  EXPECT_EQ(verdict({"a.mp4", "a", "--max-delta", kMostChroma}, 0),
            "accepted: 12 of 12 frames differ, 0 beyond tolerance");
  render("b/%04d.png", {"--digits", "2", "--from", "2", "--to", "3"});
  EXPECT_EQ(compare({"a.mp4", "b", "--max-delta", kMostChroma}).exit_code, 1);
}

TEST_F(CompareTest, ExitCodesAreInTheOrderOfSeverity) {
  for (const char* number : {"1", "2", "3", "4"}) {
    for (const char* folder : {"a/", "b/"}) write_picture(std::string(folder) + number + ".png");
  }
  const auto code = [&](const Arguments& more = {}) {
    const Arguments all = Arguments{"a", "b", "--quiet", "--report", "r.html"} + more;
    return compare(all + Arguments{"--junit", "r.xml", "--json", "r.json", "--diff", "d"})
        .exit_code;
  };
  EXPECT_EQ(code(), 0);
  still("b/1.png", "2");
  EXPECT_EQ(code(), 1);
  EXPECT_EQ(code({"--max-delta", "255"}), 0);
  fs::remove(folder_ / "b/2.png");
  EXPECT_EQ(code(), 4);
  EXPECT_EQ(code({"--max-delta", "255"}), 4) << "a tolerance is for pictures";
  write("b/3.png", "no picture");
  EXPECT_EQ(code(), 5);
  for (const char* name : {"1.png", "2.png", "3.png", "4.png"}) {
    EXPECT_TRUE(contains(contents("r.xml"), std::string("name=\"") + name)) << name;
  }
  EXPECT_TRUE(contains(contents("r.xml"), "tests=\"4\" failures=\"2\" errors=\"1\""));
}

/// A report that says that all is well is never left beside a failure.
TEST_F(CompareTest, ReportsAreWrittenWhateverIsFound) {
  write_picture("a/1.png");
  output_of({"still", "--theme", "article", "--size", "80x44", "--at", "1", "-o", "small.png"});
  write("junk.png", "no picture");
  write("junk.mp4", "no video");
  write("a.framehash", "#format: frame checksums\n0,0,0,1,1,aa\n");
  write("longer.framehash", contents("a.framehash") + "0,1,1,1,1,bb\n");
  fs::create_directory(folder_ / "empty");
  const std::vector<std::pair<Arguments, int>> cases = {{{"none.png", "a/1.png"}, 3},
                                                        {{"none", "a"}, 3},
                                                        {{"empty", "a"}, 3},
                                                        {{"none/%d.png", "a"}, 3},
                                                        {{"none.framehash", "a.framehash"}, 3},
                                                        {{"a/1.png", "small.png"}, 4},
                                                        {{"a.framehash", "longer.framehash"}, 4},
                                                        {{"a", "small.png"}, 4},
                                                        {{"a/1.png", "none.png"}, 5},
                                                        {{"a", "empty"}, 5},
                                                        {{"empty", "empty"}, 5},
                                                        {{"none", "nor"}, 5},
                                                        {{"a/1.png", "junk.png"}, 5},
                                                        {{"junk.mp4", "a/1.png"}, 5},
                                                        {{"none.png", "junk.png"}, 5},
                                                        {{"a.framehash", "none.framehash"}, 5}};
  for (const auto& [sides, code] : cases) {
    SCOPED_TRACE(sides[0] + " " + sides[1]);
    const Arguments reports = {"--junit",  "r.xml",  "--json", "r.json",
                               "--report", "r.html", "--diff", "d"};
    EXPECT_EQ(compare(Arguments{"a/1.png", "a/1.png"} + reports).exit_code, 0);
    const CommandResult result = compare(sides + reports);
    EXPECT_EQ(result.exit_code, code) << result.out << result.err;
    EXPECT_FALSE(contains(contents("r.xml"), "failures=\"0\" errors=\"0\""));
    EXPECT_TRUE(contains(contents("r.xml"), sides[1] + " against " + sides[0]));
    EXPECT_TRUE(contains(contents("r.html"), "class=\"refused\""));
    EXPECT_FALSE(contains(contents("r.json"), "\"text\":\"equal: "));
  }
}

/// Neither accepted frames nor less severe ones keep a frame out of sight.
TEST_F(CompareTest, TheMostSevereAreShownFirstEverywhere) {
  write_picture("a/0.png");
  still("b/0.png", "2");
  output_of({"still", "--size", "160x90", "--at", "1", "--theme", "dark", "-o", "c.png"});
  for (int i = 1; i <= 50; ++i) {
    fs::copy(folder_ / "a/0.png", folder_ / ("a/" + std::to_string(i) + ".png"));
    fs::copy(folder_ / "b/0.png", folder_ / ("b/" + std::to_string(i) + ".png"));
  }
  fs::copy(folder_ / "c.png", folder_ / "b/45.png", fs::copy_options::overwrite_existing);
  const Arguments tolerant = {"a", "b", "--mask", "160x88+0+2"};
  ASSERT_EQ(compare({"a/0.png", "b/0.png", "--mask", "160x88+0+2"}).exit_code, 0);
  const CommandResult one = compare(tolerant + Arguments{"--report", "r.html", "--diff", "d"});
  EXPECT_EQ(one.exit_code, 1);
  EXPECT_TRUE(one.out.starts_with("45.png: ")) << one.out;
  EXPECT_EQ(lines(one.out).size(), 42U) << "40 frames, how many more, and the verdict";
  EXPECT_TRUE(contains(one.out, "\n… and 11 more\n"));
  const std::string page = contents("r.html");
  EXPECT_LT(page.find("<h2>45.png</h2>"), page.find("<h2>0.png</h2>"));
  EXPECT_EQ(names_in("d"), (Names{"45-actual.png", "45-diff.png", "45-expected.png"}));
  EXPECT_EQ(names_in("r-files").size(), 3 * 40U) << "no more than the page shows";
  // All of them are different now.
  EXPECT_EQ(compare({"a", "b", "--report", "r.html", "--diff", "d"}).exit_code, 1);
  EXPECT_EQ(names_in("d").size(), 3 * 40U);
  const std::string all = contents("r.html");
  EXPECT_EQ(count_of(all, "<img"), 3 * 40U);
  EXPECT_TRUE(contains(all, "<b>50.png</b>")) << "the others are named";
}

TEST_F(CompareTest, NamesOfBothSidesAreSaidOnce) {
  write_picture("mine-0.png");
  write_picture("other/mine-0.png");
  still("new.png", "2");
  fs::copy(folder_ / "new.png", folder_ / "other/mine-0.png", fs::copy_options::overwrite_existing);
  EXPECT_TRUE(compare({"mine-0.png", "other/mine-0.png"}).out.starts_with("mine-0.png: "));
  EXPECT_TRUE(compare({"mine-0.png", "new.png"}).out.starts_with("mine-0.png and new.png: "));
  write("junk.png", "no picture");
  EXPECT_EQ(complaint({"junk.png", "junk.png"}, 5).find("junk.png", 40), std::string::npos);
}

TEST_F(CompareTest, AVideoAndPicturesArePairedByTheirOrder) {
  render("a.mp4");
  render("a/%04d.png");
  fs::remove(folder_ / "a/0012.png");
  EXPECT_EQ(verdict({"a.mp4", "a", "--max-delta", kMostChroma}, 4),
            "different: 11 of 11 frames differ, 0 beyond tolerance, 1 missing");
  fs::remove(folder_ / "a/0005.png");
  const CommandResult result = compare({"a/%04d.png", "a.mp4", "--max-delta", kMostChroma});
  EXPECT_EQ(result.exit_code, 4);
  EXPECT_TRUE(result.out.starts_with("frame 4: new\nframe 11: new\n")) << result.out;
  render("b.mp4", {"--to", "1/2"});
  EXPECT_EQ(verdict({"b.mp4", "a.mp4"}, 4), "different: 0 of 6 frames differ, 6 new");
}

TEST_F(CompareTest, MissingAndUnreadableInputsAreTold) {
  render("a/%04d.png");
  write("no.png", "no picture");
  write("no.mp4", "no video");
  write("no.framehash", "no hashes");
  EXPECT_EQ(complaint({"none.png", "a"}, 3), "piblocks: compare: there is no 'none.png'\n");
  EXPECT_EQ(complaint({"none/%d.png", "a"}, 3),
            "piblocks: compare: there is no file of 'none/%d.png'\n");
  EXPECT_EQ(complaint({"a", "none.png"}, 5), "piblocks: compare: there is no 'none.png'\n");
  expect_complaint({"a/0001.png", "no.png"}, "cannot read 'no.png'");
  expect_complaint({"a", "no.mp4"}, "cannot read 'no.mp4'");
  expect_complaint({"a", "no.mp4", "--quiet"}, "'no.mp4'");
  expect_complaint({"no.framehash", "no.framehash"}, "line 1 is no hash");
  std::string longer = "#format: frame checksums\n";
  for (int line = 0; line < 2'000'000; ++line) longer += "0,0,0,1,1,0\n";
  write("long.framehash", longer);
  expect_complaint({"long.framehash", "long.framehash"}, "more than 2000000 lines");
}

TEST_F(CompareTest, WrongUsageIsToldFromDifference) {
  render("a/%04d.png");
  render("a.framehash");
  for (const Arguments& wrong :
       {Arguments{"a"}, Arguments{"a", "a", "a"}, Arguments{"a", "a", "--max-delta", "256"},
        Arguments{"a", "a", "--max-delta", "-1"}, Arguments{"a", "a", "--max-window", "16"},
        Arguments{"a", "a", "--max-window", "0:3"}, Arguments{"a", "a", "--mask", "10x10"},
        Arguments{"a", "a", "--mask", "0x10+1+1"}, Arguments{"a", "a", "--max-pixels", "many"},
        Arguments{"a", "a", "--mask", "160x90+0+0"},
        Arguments{"a", "a", "--mask", "80x90+0+0", "--mask", "80x90+80+0"},
        Arguments{"a", "a", "--mask", "5x5+160+0"}, Arguments{"a", "a.framehash"},
        Arguments{"a.framehash", "a.framehash", "--max-delta", "1"}}) {
    EXPECT_TRUE(complaint(wrong, 2).starts_with("piblocks: "));
  }
}

TEST_F(CompareTest, LeavesPicturesAPageAndAListOfTests) {
  render("a/%04d.png");
  fs::copy(folder_ / "a", folder_ / "b");
  still("b/0003.png", "0.2");
  still("b/0007.png", "0.51");
  const CommandResult result = compare({"a", "b", "--diff", "d/e", "--report", "r.html", "--junit",
                                        "r.xml", "--mask", "1x1+0+0", "--mask", "1x1+1+1"});
  EXPECT_EQ(result.exit_code, 1) << result.err;
  for (const char* name : {"0003", "0007"}) {
    for (const char* kind : {"expected", "actual", "diff"}) {
      const std::string picture = fmt::format("{}-{}.png", name, kind);
      EXPECT_TRUE(contents("d/e/" + picture).starts_with("\x89PNG")) << picture;
      EXPECT_EQ(contents("r-files/" + picture), contents("d/e/" + picture));
      EXPECT_TRUE(contains(contents("r.html"), "src=\"r-files/" + picture + "\""));
    }
  }
  EXPECT_EQ(names_in("d/e").size(), 6U);
  EXPECT_EQ(names_in("r-files").size(), 6U);
  const std::string page = contents("r.html");
  EXPECT_TRUE(contains(page, "<h2>0003.png</h2>"));
  EXPECT_TRUE(contains(page, "Every sample must be equal. Masked: 1x1+0+0, 1x1+1+1."));
  EXPECT_FALSE(contains(page, "http"));
  const std::string tests = contents("r.xml");
  EXPECT_TRUE(contains(tests, "tests=\"12\" failures=\"2\""));
  EXPECT_TRUE(contains(tests, "name=\"0007.png\">\n      <failure type=\"different\" message=\""));
}

TEST_F(CompareTest, APageInOneFileNeedsNothingElse) {
  still("a.png", "1");
  still("b.png", "2");
  EXPECT_EQ(compare({"a.png", "b.png", "--report", "r.html"}).exit_code, 1);
  EXPECT_EQ(names_in("r-files"), (Names{"a-actual.png", "a-diff.png", "a-expected.png"}));
  EXPECT_EQ(compare({"a.png", "b.png", "--report", "r.html", "--report-in-one-file"}).exit_code, 1);
  EXPECT_FALSE(fs::exists(folder_ / "r-files")) << "of an earlier page";
  EXPECT_TRUE(contains(contents("r.html"), "data:image/png;base64,iVBOR"));
  EXPECT_FALSE(contains(contents("r.html"), "r-files"));
  EXPECT_TRUE(contains(complaint({"a.png", "b.png", "--report-in-one-file"}, 2), "--report"));
}

TEST_F(CompareTest, APageReplacesNoPicturesOfOthers) {
  still("a.png", "1");
  still("b.png", "2");
  fs::create_directory(folder_ / "r-files");
  write("r-files/a-diff.png", "mine");
  EXPECT_TRUE(
      contains(complaint({"a.png", "b.png", "--report", "r.html"}, 2), "'r-files/a-diff.png'"));
  EXPECT_EQ(names_in("r-files"), (Names{"a-diff.png"}));
  EXPECT_EQ(contents("r-files/a-diff.png"), "mine");
  EXPECT_FALSE(fs::exists(folder_ / "r.html"));
  still("r-files/x.png", "1");
  const CommandResult inside = compare({"r-files/x.png", "b.png", "--report", "r.html"});
  EXPECT_EQ(inside.exit_code, 2);
  EXPECT_TRUE(contains(inside.err, "--report 'r-files': would write over the reference"));
}

TEST_F(CompareTest, JsonHasTheNumbersOfEveryRow) {
  render("a/%04d.png");
  fs::copy(folder_ / "a", folder_ / "b");
  still("b/0007.png", "0.51");
  fs::remove(folder_ / "b/0008.png");
  const CommandResult result = compare({"a", "b", "--json", "r.json", "--max-delta", "0.5",
                                        "--max-window", "16:2", "--mask", "3x2+0+1"});
  EXPECT_EQ(result.exit_code, 4) << result.err;
  write("read.py", R"(import json
run = json.load(open("r.json"))
print(run["reference"], run["actual"], run["outcome"], len(run["rows"]), run["counts"]["different"])
print(run["tolerance"])
row = run["rows"][6]
print(row["name"], row["outcome"], row["masks"], row["off_pixels"] == row["different_pixels"] > 0,
      row["max_level"], row["densest"]["rect"][2:], len(row["regions"]) > 0)
print(run["rows"][7], run["rows"][0]["different_pixels"]))");
  EXPECT_EQ(
      shell("python3 read.py"),
      "a b missing 12 1\n"
      "Samples may differ by up to 0.5 of 255, except in any number of pixels, up to 2 pixels "
      "of any square of 16x16. Masked: 3x2+0+1.\n"
      "0007.png different [[0, 1, 3, 2]] True 255 [16, 16] True\n"
      "{'name': '0008.png', 'outcome': 'missing', 'text': 'missing'} 0\n");
}

/// One that is broken off must not leave the green page of an earlier one.
TEST_F(CompareTest, RemovesReportsOfAnEarlierComparisonAtOnce) {
  still("a.png", "1");
  write("r.html", "green");
  write("green.xml", "green");
  fs::create_symlink("green.xml", folder_ / "r.xml");
  const Arguments broken_off = {"a.png",   "a.png", "--report", "r.html",
                                "--junit", "r.xml", "--mask",   "9999x9999+0+0"};
  complaint(broken_off, 2);
  EXPECT_FALSE(fs::exists(folder_ / "r.html"));
  EXPECT_FALSE(fs::exists(folder_ / "green.xml"));
  EXPECT_TRUE(fs::is_symlink(folder_ / "r.xml"));
  write("r.html", "mine");
  for (const char* option : {"--report", "--junit"}) {
    EXPECT_TRUE(contains(complaint({"a.png", "a.png", option, "-"}, 2), "name a file"));
  }
  complaint({"a.png", "a.png", "--report", "r.html", "--max-delta", "x"}, 2);
  EXPECT_EQ(contents("r.html"), "mine") << "nothing has begun";
}

TEST_F(CompareTest, ReplacesPicturesOfAnEarlierComparisonAndNoOthers) {
  render("a/%04d.png");
  fs::copy(folder_ / "a", folder_ / "b");
  still("b/0003.png", "0.2");
  still("b/0007.png", "0.51");
  EXPECT_EQ(compare({"a", "b", "--diff", "d"}).exit_code, 1);
  fs::copy(folder_ / "a/0001.png", folder_ / "d/0010-diff.png");
  write("d/notes.txt", "mine");
  fs::copy(folder_ / "a/0003.png", folder_ / "b/0003.png", fs::copy_options::overwrite_existing);
  EXPECT_EQ(compare({"a", "b", "--diff", "d"}).exit_code, 1);
  const Names left = {"0007-actual.png", "0007-diff.png", "0007-expected.png", "0010-diff.png",
                      "notes.txt"};
  EXPECT_EQ(names_in("d"), left);
  still("b/0010.png", "0.51");
  EXPECT_TRUE(contains(complaint({"a", "b", "--diff", "d"}, 2), "'d/0010-diff.png'"));
  EXPECT_EQ(contents("d/0010-diff.png"), contents("a/0001.png"));
  EXPECT_EQ(names_in("d"), left);
}

/// Also where they are copies that a comparison has made, in a folder of the folder.
TEST_F(CompareTest, WhatIsComparedIsNoPictureOfAnEarlierComparison) {
  still("a/x.png", "1");
  still("b/x.png", "2");
  EXPECT_EQ(compare({"a", "b", "--diff", "d/s"}).exit_code, 1);
  const CommandResult again = compare({"d/s/x-actual.png", "a/x.png", "--diff", "d"});
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_TRUE(contains(again.err, "--diff 'd': would write over the reference"));
  EXPECT_EQ(names_in("d/s").size(), 3U);
}

TEST_F(CompareTest, FramesOfVideosHaveNumbers) {
  render("a.y4m");
  render("b.y4m", {"--from", "1/100"});
  EXPECT_EQ(compare({"a.y4m", "b.y4m", "--diff", "d"}).exit_code, 1);
  const Names names = names_in("d");
  ASSERT_EQ(names.size(), 3 * 12U);
  EXPECT_EQ(names.front(), "frame-000000-actual.png");
  EXPECT_EQ(names.back(), "frame-000011-expected.png");
}

/// Only root can mount a file system.
TEST_F(CompareTest, AFullDiskUnderTheReportIsNoUnreadableInput) {
  still("a.png", "1");
  still("b.png", "2");
  fs::create_directory(folder_ / "d");
  const std::string disk = folder_ / "d";
  if (::mount("none", disk.c_str(), "tmpfs", 0, "size=4096") != 0) GTEST_SKIP() << "no right to";
  write("d/full", std::string(4096, ' '));
  const std::string diff = complaint({"a.png", "b.png", "--diff", "d"}, 1);
  const std::string report = complaint({"a.png", "b.png", "--report", "d/r.html"}, 1);
  ::umount2(disk.c_str(), MNT_DETACH);
  EXPECT_TRUE(contains(diff, "d/a-expected.png': No space left on device"));
  EXPECT_TRUE(contains(report, "No space left on device"));
}

TEST_F(CompareTest, NamesOfAnyBytesMakeReportsThatCanBeRead) {
  fs::create_directory(folder_ / "a");
  fs::create_directory(folder_ / "b");
  const std::string bytes = "x\xff\x1b[31m\xc2\x9b\"<&>'\xef\xbf\xbf\n\xcf\x80.png";
  const std::string shown = "x\\xff\\x1b[31m\\u{9b}\"<&>'\\u{ffff}\\n\xcf\x80.png";
  still("a/" + bytes, "1");
  still("b/" + bytes, "2");
  const CommandResult result = compare({"a", "b", "--report", "r.html", "--junit", "r.xml"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_TRUE(result.out.starts_with(shown + ": ")) << result.out;
  EXPECT_EQ(contents("r.html").find_first_of("\x1b\xff\x9b"), std::string::npos);
  const std::string read_name =
      "import sys, xml.etree.ElementTree as xml; sys.stdout.buffer.write("
      "xml.parse(sys.argv[1]).find('.//testcase').get('name').encode())";
  EXPECT_EQ(shell("python3 -c \"" + read_name + "\" r.xml"), shown);
}

TEST_F(CompareTest, NoPicturesAreLeftOfWhatIsEqual) {
  render("a/%04d.png");
  EXPECT_EQ(compare({"a", "a", "--diff", "d", "--junit", "r.xml"}).exit_code, 0);
  EXPECT_TRUE(fs::is_empty(folder_ / "d"));
  EXPECT_TRUE(contains(contents("r.xml"), "tests=\"12\" failures=\"0\""));
}

// 1 would say that they differ.
TEST_F(CompareTest, WhatMayNotBeLookedAtCannotBeRead) {
  if (const auto problem = testing_support::ordinary_user_problem(); !problem.empty())
    GTEST_SKIP() << problem;
  fs::create_directory(folder_ / "closed");
  output_of({"still", "--size", "64x36", "--at", "1", "-o", "closed/1.png"});
  output_of({"still", "--size", "64x36", "--at", "1", "-o", "1.png"});
  fs::permissions(folder_.path(), fs::perms(0755));
  fs::permissions(folder_ / "closed", fs::perms(0600));
  const std::string long_name = std::string(256, 'x') + ".png";
  const std::vector<std::pair<Arguments, std::string>> cases = {
      {{"closed/1.png", "1.png"}, "cannot read 'closed/1.png': Permission denied"},
      {{"1.png", "closed/1.png"}, "cannot read 'closed/1.png': Permission denied"},
      {{"closed/%d.png", "1.png"}, "cannot read 'closed/%d.png': Permission denied"},
      {{"closed/a.framehash", "closed/a.framehash"}, "'closed/a.framehash': Permission denied"},
      {{long_name, "1.png"}, "x.png': File name too long"}};
  for (const auto& [arguments, message] : cases) {
    const testing_support::OrdinaryUser user;
    expect_complaint(arguments, message);
  }
  // What is in a folder that cannot be read is neither missing nor new.
  output_of({"still", "--size", "64x36", "--at", "1", "-o", "a/s/1.png"});
  output_of({"still", "--size", "64x36", "--at", "1", "-o", "b/s/1.png"});
  fs::permissions(folder_ / "b/s", fs::perms(0000));
  for (const Arguments& sides :
       {Arguments{"a", "b"}, {"b", "a"}, {"a/s", "b/s"}, {"a/s/%d.png", "b/s/%d.png"}}) {
    const testing_support::OrdinaryUser user;
    const CommandResult result = compare(sides);
    EXPECT_EQ(result.exit_code, 5) << result.out;
    EXPECT_EQ(result.out, "unreadable: 1 unreadable\n");
    EXPECT_EQ(lines(result.err).size(), 1U) << result.err;
  }
  fs::permissions(folder_ / "b/s", fs::perms(0700));
  fs::permissions(folder_ / "closed", fs::perms(0700));
}

TEST_F(CompareTest, WhatIsMissingIsNamed) {
  expect_refusal({"compare", "a"}, "compare: missing ACTUAL; see");
  expect_refusal({"compare"}, "compare: missing REFERENCE and ACTUAL; see");
}

}  // namespace
}  // namespace piblocks
