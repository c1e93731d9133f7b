// Encoded sound is decoded at the same place.
#include "media/libav/sound_stream.hpp"

#include <gtest/gtest.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "support/contains.hpp"
#include "support/message_of.hpp"

namespace piblocks {
namespace {

constexpr std::int64_t kSize = 30000;

/// Decaying tones that do not begin at packets.
class Clacks final : public SampleSource {
 public:
  std::size_t read(std::span<float> samples) override {
    std::size_t count = 0;
    for (; 2 * count + 1 < samples.size() && at_ < kSize; ++count, ++at_) {
      const double age = double(at_ % 9973) - 3000;
      const double value = age < 0 ? 0 : std::exp(-age / 400) * std::sin(age * 0.3);
      samples[2 * count] = float(0.5 * value);
      samples[2 * count + 1] = float(-0.25 * value);
    }
    return count;
  }

 private:
  std::int64_t at_ = 0;
};

std::vector<float> left_of_original() {
  Clacks clacks;
  std::vector<float> samples(2 * kSize);
  clacks.read(samples);
  std::vector<float> left;
  for (std::size_t i = 0; i < samples.size(); i += 2) left.push_back(samples[i]);
  return left;
}

/// The left channel, each sample at the time of its packet.
std::vector<float> decoded_left(const SoundEncoder& encoder) {
  const AVCodec* const codec = avcodec_find_decoder(encoder.parameters().codec_id);
  auto context = own_av<AvCodecContextPtr>(avcodec_alloc_context3(codec), "decoder");
  avcodec_parameters_to_context(context.get(), &encoder.parameters());
  check_av(avcodec_open2(context.get(), codec, nullptr), "open", "decoder");
  const auto packet = own_av<AvPacketPtr>(av_packet_alloc(), "packet");
  const auto frame = own_av<AvFramePtr>(av_frame_alloc(), "frame");
  Clacks clacks;
  const auto packets = encoder.encode(clacks);
  std::vector<float> left(kSize);
  std::int64_t at = 0;
  bool is_first = true;
  while (auto coded = packets->next()) {
    // libavcodec's decoder of Opus itself drops what is before sample 0.
    if (is_first) at = codec->id == AV_CODEC_ID_OPUS ? 0 : coded->pts;
    is_first = false;
    av_new_packet(packet.get(), int(coded->bytes.size()));
    std::ranges::copy(coded->bytes, packet->data);
    avcodec_send_packet(context.get(), packet.get());
    av_packet_unref(packet.get());
    while (avcodec_receive_frame(context.get(), frame.get()) >= 0) {
      const auto* const samples = reinterpret_cast<const float*>(frame->data[0]);
      for (int i = 0; i < frame->nb_samples; ++i, ++at) {
        if (at >= 0 && at < kSize) left[std::size_t(at)] = samples[i];
      }
    }
  }
  return left;
}

double correlation(const std::vector<float>& one, const std::vector<float>& other, int lag) {
  double sum = 0;
  for (std::size_t i = 100; i + 100 < one.size(); ++i) {
    sum += double(one[i]) * double(other[std::size_t(std::int64_t(i) + lag)]);
  }
  return sum;
}

class SoundEncoderTest : public testing::TestWithParam<SoundCodec> {
 protected:
  void SetUp() override {
    if (avcodec_find_encoder_by_name(GetParam().name) == nullptr) GTEST_SKIP() << GetParam().name;
  }
};

TEST_P(SoundEncoderTest, KeepsEverySampleAtItsPlace) {
  const SoundEncoder encoder(GetParam(), {.rate_hz = 48000, .size = kSize});
  const std::vector<float> original = left_of_original();
  const std::vector<float> decoded = decoded_left(encoder);
  int best = -20;
  for (int lag = -20; lag <= 20; ++lag) {
    if (correlation(original, decoded, lag) > correlation(original, decoded, best)) best = lag;
  }
  EXPECT_EQ(best, 0);
  EXPECT_GT(correlation(original, decoded, 0), 0.9 * correlation(original, original, 0));
}

TEST_P(SoundEncoderTest, IsTheSameEachTime) {
  const SoundEncoder encoder(GetParam(), {.rate_hz = 48000, .size = kSize});
  Clacks one;
  Clacks other;
  const auto packets = encoder.encode(one);
  const auto again = encoder.encode(other);
  while (const auto packet = packets->next()) EXPECT_EQ(packet->bytes, again->next()->bytes);
  EXPECT_FALSE(again->next().has_value());
}

INSTANTIATE_TEST_SUITE_P(Codecs, SoundEncoderTest, testing::Values(kAac, kOpus),
                         [](const auto& codec) { return std::string(codec.param.name); });

TEST(SoundEncoder, SaysWhatToDoWithoutAnEncoder) {
  const std::string said = testing_support::message_of<UsageError>(
      [] { SoundEncoder({.name = "nosuch", .bit_rate = 1}, {}); });
  EXPECT_TRUE(testing_support::contains(said, "'nosuch'; leave the sound out"));
}

}  // namespace
}  // namespace piblocks
