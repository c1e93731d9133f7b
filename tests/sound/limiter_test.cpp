#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "sound/click.hpp"
#include "sound/soundtrack.hpp"
#include "sound/true_peak.hpp"

namespace piblocks {
namespace {
using testing_support::interpolated_peak;
using testing_support::true_peak;

constexpr double kCeiling = 0.75;

std::vector<double> limited(const std::vector<double>& samples) {
  Limiter limiter(kCeiling, 48000);
  std::vector<double> out;
  for (std::size_t i = 0; i < samples.size() + Limiter::kDelay; ++i) {
    const double in = i < samples.size() ? samples[i] : 0;
    const auto pair = limiter.next({in, -in / 2});
    if (i >= std::size_t{Limiter::kDelay}) out.push_back(pair[0]);
  }
  return out;
}

TEST(Limiter, LeavesAloneWhatIsLowEnough) {
  std::vector<double> samples(5000);
  for (std::size_t i = 0; i < samples.size(); ++i) samples[i] = 0.7 * std::sin(double(i) * 0.07);
  EXPECT_EQ(limited(samples), samples);
}

TEST(Limiter, LetsNothingOverTheCeilingAlsoBetweenSamples) {
  for (double volume : {1.0, 3.0, 30.0, 1e6}) {
    for (double frequency : {0.001, 0.02, 0.2499, 0.35, 0.41}) {
      std::vector<double> samples(6000);
      for (std::size_t i = 1000; i < 4000; ++i) {
        const double turn = 2 * std::numbers::pi * frequency * double(i) + 0.7;
        samples[i] = volume * std::sin(turn) * (i % 1000 < 300 ? 1 : 0.1);
      }
      const std::vector<double> out = limited(samples);
      // By the limiter's own interpolation.
      const double peak = interpolated_peak(
          out, 12, [](double distance) { return sinc(distance) * kaiser(distance / 12, 6); });
      EXPECT_LT(20 * std::log10(peak / kCeiling), 0.02) << volume << " at " << frequency;
      EXPECT_LT(20 * std::log10(true_peak(out) / kCeiling), 0.2) << volume << " at " << frequency;
    }
  }
}

TEST(Limiter, ComesBackAfterAPeak) {
  std::vector<double> samples(48000, 0.1);
  samples[1000] = 50;
  const std::vector<double> out = limited(samples);
  EXPECT_LT(out[1000], kCeiling * 1.01);
  EXPECT_LT(out[1100], 0.02);
  EXPECT_EQ(out[47000], 0.1);
  EXPECT_EQ(out[700], 0.1);
}

}  // namespace
}  // namespace piblocks
