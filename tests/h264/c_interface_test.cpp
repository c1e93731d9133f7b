// The encoder as C calls it: the same bytes, and what goes wrong as texts.
#include "h264/c_interface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "h264/callers_picture.hpp"
#include "h264/encoder.hpp"
#include "h264/h264.h"

namespace piblocks::h264 {
namespace {

using Bytes = std::vector<std::uint8_t>;

struct Close {
  void operator()(piblocks_h264_encoder* encoder) const { piblocks_h264_close(encoder); }
};
using EncoderPtr = std::unique_ptr<piblocks_h264_encoder, Close>;

EncoderPtr open(const piblocks_h264_config& config) {
  return EncoderPtr(piblocks_h264_open(&config, nullptr, 0));
}

using ThreePlanes = std::array<piblocks_h264_plane, 3>;
ThreePlanes planes_of(const CallersPicture& picture) {
  const auto plane = [&](int number) -> piblocks_h264_plane {
    return {picture.row(number, 0), picture.stride_bytes(number)};
  };
  return {plane(0), plane(1), plane(2)};
}

void append(Bytes& stream, std::span<const std::uint8_t> bytes) {
  stream.insert(stream.end(), bytes.begin(), bytes.end());
}

TEST(CInterface, MakesTheSameStreamInAProgramInC) {
  const Config config = {.width_px = 66, .height_px = 40};
  std::size_t size = 0;
  std::uint8_t* const bytes = encode_in_c(config.width_px, config.height_px, &size);
  ASSERT_NE(bytes, nullptr);
  const Bytes stream(bytes, bytes + size);
  std::free(bytes);

  Encoder encoder(config);
  CallersPicture picture(config.width_px, config.height_px);
  Bytes expected;
  append(expected, encoder.headers());
  for (int i = 0; i < 3; ++i) {
    picture.set([&](int plane, int x, int y) {
      if (plane > 0) return 128;
      return y < config.height_px / 2 && 4 * i <= x && x < 4 * i + 8 ? 16 : 235;
    });
    Bytes unit;
    const Rect changed = {4 * i, 0, 16, config.height_px / 2};
    encoder.encode(picture.planes(), {&changed, 1}, i == 2 ? PictureType::idr : PictureType::p,
                   unit);
    append(expected, unit);
  }
  EXPECT_EQ(stream, expected);
}

TEST(CInterface, HasTheDefaultsOfTheConfig) {
  const piblocks_h264_config config = piblocks_h264_default_config(320, 176);
  const Config expected = {.width_px = 320, .height_px = 176};
  EXPECT_EQ(config.width_px, expected.width_px);
  EXPECT_EQ(config.height_px, expected.height_px);
  EXPECT_EQ(config.rate_numerator, expected.rate_numerator);
  EXPECT_EQ(config.rate_denominator, expected.rate_denominator);
  EXPECT_EQ(config.qp, expected.qp);
  EXPECT_EQ(config.level_idc, expected.level_idc);
  EXPECT_EQ(piblocks_h264_max_unit_bytes(&config), Encoder::max_unit_bytes(expected));
}

TEST(CInterface, PassesOnEveryFieldOfTheConfig) {
  const piblocks_h264_config config = {.width_px = 34,
                                       .height_px = 18,
                                       .rate_numerator = 24000,
                                       .rate_denominator = 1001,
                                       .qp = 31,
                                       .level_idc = 40};
  const Encoder encoder({.width_px = 34,
                         .height_px = 18,
                         .rate_numerator = 24000,
                         .rate_denominator = 1001,
                         .qp = 31,
                         .level_idc = 40});
  Bytes headers(piblocks_h264_max_unit_bytes(&config));
  headers.resize(piblocks_h264_headers(open(config).get(), headers.data(), headers.size()));
  EXPECT_EQ(headers, Bytes(encoder.headers().begin(), encoder.headers().end()));
}

TEST(CInterface, SaysWhyThereIsNoEncoderInAsManyBytesAsThereAre) {
  const std::string problem = "h264: width_px is 3, which is odd";
  const piblocks_h264_config config = piblocks_h264_default_config(3, 2);
  EXPECT_EQ(piblocks_h264_max_unit_bytes(&config), 0u);
  EXPECT_EQ(piblocks_h264_open(&config, nullptr, 100), nullptr);
  for (std::size_t room = 0; room < problem.size() + 5; ++room) {
    std::vector<char> message(room + 1, '#');
    EXPECT_EQ(piblocks_h264_open(&config, message.data(), room), nullptr);
    EXPECT_EQ(message[room], '#') << "it wrote beyond the end";
    if (room > 0) {
      EXPECT_EQ(std::string(message.data()), problem.substr(0, room - 1));
    }
  }
  piblocks_h264_config low = piblocks_h264_default_config(1920, 1080);
  low.level_idc = 20;
  EXPECT_EQ(open(low), nullptr);
  EXPECT_EQ(piblocks_h264_max_unit_bytes(&low), 0u);
  low.level_idc = 7;
  EXPECT_EQ(piblocks_h264_max_unit_bytes(&low), 0u);
}

TEST(CInterface, ClosesNothingToo) { piblocks_h264_close(nullptr); }

/// A buffer that is too small: nothing is written, and the picture is not lost.
TEST(CInterface, RefusesBuffersThatAreTooSmallAndGoesOn) {
  const piblocks_h264_config config = piblocks_h264_default_config(32, 16);
  const EncoderPtr encoder = open(config);
  EXPECT_STREQ(piblocks_h264_problem(encoder.get()), "");
  const std::size_t most = piblocks_h264_max_unit_bytes(&config);
  EXPECT_EQ(most, 1296u);
  CallersPicture picture(32, 16);
  const ThreePlanes planes = planes_of(picture);
  Bytes unit(most, 0xee);
  const Bytes untouched = unit;
  const auto encode = [&](std::uint8_t* to, std::size_t room) {
    return piblocks_h264_encode(encoder.get(), planes.data(), nullptr, 0, 0, to, room);
  };
  EXPECT_EQ(encode(unit.data(), most - 1), 0u);
  EXPECT_STREQ(piblocks_h264_problem(encoder.get()),
               "h264: a unit may have 1296 bytes, the buffer has 1295");
  EXPECT_EQ(encode(nullptr, most), 0u);
  EXPECT_STREQ(piblocks_h264_problem(encoder.get()),
               "h264: a unit may have 1296 bytes, the buffer has 0");
  EXPECT_EQ(piblocks_h264_headers(encoder.get(), unit.data(), 5), 0u);
  EXPECT_NE(std::string(piblocks_h264_problem(encoder.get())).find("the buffer has 5"),
            std::string::npos);
  EXPECT_EQ(unit, untouched);

  // The first picture is still to come.
  const std::size_t size = encode(unit.data(), most);
  ASSERT_GT(size, 4u);
  EXPECT_EQ(unit[4], 0x65);
  picture.set([](int, int, int) { return 200; });
  const piblocks_h264_rect all = {0, 0, 32, 16};
  EXPECT_EQ(piblocks_h264_encode(encoder.get(), planes.data(), &all, 1, 0, unit.data(), 10), 0u);
  EXPECT_GT(piblocks_h264_encode(encoder.get(), planes.data(), nullptr, 0, 0, unit.data(), most),
            0u);
  EXPECT_EQ(unit[4], 0x41);
}

TEST(CInterface, RefusesPlanesWithoutSamples) {
  const piblocks_h264_config config = piblocks_h264_default_config(32, 16);
  const EncoderPtr encoder = open(config);
  Bytes unit(piblocks_h264_max_unit_bytes(&config));
  const CallersPicture picture(32, 16);
  for (std::size_t missing = 0; missing < 3; ++missing) {
    ThreePlanes planes = planes_of(picture);
    planes[missing].samples = nullptr;
    EXPECT_EQ(
        piblocks_h264_encode(encoder.get(), planes.data(), nullptr, 0, 1, unit.data(), unit.size()),
        0u);
    EXPECT_STREQ(piblocks_h264_problem(encoder.get()), "h264: a plane has no samples");
  }
}

}  // namespace
}  // namespace piblocks::h264
