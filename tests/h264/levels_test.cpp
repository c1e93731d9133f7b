// Levels: what they allow, and what a stream needs. The model of the decoder's buffer that the
// watches are compared with is written here anew, in exact fractions.
#include "h264/levels.hpp"

#include <gtest/gtest.h>
#include <piblocks/exact.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "support/contains.hpp"
#include "support/traced_random.hpp"

namespace piblocks::h264 {
namespace {

constexpr PictureRate kSlow = {1, std::numeric_limits<std::int32_t>::max()};
constexpr PictureRate kFast = {std::numeric_limits<std::int32_t>::max(), 1};

const Level& level_with(int idc) { return *std::ranges::find(levels(), idc, &Level::idc); }

/// What table A-1 is known for.
TEST(Levels, HoldWellKnownPictures) {
  const auto lowest = [](int width_px, int height_px, std::int64_t rate) {
    const Level* const level = lowest_level(width_px, height_px, {rate, 1});
    return level == nullptr ? 0 : level->idc;
  };
  EXPECT_EQ(lowest(2, 2, 1), 20);
  EXPECT_EQ(lowest(352, 288, 30), 20);
  EXPECT_EQ(lowest(352, 480, 30), 21);
  EXPECT_EQ(lowest(720, 480, 15), 22);
  EXPECT_EQ(lowest(720, 576, 25), 30);
  EXPECT_EQ(lowest(1280, 720, 30), 31);
  EXPECT_EQ(lowest(1280, 720, 60), 32);
  EXPECT_EQ(lowest(1920, 1080, 30), 40);
  EXPECT_EQ(lowest(1920, 1080, 60), 42);
  EXPECT_EQ(lowest(2560, 1920, 30), 50);
  EXPECT_EQ(lowest(3840, 2160, 30), 51);
  EXPECT_EQ(lowest(3840, 2160, 60), 52);
  EXPECT_EQ(lowest(7680, 4320, 30), 60);
  EXPECT_EQ(lowest(7680, 4320, 60), 61);
  EXPECT_EQ(lowest(7680, 4320, 120), 62);
  EXPECT_EQ(lowest(7680, 4320, 200), 0);
}

/// The inequalities of A.3.1, in fractions.
bool holds(const Level& level, int width_px, int height_px, PictureRate rate) {
  const long width_mb = (width_px + 15) / 16;
  const long height_mb = (height_px + 15) / 16;
  const Rational per_second =
      Rational(width_mb * height_mb) * Rational(long(rate.numerator), long(rate.denominator));
  return width_mb * height_mb <= level.max_macroblocks &&
         width_mb * width_mb <= 8 * level.max_macroblocks &&
         height_mb * height_mb <= 8 * level.max_macroblocks &&
         per_second <= Rational(long(level.max_macroblocks_per_s));
}

const Level* lowest_that_holds(int width_px, int height_px, PictureRate rate) {
  const auto found = std::ranges::find_if(
      levels(), [&](const Level& level) { return holds(level, width_px, height_px, rate); });
  return found == levels().end() ? nullptr : &*found;
}

TEST(Levels, OfRandomPicturesAreTheLowestThatHold) {
  TracedRandom random(31);
  std::set<int> seen;
  for (std::int64_t i = 0; i < many(20000); ++i) {
    const auto width_px = static_cast<int>(random.integer(1, 1 << random.integer(1, 14)));
    const auto height_px = static_cast<int>(random.integer(1, 1 << random.integer(1, 14)));
    const PictureRate rate = {random.integer(1, std::int64_t{1} << random.integer(1, 30)),
                              random.integer(1, std::int64_t{1} << random.integer(1, 30))};
    const Level* const lowest = lowest_that_holds(width_px, height_px, rate);
    ASSERT_EQ(lowest_level(width_px, height_px, rate), lowest);
    ASSERT_EQ(level_problem(width_px, height_px, rate).empty(), lowest != nullptr);
    seen.insert(lowest == nullptr ? 0 : lowest->idc);
  }
  // Also none; but level 4.1 differs from 4 in its bytes alone.
  EXPECT_EQ(seen.size(), levels().size());
}

/// The largest area, the longest side and the highest rate of each level, and what is beyond them.
TEST(Levels, EndWhereTheirLimitsAre) {
  const auto expect_lowest = [](std::int64_t width_mb, std::int64_t height_mb, PictureRate rate) {
    const int width_px = static_cast<int>(16 * width_mb);
    const int height_px = static_cast<int>(16 * height_mb);
    EXPECT_EQ(lowest_level(width_px, height_px, rate), lowest_that_holds(width_px, height_px, rate))
        << width_mb << 'x' << height_mb << " at " << rate.numerator << '/' << rate.denominator;
  };
  for (const Level& level : levels()) {
    const auto side = static_cast<std::int64_t>(std::sqrt(double(level.max_macroblocks)));
    const auto longest = static_cast<std::int64_t>(std::sqrt(8.0 * double(level.max_macroblocks)));
    for (const std::int64_t more : {0, 1}) {
      expect_lowest(side, level.max_macroblocks / side + more, kSlow);
      expect_lowest(longest + more, 1, kSlow);
      expect_lowest(1, longest + more, kSlow);
      expect_lowest(1, 1, {level.max_macroblocks_per_s + more, 1});
      expect_lowest(3, 1, {level.max_macroblocks_per_s + more, 3});
    }
  }
}

TEST(LevelProblem, SaysTheLimit) {
  EXPECT_TRUE(testing_support::contains(level_problem(16881, 16, {1, 1}), "16880 px"));
  EXPECT_EQ(level_problem(8194, 4352, {1, 1}),
            "8194x4352 are 139536 macroblocks of 16x16 pixels, more than the 139264 of level 6.2, "
            "the highest");
  EXPECT_EQ(level_problem(32, 16, {16'711'681, 2}),
            "2 macroblocks of 16x16 pixels in each of 16711681/2 frames a second are more than the "
            "16711680 a second of level 6.2, the highest");
}

/// C.1.1 and A.3.1, items c and d: a leaky bucket in exact fractions of bits.
class Bucket {
 public:
  Bucket(const Level& level, int size_mb, PictureRate rate)
      : capacity_(long(level.max_buffer_bits)),
        in_buffer_(capacity_),
        duration_(long(rate.denominator), long(rate.numerator)),
        compressed_bytes_(384, level.min_compression) {
    duration_.canonicalize();
    compressed_bytes_.canonicalize();
    refill_ = duration_ * long(level.max_rate_bps);
    limit_bytes_ = compressed_bytes_ * long(level.max_macroblocks_per_s) * duration_;
    const Rational least(long(level.max_macroblocks_per_s), level.idc < 60 ? 172L : 300L);
    first_limit_bytes_ = compressed_bytes_ * std::max(Rational(size_mb), Rational(least));
  }

  bool has_room_for(std::int64_t size_bytes) const {
    const Rational size(static_cast<long>(size_bytes));
    return 8 * size <= in_buffer_ && size <= (is_first_ ? first_limit_bytes_ : limit_bytes_);
  }
  bool take(std::int64_t size_bytes) {
    const bool is_kept = has_room_for(size_bytes);
    is_first_ = false;
    in_buffer_ -= 8 * Rational(static_cast<long>(size_bytes));
    if (in_buffer_ < 0) in_buffer_ = 0;
    in_buffer_ += refill_;
    if (in_buffer_ > capacity_) in_buffer_ = capacity_;
    return is_kept;
  }

 private:
  Rational capacity_;  // in bits
  Rational in_buffer_;
  Rational duration_;  // in seconds
  Rational compressed_bytes_;
  Rational refill_;
  Rational limit_bytes_;
  Rational first_limit_bytes_;
  bool is_first_ = true;
};

PictureRate random_rate(Random& random) {
  switch (random.integer(0, 5)) {
    case 0:
      return {60, 1};
    case 1:
      return {30000, 1001};
    case 2:
      return {24000, 1001};
    case 3:
      return {random.integer(1, 300), 1};
    case 4:
      return {random.integer(1, 1000), random.integer(1, 1000)};
    default:
      return {random.integer(1, kFast.numerator), random.integer(1, kFast.numerator)};
  }
}

/// Sizes that the buffer has exactly, nearly, or by far not.
TEST(RateWatch, IsAnExactLeakyBucket) {
  TracedRandom random(20);
  int kept = 0;
  int broken = 0;
  for (std::int64_t i = 0; i < many(600); ++i) {
    const Level& level = levels()[std::size_t(random.integer(0, std::ssize(levels()) - 1))];
    const PictureRate rate = random_rate(random);
    const auto size_mb = static_cast<int>(random.integer(1, level.max_macroblocks));
    RateWatch watch(level, size_mb, rate);
    Bucket bucket(level, size_mb, rate);
    const std::int64_t greed = random.integer(0, 4);
    for (int picture = 0; picture < 40; ++picture) {
      const std::int64_t room = watch.room_bytes();
      ASSERT_TRUE(bucket.has_room_for(room)) << level.idc << ", picture " << picture;
      ASSERT_FALSE(bucket.has_room_for(room + 1)) << level.idc << ", picture " << picture;
      std::int64_t size = room;
      if (greed > 0) size = random.integer(0, 2 + 2 * room / greed);
      if (random.integer(0, 20) == 0) size = room + random.integer(0, 1);
      const bool is_kept = bucket.take(size);
      ASSERT_EQ(watch.take(size), is_kept) << level.idc << ", picture " << picture;
      ++(is_kept ? kept : broken);
    }
  }
  EXPECT_GT(kept, 1000);
  EXPECT_GT(broken, 1000);
}

TEST(RateWatch, HasAFullBufferAtFirstAndALittleMoreWithEveryPicture) {
  // Level 2.0: 2,000,000 bits, and as many a second. MinCR 2 allows much more at one a second.
  RateWatch watch(level_with(20), 396, {10, 1});
  EXPECT_EQ(watch.room_bytes(), 192 * 396);
  EXPECT_TRUE(watch.take(192 * 396));
  EXPECT_EQ(watch.room_bytes(), 250'000 - 192 * 396 + 25'000);
  EXPECT_TRUE(watch.take(watch.room_bytes()));
  EXPECT_EQ(watch.room_bytes(), 25'000);
  EXPECT_FALSE(watch.take(1'000'000));
  EXPECT_EQ(watch.room_bytes(), 25'000);
  for (int i = 0; i < 100; ++i) EXPECT_TRUE(watch.take(0));
  EXPECT_EQ(watch.room_bytes(), 192 * 1188);
}

/// 384 bytes a macroblock, by MinCR; of the first picture, for as many macroblocks as it has, or as
/// the level has in 1/172 s, from level 6 on in 1/300 s.
TEST(RateWatch, AsksForTheLeastCompression) {
  const auto first = [](int idc, int size_mb, PictureRate rate) {
    return RateWatch(level_with(idc), size_mb, rate).room_bytes();
  };
  const auto second = [](int idc, int size_mb, PictureRate rate) {
    RateWatch watch(level_with(idc), size_mb, rate);
    watch.take(0);
    return watch.room_bytes();
  };
  EXPECT_EQ(first(20, 1, {60, 1}), 13'261);  // 192 * 11880 / 172
  EXPECT_EQ(first(20, 100, {60, 1}), 19'200);
  EXPECT_EQ(first(60, 1, {60, 1}), 192 * 4'177'920 / 300);
  EXPECT_EQ(first(31, 3600, {30, 1}), 96 * 3600);
  EXPECT_EQ(first(62, 139'264, {1, 1}), 192 * 139'264);
  EXPECT_EQ(second(20, 1, {60, 1}), 192 * 198);
  EXPECT_EQ(second(31, 1, {30, 1}), 96 * 3600);
  EXPECT_EQ(second(41, 8160, {30, 1}), 192 * 8192);
  EXPECT_EQ(second(20, 1, {11'880, 1}), 192);
  EXPECT_EQ(second(62, 1, {16'711'680, 1}), 192);
  EXPECT_EQ(second(62, 1, kFast), 1);
  EXPECT_EQ(second(62, 1, kSlow), 100'000'000) << "the whole buffer";
}

/// Rates and sizes at their ends: nothing overflows (the sanitizers would say so).
TEST(RateWatch, TakesTheLargestNumbers) {
  for (const Level& level : levels()) {
    for (const PictureRate rate : {kSlow, kFast, PictureRate{kFast.numerator, kFast.numerator}}) {
      RateWatch watch(level, static_cast<int>(level.max_macroblocks), rate);
      for (const std::int64_t size : {std::int64_t{0}, std::numeric_limits<std::int64_t>::max(),
                                      std::int64_t{1}, level.max_buffer_bits, watch.room_bytes()}) {
        watch.take(size);
        EXPECT_GE(watch.room_bytes(), 0);
        EXPECT_LE(8 * watch.room_bytes(), level.max_buffer_bits);
      }
    }
  }
}

TEST(LevelWatch, IsTheLowestLevelThatNeverBreaks) {
  TracedRandom random(62);
  std::set<int> seen;
  for (std::int64_t i = 0; i < many(500); ++i) {
    const auto width_px = static_cast<int>(random.integer(1, 2000));
    const auto height_px = static_cast<int>(random.integer(1, 2000));
    const PictureRate rate = {random.integer(1, 120), random.integer(1, 4)};
    const int size_mb = ((width_px + 15) / 16) * ((height_px + 15) / 16);
    const std::int64_t most_bytes = random.integer(1, std::int64_t{1} << random.integer(1, 26));
    std::vector<std::int64_t> sizes;
    const bool is_high = random.integer(0, 1) == 1;
    LevelWatch watch(width_px, height_px, rate, is_high ? 100 : 66);
    EXPECT_EQ(watch.level(), lowest_level(width_px, height_px, rate));
    for (int picture = 0; picture < 30; ++picture) {
      sizes.push_back(random.integer(0, most_bytes));
      watch.take(sizes.back());
    }
    const Level* lowest = nullptr;
    for (const Level& level : levels()) {
      if (lowest != nullptr || !holds(level, width_px, height_px, rate)) continue;
      // Table A-2: cpbBrVclFactor is 1250 of the High profile, else 1000.
      Level limits = level;
      limits.max_rate_bps = level.max_rate_bps / 1000 * (is_high ? 1250 : 1000);
      limits.max_buffer_bits = level.max_buffer_bits / 1000 * (is_high ? 1250 : 1000);
      RateWatch single(limits, size_mb, rate);
      bool never_breaks = true;
      for (const std::int64_t size : sizes) never_breaks = single.take(size) && never_breaks;
      if (never_breaks) lowest = &level;
    }
    ASSERT_EQ(watch.level(), lowest);
    seen.insert(lowest == nullptr ? 0 : lowest->idc);
  }
  EXPECT_GT(seen.size(), 10u);
  EXPECT_TRUE(seen.contains(0));
}

TEST(LevelWatch, HasNoneForWhatNoLevelHolds) {
  LevelWatch watch(16881, 16, {1, 1}, 66);
  EXPECT_EQ(watch.level(), nullptr);
  watch.take(1);
  EXPECT_EQ(watch.level(), nullptr);
}

}  // namespace
}  // namespace piblocks::h264
