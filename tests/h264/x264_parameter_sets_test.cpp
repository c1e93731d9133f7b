// Parameter sets as libx264 writes them through libavcodec.
#include <gtest/gtest.h>
#include <piblocks/error.hpp>

#include <string>
#include <utility>
#include <vector>

#include "h264/parameter_sets.hpp"
#include "h264/refused_stream.hpp"
#include "media/libav/av.hpp"

extern "C" {
#include <libavutil/opt.h>
}

namespace piblocks::h264 {
namespace {

using Bytes = std::vector<std::uint8_t>;
/// Names and values, in the order they are set in.
using Options = std::vector<std::pair<std::string, std::string>>;

Bytes headers_of(int width_px, int height_px, const Options& options) {
  const AVCodec* const codec = avcodec_find_encoder_by_name("libx264");
  auto context = own_av<AvCodecContextPtr>(avcodec_alloc_context3(codec), "libx264");
  context->width = width_px;
  context->height = height_px;
  context->pix_fmt = AV_PIX_FMT_YUV420P;
  context->time_base = {1, 60};
  context->thread_count = 1;
  context->flags = static_cast<int>(AV_CODEC_FLAG_GLOBAL_HEADER | AV_CODEC_FLAG_BITEXACT);
  for (const auto& [name, value] : options) {
    const int code = av_opt_set(context.get(), name.c_str(), value.c_str(), AV_OPT_SEARCH_CHILDREN);
    check_av(code, "set", name);
  }
  check_av(avcodec_open2(context.get(), codec, nullptr), "open encoder", "libx264");
  return {context->extradata, context->extradata + context->extradata_size};
}

class X264ParameterSets : public testing::Test {
 protected:
  void SetUp() override {
    silence_av();
    if (avcodec_find_encoder_by_name("libx264") == nullptr) GTEST_SKIP() << "there is no libx264";
  }

  static void expect_refused(const Options& options, const std::string& property) {
    EXPECT_EQ(problem_of(headers_of(64, 48, options)),
              "h264: cannot continue a stream with " + property);
  }
};

/// The numbers are those that libavcodec's trace_headers prints for these streams.
TEST_F(X264ParameterSets, OfTheFastestPresetAreAccepted) {
  struct Size {
    int width_px;
    int height_px;
    int width_mb;
    int height_mb;
  };
  for (const Size& size : {Size{1920, 1080, 120, 68}, Size{250, 234, 16, 15}, Size{2, 2, 1, 1}}) {
    const ParameterSets sets = read_parameter_sets(
        headers_of(size.width_px, size.height_px, {{"preset", "ultrafast"}, {"qp", "14"}}));
    EXPECT_EQ(sets.width_mb, size.width_mb);
    EXPECT_EQ(sets.height_mb, size.height_mb);
    EXPECT_EQ(sets.log2_max_frame_num, 4);
    EXPECT_EQ(sets.picture_parameter_set_id, 0u);
    EXPECT_FALSE(sets.overrides_reference_count);
    EXPECT_EQ(sets.initial_qp, 14);
    EXPECT_EQ(sets.chroma_qp_offset, 0);
  }
}

TEST_F(X264ParameterSets, OfOtherSettingsThatSuitAreAccepted) {
  const ParameterSets sets = read_parameter_sets(headers_of(64, 48,
                                                            {{"preset", "ultrafast"},
                                                             {"crf", "21"},
                                                             {"refs", "3"},
                                                             {"g", "600"},
                                                             {"chromaoffset", "-3"}}));
  EXPECT_TRUE(sets.overrides_reference_count);
  EXPECT_GE(sets.log2_max_frame_num, 4);
  EXPECT_EQ(sets.chroma_qp_offset, -3);
}

TEST_F(X264ParameterSets, OfSlowerPresetsAreRefusedByName) {
  for (const char* preset : {"superfast", "veryfast", "medium", "veryslow"}) {
    expect_refused({{"preset", preset}, {"qp", "14"}},
                   "picture order type 0 (as for B-frames and fields)");
  }
  // What else these presets use, one thing after the other switched off.
  Options options = {{"preset", "superfast"}, {"qp", "14"}, {"bf", "0"}};
  expect_refused(options, "CABAC");
  options.emplace_back("coder", "cavlc");
  expect_refused(options, "weighted prediction");
  options.emplace_back("weightp", "none");
  expect_refused(options, "8x8 transforms");
  options.emplace_back("8x8dct", "0");
  EXPECT_EQ(problem_of(headers_of(64, 48, options)), "accepted");
  options.emplace_back("flags", "+ildct");
  expect_refused(options, "picture order type 0 (as for B-frames and fields)");
}

TEST_F(X264ParameterSets, OfLosslessVideoAreRefused) {
  expect_refused({{"preset", "ultrafast"}, {"qp", "0"}}, "lossless macroblocks");
}

TEST_F(X264ParameterSets, EndingTooEarlyAreRefused) {
  const Bytes stream = headers_of(250, 234, {{"preset", "ultrafast"}, {"qp", "14"}});
  for (std::size_t size = 0; size < stream.size(); ++size) {
    const Bytes start(stream.begin(), stream.begin() + std::ptrdiff_t(size));
    EXPECT_NE(problem_of(start), "accepted") << size;
  }
}

}  // namespace
}  // namespace piblocks::h264
