#include <gtest/gtest.h>
#include <piblocks/error.hpp>
#include <piblocks/script.hpp>

#include <fstream>

#include "scene/file_fixture.hpp"
#include "scene/scene_keys.hpp"

namespace piblocks {
namespace {

class StoryboardFileTest : public FileFixture {
 protected:
  Storyboard story(const std::string& text) { return std::get<Storyboard>(script(text)); }
};

const Scene& only_run(const Segment& part) { return std::get<Scenes>(part.content).at(0); }

TEST_F(StoryboardFileTest, AFileWithoutPartsIsAScene) {
  const Scene scene = load("digits = 2\n[time]\nspeed = 3\n");
  EXPECT_EQ(scene.system.bodies[1].mass.value(), 100);
  EXPECT_EQ(scene.time.speed, 3);
}

TEST_F(StoryboardFileTest, DigitsAndMassRatioSetTheMassOfRed) {
  const auto red_mass = [&](const std::string& text) {
    return load(text).system.bodies[1].mass.value();
  };
  EXPECT_EQ(red_mass("digits = 1"), 1);
  EXPECT_EQ(red_mass("digits = \"4\"\nblue.mass = 3"), 3'000'000);
  EXPECT_EQ(red_mass("mass-ratio = \"1/3\"\nblue.mass = 6"), 2);
  EXPECT_EQ(red_mass("digits = 3\nbase = 2"), 16);
  EXPECT_EQ(red_mass("base = 16\ndigits = 2"), 256);
}

TEST_F(StoryboardFileTest, ATextIsReadAsAFileIs) {
  const std::string text = "digits = 2\n[[part]]\ncard = 'a'\n[[part]]\ndigits = 0\n";
  ScriptBuilder builder;
  builder.read_text("lecture (shipped)", text);
  std::vector<std::string> expected = problems(text);
  ASSERT_EQ(expected.size(), 1U);
  expected[0].replace(0, path_.size(), "lecture (shipped)");
  EXPECT_EQ(problems(builder), expected);
  EXPECT_THROW(ScriptBuilder().read_text("text", "= 1"), SceneError);
}

TEST_F(StoryboardFileTest, KeysAboveHoldForAllParts) {
  const Storyboard read = story(R"(
    digits = 2
    [view]
    size = "640x360"
    fps = 25
    theme = "dark"
    [time]
    speed = 2
    [golden]
    frames = ["1.5"]
    [[part]]
    [[part]]
    digits = 3
    fade = "1/3"
    time.duration = 6
    show.title = "three"
    [[part]]
    red.mass = 7
    [part.time]
    speed = 5
  )");
  EXPECT_EQ(read.view.width_px, 640);
  EXPECT_EQ(read.view.frame_rate, 25);
  EXPECT_EQ(read.view.theme, Theme::dark);
  EXPECT_EQ(read.golden.frames, std::vector<std::string>{"1.5"});
  ASSERT_EQ(read.segments.size(), 3U);
  EXPECT_EQ(only_run(read.segments[0]).system.bodies[1].mass.value(), 100);
  EXPECT_EQ(only_run(read.segments[0]).time.speed, 2);
  EXPECT_EQ(read.segments[0].fade_s, 0);
  EXPECT_EQ(only_run(read.segments[1]).system.bodies[1].mass.value(), 10000);
  EXPECT_EQ(only_run(read.segments[1]).pacing.duration_s, 6);
  EXPECT_EQ(only_run(read.segments[1]).show.title, "three");
  EXPECT_EQ(read.segments[1].fade_s, Rational(1, 3));
  EXPECT_EQ(only_run(read.segments[2]).system.bodies[1].mass.value(), 7)
      << "the part's key wins over the film's";
  EXPECT_EQ(only_run(read.segments[2]).time.speed, 5);
  EXPECT_EQ(only_run(read.segments[2]).show.title, "");
  EXPECT_EQ(read.segments[2].origin, path_ + ":17");
}

TEST_F(StoryboardFileTest, ACardHasLines) {
  const auto lines = [&](const std::string& value) {
    return std::get<Card>(story("[[part]]\ncard = " + value + "\n").segments.at(0).content).lines;
  };
  const std::vector<std::string> two = {"Counting π", "by hand"};
  EXPECT_EQ(lines("'π'"), std::vector<std::string>{"π"});
  EXPECT_EQ(lines("['Counting π', 'by hand']"), two);
  EXPECT_EQ(lines("\"Counting π\\nby hand\""), two);
  EXPECT_EQ(lines("\"\"\"\nCounting π\nby hand\n\"\"\""), two);
  const Storyboard read = story("[[part]]\ncard = 'a'\n[[part]]\ncard = 'b'\nseconds = '5/2'\n");
  EXPECT_EQ(std::get<Card>(read.segments[0].content).length_s, 2);
  EXPECT_EQ(std::get<Card>(read.segments[1].content).length_s, Rational(5, 2));
}

TEST_F(StoryboardFileTest, WhatAPartSaysHoldsForAllItCompares) {
  const Storyboard read = story(R"(
    [[part]]
    time.duration = 4
    red.position = 6
    compare = [{ mass-ratio = 16, show.title = "16" }, { digits = 2, red.position = 7 }]
  )");
  const Scenes& runs = std::get<Scenes>(read.segments.at(0).content);
  ASSERT_EQ(runs.size(), 2U);
  EXPECT_EQ(runs[0].system.bodies[1].mass.value(), 16);
  EXPECT_EQ(runs[0].system.bodies[1].position[0], 6);
  EXPECT_EQ(runs[0].show.title, "16");
  EXPECT_EQ(runs[1].system.bodies[1].mass.value(), 100);
  EXPECT_EQ(runs[1].system.bodies[1].position[0], 7);
  EXPECT_EQ(runs[1].pacing.duration_s, 4);
}

TEST_F(StoryboardFileTest, ColoursAreTheFilmsAndThoseOfBlocksARuns) {
  const Storyboard read = story(R"(
    view.background = "#0b2545"
    [[part]]
    compare = [{ digits = 1 }, { digits = 2, blue.color = "#00ff00" }]
  )");
  const Scenes& runs = std::get<Scenes>(read.segments.at(0).content);
  EXPECT_EQ(with_film_view(runs[1], read.view).view.colors.background, (RgbColor{11, 37, 69}));
  EXPECT_FALSE(runs[0].styles[0].color);
  EXPECT_EQ(runs[1].styles[0].color, (RgbColor{0, 255, 0}));
  EXPECT_EQ(describe(story(scene_toml(read))), describe(read));
}

TEST_F(StoryboardFileTest, EveryProblemNamesItsLine) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"[[part]]\ndigits = 0", ":2: digits = 0: must be a whole number from 1"},
      {"[[part]]\ndigits = 1.5", ":2: digits = 1.5: must be a whole number from 1"},
      {"[[part]]\ndigits = [1, 2]", ":2: digits = [1, 2]: must be one value"},
      {"[[part]]\nmass-ratio = -1", ":2: red.mass = -1: must be greater than 0"},
      {"[[part]]\ndigits = 1\nmass-ratio = 3", ":1: digits and mass-ratio both set the mass"},
      {"digits = 1\nmass-ratio = 3\nred.mass = 3", ": digits and mass-ratio and red.mass all set"},
      {"[[part]]\ntime.speed = 1\ntime.duration = 3", ":1: time.speed and time.duration both set"},
      {"[[part]]\nspeed = 1", ":2: speed: unknown key"},
      {"[[part]]\nview.size = '64x64'", ":2: view.size: holds for the whole film"},
      {"[[part]]\n[part.view]\nfps = 10", ":3: view.fps: holds for the whole film"},
      {"[[part]]\nview.theme = 'dark'", ":2: view.theme: holds for the whole film"},
      {"[[part]]\nview.colors.ink = '#000000'", ":2: view.colors.ink: holds for the whole film"},
      {"[[part]]\ngolden.frames = [1]", ":2: golden.frames: holds for the whole film"},
      {"[[part]]\nfade = 1", ":2: fade = 1: no part is before the first"},
      {"[[part]]\n[[part]]\nfade = -1", ":3: fade = -1: must not be less than 0"},
      {"[[part]]\n[[part]]\nfade = 'x'", ":3: fade = x: not a number"},
      {"[[part]]\n[[part]]\nfade = [[1]]", ":3: fade: "},
      {"[[part]]\ncard = ''", ":2: card must not have an empty line"},
      {"[[part]]\ncard = ['a', '']", ":2: card must not have an empty line"},
      {"[[part]]\ncard = [1,2,3,4,5,6,7,8,9]", ":2: card must be from 1 to 8 lines"},
      {"[[part]]\ncard = \"a\\n\\nb\"", ":2: card must not have an empty line"},
      {"[[part]]\ncard = \"a\\tb\"", ":2: card must be one line of text"},
      {"[[part]]\ncard = 'a'\nseconds = 0", ":3: seconds = 0: must be greater than 0"},
      {"[[part]]\ncard = 'a'\ndigits = 3", ":3: digits: a card has nothing but"},
      {"[[part]]\ncard = 'a'\ncompare = [{}, {}]", ":3: compare: a card has nothing but"},
      {"[[part]]\nseconds = 3", ":2: seconds: is the length of a card"},
      {"[[part]]\ncompare = 3", ":2: compare: must be a list of 2 to 4 tables"},
      {"[[part]]\ncompare = [{}]", ":2: compare: must be a list of 2 to 4 tables"},
      {"[[part]]\ncompare = [{}, {}, {}, {}, {}]", ":2: compare: must be a list of 2 to 4"},
      {"[[part]]\ncompare = [{}, 3]", ":2: compare: must be a list of 2 to 4 tables"},
      {"[[part]]\ncompare = [{}, { time.speed = 2 }]", ":2: time.speed: compared runs share one"},
      {"[[part]]\ncompare = [{}, { view.size = 2 }]", ":2: view.size: holds for the whole film"},
      {"[[part]]\ncompare = [{}, { fade = 2 }]", ":2: fade: unknown key"},
      {"[part]\ndigits = 2", ":2: part: is written [[part]]"},
      {"part = 2", ":1: part: is written [[part]]"},
      {"[view]\nfps = 0\n[[part]]\n[[part]]", ":2: view.fps = 0: must be greater than 0"},
      {"[view]\nfps = 0\n[[part]]\ncard = 'a'", ":2: view.fps = 0: must be greater than 0"},
      {"[time]\nspeed = -1\n[[part]]\n[[part]]", ":2: time.speed = -1: must be greater than 0"},
      {"[[part]]\n[[part]]\nred.width = 7", ":2: red.position"},
      {"[[part]]\n[[part]]\nred.position = 2", ":3: red.position"},
  };
  for (const auto& [text, expected] : cases) {
    const auto found = problems(text);
    ASSERT_EQ(found.size(), 1U) << text << "\n" << testing::PrintToString(found);
    EXPECT_TRUE(found.front().starts_with(path_ + expected)) << found.front();
  }
}

TEST_F(StoryboardFileTest, AllProblemsAreToldAtOnce) {
  const auto found = problems(
      "[view]\nfps = 0\n[[part]]\ncard = ''\n[[part]]\ndigits = 0\n[[part]]\ntime.speed = -1\n");
  EXPECT_EQ(found.size(), 4U) << testing::PrintToString(found);
}

TEST_F(StoryboardFileTest, HasALimitedNumberOfParts) {
  std::string text;
  for (std::size_t i = 0; i < kMaxSegments; ++i) text += "[[part]]\n";
  EXPECT_EQ(story(text).segments.size(), kMaxSegments);
  EXPECT_EQ(problems(text + "[[part]]\n").size(), 1U);
}

TEST_F(StoryboardFileTest, KeysOfOneRunAreRefusedBeforeTheFileIsReadAsWell) {
  std::ofstream(path_) << "[[part]]\n[[part]]\ncard = 'a'\n";
  ScriptBuilder builder;
  builder.set("--fps", "view.fps", "12");
  builder.set("--speed", "time.speed", "2");
  builder.read_file(path_);
  const auto found = problems(builder);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_TRUE(found[0].starts_with("--speed: '" + path_ + "' is a storyboard"));
}

TEST_F(StoryboardFileTest, OptionsSetKeysOfTheWholeFilmOnly) {
  std::ofstream(path_) << "[[part]]\n[[part]]\ncard = 'a'\n";
  ScriptBuilder builder;
  builder.read_file(path_);
  builder.set("--size", "view.size", "64x48");
  builder.set("--fps", "view.fps", "12");
  const auto story = std::get<Storyboard>(builder.build());
  EXPECT_EQ(story.view.height_px, 48);
  EXPECT_EQ(story.view.frame_rate, 12);
  builder.set("--speed", "time.speed", "2");
  builder.set("--digits", "digits", "2");
  builder.set("--size", "view.size", "0x48");
  const auto found = problems(builder);
  ASSERT_EQ(found.size(), 3U);
  EXPECT_TRUE(found[0].starts_with("--speed: '" + path_ + "' is a storyboard"));
  EXPECT_TRUE(found[1].starts_with("--digits: '" + path_ + "' is a storyboard"));
  EXPECT_TRUE(found[2].starts_with("--size: view.size = 0x48"));
}

TEST_F(StoryboardFileTest, IsNotBuiltAsAScene) {
  std::ofstream(path_) << "[[part]]\n";
  ScriptBuilder builder;
  builder.read_file(path_);
  EXPECT_THROW(builder.build_scene(), SceneError);
}

/// Parts of a rendering are told apart by descriptions.
TEST_F(StoryboardFileTest, DescriptionsDifferWhereFilmsDo) {
  const std::string base =
      "[view]\nfps = 30\n[[part]]\ncard = ['a', 'b']\n[[part]]\nfade = 1\n"
      "compare = [{digits = 1}, {digits = 2}]\n";
  const std::vector<std::pair<std::string, std::string>> changes = {
      {"fps = 30", "fps = 31"},
      {"fps = 30", "fps = 30\n[sound]\non = true"},
      {"'b'", "'c'"},
      {"['a', 'b']", "'a b'"},
      {"['a', 'b']", "'a'\nseconds = 3"},
      {"fade = 1", "fade = 2"},
      {"digits = 2", "digits = 3"},
      {"{digits = 1}", "{digits = 1}, {digits = 1}"}};
  const auto described = describe(story(base));
  EXPECT_EQ(described, describe(story(base)));
  for (const auto& [from, to] : changes) {
    std::string changed = base;
    changed.replace(changed.find(from), from.size(), to);
    EXPECT_NE(described, describe(story(changed))) << to;
  }
}

TEST(Storyboard, ProblemsOfOneMadeByHandAreToldAtOnce) {
  Storyboard story;
  EXPECT_EQ(problems_of(story).size(), 1U);
  story.segments = {{.content = Scenes{}, .fade_s = 1},
                    {.content = Card{}, .fade_s = -1},
                    {Card{{"a", ""}, 0}},
                    {Card{{"a\xff"}}},
                    {Scenes{Scene{}}}};
  story.view.width_px = 0;
  const auto found = problems_of(story);
  // The frame, as the film's and as the last part's; fade and no run; fade and no line; an empty
  // line and no time; a line that is not UTF-8.
  EXPECT_EQ(found.size(), 9U) << UsageError(found).what();
}

}  // namespace
}  // namespace piblocks
