// Films of several parts: what every frame shows, and that nothing changes their bytes.
#include "render/film.hpp"

#include <gtest/gtest.h>
#include <piblocks/encode.hpp>
#include <piblocks/error.hpp>
#include <piblocks/render.hpp>

#include <algorithm>

#include "draw/canvas.hpp"
#include "draw/found_items.hpp"
#include "render/renderings.hpp"
#include "rendered_parts.hpp"
#include "support/contains.hpp"
#include "support/script_of.hpp"
#include "support/temporary_folder.hpp"

namespace piblocks {
namespace {
using testing_support::contains;
using testing_support::file_contents;
using testing_support::TemporaryFolder;

class FilmTest : public testing::Test {
 protected:
  static Script read(const std::string& text) {
    return testing_support::script_of(
        "view.size = '160x90'\nview.fps = 10\nview.theme = 'article'\n" + text);
  }
  static Film film(const std::string& text) { return Film(read(text)); }

  static std::vector<std::string> problems(const std::string& text) {
    try {
      film(text);
    } catch (const UsageError& error) {
      return error.lines();
    }
    return {};
  }

  TemporaryFolder folder_;
};

/// A card, runs, a comparison, fades and a cut; what moves is exposed in some.
constexpr const char* kStory = R"(
[[part]]
card = ["Counting π", "twice"]
seconds = 1
[[part]]
digits = 1
fade = 0.5
time.duration = 3
[[part]]
digits = 2
time.duration = 2
view.shutter = 1
[[part]]
fade = 0.7
time.duration = 3
compare = [{ mass-ratio = 1 }, { mass-ratio = 16, view.shutter = "1/2" }]
)";

TEST_F(FilmTest, PartsFollowEachOther) {
  const Film made = film(kStory);
  const auto parts = made.segments();
  ASSERT_EQ(parts.size(), 4U);
  const std::vector<std::int64_t> counts = {10, 30, 20, 30};
  const std::vector<std::int64_t> fades = {0, 5, 0, 7};
  const std::vector<std::int64_t> first = {0, 5, 35, 48};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(parts[i].segment.frame_count(), counts[i]) << i;
    EXPECT_EQ(parts[i].fade_frames, fades[i]) << i;
    EXPECT_EQ(parts[i].first_frame, first[i]) << i;
    EXPECT_EQ(parts[i].segment.schedule() != nullptr, i > 0) << i;
    EXPECT_EQ(parts[i].segment.runs().size(), i == 3 ? 2U : i == 0 ? 0U : 1U) << i;
  }
  EXPECT_EQ(made.frame_count(), 78);
}

TEST_F(FilmTest, APartShowsWhatItsSceneWouldShowAlone) {
  const Film made = film(kStory);
  const Film alone = film("digits = 2\ntime.duration = 2\nview.shutter = 1");
  for (std::int64_t k = 35; k < 48; ++k) EXPECT_EQ(made.frame(k), alone.frame(k - 35)) << k;
}

bool is_exposed(const DrawList& list) { return !items_of<ExposedBlocksItem>(list.items).empty(); }

TEST_F(FilmTest, EachRunHasItsOwnShutter) {
  const Film made = film(kStory);
  EXPECT_FALSE(is_exposed(made.frame(20)));
  EXPECT_TRUE(is_exposed(made.frame(40)));
  std::vector<bool> exposed;
  for (const GroupItem& group : items_of<GroupItem>(made.frame(60).items)) {
    exposed.push_back(is_exposed(*group.list));
  }
  EXPECT_EQ(exposed, (std::vector<bool>{false, true}));
}

/// The earlier part in the first half, the later one in the second, and half-way neither, so that
/// no text is ever over another one.
TEST_F(FilmTest, AFadeGoesThroughTheBackground) {
  const Film made = film(kStory);
  const auto parts = made.segments();
  for (const std::size_t i : {1U, 3U}) {
    const std::int64_t fade = parts[i].fade_frames;
    std::vector<double> opacities;
    for (std::int64_t k = 0; k < fade; ++k) {
      const std::int64_t number = parts[i].first_frame + k;
      const DrawList frame = made.frame(number);
      ASSERT_LE(frame.items.size(), 1U) << number;
      EXPECT_EQ(frame.items.empty(), 2 * k + 1 == fade) << number;
      opacities.push_back(0);
      if (frame.items.empty()) continue;
      const bool is_first_half = 2 * k + 1 < fade;
      const auto& group = std::get<GroupItem>(frame.items.front());
      EXPECT_EQ(*group.list, is_first_half
                                 ? parts[i - 1].segment.frame(number - parts[i - 1].first_frame)
                                 : parts[i].segment.frame(k))
          << number;
      opacities.back() = group.opacity;
      EXPECT_DOUBLE_EQ(group.opacity, std::fabs(1 - 2 * double(k + 1) / double(fade + 1)));
    }
    EXPECT_TRUE(std::equal(opacities.begin(), opacities.end(), opacities.rbegin()))
        << "symmetrical";
    const std::int64_t after = parts[i].first_frame + fade;
    EXPECT_EQ(made.frame(after), parts[i].segment.frame(fade)) << "the fade is over";
    const std::int64_t before = parts[i].first_frame - 1;
    EXPECT_EQ(made.frame(before), parts[i - 1].segment.frame(before - parts[i - 1].first_frame));
  }
}

TEST_F(FilmTest, AFadeOfTwoFramesHasOneOfEachPart) {
  const std::string card = "[[part]]\nseconds = 1\ncard = ";
  const Film made = film(card + "'a'\n" + card + "'b'\nfade = 0.2\n");
  for (const std::int64_t number : {8, 9}) {
    const DrawList frame = made.frame(number);
    ASSERT_EQ(frame.items.size(), 1U);
    const auto& group = std::get<GroupItem>(frame.items.front());
    EXPECT_DOUBLE_EQ(group.opacity, 1.0 / 3);
    EXPECT_EQ(*group.list, made.frame(number == 8 ? 7 : 10));
  }
}

TEST_F(FilmTest, HasTheFramesOfItsStretches) {
  for (const char* ease : {"0", "0.31", "2"}) {
    const Film made = film("digits = 2\ntime.to = 6\ntime.slow-motion = ['2:2.1:9', 'turn:4:3']\n" +
                           std::string("time.ease = ") + ease);
    const Schedule& schedule = *made.segments().front().segment.schedule();
    EXPECT_EQ(made.frame_count(), schedule.frame_count()) << ease;
    EXPECT_LT(schedule.time_of(made.frame_count() - 1), 6) << ease;
    EXPECT_GE(schedule.time_of(made.frame_count()), 6) << ease;
    for (std::int64_t k = 1; k < made.frame_count(); ++k) {
      ASSERT_GT(schedule.time_of(k), schedule.time_of(k - 1)) << ease << ", frame " << k;
    }
  }
}

TEST_F(FilmTest, WhatIsComparedHasOneClock) {
  const Film made = film(
      "[[part]]\ntime.to = 'last+1'\ncompare = [{digits = 1}, {mass-ratio = 16}, {digits = 3}]");
  const PlacedSegment& placed = made.segments().front();
  const auto runs = placed.segment.runs();
  ASSERT_EQ(runs.size(), 3U);
  // As long as the run that takes longest would be alone.
  const auto length = [&](const char* keys) {
    return film(std::string(keys) + "\ntime.to = 'last+1'").frame_count();
  };
  const std::int64_t longest =
      std::max({length("digits = 1"), length("mass-ratio = 16"), length("digits = 3")});
  EXPECT_EQ(made.frame_count(), longest);
  for (const std::int64_t k : {std::int64_t{0}, longest / 2, longest - 1}) {
    const auto cells = items_of<GroupItem>(made.frame(k).items);
    ASSERT_EQ(cells.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(*cells[i].list, runs[i].frame(*placed.segment.schedule(), k))
          << "frame " << k << ", cell " << i;
    }
  }
}

TEST_F(FilmTest, FadesHaveToFit) {
  const std::string card = "[[part]]\ncard = 'a'\nseconds = 1\n";
  EXPECT_EQ(film(card + card + "fade = 0.9\n").frame_count(), 11);
  EXPECT_EQ(film(card + card + "fade = 0.94\n").frame_count(), 11) << "rounded to whole frames";
  EXPECT_EQ(film(card + card + "fade = 0.04\n").frame_count(), 20) << "rounded to a cut";
  EXPECT_EQ(film(card + card + "fade = 0.5\n" + card + "fade = 0.5\n").frame_count(), 20);
  for (const std::string& fades : {std::string("fade = 1\n"), std::string("fade = 1000000000\n"),
                                   std::string("fade = 0.95")}) {
    const auto found = problems(card + card + fades);
    ASSERT_EQ(found.size(), 1U) << fades;
    EXPECT_TRUE(contains(found.front(), "scene.toml:7: fade = "));
  }
  EXPECT_EQ(problems(card + card + "fade = 0.6\n" + card + "fade = 0.5\n").size(), 1U)
      << "three parts at once";
  EXPECT_EQ(problems(card + card + "fade = 1\n" + card + "fade = 1\n").size(), 2U);
}

TEST_F(FilmTest, ProblemsOfAllPartsAreToldAtOnce) {
  const std::string long_line(500, 'm');
  const auto found = problems("[[part]]\ncard = '" + long_line +
                              "'\n[[part]]\nred.velocity = 0\n[[part]]\nview.x = [-1, 30]\n"
                              "[[part]]\ncard = 'a'\nseconds = 1e9\n");
  ASSERT_EQ(found.size(), 3U) << testing::PrintToString(found);
  EXPECT_TRUE(contains(found[0], "scene.toml:4: card: "));
  EXPECT_TRUE(contains(found[1], "scene.toml:6: time.to: "));
  EXPECT_TRUE(contains(found[2], "scene.toml:10: seconds = "));
}

TEST_F(FilmTest, RefusesAStoryboardThatWasNotChecked) {
  const Script empty = Storyboard();
  EXPECT_THROW(Film{empty}, SceneError);
}

TEST_F(FilmTest, IsNotTooLong) {
  std::string text = "[[part]]\ncard = 'a'\nseconds = 60000\n";
  EXPECT_TRUE(problems(text).empty());
  EXPECT_EQ(problems(text + text).size(), 1U);
}

TEST_F(FilmTest, EveryFrameIsThatOfAFullPaintInAnyOrder) {
  const Script script = read(kStory);
  const Film made(script);
  FrameRenderer renderer(script);
  ASSERT_EQ(renderer.frame_count(), made.frame_count());
  for (std::int64_t k = 0; k < made.frame_count(); ++k) {
    ASSERT_EQ(pixels_of(renderer.frame(k)), painted(made.frame(k))) << k;
    const std::int64_t other = k * 37 % made.frame_count();
    ASSERT_EQ(pixels_of(renderer.frame(other)), painted(made.frame(other))) << other;
    ASSERT_EQ(pixels_of(renderer.frame(k)), painted(made.frame(k))) << k << " again";
  }
}

TEST_F(FilmTest, BytesDoNotDependOnJobsNorOnParts) {
  const Script script = read(kStory);
  for (const char* name : {"out.mp4", "out.framehash"}) expect_equal_bytes(script, folder_, name);
}

TEST_F(FilmTest, PartsOfOtherStoriesAreNotJoined) {
  std::string changed = kStory;
  changed.replace(changed.find("twice"), 5, "again");
  std::vector<std::string> parts;
  for (int i = 1; i <= 2; ++i) {
    parts.push_back(rendered_part({i, 2}, {read(i == 1 ? kStory : changed), folder_ / "out.mp4"}));
  }
  try {
    join(parts, folder_ / "joined.mp4");
    FAIL() << "joined";
  } catch (const UsageError& error) {
    EXPECT_TRUE(std::string(error.what()).ends_with("they differ in part-1")) << error.what();
  }
}

TEST_F(FilmTest, AStillIsTheFrameOfASecondOfTheVideo) {
  const Script script = read(kStory);
  const Film made(script);
  const auto still = [&](const Instant& instant) {
    render_still(script, instant, folder_ / "still.png");
    return file_contents(folder_ / "still.png");
  };
  const auto frame = [&](std::int64_t number) {
    const DrawList list = made.frame(number);
    Canvas canvas(list.width_px, list.height_px);
    canvas.paint(list);
    const auto png = encode_png(canvas.view());
    return std::string(png.begin(), png.end());
  };
  EXPECT_EQ(still(Rational(0)) == frame(0), true);
  EXPECT_EQ(still(Rational(509, 100)) == frame(50), true) << "in a fade";
  EXPECT_EQ(still(Instant::last()) == frame(77), true);
  EXPECT_THROW(still(Rational(-1)), UsageError);
  EXPECT_THROW(still(Rational(78, 10)), UsageError);
  EXPECT_THROW(still(Instant::collision(1)), UsageError);
}

/// The speed decides how far trails go back, whether it is named or follows from a duration.
TEST(Film, IsTheSameWithADurationAsWithTheSpeedThatItGives) {
  const auto make = [](const std::vector<std::pair<const char*, const char*>>& keys) {
    ScriptBuilder builder;
    builder.read_text("discs",
                      "[[body]]\nposition = [0, 0]\nradius = 1\nvelocity = [1, 2]\n"
                      "[[body]]\nposition = [5, 4]\nradius = 1\n[view]\nfps = 5\n"
                      "size = '320x180'\n[time]\nto = 6\n[show]\noverlays = ['trails']\n");
    for (const auto& [key, text] : keys) builder.set("test", key, text);
    return builder.build_scene();
  };
  const Scene fast = make({{"time.speed", "2"}});
  const Scene slow = make({{"time.speed", "1/2"}});
  Scene in_3_s = make({{"time.duration", "3"}});
  in_3_s.time.speed = 7;  // is not used
  const Film film(fast);
  const Film same(in_3_s);
  ASSERT_EQ(film.frame_count(), same.frame_count());
  for (std::int64_t k = 0; k < film.frame_count(); ++k)
    ASSERT_EQ(film.frame(k), same.frame(k)) << k;
  const Instant end(Rational(5));
  EXPECT_EQ(still_picture(fast, end), still_picture(in_3_s, end));
  EXPECT_FALSE(still_picture(fast, end) == still_picture(slow, end))
      << "trails depend on the speed";
}

}  // namespace
}  // namespace piblocks
