// What a film's title, description and captions say, part by part.
#include "render/video_text.hpp"

#include <gtest/gtest.h>
#include <piblocks/script.hpp>

#include <filesystem>
#include <regex>
#include <string>
#include <utility>

#include "support/contains.hpp"
#include "support/script_of.hpp"
#include "support/temporary_folder.hpp"

namespace piblocks {
namespace {
using testing_support::contains;
using testing_support::file_contents;
using testing_support::script_of;

/// For its texts alone.
Film film(const std::string& text) { return Film(script_of(text), {FilmUse::audio_only}); }

std::string last_cue(const Film& film) {
  const std::string text = captions(film);
  return text.substr(text.find('\n', text.rfind(" --> ")) + 1);
}

/// Equal masses meet at 2, 3.5 and 5; those that are half a unit further apart, at 2.5, 4 and 5.5.
constexpr const char* kStory = R"(
view.fps = 10
[[part]]
card = ["Counting  π", " ", "by two & two"]
seconds = 2
[[part]]
fade = 1
digits = 1
time.to = 9
show.title = "As heavy <as> the other"
[[part]]
time.to = 10
compare = [{ digits = 1, show.title = "Near" }, { digits = 1, red.position = 5.5 }]
)";

/// The second part is seen from 1.5 s on, and is then at its time 0.5.
TEST(VideoText, CaptionsTellTheStoryInItsOrder) {
  EXPECT_EQ(captions(film(kStory)), R"(WEBVTT

00:00:00.000 --> 00:00:01.500
Counting π
by two &amp; two

00:00:01.500 --> 00:00:03.000
As heavy &lt;as&gt; the other
No collision yet

00:00:03.000 --> 00:00:04.500
1 collision

00:00:04.500 --> 00:00:06.000
2 collisions

00:00:06.000 --> 00:00:10.000
3 collisions, after which there are no more: the first digit of π, 3

00:00:10.000 --> 00:00:15.000
Near
Masses 1 and 1

00:00:15.000 --> 00:00:15.500
Near: 3 collisions

00:00:15.500 --> 00:00:20.000
Near: 3 collisions
Masses 1 and 1: 3 collisions
)");
}

TEST(VideoText, DescribesAStoryPartByPart) {
  EXPECT_EQ(describe_film(film(kStory)),
            "A film in 3 parts. Part 1. “Counting π / by two & two”. Part 2. “As heavy <as> the "
            "other”: Two blocks of masses 1 and 1 beside a wall have 3 collisions: the first digit "
            "of π, 3. Part 3. 2 runs at once. “Near”: Two blocks of masses 1 and 1 beside a wall "
            "have 3 collisions: the first digit of π, 3. Two blocks of masses 1 and 1 beside a "
            "wall have 3 collisions: the first digit of π, 3.");
  EXPECT_EQ(describe_film(film("[[part]]\ndigits = 2\ntime.to = 1\n")),
            "A film in 1 part. Part 1. Two blocks of masses 1 and 100 beside a wall.")
      << "nothing has happened yet";
}

TEST(VideoText, AStoryIsNamedAfterItsFirstPart) {
  EXPECT_EQ(title_of(film(kStory)), "Counting π");
  const std::string runs = "compare = [{ digits = 1, show.title = 'Near' }, { digits = 2 }]\n";
  EXPECT_EQ(title_of(film("[[part]]\n" + runs)), "Near, Masses 1 and 100");
  EXPECT_EQ(title_of(film("[[part]]\ndigits = 2\n")), "Masses 1 and 100: 31 collisions");
  EXPECT_EQ(title_of(film("digits = 2\nshow.title = 'A  run'\n")), "A run");
}

/// 22 characters are said for 1.1 s: the hit at time 2 comes after 1 s, that at 3.5 after 2.5 s.
TEST(VideoText, ATitleIsSaidForAsLongAsOneReadsIt) {
  const std::string text = captions(
      film("view.fps = 10\ndigits = 1\ntime.from = 1\ntime.to = 9\nshow.title = 'Twenty-two "
           "letters, ok'\n"));
  EXPECT_TRUE(
      contains(text, "00:00:01.000 --> 00:00:02.500\nTwenty-two letters, ok\n1 collision\n"))
      << text;
  EXPECT_TRUE(contains(text, "00:00:02.500 --> 00:00:04.000\n2 collisions\n")) << text;
}

TEST(VideoText, SaysWhatADiagramProves) {
  const std::string arcs = "Each hit cuts off an arc of 2θ on the circle of speeds: ";
  const std::string angles = "31 equal angles θ fit into half a turn: ";
  const std::string number = "π/θ ≈ 10π = 31.4…";
  for (const auto& [panels, proof] : {std::pair{"'velocity'", arcs},
                                      {"'count', 'ellipse'", arcs},
                                      {"'mirrors'", angles},
                                      {"'unfolded', 'velocity'", angles}}) {
    const std::string scene = std::string("digits = 2\nshow.panels = [") + panels + "]\n";
    const std::string all =
        "31 collisions, after which there are no more: the first 2 digits of π, 3.1\n";
    EXPECT_EQ(last_cue(film(scene + "time.hold-end = 7\n")), all + proof + number + "\n");
    EXPECT_EQ(last_cue(film(scene + "time.hold-end = 4\n")),
              "31 collisions\n" + proof + number + "\n");
    EXPECT_EQ(last_cue(film(scene + "time.hold-end = 0.5\n")), "31 collisions: " + number + "\n");
    EXPECT_TRUE(describe_film(film(scene)).ends_with(". " + proof + number));
    EXPECT_TRUE(describe_film(film("[[part]]\n" + scene)).ends_with(". " + proof + number));
    EXPECT_FALSE(contains(describe_film(film(scene + "time.to = 6\n")), "θ")) << "not over";
  }
  const std::string none = "digits = 2\nshow.panels = ['time']\n";
  EXPECT_FALSE(contains(describe_film(film(none)), "θ"));
}

/// Of every storyboard that comes with the program.
TEST(VideoText, CaptionsCoverTheFilm) {
  int stories = 0;
  for (const auto& file : std::filesystem::directory_iterator(PIBLOCKS_SCENES)) {
    const std::string text = file.path().extension() == ".toml" ? file_contents(file.path()) : "";
    if (!contains(text, "[[part]]")) continue;
    ++stories;
    const Film shown = film(text);
    const std::string said = captions(shown);
    const std::regex cue("\n\n(\\S+) --> (\\S+)\n(?!\n)");
    std::string end = "00:00:00.000";
    for (std::sregex_iterator found(said.begin(), said.end(), cue), none; found != none; ++found) {
      EXPECT_EQ((*found)[1], end) << file.path();
      EXPECT_LT((*found)[1], (*found)[2]);
      end = (*found)[2];
    }
    const double length_s = double(shown.frame_count()) / to_double(shown.view().frame_rate);
    EXPECT_NEAR(60 * std::stod(end.substr(3, 2)) + std::stod(end.substr(6)), length_s, 0.001);
  }
  EXPECT_GE(stories, 3);
}

}  // namespace
}  // namespace piblocks
