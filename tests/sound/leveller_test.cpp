#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "sound/soundtrack.hpp"

namespace piblocks {
namespace {

/// Ends when the last sample has come out.
std::vector<double> levelled(const std::vector<double>& samples) {
  Leveller leveller;
  std::vector<double> out;
  for (std::size_t i = 0; i < samples.size() + Leveller::kDelay; ++i) {
    const double in = i < samples.size() ? samples[i] : 0;
    const StereoSample pair = leveller.next({in, -in});
    if (i >= Leveller::kDelay) out.push_back(pair[0]);
  }
  return out;
}

/// A tone on both sides; its loudness is its level in dB plus what BS.1770 adds: 0 dB at 1 kHz for
/// one side (clause 2.4: -3.01 LUFS for a full tone of 997 Hz), 3 dB for both.
std::vector<double> tone(double loudness_LUFS, std::size_t size) {
  const double height = std::pow(10, loudness_LUFS / 20);
  std::vector<double> samples(size);
  for (std::size_t i = 0; i < size; ++i) {
    samples[i] = height * std::sin(2 * std::numbers::pi * 997 / 48000 * double(i));
  }
  return samples;
}

double highest(const std::vector<double>& samples, std::size_t begin, std::size_t end) {
  double high = 0;
  for (std::size_t i = begin; i < end; ++i) high = std::max(high, std::fabs(samples[i]));
  return high;
}

TEST(Leveller, LeavesAloneWhatIsQuietEnough) {
  const std::vector<double> quiet = tone(-16.7, 96000);
  EXPECT_EQ(levelled(quiet), quiet);
  // A blow is not loud for long.
  std::vector<double> blow(96000);
  for (std::size_t i = 48000; i < 48240; ++i) blow[i] = 0.9 * std::sin(0.13 * double(i));
  EXPECT_EQ(levelled(blow), blow);
}

TEST(Leveller, HoldsALoudToneToItsLimit) {
  for (const double loudness : {-15.0, -10.0, 0.0, 20.0}) {
    const std::vector<double> out = levelled(tone(loudness, 96000));
    EXPECT_NEAR(20 * std::log10(highest(out, 30000, 66000)), -16.5, 0.15) << loudness;
  }
}

/// Neither where it begins, nor where it ends.
TEST(Leveller, ChangesTheGainSlowly) {
  std::vector<double> samples(144000, 0.01);  // shows the gain
  const std::vector<double> loud = tone(-6, 48000);
  for (std::size_t i = 0; i < loud.size(); ++i) samples[48000 + i] = loud[i];
  const std::vector<double> out = levelled(samples);
  for (std::size_t i = 1; i < 48000; ++i) {
    ASSERT_NEAR(out[i], out[i - 1], 0.01 / 480) << i;
    ASSERT_NEAR(out[96000 + i], out[96000 + i - 1], 0.01 / 480) << i;
  }
  EXPECT_LT(out[47999], 0.004);
  EXPECT_LT(out[96000], 0.004);
  EXPECT_EQ(out[27000], 0.01);
  EXPECT_EQ(out[117000], 0.01);
}

}  // namespace
}  // namespace piblocks
