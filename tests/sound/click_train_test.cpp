// What is left out where collisions are denser than samples, and that nothing is folded back.
#include "sound/click_train.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "sound/click.hpp"

namespace piblocks {
namespace {
using testing_support::clacks_of;
using testing_support::ClickTrain;

constexpr double kTrainRate_hz = 48000;
constexpr double kTurn_s = 0.2;  // after the film's begin

double level_db(const std::vector<double>& samples) {
  double energy = 0;
  for (double sample : samples) energy += sample * sample;
  return 10 * std::log10(energy);
}

TEST(ClickTrain, OfCollisionsTakenTogetherIsThatOfAllOfThem) {
  for (int digits : {4, 5, 6}) {
    const auto log = make_pair_log(article_system(digits));
    const Rational begin = Rational(7, 2) - Rational(1, 5);
    const std::size_t size = 19200;
    ClickTrain together(size);
    for (const Clack& clack : clacks_of(*log, {{0, begin, 1}}, Rational(2, 5))) {
      together.add(clack.sample, clack.impulse);
    }
    ClickTrain all(size);
    const auto stream = log->stream(1, log->last());
    PairBatch batch;
    const double r = to_double(1 / article_blocks(digits).red.mass);
    while (stream->read(batch)) {
      for (std::size_t i = 0; i < batch.size; ++i) {
        const double u1 = batch.blue_velocity[i];
        const double u2 = batch.red_velocity[i];
        const double blow =
            batch.kind[i] == CollisionKind::wall ? (1 + r) * std::fabs(u1) : std::fabs(u2 - u1);
        const double time = (batch.time_hi[i] - to_double(begin)) + batch.time_lo[i];
        all.add(time * kTrainRate_hz, blow / std::hypot(std::sqrt(r) * u1, u2));
      }
    }
    std::vector<double> error = together.samples();
    const std::vector<double> exact = all.samples();
    for (std::size_t i = 0; i < size; ++i) error[i] -= exact[i];
    const double relative_db = level_db(error) - level_db(exact);
    RecordProperty("error_db_" + std::to_string(digits), std::to_string(relative_db));
    EXPECT_LT(relative_db, digits == 6 ? -56 : -78) << digits;
  }
}

/// The clicks of 20 digits around the turn, all sharp or as they are heard.
std::vector<double> clicks(bool are_sharp) {
  const auto log = make_pair_log(article_system(20));
  const Rational begin = Rational(7, 2) - Rational(1, 5);
  const std::vector<Clack> clacks = clacks_of(*log, {{0, begin, 1}}, Rational(2, 5));
  ClickTrain train(19200);
  for (std::size_t i = 0; i < clacks.size(); ++i) {
    const auto [height, softness] = click(clacks, i);
    train.add(clacks[i].sample, height, are_sharp ? 0 : softness);
  }
  return train.samples();
}

/// Energy of a window around a time before the turn, from one frequency to another.
double band_energy(const std::vector<double>& samples, double tau_s, double low_hz,
                   double high_hz) {
  constexpr int kSize = 128;
  const auto begin = std::size_t((kTurn_s - tau_s) * kTrainRate_hz) - kSize / 2;
  double energy = 0;
  for (int bin = 0; bin <= kSize / 2; ++bin) {
    const double frequency_hz = bin * kTrainRate_hz / kSize;
    if (frequency_hz < low_hz || frequency_hz > high_hz) continue;
    std::complex<double> sum = 0;
    for (int i = 0; i < kSize; ++i) {
      const double phase = 2 * std::numbers::pi * i / kSize;
      const double window = 0.35875 - 0.48829 * std::cos(phase) + 0.14128 * std::cos(2 * phase) -
                            0.01168 * std::cos(3 * phase);  // Blackman-Harris
      sum += window * samples[begin + std::size_t(i)] * std::polar(1.0, -phase * bin);
    }
    energy += std::norm(sum);
  }
  return energy;
}

TEST(ClickTrain, IsAChirpWithoutAnythingFoldedBack) {
  const std::vector<double> samples = clicks(true);
  // Collisions come 1.5/tau^2 times a second. Below this frequency is their steady push, which is
  // slower than 3 kHz, and nothing else.
  for (double tau_s : {0.0125, 0.011, 0.0105, 0.0100, 0.0095}) {
    const double chirp_hz = 1.5 / (tau_s * tau_s);
    const double whole = band_energy(samples, tau_s, 3000, 24000);
    const double below = band_energy(samples, tau_s, 3000, 0.65 * chirp_hz);
    EXPECT_LT(10 * std::log10(below / whole), -40) << chirp_hz;
  }
  // Beyond the audio rate only the push is left.
  const double heard = band_energy(samples, 0.0100, 3000, 24000);
  for (double tau_s : {0.0055, 0.005, 0.0045}) {
    const double above = band_energy(samples, tau_s, 3000, 24000);
    EXPECT_LT(10 * std::log10(above / heard), -40) << tau_s;
  }
}

TEST(ClickTrain, IsSoftAsSoonAsItIsDense) {
  const std::vector<double> samples = clicks(false);
  // 1.5/tau^2 times a second: 240 to 17,000.
  for (double tau_s : {0.079, 0.05, 0.03, 0.02, 0.0125, 0.0095}) {
    const double all = band_energy(samples, 0.079, 0, 24000);
    const double treble = band_energy(samples, tau_s, 6500, 24000);
    EXPECT_LT(10 * std::log10(treble / all), -70) << tau_s;
  }
}

TEST(Loudness, RisesWithTheImpulseAndStaysBounded) {
  double before = 1;
  for (double impulse = 1e-6; impulse < 1e300; impulse *= 10) {
    const double now = loudness(impulse);
    EXPECT_GT(now, before);
    EXPECT_LT(now, 2);
    before = now;
  }
  EXPECT_EQ(loudness(0), 1);
  EXPECT_NEAR(loudness(1), 1 + 0.8814 / 1.8814, 1e-4);  // arsinh 1 = ln(1 + sqrt 2)
  EXPECT_NEAR(loudness(100), 1 + 5.2983 / 6.2983, 1e-4);
  EXPECT_LT(loudness(HUGE_VAL), 2);
}

TEST(Loudness, OfABlowOfManyIsThatOfOne) {
  std::vector<Clack> blow;
  for (int i = 0; i < 100; ++i) blow.push_back({10 + i * 1e-6, CollisionKind::wall, 5, 0});
  double total = 0;
  for (std::size_t i = 0; i < blow.size(); ++i) total += click(blow, i).height;
  EXPECT_NEAR(total, loudness(500), 1e-6);
  // Far from each other they are as loud as alone.
  const std::vector<Clack> apart = {{0, CollisionKind::wall, 5, 0},
                                    {5, CollisionKind::wall, 50, 0}};
  EXPECT_EQ(click(apart, 0).height, loudness(5));
}

/// The click in the middle of a second of clacks.
Click click_at_rate(int per_second) {
  std::vector<Clack> clacks;
  for (int i = 0; i < per_second; ++i) {
    clacks.push_back({i * kTrainRate_hz / per_second, CollisionKind::wall, 1e6, 0});
  }
  return click(clacks, clacks.size() / 2);
}

TEST(Loudness, OfASwarmDoesNotGrowWithTheRate) {
  for (int per_second : {1, 5, 10}) {
    EXPECT_EQ(click_at_rate(per_second).height, loudness(1e6)) << per_second;
  }
  for (int per_second : {100, 300, 1000, 10000}) {
    const double height = click_at_rate(per_second).height;
    EXPECT_NEAR(height * height * per_second, 100, 10) << per_second;
  }
}

TEST(Loudness, OfASwarmIsSoft) {
  EXPECT_EQ(click_at_rate(90).softness, 0);
  EXPECT_GT(click_at_rate(150).softness, 0.4);
  EXPECT_LT(click_at_rate(150).softness, 0.6);
  for (int per_second : {200, 1000, 100000}) {
    EXPECT_EQ(click_at_rate(per_second).softness, 1) << per_second;
  }
}

}  // namespace
}  // namespace piblocks
