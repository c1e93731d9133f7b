// The public encoder: what it refuses, and what its bytes do and do not depend on.
#include "h264/encoder.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "h264/bit_stream.hpp"
#include "h264/callers_picture.hpp"
#include "h264/deviation_bound.hpp"
#include "h264/nal_unit.hpp"
#include "h264/random_pictures.hpp"
#include "h264/stream_fixture.hpp"
#include "support/message_of.hpp"
#include "support/property.hpp"

namespace piblocks::h264 {
namespace {

constexpr int kMostInt = std::numeric_limits<int>::max();

std::string problem_of(const Config& config) {
  return testing_support::message_of<Error>([&] { Encoder{config}; });
}

void expect_refused(const Config& config, const std::string& problem) {
  EXPECT_EQ(problem_of(config), "h264: " + problem);
}

TEST(EncoderConfig, IsRefusedByItsFieldAndLimits) {
  Config config = {.width_px = 64, .height_px = 48};
  const auto refuses = [&](auto Config::*field, auto value, const std::string& problem) {
    Config other = config;
    other.*field = value;
    expect_refused(other, problem);
  };
  refuses(&Config::width_px, 0, "width_px is 0, not in [2, 16880]");
  refuses(&Config::width_px, 1, "width_px is 1, not in [2, 16880]");
  refuses(&Config::width_px, -64, "width_px is -64, not in [2, 16880]");
  refuses(&Config::width_px, 16882, "width_px is 16882, not in [2, 16880]");
  refuses(&Config::width_px, kMostInt, "width_px is 2147483647, not in [2, 16880]");
  refuses(&Config::width_px, 63, "width_px is 63, which is odd");
  refuses(&Config::height_px, 0, "height_px is 0, not in [2, 16880]");
  refuses(&Config::height_px, 16881, "height_px is 16881, not in [2, 16880]");
  refuses(&Config::height_px, 49, "height_px is 49, which is odd");
  for (const std::int64_t term : {std::int64_t{0}, std::int64_t{-1}, std::int64_t{1} << 31,
                                  std::numeric_limits<std::int64_t>::max()}) {
    const std::string is = " is " + std::to_string(term) + ", not in [1, 2147483647]";
    refuses(&Config::rate_numerator, term, "rate_numerator" + is);
    refuses(&Config::rate_denominator, term, "rate_denominator" + is);
  }
  refuses(&Config::qp, -1, "qp is -1, not in [0, 41]");
  refuses(&Config::qp, 42, "qp is 42, not in [0, 41]");
  EXPECT_EQ(problem_of(config), "");
}

TEST(EncoderConfig, HasTheLowestLevelThatHoldsIt) {
  EXPECT_EQ(Encoder({.width_px = 1920, .height_px = 1080, .rate_numerator = 60}).level_idc(), 42);
  EXPECT_EQ(Encoder({.width_px = 1920, .height_px = 1080, .rate_numerator = 30}).level_idc(), 40);
  EXPECT_EQ(Encoder({.width_px = 16, .height_px = 16}).level_idc(), 20);
}

/// The largest of what a process has had in memory.
long peak_kb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss;
}

TEST(EncoderConfig, ThatNoLevelHoldsIsRefusedBeforeAnythingLargeIsAllocated) {
  const long before_kb = peak_kb();
  expect_refused({.width_px = 16880, .height_px = 16880},
                 "16880x16880 are 1113025 macroblocks of 16x16 pixels, more than the 139264 of "
                 "level 6.2, the highest");
  expect_refused({.width_px = 8192, .height_px = 4352, .rate_numerator = 121},
                 "139264 macroblocks of 16x16 pixels in each of 121 frames a second are more than "
                 "the 16711680 a second of level 6.2, the highest");
  EXPECT_LT(peak_kb() - before_kb, 20'000);
}

/// Noise of a seed.
CallersPicture noise(const Config& config, std::uint64_t seed, int padding_bytes = 0) {
  Random random(seed);
  CallersPicture picture(config.width_px, config.height_px, padding_bytes);
  picture.set([&](int, int, int) { return random.integer(0, 255); });
  return picture;
}

std::vector<Rect> whole(const Config& config) {
  return {{0, 0, config.width_px, config.height_px}};
}

Bytes headers_of(const Encoder& encoder) {
  return {encoder.headers().begin(), encoder.headers().end()};
}

Bytes key_frame_of(const Config& config, const Planes& picture) {
  Encoder encoder(config);
  Bytes unit;
  encode(encoder, picture, whole(config), PictureType::idr, unit);
  return unit;
}

TEST(Encoder, MakesTheFirstPictureAKeyFrame) {
  const Config config = {.width_px = 70, .height_px = 38};
  const CallersPicture picture = noise(config, 1);
  Encoder encoder(config);
  Bytes unit;
  const CodedPicture coded = encode(encoder, picture.planes(), whole(config), PictureType::p, unit);
  EXPECT_EQ(coded.type, PictureType::idr);
  EXPECT_EQ(coded.transformed_macroblocks, 0);
  EXPECT_EQ(unit, key_frame_of(config, picture.planes()));
  StrictDecoder decoder(headers_of(encoder));
  const auto shown = decoder.decode(unit);
  ASSERT_TRUE(shown);
  EXPECT_EQ(excess(picture.planes(), config.width_px, config.height_px, *shown, config.qp), "");
  // The next is what was asked for.
  EXPECT_EQ(encoder.encode(PictureType::p, unit).type, PictureType::p);
  EXPECT_LE(unit.size(), 12u);
}

/// The units of a stream whose picture changes in a square, of which these rectangles are taken.
std::vector<Bytes> units_told(const Config& config, const std::vector<Rect>& rects) {
  Encoder encoder(config);
  CallersPicture picture = noise(config, 2);
  std::vector<Bytes> units(4);
  encode(encoder, picture.planes(), whole(config), PictureType::idr, units[0]);
  for (std::size_t i = 1; i < units.size(); ++i) {
    for (int y = 20; y < 30; ++y) std::fill_n(picture.row(0, y) + 36, 10, std::uint8_t(50 * i));
    encode(encoder, picture.planes(), rects, i == 2 ? PictureType::idr : PictureType::p, units[i]);
  }
  return units;
}

TEST(Encoder, MakesTheSameBytesHoweverCoarseTheRectanglesAre) {
  constexpr int kMostEven = kMostInt - 1;
  const Config config = {.width_px = 70, .height_px = 38};
  const std::vector<Bytes> expected = units_told(config, {{36, 20, 10, 10}});
  const std::vector<std::vector<Rect>> others = {
      {{34, 18, 14, 12}},
      {{36, 20, 4, 10}, {40, 20, 6, 10}, {36, 20, 10, 10}},
      {{36, 20, 10, 2}, {36, 22, 10, 6}, {36, 28, 10, 2}},
      whole(config),
      {{0, 0, 1000, 1000}},
      {{0, 0, kMostEven, kMostEven}},
      {{36, 20, kMostEven, kMostEven}},
      // What is empty or outside says nothing.
      {{36, 20, 10, 10}, {0, 0, 0, 4}, {70, 0, 4, 4}, {2, 38, 4, 4}, {70, 38, kMostEven, 2}}};
  for (const std::vector<Rect>& rects : others) {
    EXPECT_EQ(units_told(config, rects), expected) << &rects - others.data();
  }
}

TEST(Encoder, LeavesWhatIsInNoRectangle) {
  const Config config = {.width_px = 70, .height_px = 38};
  const std::vector<Bytes> units =
      units_told(config, {{0, 0, 0, 4}, {0, 0, 36, 38}, {46, 0, 24, 38}, {0, 38, 70, 10}});
  EXPECT_LE(units[1].size(), 12u);
  EXPECT_EQ(units[2].size(), units[0].size()) << "as the first, but for idr_pic_id";
  EXPECT_LE(units[3].size(), 12u);
}

TEST(Encoder, RefusesPartsWithoutSamplesOrOfOddPlacesAndGoesOn) {
  const Config config = {.width_px = 36, .height_px = 20};
  const CallersPicture picture = noise(config, 3);
  Encoder encoder(config);
  for (Plane Planes::*const plane : {&Planes::y, &Planes::cb, &Planes::cr}) {
    Planes planes = picture.planes();
    (planes.*plane).samples = nullptr;
    EXPECT_THROW(encoder.take(planes, {0, 0, 36, 20}), Error);
  }
  for (const Rect& rect : {Rect{1, 0, 2, 2},
                           {0, 3, 2, 2},
                           {0, 0, 5, 2},
                           {0, 0, 2, kMostInt},
                           {-2, 0, 2, 2},
                           {0, -kMostInt - 1, 2, 2},
                           {0, 0, -4, 2}}) {
    EXPECT_THROW(encoder.take(picture.planes(), rect), Error);
  }
  Bytes unit;
  encode(encoder, picture.planes(), whole(config), PictureType::p, unit);
  EXPECT_EQ(unit, key_frame_of(config, picture.planes()));
}

TEST(Encoder, TakesRowsHoweverFarApartAndEitherWay) {
  const Config config = {.width_px = 52, .height_px = 36};
  const CallersPicture dense = noise(config, 4);
  const Bytes expected = key_frame_of(config, dense.planes());
  for (const int padding_bytes : {1, 12, 77}) {
    CallersPicture wide(config.width_px, config.height_px, padding_bytes);
    wide.set([&](int plane, int x, int y) { return dense.row(plane, y)[x]; });
    wide.set_padding(std::uint8_t(padding_bytes));
    EXPECT_EQ(key_frame_of(config, wide.planes()), expected) << padding_bytes;
  }
  CallersPicture upside_down(config.width_px, config.height_px, 6);
  upside_down.set(
      [&](int plane, int x, int y) { return dense.row(plane, dense.height(plane) - 1 - y)[x]; });
  const auto last_row = [&](int plane) -> Plane {
    return {upside_down.row(plane, dense.height(plane) - 1), -upside_down.stride_bytes(plane)};
  };
  EXPECT_EQ(key_frame_of(config, {last_row(0), last_row(1), last_row(2)}), expected);
}

/// The last column and row are repeated, as here by hand.
TEST(Encoder, ExtendsPicturesOfNoWholeMacroblocks) {
  for (const auto& [width, height] :
       {std::pair(2, 2), {2, 50}, {30, 4}, {18, 14}, {64, 46}, {62, 48}}) {
    const Config config = {.width_px = width, .height_px = height};
    const int width_mb = macroblocks_along(width);
    const int height_mb = macroblocks_along(height);
    Picture extended(width_mb, height_mb);
    PictureEncoder by_hand({.width_px = 16 * width_mb, .height_px = 16 * height_mb});
    MacroblockSet all(width_mb, height_mb);
    add(all, 0, 0, 16 * width_mb, 16 * height_mb);
    Encoder encoder(config);
    for (std::uint64_t i = 0; i < 4; ++i) {
      const CallersPicture picture = noise(config, i);
      for (int plane = 0; plane < 3; ++plane) {
        for (int y = 0; y < side_of(plane) * height_mb; ++y) {
          for (int x = 0; x < side_of(plane) * width_mb; ++x) {
            const std::uint8_t* const row =
                picture.row(plane, std::min(y, picture.height(plane) - 1));
            extended.plane(plane)[y * extended.stride_bytes(plane) + x] =
                row[std::min(x, picture.width(plane) - 1)];
          }
        }
      }
      Bytes unit;
      encode(encoder, picture.planes(), whole(config), i == 0 ? PictureType::idr : PictureType::p,
             unit);
      EXPECT_EQ(unit, i == 0 ? encoded_idr(by_hand, extended) : encoded_p(by_hand, extended, all))
          << width << 'x' << height << ", picture " << i;
    }
  }
}

/// The units of random pictures, always the same for a seed.
std::vector<Bytes> units_of(Encoder& encoder, const Config& config, std::uint64_t seed) {
  Random random(seed);
  RandomPictures pictures(macroblocks_along(config.width_px), macroblocks_along(config.height_px),
                          random);
  CallersPicture picture(config.width_px, config.height_px);
  std::vector<Bytes> units;
  for (int i = 0; i < 10; ++i) {
    if (i > 0) pictures.advance();
    picture.copy(pictures.picture());
    encode(encoder, picture.planes(), whole(config), i == 6 ? PictureType::idr : PictureType::p,
           units.emplace_back());
  }
  return units;
}

TEST(Encoder, BeginsAnewAsANewOneDoes) {
  const Config config = {.width_px = 100, .height_px = 68};
  Encoder used(config);
  for (std::uint64_t seed = 1; seed <= std::uint64_t(many(20)); ++seed) {
    Encoder fresh(config);
    used.restart();
    ASSERT_EQ(units_of(used, config, seed), units_of(fresh, config, seed)) << seed;
  }
}

TEST(Encoder, KeepsTheCallersBytesFromPictureToPicture) {
  const Config config = {.width_px = 64, .height_px = 48};
  Encoder encoder(config);
  Bytes unit;
  unit.reserve(10'000);
  const std::uint8_t* const begin = unit.data();
  for (std::uint64_t i = 0; i < 6; ++i) {
    const CallersPicture picture = noise(config, i);
    encode(encoder, picture.planes(), whole(config), PictureType::p, unit);
    EXPECT_EQ(unit.data(), begin);
    EXPECT_EQ(std::vector(unit.begin(), unit.begin() + 4), Bytes({0, 0, 0, 1}));
    EXPECT_EQ(read_units(unit).size(), 1u);
    EXPECT_EQ(unit[4], i == 0 ? 0x65 : 0x41);
  }
}

/// Consecutive IDR pictures differ in idr_pic_id (7.4.3), also where the stream begins anew.
TEST(Encoder, NumbersKeyFramesThatFollowEachOther) {
  const Config config = {.width_px = 96, .height_px = 80, .rate_numerator = 360, .qp = 4};
  Encoder encoder(config);
  std::uint32_t last = 1000;
  for (std::uint64_t i = 0; i < 8; ++i) {
    Bytes unit;
    if (i > 4) encoder.restart();
    encode(encoder, noise(config, i).planes(), whole(config), PictureType::idr, unit);
    const std::vector<Unit> units = read_units(unit);
    ASSERT_EQ(units.size(), 1u);
    EXPECT_EQ(units[0].type, 5);
    BitReader bits(units[0].rbsp);
    for (int field = 0; field < 3; ++field) bits.get_unsigned();  // up to the picture set's id
    EXPECT_EQ(bits.get(4), 0u) << "frame_num";
    const std::uint32_t id = bits.get_unsigned();
    EXPECT_NE(id, last);
    EXPECT_LE(id, 65535u);
    last = id;
  }
}

}  // namespace
}  // namespace piblocks::h264
