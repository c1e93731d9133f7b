// Motion vectors: prediction by clause 8.4 of ITU-T H.264, and what the search finds.
#include "h264/motion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "h264/picture_encoder.hpp"
#include "h264/stream_fixture.hpp"
#include "support/traced_random.hpp"

namespace piblocks::h264 {
namespace {

MacroblockState inter(MotionVector vector) {
  MacroblockState state;
  state.vector = vector;
  return state;
}

MacroblockState intra() {
  MacroblockState state;
  state.is_intra = true;
  return state;
}

const MacroblockState kStays = inter({0, 0});
const MacroblockState kRight = inter({8, 0});
const MacroblockState kFarRight = inter({20, -4});
const MacroblockState kUp = inter({2, -6});
const MacroblockState kIntra = intra();

TEST(PredictedVector, IsTheMedianOfThree) {
  EXPECT_EQ(predicted_vector({&kRight, &kFarRight, &kUp}), (MotionVector{8, -4}));
  EXPECT_EQ(predicted_vector({&kStays, &kStays, &kUp}), (MotionVector{0, 0}));
}

TEST(PredictedVector, IsThatOfTheOnlyInterMacroblock) {
  EXPECT_EQ(predicted_vector({&kIntra, &kIntra, &kUp}), kUp.vector);
  EXPECT_EQ(predicted_vector({&kRight, &kIntra, nullptr}), kRight.vector);
  EXPECT_EQ(predicted_vector({nullptr, &kFarRight, nullptr}), kFarRight.vector);
}

TEST(PredictedVector, TakesOthersThanInterAsZero) {
  EXPECT_EQ(predicted_vector({&kRight, &kIntra, &kFarRight}), (MotionVector{8, 0}));
  EXPECT_EQ(predicted_vector({&kIntra, &kIntra, &kIntra}), MotionVector{});
  EXPECT_EQ(predicted_vector({nullptr, nullptr, nullptr}), MotionVector{});
}

TEST(SkipVector, IsZeroAtTheEdgesAndBesideWhatStays) {
  EXPECT_EQ(skip_vector({nullptr, &kRight, &kRight}), MotionVector{});
  EXPECT_EQ(skip_vector({&kRight, nullptr, &kRight}), MotionVector{});
  EXPECT_EQ(skip_vector({&kRight, &kStays, &kRight}), MotionVector{});
  EXPECT_EQ(skip_vector({&kStays, &kRight, &kRight}), MotionVector{});
  EXPECT_EQ(skip_vector({&kIntra, &kRight, &kIntra}), kRight.vector);
  EXPECT_EQ(skip_vector({&kRight, &kRight, &kUp}), kRight.vector);
}

Picture noise_picture(Random& random, int width_mb, int height_mb) {
  Picture picture(width_mb, height_mb);
  for (int plane = 0; plane < 3; ++plane) {
    const std::ptrdiff_t count = picture.stride_bytes(plane) * side_of(plane) * height_mb;
    std::generate_n(picture.plane(plane), count, [&] { return random.byte(); });
  }
  return picture;
}

/// A sample of the picture whose edges go on for ever.
int sample(const Picture& picture, int plane, int x, int y) {
  const int side = side_of(plane);
  const int column = std::clamp(x, 0, side * picture.width_mb() - 1);
  const int row = std::clamp(y, 0, side * picture.height_mb() - 1);
  return picture.plane(plane)[row * picture.stride_bytes(plane) + column];
}

/// 8.4.2.2.2, by a vector in eighths of a chroma sample.
int chroma_sample(const Picture& picture, int plane, int x, int y, MotionVector eighths) {
  const int left = x + (eighths.x >> 3);
  const int top = y + (eighths.y >> 3);
  const int fx = eighths.x & 7;
  const int fy = eighths.y & 7;
  return ((8 - fx) * (8 - fy) * sample(picture, plane, left, top) +
          fx * (8 - fy) * sample(picture, plane, left + 1, top) +
          (8 - fx) * fy * sample(picture, plane, left, top + 1) +
          fx * fy * sample(picture, plane, left + 1, top + 1) + 32) >>
         6;
}

TEST(PredictMoved, IsInterPredictionInsideAndOutsideThePicture) {
  TracedRandom random(84);
  const auto pick = [&](int first, int last) {
    return static_cast<int>(random.integer(first, last));
  };
  for (std::int64_t i = 0; i < many(300); ++i) {
    const Picture before = noise_picture(random, pick(1, 5), pick(1, 4));
    const int x_mb = pick(0, before.width_mb() - 1);
    const int y_mb = pick(0, before.height_mb() - 1);
    const MotionVector vector = {pick(-70, 70), pick(-70, 70)};
    Samples samples;
    predict_moved(before, x_mb, y_mb, vector, samples);
    for (int at = 0; at < 256; ++at) {
      ASSERT_EQ(samples.plane(0)[at],
                sample(before, 0, 16 * x_mb + at % 16 + vector.x, 16 * y_mb + at / 16 + vector.y));
    }
    // A quarter of a luma sample is an eighth of a chroma sample.
    const MotionVector eighths = {4 * vector.x, 4 * vector.y};
    for (int plane = 1; plane < 3; ++plane) {
      for (int at = 0; at < 64; ++at) {
        ASSERT_EQ(samples.plane(plane)[at],
                  chroma_sample(before, plane, 8 * x_mb + at % 8, 8 * y_mb + at / 8, eighths));
      }
    }
  }
}

/// Beside macroblocks that stay.
const MacroblockState kSkipped;
const Neighbours kBesideStill = {&kSkipped, &kSkipped, &kSkipped};

TEST(MotionSearch, FindsWhatSlidOrScrolled) {
  TracedRandom random(16);
  const Picture before = noise_picture(random, 8, 8);
  for (const MotionVector moved :
       {MotionVector{3, 0}, {-17, 0}, {48, 0}, {0, 1}, {0, -48}, {16, 0}, {-1, 0}}) {
    Samples source;
    predict_moved(before, 4, 4, moved, source);
    MotionSearch search(14);
    EXPECT_EQ(search.find(source, before, 4, 4, kBesideStill), moved) << moved.x << ", " << moved.y;
  }
}

TEST(MotionSearch, FindsNothingInNoiseAndAfterFailuresGoesOnWithTheNextPicture) {
  TracedRandom random(61);
  const Picture before = noise_picture(random, 8, 8);
  Samples other;
  noise_picture(random, 8, 8).load(1, 1, other);
  Samples slid;
  predict_moved(before, 4, 4, {9, 0}, slid);
  Samples crept;
  predict_moved(before, 4, 4, {0, -8}, crept);
  MotionSearch search(14);
  for (int i = 0; i < 20; ++i) EXPECT_FALSE(search.find(other, before, 4, 4, kBesideStill));
  EXPECT_FALSE(search.find(slid, before, 4, 4, kBesideStill)) << "it has given up for this picture";
  EXPECT_EQ(search.find(crept, before, 4, 4, kBesideStill), (MotionVector{0, -8}));
  search.begin_picture(0);
  EXPECT_EQ(search.find(slid, before, 4, 4, kBesideStill), (MotionVector{9, 0}));
}

TEST(MotionSearch, GoesFarWhereMuchHasChanged) {
  TracedRandom random(3);
  const Picture before = noise_picture(random, 3, 20);
  Samples other;
  noise_picture(random, 3, 20).load(1, 1, other);
  for (const int changed : {0, 640}) {
    MotionSearch search(14);
    search.begin_picture(changed);
    for (int i = 0; i < 10; ++i) EXPECT_FALSE(search.find(other, before, 1, 4, kBesideStill));
    Samples source;
    predict_moved(before, 1, 4, {0, 100}, source);
    EXPECT_EQ(search.find(source, before, 1, 4, kBesideStill).has_value(), changed > 0) << changed;
  }
}

TEST(MotionSearch, TakesWhatACoarserQuantiserLeavesForTheSame) {
  TracedRandom random(4);
  const Picture before = noise_picture(random, 8, 8);
  Samples source;
  predict_moved(before, 4, 4, {5, 0}, source);
  for (int i = 0; i < 256; ++i) source.plane(0)[i] ^= 4;  // a sum of 1024
  EXPECT_FALSE(MotionSearch(14).find(source, before, 4, 4, kBesideStill));
  EXPECT_EQ(MotionSearch(26).find(source, before, 4, 4, kBesideStill), (MotionVector{5, 0}));
}

TEST(MotionSearch, StaysWithinTheRangeOfAllLevelsWhereMotionSpeedsUp) {
  TracedRandom random(48);
  const Picture before = noise_picture(random, 3, 28);
  MotionSearch search(14);
  for (int distance = 40; distance <= 140; ++distance) {
    Samples source;
    predict_moved(before, 1, 10, {0, distance}, source);
    search.begin_picture(0);
    const auto found = search.find(source, before, 1, 10, kBesideStill);
    EXPECT_EQ(found.has_value(), distance <= 120) << distance;
  }
}

/// Writing on flat ground: squares of two samples, dark or not, with their left edge at `x`.
void write(Picture& picture, MacroblockSet& changed, int x) {
  constexpr int kWidth = 96;
  constexpr int kHeight = 32;
  for (int plane = 0; plane < 3; ++plane) {
    const int step = plane == 0 ? 1 : 2;
    const std::ptrdiff_t stride = picture.stride_bytes(plane);
    std::fill_n(picture.plane(plane), stride * side_of(plane) * picture.height_mb(),
                plane == 0 ? 120 : 90);
    for (int row = 0; row < kHeight / step; ++row) {
      for (int column = 0; column < kWidth / step; ++column) {
        const int square = (column * step / 2) * 7919 + (row * step / 2) * 104'729;
        std::uint8_t* const at = picture.plane(plane) + (row + 32 / step) * stride;
        if (square % 5 < 2) at[column + x / step] = plane == 0 ? 16 : 128;
      }
    }
  }
  add(changed, 0, 32, 16 * picture.width_mb(), kHeight);
}

TEST(Motion, OfWritingCostsATenthOfTheWriting) {
  const StreamHeaders headers({.width_px = 320, .height_px = 96});
  Picture picture(headers.width_mb, headers.height_mb);
  MacroblockSet changed(headers.width_mb, headers.height_mb);
  PictureEncoder encoder(headers.config);
  StrictDecoder decoder(headers.bytes);
  write(picture, changed, 20);
  const auto first = encoded_idr(encoder, picture);
  ASSERT_TRUE(decoder.decode(first));
  for (int frame = 1; frame < 10; ++frame) {
    write(picture, changed, 20 + 6 * frame);
    const auto next = encoded_p(encoder, picture, changed);
    const auto shown = decoder.decode(next);
    ASSERT_TRUE(shown);
    ASSERT_EQ(difference(encoder.decoded(), *shown), "") << frame;
    EXPECT_LT(next.size(), first.size() / 10) << frame;
  }
}

/// A window of noise on grey, whose noise has its corner at (x, y).
void draw_window(Picture& picture, const Picture& noise, const Rect& window, int x, int y) {
  for (int plane = 0; plane < 3; ++plane) {
    const int step = plane == 0 ? 1 : 2;
    const std::ptrdiff_t stride = picture.stride_bytes(plane);
    std::fill_n(picture.plane(plane), stride * side_of(plane) * picture.height_mb(), 128);
    for (int row = 0; row < window.height_px / step; ++row) {
      std::memcpy(picture.plane(plane) + (window.y_px / step + row) * stride + window.x_px / step,
                  noise.plane(plane) + (y / step + row) * noise.stride_bytes(plane) + x / step,
                  static_cast<std::size_t>(window.width_px / step));
    }
  }
}

TEST(Motion, FollowsLargeWindowsThatScrollFarOrAreDragged) {
  TracedRandom random(66);
  const Picture texture = noise_picture(random, 60, 60);
  const StreamHeaders headers({.width_px = 640, .height_px = 480});
  PictureEncoder encoder(headers.config);
  StrictDecoder decoder(headers.bytes);
  Picture picture(headers.width_mb, headers.height_mb);
  struct Step {
    Rect window;
    int x, y;
  };
  std::size_t first_bytes = 0;
  for (const auto& [window, x, y] :
       {Step{{32, 32, 512, 384}, 0, 0}, Step{{32, 32, 512, 384}, 0, 66},
        Step{{32, 32, 512, 384}, 100, 66}, Step{{32, 32, 512, 384}, 100, 186},
        Step{{42, 20, 512, 384}, 100, 186}, Step{{66, 44, 512, 384}, 100, 186}}) {
    draw_window(picture, texture, window, x, y);
    const bool is_first = first_bytes == 0;
    MacroblockSet all(picture.width_mb(), picture.height_mb());
    add(all, 0, 0, 640, 480);
    const Bytes unit = is_first ? encoded_idr(encoder, picture) : encoded_p(encoder, picture, all);
    if (is_first) first_bytes = unit.size();
    const auto shown = decoder.decode(unit);
    ASSERT_TRUE(shown);
    ASSERT_EQ(difference(encoder.decoded(), *shown), "") << x << ", " << y;
    if (!is_first) {
      EXPECT_LT(unit.size(), first_bytes / 2) << x << ", " << y;
    }
  }
}

TEST(Motion, LeavesWhatIsMarkedAndDoesNotChangeAlone) {
  const StreamHeaders headers({.width_px = 320, .height_px = 96, .qp = 38});
  Picture picture(headers.width_mb, headers.height_mb);
  MacroblockSet changed(headers.width_mb, headers.height_mb);
  PictureEncoder encoder(headers.config);  // so coarse that some samples are far off
  write(picture, changed, 20);
  encoded_idr(encoder, picture);
  EXPECT_LE(encoded_p(encoder, picture, changed).size(), 12U);
}

}  // namespace
}  // namespace piblocks::h264
