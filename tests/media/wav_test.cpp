#include <gtest/gtest.h>
#include <piblocks/error.hpp>

#include <cstring>

#include "media/output/output.hpp"
#include "support/contains.hpp"
#include "support/message_of.hpp"
#include "support/temporary_folder.hpp"

namespace piblocks {
namespace {
using testing_support::contains;
using testing_support::file_contents;
using testing_support::TemporaryFolder;

class Samples final : public SampleSource {
 public:
  explicit Samples(std::vector<float> values) : values_(std::move(values)) {}
  std::size_t read(std::span<float> samples) override {
    const std::size_t count = std::min(samples.size(), values_.size() - at_) / 2;
    std::copy_n(values_.begin() + std::ptrdiff_t(at_), 2 * count, samples.begin());
    at_ += 2 * count;
    return count;
  }

 private:
  std::vector<float> values_;
  std::size_t at_ = 0;
};

int sample(const std::string& bytes, std::size_t index) {
  int value = 0;
  std::memcpy(&value, bytes.data() + 44 + 3 * index, 3);
  return (value ^ 0x800000) - 0x800000;
}

void write(const std::string& path, std::vector<float> values, std::int64_t size) {
  const auto output = set_up_output(path, {}, {}, SoundFormat{.rate_hz = 48000, .size = size});
  const auto sink = output.open({0});
  Samples samples(std::move(values));
  const auto packets = output.encode_sound(samples);
  sink->take_sound(*packets);
  sink->finish();
}

TEST(Wav, HoldsEverySample) {
  const TemporaryFolder folder;
  write(folder / "a.wav", {0, 1, -1, 0.5F, -0.25F, 2}, 3);
  const std::string bytes = file_contents(folder / "a.wav");
  ASSERT_EQ(bytes.size(), 44u + 18u);
  EXPECT_EQ(bytes.substr(0, 4), "RIFF");
  EXPECT_EQ(bytes[4], 36 + 18);
  EXPECT_EQ(bytes.substr(8, 8), "WAVEfmt ");
  const int expected[] = {0, 8388607, -8388607, 4194304, -2097152, 8388607};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(sample(bytes, i), expected[i]) << i;
}

TEST(Wav, IsNotWrittenIfTheSoundIsOfAnotherLength) {
  const TemporaryFolder folder;
  EXPECT_THROW(write(folder / "a.wav", {0, 0}, 3), MediaError);
  EXPECT_TRUE(folder.is_empty());
}

std::string refusal_of(const char* name, const SoundFormat& sound) {
  return testing_support::message_of<UsageError>([&] { set_up_output(name, {}, {}, sound); });
}

TEST(Wav, RefusesWhatNoHeaderCanSay) {
  EXPECT_TRUE(contains(refusal_of("a.wav", {.rate_hz = 48000, .size = 900'000'000}),
                       "WAV ends at 4 GiB, which is 14913 s"));
}

TEST(Sound, IsRefusedWhereThereIsNone) {
  const SoundFormat sound{.rate_hz = 48000, .size = 3};
  for (const char* name :
       {"a.y4m", "-", "%d.png", "a.framehash", "null", "a.gif", "a.apng", "a.webp"}) {
    EXPECT_TRUE(contains(refusal_of(name, sound), "has no sound; write one of: *.mp4")) << name;
  }
  for (const char* name : {"a.mp4", "a.mov", "a.webm"}) {
    EXPECT_EQ(refusal_of(name, sound), "") << name;
  }
}

TEST(Sound, IsNotTakenByAnOutputThatWasSetUpWithout) {
  const TemporaryFolder folder;
  const auto output = set_up_output(folder / "a.mp4", {}, {});
  Samples samples({0, 0});
  EXPECT_THROW(output.encode_sound(samples), MediaError);
  const auto packets = set_up_output("a.wav", {}, {}).encode_sound(samples);
  EXPECT_THROW(output.open({1})->take_sound(*packets), MediaError);
}

}  // namespace
}  // namespace piblocks
