// compare_files(): which pictures are compared with which, and what becomes of all the others.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <piblocks/compare.hpp>
#include <piblocks/error.hpp>
#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <random>
#include <tuple>

#include "golden/difference.hpp"
#include "golden/reports.hpp"
#include "golden/shown_frames.hpp"
#include "media/png/png_chunk.hpp"
#include "media/png/png_reader.hpp"
#include "support/contains.hpp"
#include "support/message_of.hpp"
#include "support/temporary_folder.hpp"

namespace piblocks {
namespace {
namespace fs = std::filesystem;
using testing_support::contains;
using testing_support::message_of;
using testing_support::TemporaryFolder;

using Lines = std::vector<std::string>;

class CompareFilesTest : public testing::Test {
 protected:
  /// A picture of one colour. Missing folders are made.
  void picture(const std::string& name, std::uint32_t word = 0xff204060, int width_px = 4) const {
    save(name, {width_px, 4, std::vector<std::uint32_t>(std::size_t(width_px) * 4, word)});
  }
  void save(const std::string& name, const Image& image) const {
    const Bytes bytes = encode_png_samples(image);
    text(name, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  }
  void pictures(const std::vector<std::string>& names) const {
    for (const std::string& name : names) picture(name);
  }
  void text(const std::string& name, std::string_view text) const {
    fs::create_directories(fs::path(folder_ / name).parent_path());
    folder_.save(name, text);
  }
  ComparisonJob job(const std::string& reference, const std::string& actual) const {
    return {folder_ / reference, folder_ / actual};
  }
  /// "NAME OUTCOME" for each row.
  Lines rows(const ComparisonJob& job) {
    Lines lines;
    result_ = compare_files(job, [&](const FrameComparison& row) {
      EXPECT_EQ(row.number, static_cast<std::int64_t>(lines.size()));
      lines.push_back(row.name + " " + name_of(row.outcome));
      problems_ += row.problem + "\n";
    });
    EXPECT_EQ(result_.total(), static_cast<std::int64_t>(lines.size()));
    return lines;
  }
  Lines rows(const std::string& reference, const std::string& actual) {
    return rows(job(reference, actual));
  }

  TemporaryFolder folder_;
  ComparisonResult result_;
  std::string problems_;
};

TEST_F(CompareFilesTest, FoldersArePairedByName) {
  picture("a/a.png", 0xffff0000);
  picture("a/b.png", 0xff00ff00);
  picture("b/b.png", 0xffff0000);
  picture("b/c.png", 0xff00ff00);
  EXPECT_EQ(rows("a", "b"), (Lines{"a.png missing", "b.png different", "c.png new"}));
  EXPECT_EQ(result_.worst(), Outcome::missing);
  EXPECT_EQ(result_.reference_frames, 2);
  EXPECT_EQ(result_.actual_frames, 2);
}

TEST_F(CompareFilesTest, OneMorePictureShiftsNothing) {
  pictures({"a/1.png", "a/2.png", "a/10.png", "b/0.png", "b/1.png", "b/2.png", "b/10.png"});
  EXPECT_EQ(rows("a", "b"), (Lines{"0.png new", "1.png equal", "2.png equal", "10.png equal"}));
  EXPECT_EQ(rows("b", "a")[0], "0.png missing");
}

TEST_F(CompareFilesTest, FoldersInFoldersAreCompared) {
  pictures({"a/x.png", "a/s/x.png", "a/s/t/y.png", "b/x.png", "b/s/t/y.png", "b/u/x.png"});
  picture("a/p.png/x.png");  // a folder may be called so
  picture("b/p.png");
  EXPECT_EQ(rows("a", "b"), (Lines{"p.png new", "p.png/x.png missing", "s/t/y.png equal",
                                   "s/x.png missing", "u/x.png new", "x.png equal"}));
  ComparisonJob flat = job("a", "b");
  flat.is_recursive = false;
  EXPECT_EQ(rows(flat), (Lines{"p.png new", "x.png equal"}));
}

TEST_F(CompareFilesTest, LinksAreFollowedButNotForEver) {
  pictures({"a/x.png", "b/x.png", "c/y.png", "a/d/y.png"});
  fs::create_directory_symlink(folder_ / "c", folder_ / "b/d");
  EXPECT_EQ(rows("a", "b"), (Lines{"d/y.png equal", "x.png equal"}));
  fs::create_directory_symlink("..", folder_ / "c/up");
  fs::create_directory_symlink(".", folder_ / "b/again");
  EXPECT_EQ(result_.count(Outcome::unreadable), 0);
  rows("a", "b");
  EXPECT_GT(result_.count(Outcome::unreadable), 0);
  EXPECT_TRUE(contains(problems_, "it leads back to a folder that it is in"));
}

TEST_F(CompareFilesTest, PatternsArePairedByNumber) {
  pictures({"a/7x.png", "a/8x.png", "a/10x.png", "b/0008x.png", "b/0010x.png", "b/0011x.png",
            "b/x.png", "b/12x.png"});
  const Lines expected = {"7x.png missing", "8x.png and 0008x.png equal",
                          "10x.png and 0010x.png equal", "0011x.png new"};
  EXPECT_EQ(rows("a/%dx.png", "b/%04dx.png"), expected);
  // A gap on both sides is none: nothing is expected there.
  EXPECT_EQ(rows("a/%dx.png", "a/%dx.png"),
            (Lines{"7x.png equal", "8x.png equal", "10x.png equal"}));
  EXPECT_EQ(rows("a/%dx.png", "none/%d.png").size(), 3U);
  EXPECT_EQ(result_.problem, fmt::format("there is no file of '{}'", folder_ / "none/%d.png"));
}

TEST_F(CompareFilesTest, APatternPairsThePicturesOfAFolderByTheirNumbers) {
  pictures({"a/1.png", "a/2.png", "b/000001.png", "b/000002.png", "b/poster.png", "b/s/1.png"});
  const Lines strangers = {"poster.png new", "s/1.png new"};
  Lines expected = {"1.png and 000001.png equal", "2.png and 000002.png equal"};
  expected.insert(expected.end(), strangers.begin(), strangers.end());
  EXPECT_EQ(rows("a/%d.png", "b"), expected);
  EXPECT_EQ(rows("b/%06d.png", "b"),
            (Lines{"000001.png equal", "000002.png equal", "poster.png new", "s/1.png new"}));
  EXPECT_EQ(rows("b", "a/%d.png")[0], "000001.png and 1.png equal");
  // Of two names with one number, that of the pattern's shape has it.
  pictures({"c/01.png", "c/1.png"});
  EXPECT_EQ(rows("a/%d.png", "c"), (Lines{"1.png equal", "2.png missing", "01.png new"}));
}

TEST_F(CompareFilesTest, AFileIsPairedByItsNameUnlessBothAreNamed) {
  pictures({"a/1.png", "b/1.png", "b/2.png", "c.png"});
  EXPECT_EQ(rows("a/1.png", "c.png"), (Lines{"1.png and c.png equal"}));
  EXPECT_EQ(rows("a/1.png", "b"), (Lines{"1.png equal", "2.png new"}));
  EXPECT_EQ(rows("b/%d.png", "a/1.png"), (Lines{"1.png equal", "2.png missing"}));
  EXPECT_EQ(rows("c.png", "b"), (Lines{"1.png new", "2.png new", "c.png missing"}));
  EXPECT_TRUE(contains(result_.problem, "has the name of one of"));
}

TEST_F(CompareFilesTest, TheComparisonGoesOnAfterWhateverIsFound) {
  pictures({"a/1.png", "a/2.png", "a/3.png", "a/4.png", "a/6.png", "b/6.png"});
  picture("b/1.png", 0xff204060, 5);
  text("b/2.png", "no picture");
  picture("b/3.png", 0xff204061);
  pictures({"b/4.png"});
  text("a/5.png", "");
  picture("b/5.png");
  ASSERT_EQ(::mkfifo((folder_ / "a/7.png").c_str(), 0600), 0);
  picture("b/7.png");
  fs::create_symlink("nowhere", folder_ / "b/8.png");
  EXPECT_EQ(rows("a", "b"),
            (Lines{"1.png not comparable", "2.png unreadable", "3.png different", "4.png equal",
                   "5.png unreadable", "6.png equal", "7.png unreadable", "8.png unreadable"}));
  EXPECT_TRUE(contains(problems_, "another size: 5x4 instead of 4x4"));
  EXPECT_TRUE(contains(problems_, "it is no regular file"));
  EXPECT_EQ(result_.worst(), Outcome::unreadable);
}

/// No pixel is off, but one is beyond the hard limit.
TEST_F(CompareFilesTest, TheHardLimitIsNamedAndItsPixelShown) {
  Image image{9000, 2, std::vector<std::uint32_t>(18000, 0xff808080)};
  save("a.png", image);
  image.words[8000] = 0xff80808f;
  save("b.png", image);
  ComparisonJob limited = job("a.png", "b.png");
  limited.tolerance.max_delta = 20;
  limited.tolerance.hard_delta = 10;
  EXPECT_TRUE(contains(tolerance_text(limited), "by up to 20 of 255, and none by more than 10"));
  const auto report = diff_folder(folder_ / "d");
  std::string text;
  const ComparisonResult result = compare_files(limited, [&](const FrameComparison& row) {
    text = difference_text(row);
    report->add(row);
  });
  report->finish(limited, result);
  EXPECT_TRUE(contains(text, "0 beyond the accepted delta, the largest beyond the hard limit"));
  const Image diff = read_png(folder_ / "d/a-diff.png");
  EXPECT_EQ(std::ranges::count(diff.words, 0xffff9797U), 1) << "red";
  EXPECT_EQ(diff.words.at(8000), 0xffff9797U);
  EXPECT_EQ(read_png(folder_ / "d/a-actual.png").words, image.words);
}

/// A picture of the difference has few colours, all of which its palette holds.
TEST_F(CompareFilesTest, PixelsOfADifferenceArePaleOrRed) {
  std::mt19937 random(1);
  Image reference{256, 300, {}};
  std::vector<std::uint8_t> deltas;
  for (int i = 0; i < 256 * 300; ++i) {
    reference.words.push_back(static_cast<std::uint32_t>(random()));
    deltas.push_back(static_cast<std::uint8_t>(i % 3 == 0 ? random() : 0U));
  }
  const Bytes png = difference_picture(reference, deltas);
  text("d.png", {reinterpret_cast<const char*>(png.data()), png.size()});
  const Image shown = read_png(folder_ / "d.png");
  ASSERT_EQ(shown.words.size(), deltas.size());
  for (std::size_t i = 0; i < deltas.size(); ++i) {
    const auto level = [&](int shift) { return int(reference.words[i] >> shift & 0xff); };
    const int mean = (level(16) + 2 * level(8) + level(0)) / 4;
    const auto grey = std::uint32_t(255 - (255 - mean) * level(24) / 255 / 4);
    const auto other = std::uint32_t(160 - 160 * deltas[i] / 255);
    ASSERT_EQ(shown.words[i],
              0xff000000 | (deltas[i] == 0 ? grey * 0x010101 : 0xff0000 | other * 0x0101));
  }
}

TEST(ChangedRegions, CoverAllThatDiffersAndAreApart) {
  std::mt19937 random(2);
  for (const auto& [width, height, count] : {std::tuple{1, 1, 1},
                                             {1, 500, 40},
                                             {333, 97, 3},
                                             {640, 360, 30},
                                             {640, 360, 5000},
                                             {4096, 5, 4096},
                                             {3000, 2000, 600},
                                             {3000, 2000, 0}}) {
    std::vector<std::uint8_t> deltas(std::size_t(width) * std::size_t(height));
    for (int i = 0; i < count; ++i) deltas[random() % deltas.size()] = 1;
    const std::vector<PixelRect> regions = changed_regions(deltas, width);
    EXPECT_LE(regions.size(), kMaxRegions);
    std::vector<int> covered(deltas.size());
    for (const PixelRect& region : regions) {
      for (int y = region.y_px; y < region.bottom_px(); ++y) {
        for (int x = region.x_px; x < region.right_px(); ++x) {
          ++covered.at(std::size_t(y) * std::size_t(width) + std::size_t(x));
        }
      }
    }
    for (std::size_t i = 0; i < deltas.size(); ++i) {
      ASSERT_LE(covered[i], 1) << "they do not overlap";
      ASSERT_TRUE(covered[i] == 1 || deltas[i] == 0) << i;
    }
  }
}

TEST(ChangedRegions, AreAsSmallAsCanBe) {
  std::vector<std::uint8_t> deltas(200 * 100);
  deltas[200 * 10 + 20] = deltas[200 * 12 + 34] = 9;  // near each other
  deltas[200 * 10 + 150] = deltas[200 * 99 + 199] = 1;
  EXPECT_EQ(changed_regions(deltas, 200),
            (std::vector<PixelRect>{{150, 10, 1, 1}, {20, 10, 15, 3}, {199, 99, 1, 1}}));
}

/// Files are copied, with all that is in them.
TEST_F(CompareFilesTest, PicturesOfADifferenceHaveTheNamesOfTheirFiles) {
  picture("a/s/x.png");
  picture("b/s/x.png", 0xff204061);
  picture("a/y.png");
  picture("b/y.png", 0xff204061);
  const auto compare_into = [&](const std::string& folder) {
    const auto report = diff_folder(folder_ / folder);
    const ComparisonJob both = job("a", "b");
    report->finish(both,
                   compare_files(both, [&](const FrameComparison& row) { report->add(row); }));
  };
  compare_into("d");
  for (const char* name : {"d/s/x-expected.png", "d/s/x-actual.png", "d/s/x-diff.png",
                           "d/y-expected.png", "d/y-actual.png", "d/y-diff.png"}) {
    EXPECT_TRUE(fs::is_regular_file(folder_ / name)) << name;
  }
  EXPECT_EQ(fs::file_size(folder_ / "d/s/x-actual.png"), fs::file_size(folder_ / "b/s/x.png") + 44)
      << "with a mark";
  // What is equal now leaves nothing, except files of others.
  fs::copy(folder_ / "a/s/x.png", folder_ / "b/s/x.png", fs::copy_options::overwrite_existing);
  text("d/s/notes-diff.png", "mine");
  compare_into("d");
  EXPECT_FALSE(fs::exists(folder_ / "d/s/x-diff.png"));
  EXPECT_TRUE(fs::exists(folder_ / "d/s/notes-diff.png"));
  fs::remove(folder_ / "d/s/notes-diff.png");
  fs::copy(folder_ / "a/y.png", folder_ / "b/y.png", fs::copy_options::overwrite_existing);
  picture("b/s/x.png", 0xff204061);
  compare_into("d");
  fs::copy(folder_ / "a/s/x.png", folder_ / "b/s/x.png", fs::copy_options::overwrite_existing);
  compare_into("d");
  EXPECT_TRUE(fs::is_empty(folder_ / "d")) << "no empty subfolder";
}

/// Opening it would wait for a writer.
TEST_F(CompareFilesTest, HashesAreNotReadFromAPipe) {
  ASSERT_EQ(::mkfifo((folder_ / "a.framehash").c_str(), 0600), 0);
  rows("a.framehash", "a.framehash");
  EXPECT_TRUE(contains(problems_, "it is no regular file"));
  EXPECT_EQ(result_.worst(), Outcome::unreadable);
}

TEST_F(CompareFilesTest, NothingIsNotEqualToNothing) {
  fs::create_directories(folder_ / "a");
  fs::create_directories(folder_ / "b");
  for (const auto& [reference, actual] :
       {std::pair{"a", "b"}, {"a/%d.png", "b"}, {"none.png", "nor.mp4"}}) {
    EXPECT_EQ(rows(reference, actual), Lines{fmt::format("{} missing", folder_ / actual)});
    EXPECT_NE(result_.problem, "");
    EXPECT_EQ(result_.actual_frames, 0);
  }
}

TEST_F(CompareFilesTest, AlphaAloneIsADifferenceThatItsPicturesKeep) {
  picture("a.png", 0x00000000);
  picture("b.png", 0xff000000);
  Image reference;
  Image actual;
  compare_files(job("a.png", "b.png"), [&](const FrameComparison& row) {
    EXPECT_EQ(row.outcome, Outcome::different);
    reference = row.reference();
    actual = row.actual();
  });
  EXPECT_EQ(reference.words.at(0), 0x00000000U);
  EXPECT_EQ(actual.words.at(0), 0xff000000U);
}

/// So are colours behind alpha, which another encoder would round.
TEST_F(CompareFilesTest, PicturesOfReportsKeepEverySample) {
  Image picture{16, 256, {}};
  for (std::uint32_t i = 0; i < 16 * 256; ++i) picture.words.push_back(i * 0x01234567U + i % 7);
  save("a.png", picture);
  std::vector<std::uint32_t> words;
  compare_files(job("a.png", "a.png"),
                [&](const FrameComparison& row) { words = row.reference().words; });
  EXPECT_EQ(words, picture.words);
}

TEST_F(CompareFilesTest, WhatAMaskHidesIsCounted) {
  picture("a.png", 0xff000000);
  picture("b.png", 0xff0000ff);
  ComparisonJob masked = job("a.png", "b.png");
  masked.masks = {{.text = "3x4+0+0", .rects = {{0, 0, 3, 4}}}};
  EXPECT_EQ(rows(masked), Lines{"a.png and b.png different"});
  EXPECT_EQ(result_.masked_frames, 1);
  masked.tolerance.max_delta = 255;
  EXPECT_EQ(rows(masked), Lines{"a.png and b.png accepted"});
  EXPECT_EQ(result_.different_frames, 1);
}

/// Each picture has to be looked at somewhere, and each mask has to hide something of one.
TEST_F(CompareFilesTest, MasksAreCheckedAgainstEachSize) {
  pictures({"a/1.png", "b/1.png"});
  picture("a/2.png", 0xff204060, 8);
  picture("b/2.png", 0xff204060, 8);
  ComparisonJob masked = job("a", "b");
  const auto is_usage = [&](const std::vector<PixelRect>& rects) {
    masked.masks.clear();
    for (const PixelRect& rect : rects) masked.masks.push_back({.text = "mask", .rects = {rect}});
    return !message_of<UsageError>([&] { rows(masked); }).empty();
  };
  EXPECT_TRUE(is_usage({{0, 0, 8, 4}}));
  EXPECT_TRUE(is_usage({{0, 0, 4, 4}})) << "all of the smaller one";
  EXPECT_TRUE(is_usage({{0, 0, 2, 4}, {2, 0, 9, 9}})) << "together";
  EXPECT_TRUE(is_usage({{0, 0, 4, 2}, {0, 2, 4, 1}, {0, 3, 4, 1}})) << "together";
  EXPECT_TRUE(is_usage({{8, 0, 1, 1}}));
  EXPECT_TRUE(is_usage({{0, 0, 1, 1}, {0, 4, 1, 1}}));
  EXPECT_FALSE(is_usage({{7, 0, 1, 1}})) << "inside of one picture";
  EXPECT_FALSE(is_usage({{3, 3, 99, 99}})) << "partly outside";
  EXPECT_FALSE(is_usage({{0, 0, 4, 2}, {0, 3, 4, 1}})) << "a row is left";
}

TEST_F(CompareFilesTest, HashesOfAnyNumberAreCompared) {
  const std::string header = "#format: frame checksums\n";
  text("a.framehash", header + "0,0,0,1,1,aa\n0,1,1,1,1,bb\n");
  text("b.framehash", header + "0,0,0,1,1,aa\n0,1,1,1,1,bc\n0,2,2,1,1,dd\n");
  text("c.framehash", "#dimensions 0: 8x8\n0,0,0,1,1,aa\n");
  EXPECT_EQ(rows("a.framehash", "b.framehash"),
            (Lines{"frame 0 equal", "frame 1 different", "frame 2 new"}));
  EXPECT_EQ(rows("b.framehash", "a.framehash")[2], "frame 2 missing");
  EXPECT_EQ(rows("a.framehash", "c.framehash"),
            (Lines{"header not comparable", "frame 0 equal", "frame 1 missing"}));
  EXPECT_EQ(rows("none.framehash", "c.framehash"), Lines{"frame 0 new"});
  EXPECT_EQ(result_.reference_frames, 0);
  text("d.framehash", "junk\n");
  EXPECT_EQ(rows("a.framehash", "d.framehash"), Lines{"d.framehash unreadable"});
}

TEST(ShownFrames, TheMostSevereComeFirstAndTheFirstOfThese) {
  ShownFrames<int> shown;
  std::vector<int> left;
  const auto add = [&](Outcome outcome, int number) {
    if (const auto item = shown.add(outcome, number)) left.push_back(item->item);
  };
  const int most = static_cast<int>(kMaxShown);
  for (int i = 0; i < most + 2; ++i) add(Outcome::accepted, i);
  EXPECT_EQ(left, (std::vector{most, most + 1}));
  add(Outcome::different, 100);
  add(Outcome::unreadable, 101);
  add(Outcome::different, 102);
  EXPECT_EQ(left, (std::vector{most, most + 1, most - 1, most - 2, most - 3}));
  EXPECT_FALSE(shown.takes(Outcome::accepted));
  std::vector<int> order;
  shown.for_each([&](Outcome /*outcome*/, int number) { order.push_back(number); });
  EXPECT_EQ(order.size(), kMaxShown);
  EXPECT_EQ(std::vector(order.begin(), order.begin() + 4), (std::vector{101, 100, 102, 0}));
}

}  // namespace
}  // namespace piblocks
