// Levels whose rate does not suffice: coarser quantisers, and how the pictures after them recover.
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "h264/callers_picture.hpp"
#include "h264/deviation_bound.hpp"
#include "h264/encoder.hpp"
#include "h264/levels.hpp"
#include "h264/random_pictures.hpp"
#include "h264/stream_fixture.hpp"
#include "support/property.hpp"

namespace piblocks::h264 {
namespace {

/// Encodes a stream and checks each picture: the level, the decoded samples, and what the encoder
/// reports of the picture.
class CheckedStream {
 public:
  explicit CheckedStream(const Config& config)
      : config_(config),
        encoder_(config),
        picture_(config.width_px, config.height_px),
        watch_(level_of(encoder_), size_mb(config),
               {config.rate_numerator, config.rate_denominator}),
        decoder_({encoder_.headers().begin(), encoder_.headers().end()}) {}

  CallersPicture& picture() { return picture_; }
  const Bytes& unit() const { return unit_; }
  void set_noise(Random& random) {
    picture_.set([&](int, int, int) { return random.integer(0, 255); });
  }
  void set_black_or_white(Random& random) {
    picture_.set([&](int, int, int) { return 255 * random.integer(0, 1); });
  }

  CodedPicture encode(PictureType type = PictureType::p) {
    const Rect all = {0, 0, config_.width_px, config_.height_px};
    const CodedPicture coded = encoder_.encode(picture_.planes(), {&all, 1}, type, unit_);
    EXPECT_GE(coded.qp, config_.qp);
    EXPECT_LE(coded.qp, kMaxQp);
    EXPECT_EQ(watch_.take(std::ssize(unit_)), coded.is_within_level);
    EXPECT_TRUE(coded.is_within_level || coded.qp == kMaxQp);
    EXPECT_TRUE(coded.coarse_macroblocks > 0 || coded.qp == config_.qp);
    EXPECT_LE(coded.coarse_macroblocks, size_mb(config_));
    if (coded.coarse_macroblocks == 0) coarsest_qp_ = config_.qp;
    coarsest_qp_ = std::max(coarsest_qp_, coded.qp);
    const auto shown = decoder_.decode(unit_);
    EXPECT_TRUE(shown);
    if (shown) {
      EXPECT_EQ(
          excess(picture_.planes(), config_.width_px, config_.height_px, *shown, coarsest_qp_), "");
    }
    return coded;
  }

  static int size_mb(const Config& config) {
    return ((config.width_px + 15) / 16) * ((config.height_px + 15) / 16);
  }

 private:
  static const Level& level_of(const Encoder& encoder) {
    return *std::ranges::find(levels(), encoder.level_idc(), &Level::idc);
  }

  Config config_;
  Encoder encoder_;
  CallersPicture picture_;
  int coarsest_qp_ = config_.qp;  // of what is shown
  RateWatch watch_;
  StrictDecoder decoder_;
  Bytes unit_;
};

/// Level 2.0 holds it, with 2 Mbit/s.
Config noisy_config(int qp) {
  return {.width_px = 352, .height_px = 288, .rate_numerator = 30, .qp = qp, .level_idc = 20};
}

class EncoderRate : public testing::TestWithParam<int> {};

TEST_P(EncoderRate, IsKeptByCoarserQuantisersOrSaidToBeBroken) {
  Random random(20);
  SCOPED_TRACE(random.trace());
  CheckedStream stream(noisy_config(GetParam()));
  int within = 0;
  int above = 0;
  for (int i = 0; i < 8; ++i) {
    stream.set_noise(random);
    const CodedPicture coded = stream.encode(i % 3 == 2 ? PictureType::idr : PictureType::p);
    EXPECT_GT(coded.qp, GetParam());
    EXPECT_EQ(coded.coarse_macroblocks, 396);
    ++(coded.is_within_level ? within : above);
  }
  // The buffer has 250,000 bytes, and gets 8,342 with every picture. At QP 41, noise has 55,000.
  EXPECT_GE(within, 3);
  EXPECT_GE(above, 3);
}

/// As many pictures as the bits take: 152,064 bytes in I_PCM, by 8,342 a picture, and as many again
/// since half of what is spare is kept.
TEST_P(EncoderRate, IsGivenToWhatIsCoarseOnceTheNoiseStops) {
  Random random(21);
  SCOPED_TRACE(random.trace());
  CheckedStream stream(noisy_config(GetParam()));
  for (int i = 0; i < 6; ++i) {
    stream.set_noise(random);
    stream.encode();
  }
  int left = 396;
  int pictures = 0;
  for (; left > 0 && pictures < 60; ++pictures) {
    const CodedPicture coded = stream.encode();
    EXPECT_EQ(coded.qp, GetParam());
    EXPECT_TRUE(coded.is_within_level);
    EXPECT_LT(coded.coarse_macroblocks, left);
    left = coded.coarse_macroblocks;
  }
  EXPECT_EQ(left, 0);
  EXPECT_LE(pictures, 36);
  // Then there is nothing to do.
  EXPECT_EQ(stream.encode().coarse_macroblocks, 0);
  EXPECT_LE(stream.unit().size(), 12u);
}

/// Something moves on while the rest is corrected.
TEST_P(EncoderRate, IsSharedByWhatChangesAndWhatIsCoarse) {
  Random random(22);
  SCOPED_TRACE(random.trace());
  CheckedStream stream(noisy_config(GetParam()));
  for (int i = 0; i < 6; ++i) {
    stream.set_black_or_white(random);
    stream.encode();
  }
  int left = 396;
  for (int i = 0; i < 80; ++i) {
    for (int y = 100; y < 130; ++y) {
      std::fill_n(stream.picture().row(0, y) + 2 * i, 40, std::uint8_t(i % 2 == 0 ? 235 : 16));
    }
    const CodedPicture coded = stream.encode();
    EXPECT_EQ(coded.qp, GetParam());
    EXPECT_TRUE(coded.is_within_level);
    left = coded.coarse_macroblocks;
  }
  EXPECT_EQ(left, 0);
}

/// A few macroblocks cost much more than what all that wait cost on average.
TEST_P(EncoderRate, IsNotExceededByCorrectionsThatCostMoreThanOthers) {
  Random random(28);
  SCOPED_TRACE(random.trace());
  CheckedStream stream(noisy_config(GetParam()));
  for (int i = 0; i < 6; ++i) {
    stream.set_noise(random);
    stream.encode();
  }
  stream.picture().set([&](int plane, int, int y) {
    return y < (plane == 0 ? 32 : 16) ? random.integer(0, 255) : random.integer(120, 123);
  });
  int left = stream.encode().coarse_macroblocks;
  EXPECT_EQ(left, 396);
  for (int i = 0; i < 60; ++i) {
    const CodedPicture coded = stream.encode();
    EXPECT_TRUE(coded.is_within_level);
    left = coded.coarse_macroblocks;
  }
  EXPECT_EQ(left, 0);
}

/// The bytes of a key frame at the config's quantiser are those of a new encoder.
TEST_P(EncoderRate, LeavesNoTraceInKeyFrames) {
  Random random(23);
  SCOPED_TRACE(random.trace());
  Config config = noisy_config(GetParam());
  CheckedStream stream(config);
  for (const PictureType last : {PictureType::p, PictureType::idr}) {
    for (int i = 0; i < 3; ++i) {
      stream.set_noise(random);
      EXPECT_GT(stream.encode(i == 2 ? last : PictureType::p).coarse_macroblocks, 0);
    }
    // The buffer fills while little is to be seen.
    stream.picture().set([](int plane, int x, int y) { return 16 + x / 4 + y / 4 + 9 * plane; });
    int left = 396;
    for (int i = 0; i < 100 && left > 0; ++i) left = stream.encode().coarse_macroblocks;
    EXPECT_EQ(left, 0);
    const CodedPicture coded = stream.encode(PictureType::idr);
    EXPECT_EQ(coded.coarse_macroblocks, 0);
    Bytes unit;
    Encoder(config).encode(stream.picture().planes(), {}, PictureType::idr, unit);
    EXPECT_EQ(stream.unit().size(), unit.size()) << "they differ in idr_pic_id";
  }
}

INSTANTIATE_TEST_SUITE_P(Quantisers, EncoderRate, testing::Values(0, 14, 26),
                         [](const auto& test) { return "Qp" + std::to_string(test.param); });

/// A rate that no quantiser keeps: 192 bytes a picture by MinCR, and 21 by MaxBR.
TEST(EncoderRateOfTinyPictures, IsSaidToBeBrokenAndRecovers) {
  Random random(24);
  SCOPED_TRACE(random.trace());
  CheckedStream stream(
      {.width_px = 16, .height_px = 16, .rate_numerator = 11'880, .qp = 0, .level_idc = 20});
  int above = 0;
  for (int i = 0; i < 2500; ++i) {
    stream.set_black_or_white(random);
    above += stream.encode().is_within_level ? 0 : 1;
  }
  EXPECT_GT(above, 100);
  stream.picture().set([](int, int, int) { return 90; });
  CodedPicture coded = stream.encode();
  for (int i = 0; i < 100 && coded.coarse_macroblocks > 0; ++i) coded = stream.encode();
  EXPECT_EQ(coded.coarse_macroblocks, 0);
  EXPECT_TRUE(coded.is_within_level);
}

/// What is encoded again, once or more: decoders show what the encoder believes, also after it; and
/// key frames are those of an encoder that has never done so.
TEST(EncodeAgain, LeavesTheDecodersInStep) {
  Random random(25);
  SCOPED_TRACE(random.trace());
  constexpr int kQp = 10;
  const StreamHeaders headers({.width_px = 112, .height_px = 80});
  PictureEncoder encoder = headers.encoder(kQp);
  StrictDecoder decoder(headers.bytes);
  RandomPictures pictures(headers.sets.width_mb, headers.sets.height_mb, random);
  bool was_idr = false;
  for (std::int64_t i = 0; i < many(400); ++i) {
    const bool is_idr = i == 0 || random.integer(0, 6) == 0;
    if (i > 0) pictures.advance();
    // Adjacent ones differ in idr_pic_id, unless a stream begins anew.
    const bool is_new = is_idr && !was_idr;
    was_idr = is_idr;
    if (is_new) encoder.restart();
    Bytes unit = is_idr ? encoded_idr(encoder, pictures.picture())
                        : encoded_p(encoder, pictures.picture(), pictures.changed());
    if (is_new) {
      PictureEncoder fresh = headers.encoder(kQp);
      ASSERT_EQ(unit, encoded_idr(fresh, pictures.picture())) << i;
    }
    const int waiting = is_idr ? 0 : encoder.waiting();
    for (std::int64_t times = random.integer(0, 3); times > 0; --times) {
      const auto corrections = static_cast<int>(random.integer(0, 1 + waiting));
      encoder.encode_again(static_cast<int>(random.integer(kQp, kMaxQp)), corrections, unit);
      EXPECT_EQ(is_idr ? 0 : encoder.waiting(), waiting);
    }
    const auto shown = decoder.decode(unit);
    ASSERT_TRUE(shown) << i;
    ASSERT_EQ(difference(encoder.decoded(), *shown), "") << i;
  }
}

/// The same quantiser and all corrections: the same bytes, if nothing moves.
TEST(EncodeAgain, ByTheSameQuantiserMakesTheSameKeyFrame) {
  Random random(26);
  SCOPED_TRACE(random.trace());
  const StreamHeaders headers({.width_px = 64, .height_px = 48});
  RandomPictures pictures(headers.sets.width_mb, headers.sets.height_mb, random);
  PictureEncoder encoder = headers.encoder(14);
  for (int i = 0; i < 20; ++i) {
    pictures.advance();
    const Bytes first = encoded_idr(encoder, pictures.picture());
    Bytes again;
    encoder.encode_again(30, 0, again);
    EXPECT_EQ(encoder.coarse_macroblocks(), 12);
    encoder.encode_again(14, 0, again);
    EXPECT_EQ(again, first);
    EXPECT_EQ(encoder.coarse_macroblocks(), 0);
  }
}

/// Corrections are counted, one by one.
TEST(EncodeAgain, CorrectsAsManyMacroblocksAsAreAskedFor) {
  Random random(27);
  SCOPED_TRACE(random.trace());
  const StreamHeaders headers({.width_px = 64, .height_px = 48});
  Picture picture(4, 3);
  for (int plane = 0; plane < 3; ++plane) {
    for (int i = 0; i < 12 * side_of(plane) * side_of(plane); ++i) {
      picture.plane(plane)[i] = static_cast<std::uint8_t>(random.integer(0, 255));
    }
  }
  PictureEncoder encoder = headers.encoder(14);
  MacroblockSet none(4, 3);
  MacroblockSet one(4, 3);
  one.add_one(5);
  Bytes unit = encoded_idr(encoder, picture);
  encoder.encode_again(30, 0, unit);
  encoded_p(encoder, picture, none);
  EXPECT_EQ(encoder.waiting(), 12);
  EXPECT_EQ(encoder.coarse_macroblocks(), 0) << "all are coded again";
  for (const int corrections : {0, 5, 11, 12, 100}) {
    encoder.encode_again(14, corrections, unit);
    EXPECT_EQ(encoder.coarse_macroblocks(), std::max(0, 12 - corrections));
  }
  encoder.encode_again(14, 5, unit);
  picture.plane(0)[16 * 64 + 16] ^= 64;  // in macroblock 5, which is still coarse
  encoded_p(encoder, picture, one);
  EXPECT_EQ(encoder.waiting(), 6);
  EXPECT_EQ(encoder.coarse_macroblocks(), 0);
  encoder.encode_again(14, 0, unit);
  EXPECT_EQ(encoder.coarse_macroblocks(), 6);
  encoder.encode_again(14, 2, unit);
  EXPECT_EQ(encoder.coarse_macroblocks(), 4) << "what changes is not counted";
  encoder.encode_again(20, 2, unit);
  EXPECT_EQ(encoder.coarse_macroblocks(), 7);
}

}  // namespace
}  // namespace piblocks::h264
