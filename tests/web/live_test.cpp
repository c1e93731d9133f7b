// The film of a page against the film that is rendered.
#include "web/live.hpp"

#include <gtest/gtest.h>
#include <piblocks/error.hpp>
#include <piblocks/render.hpp>

#include <cmath>
#include <cstring>
#include <map>
#include <string>
#include <vector>

#include "support/script_of.hpp"
#include "support/temporary_folder.hpp"
#include "web/facts.hpp"

namespace piblocks::web {
namespace {

using testing_support::script_of;

const std::string kSmall = "view.size = [320, 180]\n";
const std::string kDiagrams = kSmall + "view.theme = \"lecture\"\nshow.panels = [\"velocity\"]\n";
const std::string kStory = kSmall +
                           "[[part]]\ncard = [\"One\"]\nseconds = 1\n"
                           "[[part]]\ndigits = 1\ntime.to = 1\nfade = \"1/2\"\n";

/// What a canvas of HTML shows after some patches.
class Html {
 public:
  Html(int width, int height)
      : width_(static_cast<std::size_t>(width)), pixels_(4 * width_ * std::size_t(height)) {}

  void take(const Patch& patch) {
    const auto width = static_cast<std::size_t>(patch.rect.width_px);
    for (std::size_t y = 0; y < std::size_t(patch.rect.height_px); ++y) {
      const std::size_t row = y + std::size_t(patch.rect.y_px);
      std::memcpy(&pixels_[4 * (row * width_ + std::size_t(patch.rect.x_px))],
                  &patch.rgba[4 * y * width], 4 * width);
    }
  }

  /// Pixels that are not those of an opaque picture.
  int differences(const ImageView& expected) const {
    int count = 0;
    for (int y = 0; y < expected.height_px; ++y) {
      for (int x = 0; x < expected.width_px; ++x) {
        const std::uint8_t* const bgra = expected.row(y) + std::ptrdiff_t{4} * x;
        const std::uint8_t* const rgba = &pixels_[4 * (std::size_t(y) * width_ + std::size_t(x))];
        const bool is_equal =
            rgba[0] == bgra[2] && rgba[1] == bgra[1] && rgba[2] == bgra[0] && rgba[3] == 255;
        if (!is_equal) ++count;
      }
    }
    return count;
  }

 private:
  std::size_t width_;
  std::vector<std::uint8_t> pixels_;
};

TEST(LiveScript, ShowsTheFramesOfTheFilm) {
  Screen screen;
  Html html(320, 180);
  // One after the other on one screen, which paints what differs from the film before.
  for (const std::string& text : {kSmall, kDiagrams, kSmall + "digits = 2\n", kStory}) {
    const LiveScript live(script_of(text));
    FrameRenderer expected(script_of(text));
    ASSERT_EQ(live.frame_count(), expected.frame_count());
    for (const std::int64_t frame :
         {std::int64_t{0}, *live.frame_count() / 2, std::int64_t{1}, *live.frame_count() - 1}) {
      screen.update(live.picture(live.place_of_frame(frame)));
      html.take(screen.patch());
      EXPECT_EQ(html.differences(expected.frame(frame)), 0) << text << frame;
    }
  }
}

TEST(LiveScript, ConvertsOnlyWhatChanges) {
  Screen screen;
  const LiveScript live(script_of(kSmall));
  screen.update(live.picture(live.place_of_frame(0)));
  EXPECT_EQ(screen.patch().rect, (PixelRect{0, 0, 320, 180}));
  screen.update(live.picture(live.place_of_frame(0)));
  EXPECT_EQ(screen.patch().rect.width_px, 0);
  screen.update(live.picture(live.place_of_frame(1)));
  EXPECT_LT(screen.patch().rect.height_px, 180);
  EXPECT_GT(screen.patch().rect.height_px, 0);
}

TEST(LiveScript, TransparentPixelsAreNotMultiplied) {
  Screen screen;
  const LiveScript live(script_of(kSmall + "view.background = \"transparent\"\n"));
  FrameRenderer expected(live.script());
  screen.update(live.picture(live.place_of_frame(0)));
  const std::uint8_t* rgba = screen.patch().rgba.data();
  const ImageView multiplied = expected.frame(0);
  std::map<std::string, int> counts;
  for (int y = 0; y < multiplied.height_px; ++y) {
    for (int x = 0; x < multiplied.width_px; ++x, rgba += 4) {
      const std::uint8_t* const bgra = multiplied.row(y) + std::ptrdiff_t{4} * x;
      const int alpha = bgra[3];
      ++counts[alpha == 0 ? "none" : alpha == 255 ? "all" : "some"];
      ASSERT_EQ(rgba[3], alpha);
      for (int k = 0; k < 3; ++k) {
        const double exact = alpha == 0 ? 0 : 255.0 * bgra[2 - k] / alpha;
        ASSERT_LE(std::abs(rgba[k] - exact), 0.5) << x << ' ' << y << " alpha " << alpha;
      }
    }
  }
  EXPECT_GT(counts["none"], 0);
  EXPECT_GT(counts["some"], 100);
  EXPECT_GT(counts["all"], 0);
}

TEST(LiveScript, PlacesStayWithinTheFilm) {
  const LiveScript live(script_of(kSmall));
  const std::int64_t last = *live.frame_count() - 1;
  EXPECT_EQ(live.place_of_frame(-5).frame, 0);
  EXPECT_EQ(live.place_of_frame(1'000'000).frame, last);
  EXPECT_EQ(live.place_of(parse_instant("2.5")).frame, std::nullopt);
  EXPECT_EQ(live.frame_near(live.place_of(parse_instant("2.5"))), 150);
  EXPECT_EQ(live.frame_near(live.place_of(parse_instant("100"))), last);
  EXPECT_EQ(live.frame_near(live.place_of(parse_instant("-100"))), 0);
  EXPECT_THROW(live.place_of(parse_instant("#315")), UsageError);
}

/// The counts from a place on, one collision after the other.
std::vector<std::string> counts_beside(const LiveScript& live, LiveScript::Place place, int step) {
  std::vector<std::string> counts;
  while (const auto beside = live.collision_beside(place, step)) {
    const std::string state = live.state_text(*live.state(*beside));
    const std::size_t begin = state.find(R"("collisions":")") + 14;
    counts.push_back(state.substr(begin, state.find('"', begin) - begin));
    place = *beside;
    if (place.frame == 0) break;
  }
  return counts;
}

TEST(LiveScript, GoesFromCollisionToCollision) {
  const LiveScript live(script_of(kSmall + "digits = 1\n"));
  const LiveScript::Place start = live.place_of_frame(0);
  const LiveScript::Place end = live.place_of(parse_instant("last"));
  using Counts = std::vector<std::string>;
  EXPECT_EQ(counts_beside(live, start, 1), (Counts{"1", "2", "3"}));
  EXPECT_EQ(counts_beside(live, end, -1), (Counts{"2", "1", "0"}));
  const LiveScript::Place between = live.place_of(parse_instant("#2+1/1000"));
  EXPECT_EQ(counts_beside(live, between, -1), (Counts{"2", "1", "0"}));
  EXPECT_EQ(counts_beside(live, between, 1), (Counts{"3"}));
  EXPECT_FALSE(LiveScript(script_of(kStory)).collision_beside({0, {}}, 1));
}

TEST(LiveScript, CollisionsAtOneInstantAreOneStep) {
  // Both pairs meet at time 1, the walls are reached at time 2.
  const LiveScript live(script_of(kSmall + "box.x = [0, 10]\ntime.to = \"3/2\"\n"
                                           "[[body]]\nposition = 1\nvelocity = 1\n"
                                           "[[body]]\nposition = 4\nvelocity = -1\n"
                                           "[[body]]\nposition = 6\nvelocity = 1\n"
                                           "[[body]]\nposition = 9\nvelocity = -1\n"));
  const auto counts = counts_beside(live, live.place_of_frame(0), 1);
  EXPECT_EQ(counts, std::vector<std::string>{"2"});
  EXPECT_EQ(counts_beside(live, live.place_of(parse_instant("1.2")), -1),
            (std::vector<std::string>{"2", "0"}));
}

TEST(LiveScript, StatesAreThoseOfTheCommand) {
  const LiveScript live(script_of(kSmall));
  EXPECT_EQ(live.state_text(*live.state(live.place_of(parse_instant("1")))),
            R"({"time":1,"collisions":"0","blue":{"position":2,"velocity":0},)"
            R"("red":{"position":4,"velocity":-1}})");
  EXPECT_FALSE(LiveScript(script_of(kStory)).state({0, {}}));
}

TEST(LiveScript, SceneWithoutFilmHasStills) {
  const LiveScript live(script_of(kSmall + "red.velocity = 1\n"));
  EXPECT_EQ(live.frame_count(), std::nullopt);
  EXPECT_FALSE(live.film_problems().empty());
  EXPECT_EQ(live.picture(live.place_of_frame(3)).width_px, 320);
  EXPECT_EQ(live.frame_near(live.place_of(Instant())), std::nullopt);
}

/// Left and right of a WAV file of 24 bits a sample.
std::vector<float> samples_of_wav(const std::string& bytes) {
  std::vector<float> samples;
  for (std::size_t i = bytes.find("data") + 8; i + 3 <= bytes.size(); i += 3) {
    std::uint32_t word = 0;
    std::memcpy(&word, &bytes[i], 3);
    samples.push_back(float(static_cast<std::int32_t>(word << 8U)) / float(1U << 31U));
  }
  return samples;
}

TEST(LiveSound, IsThatOfTheFile) {
  const testing_support::TemporaryFolder folder;
  RenderJob job{.script = script_of(kSmall), .output = folder / "sound.wav"};
  render(job, [](const Progress&) {});
  const std::vector<float> expected = samples_of_wav(testing_support::file_contents(job.output));
  LiveSound sound(job.script);
  sound.read(0, sound.size());
  ASSERT_EQ(sound.samples().size(), expected.size());
  float loudest = 0;
  float difference = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    loudest = std::max(loudest, std::abs(expected[i]));
    difference = std::max(difference, std::abs(expected[i] - sound.samples()[i]));
  }
  EXPECT_GT(loudest, 0.01F);
  EXPECT_LE(difference, 2.0F / float(1U << 23U));
}

/// The pairs from this one on, 9000 or as many as there are, out of all samples.
std::vector<float> part_of(const std::vector<float>& all, std::int64_t first) {
  const auto begin = all.begin() + 2 * first;
  return {begin, begin + std::min<std::ptrdiff_t>(18'000, all.end() - begin)};
}

TEST(LiveSound, IsTheSameInAnyOrder) {
  const Script script = script_of(kSmall);
  LiveSound whole(script);
  whole.read(0, whole.size());
  const std::vector<float> all = whole.samples();
  ASSERT_EQ(all.size(), 2 * std::size_t(whole.size()));
  LiveSound parts(script);
  for (const std::int64_t first : {150'000L, 7L, 7L, 20'000L, long(whole.size()) - 100}) {
    parts.read(first, 9000);
    EXPECT_TRUE(parts.samples() == part_of(all, first)) << first;
  }
  parts.read(whole.size(), 10);
  EXPECT_TRUE(parts.samples().empty());
}

/// The same for a canvas of another size.
TEST(LiveScript, PicturesHaveTheSizeOfTheScreen) {
  const LiveScript live(script_of(kDiagrams), FrameSize{270, 480});
  EXPECT_EQ(view_of(live.script()).width_px, 320);
  EXPECT_EQ(live.view().height_px, 480);
  const LiveScript::Place place = live.place_of_frame(40);
  const DrawList picture = live.picture(place);
  EXPECT_EQ(picture.width_px, 270);
  EXPECT_EQ(live.full_picture(place), LiveScript(script_of(kDiagrams)).picture(place));
  EXPECT_EQ(LiveScript(script_of(kStory), FrameSize{270, 480}).picture({3, {}}).height_px, 480);
}

/// Whether the facts of this scene have this text.
bool has(const std::string& text, const std::string& part) {
  return facts_json(LiveScript(script_of(text))).find(part) != std::string::npos;
}

TEST(Facts, TellKeysAndBodies) {
  EXPECT_TRUE(has("", R"("red.mass":["10000"])"));
  EXPECT_TRUE(has(kStory, R"("view.size":["320x180"])"));
  EXPECT_FALSE(has(kStory, R"("red.mass")"));
  EXPECT_TRUE(has(
      "box.x = [0, 9]\ntime.to = 3\n[[body]]\nposition = 2\nvelocity = \"1/3\"\n",
      R"("bodies":{"count":1,"dimensions":1,"x":["0","9"],"y":["-inf","inf"],"rows":[)"
      R"({"mass":"1","position":["2"],"velocity":["1/3"],"size":"1","color":"","label":""}]})"));
}

}  // namespace
}  // namespace piblocks::web
