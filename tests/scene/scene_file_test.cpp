#include <gtest/gtest.h>
#include <piblocks/error.hpp>
#include <piblocks/scene.hpp>
#include <piblocks/script.hpp>
#include <piblocks/two_blocks.hpp>

#include <algorithm>
#include <fstream>

#include "scene/file_fixture.hpp"
#include "scene/scene_keys.hpp"

namespace piblocks {
namespace {

using SceneFileTest = FileFixture;

TEST_F(SceneFileTest, EmptyFileIsTheArticlesScene) {
  const Scene scene = load("");
  EXPECT_EQ(scene.system.bodies[1].mass.value(), 10000);
  EXPECT_EQ(scene.system.bodies[1].position[0], 5);
  EXPECT_EQ(scene.system.bodies[1].velocity[0], -1);
  EXPECT_EQ(two_blocks_of(scene.system)->blue_gap(), Rational(3, 2));
  EXPECT_EQ(scene.view.x.low, -1);
  EXPECT_EQ(scene.view.x.high, 12);
  EXPECT_EQ(scene.view.width_px, 1920);
  EXPECT_EQ(scene.view.frame_rate, 60);
  EXPECT_EQ(scene.time.to, Instant::last(Rational(3, 2)));
}

TEST_F(SceneFileTest, RefusesTextOfMoreThanOneLine) {
  for (const char* key : {"title", "caption", "logo"}) {
    for (const char* text : {"a\\nb.png", "a\\u007F", "\\ta.png"}) {
      const auto found = problems(std::string("[show]\n") + key + " = \"" + text + "\"\n");
      ASSERT_EQ(found.size(), 1U) << key << text;
      EXPECT_TRUE(contains(found.front(), "must be one line of text"));
    }
  }
  const std::string long_path = std::string(2000, 'a') + ".png";
  EXPECT_TRUE(load("[show]\nlogo = '" + long_path + "'").show.logo.ends_with(long_path));
}

TEST_F(SceneFileTest, AnEmptyListIsNoneWhereThereMayBeNone) {
  const Scene scene = load(R"(
    [show]
    overlays = []
    panels = []
    [time]
    slow-motion = []
    freeze = []
    [golden]
    frames = []
  )");
  EXPECT_EQ(scene.show.overlays, std::vector<Overlay>());
  EXPECT_TRUE(scene.show.panels.empty());
  EXPECT_TRUE(scene.pacing.slow_motion.empty() && scene.pacing.freezes.empty());
  EXPECT_TRUE(scene.golden.frames.empty());
  for (const char* text :
       {"[view]\nsize = []", "[golden]\nsize = []", "[view]\nx = []", "[show]\ntitle = []",
        "[time]\nduration = []", "[time]\nloop = []", "[red]\nwidth = []"}) {
    const auto found = problems(text);
    ASSERT_EQ(found.size(), 1U) << text;
    EXPECT_TRUE(contains(found.front(), " = []: must be "));
  }
}

TEST_F(SceneFileTest, BlanksAroundNamesOfAListAreNone) {
  const Scene scene =
      load("[time]\nslow-motion = ' auto , 5:6:3 '\n[show]\npanels = 'time ,\tcount '\n");
  EXPECT_TRUE(scene.pacing.automatic_slow_motion);
  EXPECT_EQ(scene.pacing.slow_motion.size(), 1U);
  EXPECT_EQ(scene.show.panels, (std::vector{Panel::time, Panel::count}));
}

TEST_F(SceneFileTest, SpeedAndDurationExcludeEachOther) {
  EXPECT_EQ(problems("[time]\nspeed = 2\nduration = 3\n").size(), 1U);
  ScriptBuilder builder;
  builder.set("--duration", "time.duration", "3");
  builder.set("--speed", "time.speed", "2");
  EXPECT_FALSE(builder.build_scene().pacing.duration_s);
}

TEST_F(SceneFileTest, LeavesKeysOut) {
  ScriptBuilder builder;
  builder.leave_out("view.fps");
  builder.leave_out("digits");
  builder.leave_out("time.to");  // which is not there
  builder.read_text("text", "digits = 0\n[view]\nfps = 0\ntheme = \"dark\"\n");
  const Scene scene = builder.build_scene();
  EXPECT_EQ(scene.view.frame_rate, Scene().view.frame_rate);
  EXPECT_EQ(scene.system.bodies[1].mass.value(), Scene().system.bodies[1].mass.value());
  EXPECT_EQ(scene.view.theme, Theme::dark);
}

TEST_F(SceneFileTest, ReadsColours) {
  const Scene scene = load(R"(
    [view]
    background = "#FDf6e3"
    [view.colors]
    ink = "#073642"
    done = "#859900"
    [red]
    color = "#dc322f"
  )");
  EXPECT_EQ(scene.view.background, Background::opaque);
  EXPECT_EQ(scene.view.colors.background, (RgbColor{0xfd, 0xf6, 0xe3}));
  EXPECT_EQ(scene.view.colors.ink, (RgbColor{0x07, 0x36, 0x42}));
  EXPECT_EQ(scene.view.colors.done, (RgbColor{0x85, 0x99, 0x00}));
  EXPECT_FALSE(scene.view.colors.accent);
  EXPECT_EQ(scene.styles[1].color, (RgbColor{0xdc, 0x32, 0x2f}));
  EXPECT_FALSE(scene.styles[0].color);
  EXPECT_EQ(describe(load(scene_toml(scene))), describe(scene));
}

TEST_F(SceneFileTest, ABackgroundReplacesTheOneBefore) {
  ScriptBuilder builder;
  builder.read_text("text", "view.background = '#fdf6e3'\n");
  builder.set("--opaque", "view.background", "opaque");
  EXPECT_FALSE(builder.build_scene().view.colors.background);
  builder.set("--background", "view.background", "#102030");
  builder.set("--transparent", "view.background", "transparent");
  EXPECT_EQ(builder.build_scene().view.background, Background::transparent);
  EXPECT_FALSE(builder.build_scene().view.colors.background);
  Scene both;
  both.view.background = Background::transparent;
  both.view.colors.background = RgbColor{1, 2, 3};
  ASSERT_EQ(problems_of(both).size(), 1U);
  EXPECT_EQ(problems_of(both).front().key, "view.background");
}

TEST_F(SceneFileTest, BackgroundsAreNamesOrColours) {
  for (const char* text : {"5", "'#12'", "'fdf6e3'", "'red'", "''", "'#fdf6e'", "'#fdf6ez'"}) {
    const auto found = problems(std::string("view.background = ") + text + "\n");
    ASSERT_EQ(found.size(), 1U) << text;
    EXPECT_TRUE(contains(found.front(), "a colour as \"#1f77b4\": # and six hexadecimal digits"));
  }
}

TEST_F(SceneFileTest, ReadsEveryKey) {
  const Scene scene = load(R"(
    [wall]
    face = -0.5
    [blue]
    mass = "1/3"
    position = 2.25
    velocity = 0.1
    width = 0.5
    [red]
    mass = "100^16"
    position = 7
    velocity = "-3/2"
    width = 2
    [view]
    x = [-2, "25/2"]
    y = [-1.5, 1.5]
    size = [1280, 720]
    fps = "30000/1001"
    shutter = 0.5
    [time]
    from = 1
    to = "last+0.25"
    speed = "1/2"
  )");
  EXPECT_EQ(scene.system.walls[0].point[0], Rational(-1, 2));
  EXPECT_EQ(scene.view.shutter, Rational(1, 2));
  EXPECT_EQ(scene.system.bodies[0].mass.value(), Rational(1, 3));
  EXPECT_EQ(scene.system.bodies[0].position[0], Rational(9, 4));
  EXPECT_EQ(scene.system.bodies[0].velocity[0], Rational(1, 10)) << "a decimal means the decimal";
  EXPECT_EQ(scene.system.bodies[0].size, Rational(1, 2));
  EXPECT_EQ(scene.system.bodies[1].mass.value(), parse_rational("1e32"));
  EXPECT_EQ(scene.system.bodies[1].position[0], 7);
  EXPECT_EQ(scene.system.bodies[1].velocity[0], Rational(-3, 2));
  EXPECT_EQ(scene.system.bodies[1].size, 2);
  EXPECT_EQ(scene.view.x.low, -2);
  EXPECT_EQ(scene.view.x.high, Rational(25, 2));
  EXPECT_EQ(scene.view.y.low, Rational(-3, 2));
  EXPECT_EQ(scene.view.y.high, Rational(3, 2));
  EXPECT_EQ(scene.view.width_px, 1280);
  EXPECT_EQ(scene.view.height_px, 720);
  EXPECT_EQ(scene.view.frame_rate, Rational(30000, 1001));
  EXPECT_EQ(scene.time.from, Rational(1));
  EXPECT_EQ(scene.time.to, Instant::last(Rational(1, 4)));
  EXPECT_EQ(scene.time.speed, Rational(1, 2));
}

TEST_F(SceneFileTest, ReportsEveryProblemWithItsLine) {
  const auto found = problems(
      "[blue]\n"
      "mass = 0\n"
      "colour = 'green'\n"
      "[red]\n"
      "mass = true\n"
      "position = 'far'\n"
      "[vieww]\n"
      "size = [1, 2]\n"
      "[time]\n"
      "speed = -1\n");
  ASSERT_EQ(found.size(), 6u);
  const auto has = [&](const std::string& place, const std::string& key, const std::string& why) {
    return std::any_of(found.begin(), found.end(), [&](const std::string& line) {
      return line.starts_with(path_ + ":" + place + ": " + key) && contains(line, why);
    });
  };
  EXPECT_TRUE(has("2", "blue.mass", "= 0: must be greater than 0"));
  EXPECT_TRUE(has("3", "blue.colour", "unknown key"));
  EXPECT_TRUE(has("5", "red.mass = true", "not a number"));
  EXPECT_TRUE(has("6", "red.position = far", "not a number"));
  EXPECT_TRUE(has("8", "vieww.size", "unknown key"));
  EXPECT_TRUE(has("10", "time.speed", "= -1: must be greater than 0"));
}

TEST_F(SceneFileTest, DecimalsAreReadAsTheyStand) {
  const Scene scene = load(R"(
    show.title = "\u00fc" # ü
    view = { x = [-1, 12.50], theme = "dark", size = "640x360", y = [ -1.000000000000000000000001, 1_0.5e-1 ] }
    [red]
    mass = 1.00000000000000000000000000000001
    position = +5.000000000000000000000000000000000000001
  )");
  EXPECT_EQ(scene.system.bodies[1].mass.value(),
            parse_rational("1.00000000000000000000000000000001"));
  EXPECT_EQ(scene.system.bodies[1].position[0], 5 + 1 / power(10, 39));
  EXPECT_EQ(scene.view.x.high, Rational(25, 2));
  EXPECT_EQ(scene.view.y.low, -1 - 1 / power(10, 24));
  EXPECT_EQ(scene.view.y.high, Rational(21, 20));
  EXPECT_EQ(count_collisions(scene.system), 4);
}

/// Decimals of k/1001, cut off or rounded, stand for it; fractions and other decimals for
/// themselves.
TEST_F(SceneFileTest, RatesOfBroadcastingHaveDecimals) {
  for (const auto& [text, rate] : {std::pair("29.97", Rational(30000, 1001)),
                                   {"29.970", Rational(30000, 1001)},
                                   {"23.976", Rational(24000, 1001)},
                                   {"23.98", Rational(24000, 1001)},
                                   {"59.94", Rational(60000, 1001)},
                                   {"119.88", Rational(120000, 1001)},
                                   {"'2997/100'", Rational(2997, 100)},
                                   {"29.98", Rational(2998, 100)},
                                   {"29.96", Rational(2996, 100)},
                                   {"24.975", Rational(24975, 1000)},
                                   {"30", Rational(30)},
                                   {"0.5", Rational(1, 2)}}) {
    Rational expected = rate;
    expected.canonicalize();
    EXPECT_EQ(load(std::string("[view]\nfps = ") + text).view.frame_rate, expected) << text;
  }
}

/// As editors of other systems write it.
TEST_F(SceneFileTest, LineEndsAndEncodingMayBeOfAnotherSystem) {
  const char* const text = "[red]\r\nmass = 1.00000000000000000000000000000001\r\n# x\r\n";
  EXPECT_EQ(load(text).system.bodies[1].mass.value(),
            parse_rational("1.00000000000000000000000000000001"));
  EXPECT_EQ(load(std::string("\xef\xbb\xbf") + text).system.bodies[1].mass.value(),
            parse_rational("1.00000000000000000000000000000001"));
  EXPECT_EQ(problems("[red]\r\nmas = 1\r\n").at(0),
            path_ + ":2: red.mas: unknown key; did you mean 'red.mass'?");
  const std::string advice = ": is not valid UTF-8; save the file in that encoding";
  EXPECT_EQ(problems("# caf\xe9\n").at(0), path_ + ":1" + advice);
  EXPECT_EQ(problems("\n\nshow.title = '\xff'\n").at(0), path_ + ":3" + advice);
  EXPECT_EQ(problems("\xff\xfe[\n").at(0), path_ + ":1" + advice);
}

TEST_F(SceneFileTest, ColumnsBehindOtherScriptsAreFound) {
  const Scene scene = load(
      "show = { title = 'πü→', caption = '' }\nview = { theme = 'dark', "
      "x = [-1.25, 12.0000000000000000000000001] } # π\n");
  EXPECT_EQ(scene.view.x.high, 12 + 1 / power(10, 25));
  const Scene inlined = load(
      "golden = { frames = ['0'], size = '10x10' }\n"
      "red = { width = 'by-mass', mass = 2.50 }\n");
  EXPECT_EQ(inlined.system.bodies[1].mass.value(), Rational(5, 2));
}

TEST_F(SceneFileTest, RefusesInvalidValuesOneByOne) {
  const std::pair<const char*, const char*> cases[] = {
      {"[red]\nmass = -1", "red.mass"},
      {"mass-ratio = 0", ":1: red.mass = 0: must be greater"},
      {"[red]\nmass = nan", "red.mass"},
      {"[blue]\nmass = inf", "blue.mass"},
      {"[blue]\nwidth = 0", "blue.width"},
      {"[blue]\nposition = 0.4",
       "= 2/5: blue reaches 1/10 into the wall, whose face is at 0; must be at least 1/2"},
      {"[blue]\nposition = -5", "blue is left of the wall's face at 0; must be at least 1/2"},
      {"[red]\nposition = 2.9", "= 29/10: red overlaps blue by 1/10; must be at least 3"},
      {"[red]\nposition = 1", "= 1: red is left of blue; must be at least 3"},
      {"[red]\nposition = '1e400'", "range of a double"},
      {"[view]\nsize = [0, 10]", "view.size"},
      {"[view]\nsize = [-5, 10]", "view.size"},
      {"[view]\nsize = [16385, 10]", "view.size"},
      {"[view]\nsize = [16384, 16384]", "view.size"},
      {"[view]\nsize = [99999999999999999999, 2]", ""},
      {"[view]\nsize = [10.5, 10]", "view.size"},
      {"[view]\nsize = [10]", "view.size"},
      {"[view]\nx = [2, 2]", "view.x"},
      {"[view]\ny = [1, -1]", "view.y"},
      {"[view]\nfps = 0", "view.fps"},
      {"[view]\nfps = '1/0'", "view.fps"},
      {"[view]\nfps = 1001", "view.fps"},
      {"[view]\nfps = '1/3000000'", "view.fps"},
      {"[view]\nshutter = 1.01", "view.shutter"},
      {"[view]\nshutter = -1", "view.shutter"},
      {"[view]\nshutter = true", "view.shutter"},
      {"[time]\nspeed = 0", "time.speed"},
      {"[time]\nfrom = 5\nto = 5", "time.to"},
      {"[time]\nto = 'first'", "time.to"},
      {"[time]\nto = 'last-'", "time.to"},
      {"[time]\nfrom = 'turn+-1'", "time.from"},
      {"[time]\nfrom = '#1.5'", "time.from"},
      {"[time]\nto = 'last+-1'", "time.to"},
      {"[time]\nto = [1, 2]", "time.to"},
      {"[time]\nfreeze = 'turn:0'", ":2: time.freeze has a freeze of 0 s"},
      {"[time]\nslow-motion = '1:2:-3'", ":2: time.slow-motion has a window whose factor is -3"},
      {"[show]\npanels = ['time', 'count', 'time']", ":2: show.panels has 'time' more than once"},
      {"[golden]\nframes = ['last', 'last']", ":2: golden.frames has 'last' more than once"},
      {"[golden]\nframes = ['first']", ":2: golden.frames has 'first': "},
      {"[blocks]\nrestitution = 1.5", ":2: blocks.restitution = 3/2: must be from 0 "},
      {"[wall]\nrestitution = -1", ":2: wall.restitution = -1: must be from 0 "},
      {"digits = 2\nrestitution = -0.1", ":2: restitution = -0.1: must be from 0 "},
      {"restitution = 0.5\nwall.restitution = 0.5",
       ": restitution and wall.restitution both set the restitution of the wall"},
      {"blocks.restitution = 0.5\nrestitution = 0.5",
       ": restitution and blocks.restitution both set the restitution of the blocks"},
      {"blocks.restitution = 0.5\n[show]\npanels = ['time', 'unfolded', 'count']",
       ":3: show.panels has 'unfolded', which needs elastic collisions"},
      {"wall.restitution = 0.5\n[show]\noverlays = ['energy', 'digits']",
       ":3: show.overlays has 'digits', which needs elastic collisions"},
      {"wall = 3", "wall"},
      {"[red]\nmass = = 3\n", ":2: "},
      {"[wall]\nface = []", "wall.face"},
      {"[wall]\nface = { x = 1 }", "wall.face"},
      {"[wall]\nface = 2020-01-01", "wall.face"},
  };
  for (const auto& [text, expected] : cases) {
    const auto found = problems(text);
    ASSERT_EQ(found.size(), 1u) << text;
    EXPECT_TRUE(contains(found.front(), expected));
    EXPECT_TRUE(contains(found.front(), path_ + ":"));
  }
}

TEST_F(SceneFileTest, RefusesWhatItCannotRead) {
  ScriptBuilder builder;
  EXPECT_THROW(builder.read_file(folder_ / "missing.toml"), SceneError);
  EXPECT_THROW(builder.read_file(folder_.path().string()), SceneError);
  const auto found = problems(std::string((1 << 20) + 1, '#'));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(contains(found.front(), "longer than 1048576 bytes, the most"));
  EXPECT_THROW(load(std::string(100000, '[')), SceneError);
}

TEST_F(SceneFileTest, OptionsWinAndAreNamed) {
  std::ofstream(path_) << "[view]\nsize = [640, 480]\n[red]\nmass = 7\n[blue]\nmass = 3\n";
  ScriptBuilder builder;
  builder.read_file(path_);
  builder.set("--size", "view.size", "1280x720");
  builder.set("--digits", "digits", "2");
  const Scene scene = builder.build_scene();
  EXPECT_EQ(scene.view.width_px, 1280);
  EXPECT_EQ(scene.view.height_px, 720);
  EXPECT_EQ(scene.system.bodies[1].mass.value(), 300)
      << "the ratio is to the blue mass of the file";

  builder.set("--size", "view.size", "1280");
  builder.set("--fps", "view.fps", "-1");
  const auto found = problems(builder);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_TRUE(found[0].starts_with("--size: view.size = 1280: "));
  EXPECT_TRUE(found[1].starts_with("--fps: view.fps = -1: "));
}

}  // namespace
}  // namespace piblocks
