// Whole pictures: what they cost, how good they are, and what they depend on.
#include "h264/picture_encoder.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "h264/bit_stream.hpp"
#include "h264/nal_unit.hpp"
#include "h264/random_pictures.hpp"
#include "h264/stream_fixture.hpp"
#include "media/pixels/yuv.hpp"
#include "support/article_frames.hpp"
#include "support/traced_random.hpp"

namespace piblocks::h264 {
namespace {
using testing_support::article_frame;
using testing_support::Pixels;

const Config kSmall = {.width_px = 320, .height_px = 176, .rate_numerator = 10};

/// Sets a rectangle of all planes to a value, and notes that it has changed.
void fill(Picture& picture, MacroblockSet& changed, const PixelRect& rect, std::uint8_t value) {
  for (int plane = 0; plane < 3; ++plane) {
    const int step = plane == 0 ? 1 : 2;
    for (int y = rect.y_px / step; y < (rect.bottom_px()) / step; ++y) {
      std::uint8_t* const row = picture.plane(plane) + y * picture.stride_bytes(plane);
      std::fill_n(row + rect.x_px / step, rect.width_px / step, value);
    }
  }
  add(changed, rect.x_px, rect.y_px, rect.width_px, rect.height_px);
}

void convert(const Pixels& pixels, Picture& picture) {
  const auto plane = [&](int number) -> PlaneView<std::uint8_t> {
    return {picture.plane(number), picture.stride_bytes(number)};
  };
  convert_to_yuv420(pixels.view(), {0, 0, pixels.width_px, pixels.height_px},
                    {plane(0), plane(1), plane(2)});
}

struct Deviation {
  double psnr_db;
  int largest;
};

Deviation deviation_of(const Picture& wanted, const Picture& shown) {
  double sum = 0;
  double count = 0;
  int largest = 0;
  for (int plane = 0; plane < 3; ++plane) {
    const std::ptrdiff_t samples = wanted.stride_bytes(plane) * wanted.height_mb() * side_of(plane);
    for (std::ptrdiff_t i = 0; i < samples; ++i) {
      const int difference = wanted.plane(plane)[i] - shown.plane(plane)[i];
      sum += difference * difference;
      largest = std::max(largest, std::abs(difference));
    }
    count += static_cast<double>(samples);
  }
  return {10 * std::log10(255 * 255 * count / std::max(sum, 1e-9)), largest};
}

class PictureEncoderTest : public testing::Test {
 protected:
  PictureEncoderTest()
      : headers_(kSmall),
        picture_(headers_.width_mb, headers_.height_mb),
        changed_(headers_.width_mb, headers_.height_mb) {
    fill(picture_, changed_, {0, 0, kSmall.width_px, kSmall.height_px}, 235);
    changed_.clear();
  }

  StreamHeaders headers_;
  Picture picture_;
  MacroblockSet changed_;
};

TEST_F(PictureEncoderTest, SpendsAFewBytesOnAPictureThatStays) {
  constexpr std::size_t kFewBytes = 12;  // with 5 of start code and header
  convert(article_frame(kSmall.width_px, kSmall.height_px, 0.5), picture_);
  PictureEncoder encoder(kSmall);
  encoded_idr(encoder, picture_);
  EXPECT_LE(encoded_p(encoder, picture_, changed_).size(), kFewBytes);
  EXPECT_EQ(encoder.transformed_macroblocks(), 0);

  // Also if all macroblocks are marked, but none changes.
  const Picture shown = encoder.decoded();
  add(changed_, 0, 0, kSmall.width_px, kSmall.height_px);
  EXPECT_LE(encoded_p(encoder, shown, changed_).size(), kFewBytes);
  EXPECT_EQ(encoder.transformed_macroblocks(), 0);
  EXPECT_EQ(deviation_of(shown, encoder.decoded()).largest, 0);
}

TEST_F(PictureEncoderTest, LeavesUnmarkedMacroblocksAlone) {
  PictureEncoder encoder(kSmall);
  encoded_idr(encoder, picture_);
  const Picture before = encoder.decoded();
  fill(picture_, changed_, {32, 32, 64, 64}, 100);
  changed_.clear();
  encoded_p(encoder, picture_, changed_);
  EXPECT_EQ(deviation_of(before, encoder.decoded()).largest, 0);
}

TEST_F(PictureEncoderTest, CountsWhatIsTransformed) {
  PictureEncoder encoder(kSmall);
  encoded_idr(encoder, picture_);
  fill(picture_, changed_, {36, 36, 8, 8}, 16);
  encoded_p(encoder, picture_, changed_);
  EXPECT_EQ(encoder.transformed_macroblocks(), 1);
  changed_.clear();
  fill(picture_, changed_, {32, 32, 16, 16}, 235);
  encoded_p(encoder, picture_, changed_);
  EXPECT_EQ(encoder.transformed_macroblocks(), 0) << "it is what is beside it";
}

/// The unit's type and its frame_num (7.3.3).
std::pair<int, int> number_of(const Bytes& access_unit) {
  const std::vector<Unit> units = read_units(access_unit);
  if (units.size() != 1) return {};
  BitReader bits(units[0].rbsp);
  bits.get_unsigned();                 // first_mb_in_slice
  bits.get_unsigned();                 // slice_type
  EXPECT_EQ(bits.get_unsigned(), 0U);  // pic_parameter_set_id
  return {units[0].type, static_cast<int>(bits.get(kFrameNum_bits))};
}

TEST_F(PictureEncoderTest, NumbersThePicturesOfEveryGroup) {
  using Number = std::pair<int, int>;
  const int numbers = 1 << kFrameNum_bits;
  PictureEncoder encoder(kSmall);
  for (const int pictures : {3, 2 * numbers + 1, 1, 2}) {
    EXPECT_EQ(number_of(encoded_idr(encoder, picture_)), Number(5, 0));
    for (int i = 1; i < pictures; ++i) {
      EXPECT_EQ(number_of(encoded_p(encoder, picture_, changed_)), Number(1, i % numbers));
    }
  }
}

TEST_F(PictureEncoderTest, GoesOnWhereFrameNumbersBeginAgain) {
  const int pictures = 300;
  PictureEncoder encoder(kSmall);
  StrictDecoder decoder(headers_.bytes);
  ASSERT_TRUE(decoder.decode(encoded_idr(encoder, picture_)));
  for (int i = 1; i < pictures; ++i) {
    changed_.clear();
    if (i % 3 > 0) {
      const PixelRect rect = {2 * (i % 140), 2 * (i % 70), 24, 18};
      fill(picture_, changed_, rect, static_cast<std::uint8_t>(i));
    }
    const auto shown = decoder.decode(encoded_p(encoder, picture_, changed_));
    ASSERT_TRUE(shown) << "picture " << i;
    ASSERT_EQ(difference(encoder.decoded(), *shown), "") << "picture " << i;
  }
}

TEST_F(PictureEncoderTest, KeepsFlatColoursExactWithinOne) {
  TracedRandom random(10);
  PictureEncoder encoder(kSmall);
  encoded_idr(encoder, picture_);
  for (int i = 0; i < 200; ++i) {
    changed_.clear();
    const PixelRect rect = {16 * static_cast<int>(random.integer(0, 15)),
                            16 * static_cast<int>(random.integer(0, 6)), 64, 64};
    fill(picture_, changed_, rect, random.byte());
    encoded_p(encoder, picture_, changed_);
    ASSERT_LE(deviation_of(picture_, encoder.decoded()).largest, 1) << i;
    encoded_idr(encoder, picture_);
    ASSERT_LE(deviation_of(picture_, encoder.decoded()).largest, 1) << i;
  }
}

TEST_F(PictureEncoderTest, ShowsWhatWasDrawn) {
  constexpr double kLeast_dB = 60;
  const Config format = {.width_px = 1280, .height_px = 720, .rate_numerator = 10};
  const StreamHeaders headers(format);
  Picture picture(headers.width_mb, headers.height_mb);
  MacroblockSet changed(headers.width_mb, headers.height_mb);
  add(changed, 0, 0, format.width_px, format.height_px);
  PictureEncoder encoder(format);
  for (int i = 0; i < 20; ++i) {
    convert(article_frame(format.width_px, format.height_px, i / 10.0), picture);
    i == 0 ? encoded_idr(encoder, picture) : encoded_p(encoder, picture, changed);
    const Deviation error = deviation_of(picture, encoder.decoded());
    EXPECT_GE(error.psnr_db, kLeast_dB) << i;
    EXPECT_LE(error.largest, 10) << i;
  }
}

/// A group of pictures, always the same for a seed.
Bytes encode_group(PictureEncoder& encoder, const StreamHeaders& headers, std::uint64_t seed) {
  Random random(seed);
  RandomPictures pictures(headers.width_mb, headers.height_mb, random);
  Bytes stream = encoded_idr(encoder, pictures.picture());
  for (int i = 1; i < 12; ++i) {
    pictures.advance();
    const Bytes unit = encoded_p(encoder, pictures.picture(), pictures.changed());
    stream.insert(stream.end(), unit.begin(), unit.end());
  }
  return stream;
}

TEST_F(PictureEncoderTest, MakesTheSameGroupAfterAnyOther) {
  PictureEncoder used(kSmall);
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    PictureEncoder fresh(kSmall);
    EXPECT_EQ(encode_group(used, headers_, seed), encode_group(fresh, headers_, seed)) << seed;
  }
}

TEST_F(PictureEncoderTest, MakesKeyFramesOfTheSameBytesWhetherItRemembersTheLastOrNot) {
  TracedRandom random(7);
  for (const int qp : {2, 14, 34}) {
    Config config = kSmall;
    config.qp = qp;
    RandomPictures pictures(headers_.width_mb, headers_.height_mb, random);
    PictureEncoder used(config);
    encoded_idr(used, pictures.picture());
    for (std::int64_t i = 0; i < many(40); ++i) {
      for (std::int64_t between = random.integer(1, 3); between > 0; --between) {
        pictures.advance();
        encoded_p(used, pictures.picture(), pictures.changed());
      }
      pictures.advance();
      PictureEncoder fresh(config);
      ASSERT_EQ(encoded_idr(used, pictures.picture(), pictures.changed()),
                encoded_idr(fresh, pictures.picture()))
          << i << " at QP " << qp;
      ASSERT_EQ(deviation_of(used.decoded(), fresh.decoded()).largest, 0);
    }
  }
}

}  // namespace
}  // namespace piblocks::h264
