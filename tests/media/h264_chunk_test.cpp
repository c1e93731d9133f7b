// Chunks that are coded from what changes, as the product makes them.
#include "media/mp4/h264_chunk.hpp"

#include <gtest/gtest.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <utility>

#include "h264/stream_fixture.hpp"
#include "media/pixels/yuv.hpp"
#include "media/write_frames.hpp"
#include "support/decode_video.hpp"
#include "support/temporary_folder.hpp"
#include "support/traced_random.hpp"

namespace piblocks {

// For EXPECT_EQ of chunks.
bool operator==(const Packet& a, const Packet& b) {
  return a.bytes == b.bytes && a.pts == b.pts && a.dts == b.dts && a.key_frame == b.key_frame;
}
void PrintTo(const Packet& packet, std::ostream* out) {
  *out << "packet " << packet.pts << " of " << packet.bytes.size() << " bytes";
}

namespace {
using testing_support::Pixels;
using testing_support::TemporaryFolder;

const VideoFormat kFormat = {.width_px = 640, .height_px = 360, .frame_rate = 30};
constexpr std::int64_t kFramesPerChunk = 30;
const EncoderSettings kBuiltin = {.encoder = "builtin"};
const EncoderSettings kLibx264 = {.encoder = "libx264"};
constexpr int kLargestError = 10;

/// The numbers of the key frames.
std::vector<std::int64_t> key_frames(const EncodedChunk& chunk) {
  std::vector<std::int64_t> numbers;
  for (const Packet& packet : chunk) {
    if (packet.key_frame) numbers.push_back(packet.pts);
  }
  return numbers;
}

/// The frames of the first chunk are random.
PaintFrame random_then_article(const VideoFormat& format) {
  return [format](std::int64_t number) {
    return number < kFramesPerChunk ? random_frames(format)(number)
                                    : article_frames(format)(number);
  };
}

/// The largest difference between a shown and a drawn sample.
int largest_error(const Pixels& drawn, const h264::ShownPicture& shown) {
  h264::Picture wanted((drawn.width_px + 15) / 16, (drawn.height_px + 15) / 16);
  const auto view = [&](int number) -> PlaneView<std::uint8_t> {
    return {wanted.plane(number), wanted.stride_bytes(number)};
  };
  convert_to_yuv420(drawn.view(), {0, 0, drawn.width_px, drawn.height_px},
                    {view(0), view(1), view(2)});
  int largest = 0;
  for (int plane = 0; plane < 3; ++plane) {
    const auto at = static_cast<std::size_t>(plane);
    const int step = plane == 0 ? 1 : 2;
    for (int y = 0; y < drawn.height_px / step; ++y) {
      for (int x = 0; x < drawn.width_px / step; ++x) {
        const int a = wanted.plane(plane)[y * wanted.stride_bytes(plane) + x];
        const int b = shown.planes[at][y * shown.strides[at] + x];
        largest = std::max(largest, std::abs(a - b));
      }
    }
  }
  return largest;
}

class BuiltinChunkTest : public testing::Test {
 protected:
  void SetUp() override {
    if (encoder_names(EncoderKind::h264).empty() ||
        encoder_names(EncoderKind::h264).front() != "builtin") {
      GTEST_SKIP() << "the headers are libx264's";
    }
  }

  Output output(const EncoderSettings& settings, const VideoFormat& format = kFormat) const {
    return set_up_output(folder_ / "x.mp4", format, settings);
  }
  EncodedChunk first_chunk(const EncoderSettings& settings, const PaintFrame& paint) const {
    return encode_chunk(output(settings), 0, kFramesPerChunk, paint);
  }

  TemporaryFolder folder_;
};

TEST_F(BuiltinChunkTest, IsWhatAnMp4GetsUnlessToldOtherwise) {
  const EncodedChunk chunk = first_chunk({}, article_frames(kFormat));
  EXPECT_EQ(chunk, first_chunk(kBuiltin, article_frames(kFormat)));
  EXPECT_NE(chunk, first_chunk(kLibx264, article_frames(kFormat)));
  EXPECT_NE(output({}).signature, output(kLibx264).signature);
}

TEST_F(BuiltinChunkTest, BeginsWithItsOnlyKeyFrame) {
  for (const std::int64_t first : {std::int64_t{0}, 5 * kFramesPerChunk}) {
    const auto made =
        encode_chunk(output({}), first, first + kFramesPerChunk, article_frames(kFormat));
    ASSERT_EQ(made.size(), std::size_t{kFramesPerChunk});
    EXPECT_EQ(key_frames(made), std::vector{first});
    for (std::size_t i = 0; i < made.size(); ++i) {
      EXPECT_EQ(made[i].pts, first + static_cast<std::int64_t>(i));
      EXPECT_EQ(made[i].dts, made[i].pts);
    }
  }
}

TEST_F(BuiltinChunkTest, LeavesTheRestOfAChunkThatIsAllNewToTheStreamsEncoder) {
  const EncodedChunk chunk = first_chunk({}, random_frames(kFormat));
  ASSERT_EQ(chunk.size(), std::size_t{kFramesPerChunk});
  // 920 macroblocks in each of three pictures are more than 64 in each of thirty.
  EXPECT_EQ(key_frames(chunk), (std::vector<std::int64_t>{0, 4}));
  EXPECT_TRUE(std::ranges::equal(chunk, first_chunk(kLibx264, random_frames(kFormat)), {},
                                 &Packet::pts, &Packet::pts));
  const EncodedChunk forced = first_chunk(kBuiltin, random_frames(kFormat));
  EXPECT_EQ(forced.size(), std::size_t{kFramesPerChunk});
  EXPECT_EQ(key_frames(forced), (std::vector<std::int64_t>{0}));
}

TEST_F(BuiltinChunkTest, DependsOnTheFramesOfTheChunkAlone) {
  for (const PaintFrame& paint : {article_frames(kFormat), random_then_article(kFormat)}) {
    for (const EncoderSettings& settings : {EncoderSettings{}, kBuiltin}) {
      const auto made = output(settings);
      const auto encoder = made.make_encoder();
      for (const std::int64_t first : {std::int64_t{0}, kFramesPerChunk}) {
        const std::int64_t end = first + kFramesPerChunk;
        EXPECT_EQ(encode_chunk(made, *encoder, first, end, paint),
                  encode_chunk(made, first, end, paint))
            << "chunk at " << first;
      }
    }
  }
}

/// Frames in which rectangles change, often enough to leave a chunk to the stream's encoder.
class ChangingFrame {
 public:
  ChangingFrame(const VideoFormat& format, Random& random)
      : random_(random), pixels_(format.width_px, format.height_px) {}

  const Pixels& pixels() const { return pixels_; }

  std::vector<PixelRect> change() {
    std::vector<PixelRect> rects(static_cast<std::size_t>(random_.integer(0, 3)));
    for (PixelRect& rect : rects) {
      rect.x_px = pick(0, pixels_.width_px - 1);
      rect.y_px = pick(0, pixels_.height_px - 1);
      rect.width_px = pick(1, std::min(40, pixels_.width_px - rect.x_px));
      rect.height_px = pick(1, std::min(40, pixels_.height_px - rect.y_px));
      if (pick(0, 1) == 0) rect = {0, 0, pixels_.width_px, pixels_.height_px};
      fill(rect);
    }
    return rects;
  }

 private:
  int pick(int first, int last) { return static_cast<int>(random_.integer(first, last)); }

  /// Fills a rectangle with one colour or with many.
  void fill(const PixelRect& rect) {
    const bool is_flat = pick(0, 1) > 0;
    int colour = pick(0, 0xffffff);
    for (int y = rect.y_px; y < rect.bottom_px(); ++y) {
      for (int x = rect.x_px; x < rect.right_px(); ++x) {
        if (!is_flat) colour = pick(0, 0xffffff);
        pixels_.at(x, y) = 0xff000000U | static_cast<std::uint32_t>(colour);
      }
    }
  }

  Random& random_;
  Pixels pixels_;
};

/// Of frames, in pixels.
using Size = std::pair<int, int>;

class BuiltinChunkSizeTest : public BuiltinChunkTest, public testing::WithParamInterface<Size> {};

TEST_P(BuiltinChunkSizeTest, ShowsWhatWasDrawnFromTheRegionAlone) {
  constexpr int kChunks = 6;
  const auto [width_px, height_px] = GetParam();
  const VideoFormat format = {.width_px = width_px, .height_px = height_px, .frame_rate = 30};
  const h264::StreamHeaders headers(h264::Config{.width_px = width_px, .height_px = height_px});
  TracedRandom random(11);
  for (const EncoderSettings& settings : {EncoderSettings{}, kBuiltin}) {
    const auto made = output(settings, format);
    const auto encoder = made.make_encoder();
    h264::StrictDecoder decoder(headers.bytes);
    ChangingFrame frame(format, random);
    int handed_over = 0;  // and followed by a chunk that lacks what happened meanwhile
    for (int chunk = 0; chunk < kChunks; ++chunk) {
      std::vector<Pixels> drawn;
      encoder->begin(chunk * kFramesPerChunk);
      for (int i = 0; i < kFramesPerChunk; ++i) {
        std::vector<PixelRect> changed = frame.change();
        if (chunk == 0 && i == 0) changed = {{0, 0, format.width_px, format.height_px}};
        encoder->take(frame.pixels().view(), changed);
        encoder->encode();
        drawn.push_back(frame.pixels());
      }
      const EncodedChunk packets = encoder->finish();
      ASSERT_EQ(packets.size(), drawn.size());
      if (chunk + 1 < kChunks && key_frames(packets).size() > 1) ++handed_over;
      for (std::size_t i = 0; i < drawn.size(); ++i) {
        const auto shown = decoder.decode(packets[i].bytes);
        ASSERT_TRUE(shown) << "frame " << i << " of chunk " << chunk;
        ASSERT_LE(largest_error(drawn[i], *shown), kLargestError)
            << "frame " << i << " of chunk " << chunk;
      }
    }
    EXPECT_EQ(handed_over > 0, format.width_px > 300 && !settings.encoder);
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, BuiltinChunkSizeTest,
                         testing::Values(Size{2, 2}, Size{4, 2}, Size{16, 16}, Size{18, 30},
                                         Size{322, 180}, Size{334, 178}));

// The margin up to whole macroblocks is not shown, and should cost nothing.
TEST_F(BuiltinChunkTest, SpendsNothingOnWhatLiesBeyondThePicture) {
  const auto grey_frames = [&](int width_px, int height_px) {
    const VideoFormat format = {.width_px = width_px, .height_px = height_px, .frame_rate = 30};
    const auto paint = [&](std::int64_t number) {
      Pixels pixels(width_px, height_px);
      std::ranges::fill(pixels.words, 0xff000000 | 0x101010 * static_cast<std::uint32_t>(number));
      return pixels;
    };
    return encode_chunk(output(kBuiltin, format), 0, 10, paint);
  };
  const EncodedChunk whole = grey_frames(48, 32);
  EXPECT_EQ(grey_frames(34, 18), whole);
  EXPECT_EQ(grey_frames(46, 32), whole);
  EXPECT_EQ(grey_frames(48, 30), whole);
}

TEST_F(BuiltinChunkTest, LeavesStreamsOfChosenQualityToTheStreamsEncoder) {
  const auto chunk = [&](const EncoderSettings& settings) {
    return first_chunk(settings, article_frames(kFormat));
  };
  EXPECT_EQ(chunk({.crf = 20}), chunk({.crf = 20, .encoder = "libx264"}));
  EXPECT_EQ(chunk({.preset = "ultrafast"}), chunk({.preset = "ultrafast", .encoder = "libx264"}));
  EXPECT_EQ(chunk({.preset = "medium"}), chunk({.preset = "medium", .encoder = "libx264"}));
}

}  // namespace
}  // namespace piblocks
