// The headers of a stream of our own: what libavcodec makes of them. The hashes of films hold every
// bit.
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "h264/callers_picture.hpp"
#include "h264/encoder.hpp"
#include "media/libav/av.hpp"
#include "support/decode_video.hpp"

namespace piblocks::h264 {
namespace {

std::vector<Config> configs() {
  return {
      {.width_px = 2, .height_px = 2},
      {.width_px = 1920, .height_px = 1080},
      {.width_px = 1920, .height_px = 1088, .rate_numerator = 30000, .rate_denominator = 1001},
      {.width_px = 34, .height_px = 64, .rate_numerator = 1, .rate_denominator = 256, .qp = 0},
      {.width_px = 64, .height_px = 46, .rate_numerator = 7, .qp = 41},
      {.width_px = 352, .height_px = 288, .rate_numerator = 30, .qp = 26},
      {.width_px = 18,
       .height_px = 18,
       .rate_numerator = 1,
       .rate_denominator = 2147483647,
       .qp = 27},
  };
}

TEST(EncoderHeaders, AreUnderstoodByLibavcodec) {
  for (const Config& config : configs()) {
    SCOPED_TRACE(config.width_px);
    Encoder encoder(config);
    const CallersPicture picture(config.width_px, config.height_px);
    std::vector<std::uint8_t> unit;
    encoder.take(picture.planes(), {0, 0, config.width_px, config.height_px});
    encoder.encode(PictureType::idr, unit);
    // In the stream, as in a file .h264.
    unit.insert(unit.begin(), encoder.headers().begin(), encoder.headers().end());
    const auto size = static_cast<int>(unit.size());
    unit.resize(unit.size() + AV_INPUT_BUFFER_PADDING_SIZE);
    const AVCodec* const codec = avcodec_find_decoder(AV_CODEC_ID_H264);
    const auto context = own_av<AvCodecContextPtr>(avcodec_alloc_context3(codec), "decoder");
    context->err_recognition = AV_EF_EXPLODE | AV_EF_COMPLIANT | AV_EF_AGGRESSIVE;
    check_av(avcodec_open2(context.get(), codec, nullptr), "open", "decoder");
    const auto packet = own_av<AvPacketPtr>(av_packet_alloc(), "packet");
    const auto frame = own_av<AvFramePtr>(av_frame_alloc(), "frame");
    packet->data = unit.data();
    packet->size = size;
    check_av(avcodec_send_packet(context.get(), packet.get()), "decode", "picture");
    check_av(avcodec_send_packet(context.get(), nullptr), "end", "stream");
    check_av(avcodec_receive_frame(context.get(), frame.get()), "decode", "picture");
    EXPECT_EQ(context->profile, FF_PROFILE_H264_CONSTRAINED_BASELINE);
    EXPECT_EQ(context->level, encoder.level_idc());
    EXPECT_EQ(context->has_b_frames, 0);
    EXPECT_EQ(context->refs, 1);
    const double rate = double(config.rate_numerator) / double(config.rate_denominator);
    // libavcodec rounds to terms of 30 bits.
    EXPECT_NEAR(av_q2d(context->framerate), rate, 1e-9 * (1 + rate));
    EXPECT_EQ(frame->width, config.width_px);
    EXPECT_EQ(frame->height, config.height_px);
    EXPECT_EQ(frame->format, AV_PIX_FMT_YUV420P);
    EXPECT_TRUE(testing_support::is_key_frame(*frame));
    EXPECT_EQ(frame->sample_aspect_ratio.num, 1);
    EXPECT_EQ(frame->sample_aspect_ratio.den, 1);
    EXPECT_EQ(frame->color_range, AVCOL_RANGE_MPEG);
    EXPECT_EQ(frame->colorspace, AVCOL_SPC_BT709);
    EXPECT_EQ(frame->color_primaries, AVCOL_PRI_BT709);
    EXPECT_EQ(frame->color_trc, AVCOL_TRC_BT709);
    EXPECT_EQ(frame->chroma_location, AVCHROMA_LOC_LEFT);
  }
}

}  // namespace
}  // namespace piblocks::h264
