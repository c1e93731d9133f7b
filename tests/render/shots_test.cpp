// The shots of a film: their frames, their sound, what is said in them, and slides for them.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "render/film.hpp"
#include "render/renderings.hpp"
#include "render/video_text.hpp"
#include "support/contains.hpp"
#include "support/script_of.hpp"
#include "support/temporary_folder.hpp"

namespace piblocks {
namespace {
using testing_support::contains;
using testing_support::file_contents;
using testing_support::script_of;

/// Cuts, an even and an odd fade, a fade as long as its part allows.
constexpr const char* kFourShots = R"(
view = { fps = 10, size = "320x180" }
sound.on = true
[[part]]
card = ["One", "two <&>"]
seconds = 1
[[part]]
fade = 0.4
digits = 1
time.from = 1
time.to = 4
show.title = "A run"
[[part]]
time.from = 1
time.to = 3
compare = [{ digits = 1 }, { digits = 2 }]
[[part]]
fade = 0.5
card = "End"
seconds = 0.6
)";

/// Lines of frame hashes, without the numbers before them.
std::vector<std::string> hashes(const std::string& file) {
  std::vector<std::string> found;
  std::istringstream text(file_contents(file));
  for (std::string line; std::getline(text, line);) {
    if (!line.starts_with('#')) found.push_back(line.substr(line.rfind(' ') + 1));
  }
  return found;
}

TEST(Shots, AreTheFramesOfTheFilmOneAfterTheOther) {
  const testing_support::TemporaryFolder folder;
  RenderJob job{.script = script_of(kFourShots), .output = folder / "film.framehash"};
  auto* story = std::get_if<Storyboard>(&job.script);
  story->sound.on = false;
  const Film film(job.script);
  const auto no_report = [](const Progress&) {};
  render_film(job, film, no_report, {});
  const std::vector<std::string> expected = hashes(job.output);
  ASSERT_EQ(std::ssize(expected), film.frame_count());
  std::vector<std::string> found;
  for (std::size_t i = 0; i < film.segments().size(); ++i) {
    EXPECT_EQ(film.shot(i).first, std::ssize(found)) << i;
    job.frames = film.shot(i);
    job.output = folder / ("shot-" + std::to_string(i) + ".framehash");
    EXPECT_EQ(render_film(job, film, no_report, {}).frame_count, film.shot(i).count());
    for (const std::string& hash : hashes(job.output)) found.push_back(hash);
  }
  EXPECT_EQ(found, expected);
}

/// The fade from a shot to the next one belongs to the next, so a shot ends in full view.
TEST(Shots, EndBeforeTheNextFade) {
  const Film film(script_of(kFourShots), {FilmUse::audio_only});
  for (std::size_t i = 0; i + 1 < film.segments().size(); ++i) {
    const PlacedSegment& next = film.segments()[i + 1];
    EXPECT_EQ(film.shot(i).last + 1, next.first_frame);
    EXPECT_LT(film.shot(i).last, next.first_seen());
  }
}

std::vector<float> samples_of(SampleSource& source, std::size_t room) {
  std::vector<float> all;
  std::vector<float> piece(room);
  for (std::size_t pairs = room / 2; pairs == room / 2;) {
    pairs = source.read(piece);
    all.insert(all.end(), piece.begin(), piece.begin() + std::ptrdiff_t(2 * pairs));
  }
  return all;
}

/// But for the last 5 ms of each, which fade out.
TEST(Shots, HaveTheSoundOfTheFilm) {
  const Film film(script_of(kFourShots), {FilmUse::audio_only});
  const auto ignore = [](std::int64_t) {};
  FilmSound whole(film, film.frames(), {}, ignore);
  FilmSound sound(film, film.frames(), {}, ignore);
  const std::vector<float> expected = samples_of(whole, 2048);
  std::vector<float> found;
  for (std::size_t i = 0; i < film.segments().size(); ++i) {
    const SoundFormat format = sound_format(film.shot(i), film.view().frame_rate);
    sound.begin(film.shot(i));
    const std::vector<float> shot = samples_of(sound, 2 * 1000 + 2 * i);
    ASSERT_EQ(std::ssize(shot), 2 * format.size) << i;
    for (std::size_t k = 0; k < shot.size(); ++k) {
      const float whole_sample = expected.at(found.size() + k);
      if (k + 480 < shot.size()) {
        ASSERT_EQ(shot[k], whole_sample) << i << " " << k;
      } else {
        ASSERT_LE(std::fabs(shot[k]), std::fabs(whole_sample));
      }
    }
    EXPECT_NEAR(shot.back(), 0, 1e-3);
    found.insert(found.end(), shot.begin(), shot.end());
  }
  EXPECT_EQ(found.size(), expected.size());
}

TEST(Shots, SayWhatTheFilmSaysThen) {
  const Film film(script_of(kFourShots), {FilmUse::audio_only});
  const std::vector<std::string> said = shot_captions(film);
  ASSERT_EQ(said.size(), 4U);
  EXPECT_EQ(said[0], "WEBVTT\n\n00:00:00.000 --> 00:00:01.600\nOne\ntwo &lt;&amp;&gt;\n")
      << "its last caption stays";
  EXPECT_TRUE(
      said[1].starts_with("WEBVTT\n\n00:00:00.000 --> 00:00:00.200\nOne\ntwo &lt;&amp;&gt;"
                          "\n\n00:00:00.200 --> 00:00:01.000\nA run\nNo collision yet\n"))
      << said[1];
  EXPECT_TRUE(said[2].starts_with("WEBVTT\n\n00:00:00.000 --> ")) << said[2];
  EXPECT_FALSE(contains(said[2], "A run"));
}

TEST(Shots, AreChapters) {
  const Film film(script_of(kFourShots), {FilmUse::audio_only});
  const std::string text = chapters(film);
  EXPECT_TRUE(
      text.starts_with("WEBVTT\n\n00:00:00.000 --> 00:00:00.800\nOne / two &lt;&amp;&gt;\n\n"
                       "00:00:00.800 --> 00:00:03.600\nA run\n\n"))
      << text;
  EXPECT_TRUE(contains(text, "\nMasses 1 and 1, Masses 1 and 100\n")) << text;
  EXPECT_TRUE(text.ends_with("\nEnd\n")) << text;
  const Film diagrams(
      script_of("[[part]]\nshow.panels = ['mirrors', 'time']\n[[part]]\ncard = 'a'\n"),
      {FilmUse::audio_only});
  EXPECT_TRUE(contains(chapters(diagrams), "\nMasses 1 and 10,000: mirrors\n"));
}

TEST(Shots, HaveASlideEach) {
  const Film film(script_of(kFourShots), {FilmUse::audio_only});
  const std::string latex = latex_slides(film, "pi.mp4");
  const std::string reveal = reveal_slides(film, "pi.mp4");
  const std::string impress = impress_slides(film, "pi.mp4");
  EXPECT_TRUE(contains(impress, "fo:page-width=\"28cm\" fo:page-height=\"15.750cm\""));
  EXPECT_FALSE(contains(reveal, "pi-00.png"));
  for (const char* number : {"01", "02", "03", "04"}) {
    const std::string name = std::string("pi-") + number;
    EXPECT_TRUE(contains(latex, "{" + name + ".png}}{" + name + ".mp4}")) << latex;
    EXPECT_TRUE(contains(reveal, "<source src=\"" + name + ".mp4\""));
    EXPECT_TRUE(contains(impress, "<draw:plugin xlink:href=\"" + name + ".mp4\""));
    EXPECT_TRUE(contains(impress, "<draw:image xlink:href=\"" + name + ".png\""));
  }
  EXPECT_FALSE(contains(reveal, "pi-04.png")) << "nothing comes after it";
  EXPECT_TRUE(contains(reveal, "aria-label=\"“One / two &lt;&amp;&gt;”.\"")) << reveal;
}

}  // namespace
}  // namespace piblocks
