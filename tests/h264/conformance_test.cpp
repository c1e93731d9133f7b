// Decoders show the encoder's decoded pictures, sample for sample.
#include <gtest/gtest.h>

#include <cstdlib>
#include <ostream>
#include <vector>

#include "h264/random_pictures.hpp"
#include "h264/stream_fixture.hpp"
#include "support/traced_random.hpp"
#ifdef PIBLOCKS_HAS_OPENH264
#include "h264/openh264_decoder.hpp"
#endif

namespace piblocks::h264 {
namespace {

struct Case {
  int width_px;
  int height_px;
  int first_qp;
  int last_qp;
};

std::ostream& operator<<(std::ostream& out, const Case& c) {
  return out << c.width_px << 'x' << c.height_px << " at QP " << c.first_qp << " to " << c.last_qp;
}

template <typename Decoder>
void expect_every_picture(const Case& c, int qp) {
  const std::int64_t groups = many(5);  // of pictures, in a stream
  constexpr int kFramesInGroup = 12;
  const StreamHeaders headers({.width_px = c.width_px, .height_px = c.height_px, .qp = qp});
  TracedRandom random(static_cast<std::uint64_t>(1000 * qp + c.width_px));
  RandomPictures pictures(headers.width_mb, headers.height_mb, random);
  PictureEncoder encoder(headers.config);
  Decoder decoder(headers.bytes);
  for (std::int64_t frame = 0; frame < groups * kFramesInGroup; ++frame) {
    if (frame > 0) pictures.advance();
    const auto unit = frame % kFramesInGroup == 0
                          ? encoded_idr(encoder, pictures.picture())
                          : encoded_p(encoder, pictures.picture(), pictures.changed());
    const auto shown = decoder.decode(unit);
    ASSERT_TRUE(shown) << "frame " << frame;
    ASSERT_GE(shown->width, c.width_px);
    ASSERT_GE(shown->height, c.height_px);
    ASSERT_EQ(difference(encoder.decoded(), *shown), "") << "frame " << frame;
  }
}

template <typename Decoder>
void expect_every_picture(const Case& c) {
  for (int qp = c.first_qp; qp <= c.last_qp; ++qp) {
    SCOPED_TRACE(qp);
    ASSERT_NO_FATAL_FAILURE(expect_every_picture<Decoder>(c, qp));
  }
}

class ConformanceTest : public testing::TestWithParam<Case> {};

TEST_P(ConformanceTest, LibavcodecShowsEveryPictureAsItWasMade) {
  expect_every_picture<StrictDecoder>(GetParam());
}

TEST_P(ConformanceTest, OpenH264ShowsEveryPictureAsItWasMade) {
#ifdef PIBLOCKS_HAS_OPENH264
  expect_every_picture<OpenH264Decoder>(GetParam());
#else
  GTEST_SKIP() << "openh264 (Debian package libopenh264-dev) was not there when this was built";
#endif
}

TEST(Conformance, LibavcodecShowsTheLargestDifferencesAsTheyWereMade) {
  constexpr int kSide_px = 64;
  TracedRandom random(255);
  for (int qp = 0; qp <= kMaxQp; ++qp) {
    const StreamHeaders headers({.width_px = kSide_px, .height_px = kSide_px, .qp = qp});
    PictureEncoder encoder(headers.config);
    StrictDecoder decoder(headers.bytes);
    Picture picture(headers.width_mb, headers.height_mb);
    MacroblockSet changed(headers.width_mb, headers.height_mb);
    for (int frame = 0; frame < 20; ++frame) {
      // Black and white in all luma, and the other way round in the next picture.
      for (int i = 0; i < kSide_px * kSide_px; ++i) {
        std::uint8_t& value = picture.plane(0)[i];
        value = frame % 2 == 1 ? static_cast<std::uint8_t>(255 - value)
                               : static_cast<std::uint8_t>(255 * random.integer(0, 1));
      }
      add(changed, 0, 0, kSide_px, kSide_px);
      const auto shown = decoder.decode(frame == 0 ? encoded_idr(encoder, picture)
                                                   : encoded_p(encoder, picture, changed));
      ASSERT_TRUE(shown) << "frame " << frame << " at QP " << qp;
      ASSERT_EQ(difference(encoder.decoded(), *shown), "") << "frame " << frame << " at QP " << qp;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, ConformanceTest,
                         testing::Values(Case{2, 2, 0, kMaxQp}, Case{250, 234, 0, kMaxQp},
                                         Case{1922, 1078, 14, 14}, Case{3840, 2160, 20, 20}));

}  // namespace
}  // namespace piblocks::h264
