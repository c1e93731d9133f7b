// What films of several parts sound like: each run in its time and place, and nothing else.
#include <gtest/gtest.h>
#include <piblocks/render.hpp>

#include <algorithm>
#include <cmath>

#include "render/film.hpp"
#include "rendered_parts.hpp"
#include "support/script_of.hpp"
#include "support/temporary_folder.hpp"

namespace piblocks {
namespace {
using testing_support::file_contents;
using testing_support::TemporaryFolder;

constexpr std::int64_t kRate_hz = Soundtrack::kRate_hz;

struct Track {
  std::vector<double> left;
  std::vector<double> right;

  std::size_t size() const { return left.size(); }
};

bool is_silent(const std::vector<double>& channel, std::size_t from, std::size_t to) {
  return std::all_of(channel.begin() + std::ptrdiff_t(from), channel.begin() + std::ptrdiff_t(to),
                     [](double sample) { return sample == 0; });
}

Script read(const std::string& text) {
  return testing_support::script_of("view.size = '160x90'\n" + text);
}

Track track(const std::string& text) {
  const Film film(read(text));
  FilmSound sound(film, film.frames(), {}, [](std::int64_t) {});
  Track track;
  std::vector<float> samples(2000);
  while (const std::size_t count = sound.read(samples)) {
    for (std::size_t i = 0; i < count; ++i) {
      track.left.push_back(double(samples[2 * i]));
      track.right.push_back(double(samples[2 * i + 1]));
    }
  }
  EXPECT_EQ(std::int64_t(track.size()), sound_format(film.frames(), film.view().frame_rate).size);
  return track;
}

/// The first sample after `from` that is higher than half of the highest within two milliseconds.
std::size_t onset(const std::vector<double>& samples, std::size_t from) {
  std::size_t begin = from;
  while (begin < samples.size() && std::fabs(samples[begin]) < 1e-3) ++begin;
  double high = 0;
  for (std::size_t i = begin; i < begin + 96; ++i) high = std::max(high, std::fabs(samples[i]));
  while (std::fabs(samples[begin]) <= high / 2) ++begin;
  return begin;
}

/// Frame rates at which parts begin at a sample, and between two of them.
TEST(FilmSoundTest, EachPartIsHeardAtItsTime) {
  for (const std::string rate : {"10", "60", "'30000/1001'"}) {
    const std::string text = "view.fps = " + rate + R"(
[[part]]
card = 'a'
seconds = 1
[[part]]
digits = 1
time.duration = 5
[[part]]
card = 'b'
[[part]]
digits = 2
time.duration = 4
[[part]]
mass-ratio = 3
)";
    const Film film(read(text));
    const Track heard = track(text);
    const Rational& fps = film.view().frame_rate;
    const auto seconds = [&](std::int64_t frame) { return to_double(Rational(frame) / fps); };
    for (const PlacedSegment& placed : film.segments()) {
      const double begin = seconds(placed.first_frame) * kRate_hz;
      const double end = seconds(placed.first_frame + placed.segment.frame_count()) * kRate_hz;
      if (placed.segment.runs().empty()) {
        const auto from = std::size_t(std::ceil(begin));
        EXPECT_TRUE(is_silent(heard.left, from, std::size_t(end))) << "card at " << begin;
        continue;
      }
      const PairLog& log = *placed.segment.runs().front().log().pair();
      const Stretch& first = placed.segment.schedule()->stretches().front();
      const double at_s =
          (log.blocks_collision(1).time.hi - to_double(first.time)) / to_double(first.speed);
      const double expected = begin + at_s * kRate_hz;
      EXPECT_NEAR(double(onset(heard.left, std::size_t(begin))), expected, 1) << rate;
    }
  }
}

TEST(FilmSoundTest, AFilmOfOnePartIsTheScene) {
  const TemporaryFolder folder;
  const std::string keys = "digits = 3\ntime.speed = 2\nview.shutter = 1\n";
  for (const std::string name : {"a.wav", "a.mp4", "a.webm"}) {
    const std::string head = "view.fps = 10\nsound.on = true\n";
    render_silently({read(head + keys), folder / name, {}, 1});
    const std::string story = folder / ("story-" + name);
    render_silently({read(head + "[[part]]\n" + keys), story, {}, 1});
    EXPECT_EQ(file_contents(folder / name) == file_contents(story), true) << name;
  }
}

TEST(FilmSoundTest, AFadeWeighsSoundsAsItDoesPictures) {
  constexpr const char* kFirst = "mass-ratio = 2\ntime.from = 1.5\ntime.to = 5\n";
  constexpr const char* kSecond = "digits = 1\ntime.from = 1.8\ntime.to = 7\n";
  const std::string fps = "view.fps = 10\n";
  const Track first = track(fps + kFirst);
  const Track second = track(fps + kSecond);
  const std::string fade = "fade = 2\n";
  const Script script = read(fps + "[[part]]\n" + kFirst + "[[part]]\n" + fade + kSecond);
  const Film film(script);
  const Track both = track(fps + "[[part]]\n" + kFirst + "[[part]]\n" + fade + kSecond);
  const PlacedSegment& placed = film.segments()[1];
  ASSERT_EQ(placed.fade_frames, 20);
  constexpr std::int64_t kFrame = kRate_hz / 10;
  // Five milliseconds before a film ends it is faded out.
  const auto at = [](const std::vector<double>& samples, std::int64_t i) {
    return i >= 0 && i < std::int64_t(samples.size()) ? samples[std::size_t(i)] : 0;
  };
  const std::int64_t begin = placed.first_frame * kFrame;
  double loudest = 0;
  for (std::int64_t i = 0; i < std::int64_t(both.size()) - 240; ++i) {
    const double frame = double(i - begin) / double(kFrame);  // with a fraction
    // From 1 to 0 half-way, where only the background is seen, and to 1 again.
    const double along = std::clamp((frame + 1) / (20 + 1), 0.0, 1.0);
    const double falling = std::max(0.0, 1 - 2 * along);
    const double rising = std::max(0.0, 2 * along - 1);
    const double expected = falling * at(first.left, i) + rising * at(second.left, i - begin);
    const bool is_end_of_first =
        std::int64_t(first.size()) - i <= 240 && i < std::int64_t(first.size());
    ASSERT_NEAR(both.left[std::size_t(i)], expected, is_end_of_first ? 1e-3 : 1e-7) << i;
    if (frame > 0 && frame < 20) loudest = std::max(loudest, std::fabs(expected));
  }
  EXPECT_GT(loudest, 0.01) << "nothing is heard in the fade";
}

TEST(FilmSoundTest, WhatRingsAtACutIsFadedOut) {
  // The second collision is 3 ms before the cut.
  const Track alone = track("view.fps = 10\ndigits = 1\ntime.to = 5");
  const Track cut = track(
      "view.fps = 10\n[[part]]\ndigits = 1\ntime.to = 3.6\n[[part]]\ncard = 'a'\nseconds = 1\n");
  const std::size_t end = 36 * kRate_hz / 10;
  for (std::size_t i = 0; i < end - 240; ++i) ASSERT_EQ(cut.left[i], alone.left[i]) << i;
  EXPECT_GT(std::fabs(alone.left[end - 1]), 0) << "it still rings";
  double step = 0;
  for (std::size_t i = end - 240; i < end; ++i) {
    EXPECT_LE(std::fabs(cut.left[i]), std::fabs(alone.left[i]));
    step = std::fabs(cut.left[i]);
  }
  EXPECT_LT(step, 1e-5);
  EXPECT_TRUE(is_silent(cut.left, end, cut.size()));
}

TEST(FilmSoundTest, AllThatIsComparedIsHeardEachFromItsSide) {
  const std::string fps = "view.fps = 10\n";
  const std::string story =
      fps +
      "[[part]]\ntime.to = 4.5\ncompare = [{ digits = 1 }, { digits = 1, red.position = 5.5 }]";
  const Track both = track(story);
  // Blocks meet at 2 s on the left side, half a second later on the right one.
  const auto energy = [&](const std::vector<double>& samples, double at_s) {
    double sum = 0;
    const auto from = std::size_t(at_s * kRate_hz);
    for (std::size_t i = from; i < from + 9600; ++i) sum += samples[i] * samples[i];
    return sum;
  };
  EXPECT_NEAR(double(onset(both.left, 0)), 2 * kRate_hz, 1);
  EXPECT_GT(energy(both.left, 1.999), 1.1 * energy(both.right, 1.999));
  EXPECT_GT(energy(both.right, 2.499), 1.1 * energy(both.left, 2.499));
  EXPECT_GT(energy(both.left, 2.499), 0);
}

TEST(FilmSoundTest, CardsAloneAreSilent) {
  const Track heard = track("[[part]]\ncard = 'a'\n[[part]]\ncard = 'b'\nfade = 1\n");
  EXPECT_EQ(heard.size(), 3U * kRate_hz);
  EXPECT_TRUE(is_silent(heard.left, 0, heard.size()));
}

TEST(FilmSoundTest, BytesDoNotDependOnJobsNorOnParts) {
  const Script script = read(
      "view.fps = 10\nsound.on = true\n[[part]]\ncard = 'a'\n[[part]]\nfade = 0.5\ndigits = 2\n"
      "time.duration = 3\n[[part]]\nfade = 0.5\ntime.duration = 4\ncompare = [{}, { digits = 1 "
      "}]\n");
  expect_equal_bytes(script, TemporaryFolder(), "out.mp4");
}

}  // namespace
}  // namespace piblocks
