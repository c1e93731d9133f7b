// Bodies, their box and their walls in scene files: what is read, and what is wrong with it.
#include <gtest/gtest.h>
#include <piblocks/error.hpp>
#include <piblocks/script.hpp>

#include <algorithm>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "scene/file_fixture.hpp"
#include "scene/run_log.hpp"

namespace piblocks {
namespace {

class BodiesFile : public FileFixture {
 protected:
  Scene load(const std::string& text) { return std::get<Scene>(script(text)); }

  /// Expects one problem, whose line is "PATH:" and this.
  void expect_problem(const std::string& text, const std::string& line) {
    const std::vector<std::string> found = problems(text);
    ASSERT_EQ(found.size(), 1U) << text << (found.empty() ? "" : "\n" + found.back());
    EXPECT_EQ(found.front(), path_ + ":" + line) << text;
    EXPECT_EQ(found.front().find('\n'), std::string::npos);
  }
};

ExactVector vector_of(const char* x, const char* y) {
  return {parse_rational(x), parse_rational(y)};
}

TEST_F(BodiesFile, BlocksAreReadExactly) {
  const Scene scene = load(R"(
    [box]
    x = [-0.1, 30]
    [[body]]
    mass = "1/3"
    position = 0.6000000000000000000000000000001
    velocity = "-2/7"
    width = 1.2
    color = "#1F77b4"
    label = "größer"
    [[body]]
    mass = "inf"
    position = 5
    [[body]]
    mass = inf
    position = [7]
    [[body]]
    position = "1e1"
    width = 0.5
    [time]
    to = 9
  )");
  ASSERT_TRUE(scene.bodies);
  const auto& [system, styles] = *scene.bodies;
  EXPECT_EQ(system.dimensions, 1);
  ASSERT_EQ(system.bodies.size(), 4U);
  ASSERT_EQ(styles.size(), 4U);
  const Body& first = system.bodies[0];
  EXPECT_EQ(first.mass, Rational(1, 3));
  EXPECT_EQ(first.position, vector_of("0.6000000000000000000000000000001", "0"));
  EXPECT_EQ(first.velocity, vector_of("-2/7", "0"));
  EXPECT_EQ(first.size, Rational(6, 5));
  EXPECT_EQ(styles[0].color, (std::array<std::uint8_t, 3>{0x1f, 0x77, 0xb4}));
  EXPECT_EQ(styles[0].label, "größer");
  EXPECT_FALSE(system.bodies[1].mass);
  EXPECT_FALSE(system.bodies[2].mass);
  EXPECT_EQ(system.bodies[2].position, vector_of("7", "0"));
  const Body& last = system.bodies[3];
  EXPECT_EQ(last.mass, Rational(1)) << "the default";
  EXPECT_EQ(last.position, vector_of("10", "0"));
  EXPECT_EQ(last.velocity, vector_of("0", "0"));
  EXPECT_EQ(last.size, Rational(1, 2));
  EXPECT_FALSE(styles[3].color);
  EXPECT_EQ(styles[3].label, "");
  ASSERT_EQ(system.walls.size(), 2U);
  EXPECT_EQ(system.walls[0].name, "left");
  EXPECT_EQ(system.walls[0].point[0], Rational(-1, 10));
  EXPECT_EQ(system.walls[0].normal, vector_of("1", "0"));
  EXPECT_EQ(system.walls[1].name, "right");
  EXPECT_EQ(system.walls[1].point[0], 30);
  EXPECT_EQ(system.walls[1].normal, vector_of("-1", "0"));
}

TEST_F(BodiesFile, DiscsAreReadExactly) {
  const Scene scene = load(R"(
    [box]
    x = ["-inf", 8]
    y = [0, "inf"]
    [[wall]]
    point = [0.3, "-1/3"]
    normal = ["3", 0.4]
    [[body]]
    radius = "1/7"
    position = [1.1, 2.2]
    velocity = ["-1/9", 1e-3]
  )");
  ASSERT_TRUE(scene.bodies);
  const BodySystem& system = scene.bodies->system;
  EXPECT_EQ(system.dimensions, 2);
  ASSERT_EQ(system.bodies.size(), 1U);
  EXPECT_EQ(system.bodies[0].position, vector_of("11/10", "11/5"));
  EXPECT_EQ(system.bodies[0].velocity, vector_of("-1/9", "1/1000"));
  EXPECT_EQ(system.bodies[0].size, Rational(1, 7));
  ASSERT_EQ(system.walls.size(), 3U) << "'inf' is no wall";
  EXPECT_EQ(system.walls[0].name, "right");
  EXPECT_EQ(system.walls[1].name, "lower");
  EXPECT_EQ(system.walls[1].normal, vector_of("0", "1"));
  EXPECT_EQ(system.walls[2].name, "slanted-1");
  EXPECT_EQ(system.walls[2].point, vector_of("3/10", "-1/3"));
  EXPECT_EQ(system.walls[2].normal, vector_of("3", "2/5"));
}

TEST_F(BodiesFile, TwoCoordinatesMakeADiscWithoutARadius) {
  const Scene scene = load("[[body]]\nposition = [1, 2]\n");
  EXPECT_EQ(scene.bodies->system.dimensions, 2);
  EXPECT_EQ(scene.bodies->system.bodies[0].size, 1);
}

TEST_F(BodiesFile, AWallOfFiniteMassIsABlock) {
  const Scene scene = load(R"(
    mass-ratio = 16
    blue.mass = 2
    [wall]
    mass = "7/2"
    face = -0.25
  )");
  ASSERT_TRUE(scene.bodies);
  const std::vector<Body>& bodies = scene.bodies->system.bodies;
  ASSERT_EQ(bodies.size(), 3U);
  EXPECT_TRUE(scene.bodies->system.walls.empty());
  EXPECT_EQ(bodies[0].mass, Rational(2));
  EXPECT_EQ(bodies[0].position[0], 2);
  EXPECT_EQ(bodies[1].mass, Rational(32));
  EXPECT_EQ(bodies[1].velocity[0], -1);
  EXPECT_EQ(bodies[2].mass, Rational(7, 2));
  EXPECT_EQ(bodies[2].position[0] + bodies[2].size / 2, Rational(-1, 4)) << "its face";
  EXPECT_EQ(bodies[2].velocity[0], 0);
  EXPECT_EQ(scene.bodies->styles[2].label, "wall");
  EXPECT_FALSE(load("[wall]\nmass = 'inf'\n").bodies);
  EXPECT_FALSE(load("[wall]\nmass = inf\nface = -1\n").bodies);
}

TEST_F(BodiesFile, TheViewShowsEverything) {
  const auto shown = [](const Range& range) { return std::pair(range.low, range.high); };
  const std::string block = "[[body]]\nposition = 2\nwidth = 2\n";
  const Scene blocks = load(block + "[[body]]\nposition = 10\nwidth = 4\n");
  EXPECT_EQ(shown(blocks.view.x), std::pair(parse_rational("0.45"), parse_rational("12.55")));
  EXPECT_EQ(shown(blocks.view.y), shown(View().y));
  const Scene boxed = load("[box]\nx = [-10, 10]\n[time]\nto = 1\n" + block);
  EXPECT_EQ(shown(boxed.view.x), std::pair(Rational(-11), Rational(11)));
  const std::string disc = "[[body]]\nposition = [2, 4]\nradius = 0.5\n";
  const Scene discs = load(disc + "[[body]]\nposition = [5, 2]\nradius = 1\n");
  EXPECT_EQ(shown(discs.view.x), std::pair(parse_rational("1.275"), parse_rational("6.225")));
  EXPECT_EQ(shown(discs.view.y), std::pair(parse_rational("0.825"), parse_rational("4.675")));
}

TEST_F(BodiesFile, AViewThatIsGivenStays) {
  const std::string block = "[[body]]\nposition = 2\n";
  const std::string disc = "[[body]]\nposition = [2, 4]\n";
  const Scene blocks = load(block + "[view]\nx = [-3, 4]\n");
  EXPECT_EQ(blocks.view.x.low, -3);
  EXPECT_EQ(blocks.view.x.high, 4);
  const Scene discs = load(disc + "[view]\ny = [-9, 9]\n");
  EXPECT_EQ(discs.view.y.low, -9);
  EXPECT_EQ(discs.view.y.high, 9);
  EXPECT_EQ(discs.view.x.low, parse_rational("0.9"));
}

TEST_F(BodiesFile, DescriptionsDifferByEveryProperty) {
  const std::string blocks = "[time]\nto = 3\n[box]\nx = [0, 20]\n[[body]]\nposition = 10\n";
  const std::string discs =
      "[time]\nto = 3\n[box]\nx = [0, 20]\ny = [0, 20]\n[[body]]\nposition = [10, 9]\n";
  const std::vector<std::string> texts = {
      blocks,
      blocks + "mass = 2\n",
      blocks + "mass = 2.0000000000000000000000000000000001\n",
      blocks + "velocity = 1\n",
      blocks + "velocity = -1\n",
      blocks + "width = 2\n",
      blocks + "color = '#000000'\n",
      blocks + "color = '#000001'\n",
      blocks + "color = '#000100'\n",
      blocks + "color = '#010000'\n",
      blocks + "label = 'a'\n",
      blocks + "label = 'b'\n",
      blocks + "[[body]]\nposition = 15\n",
      blocks + "[[body]]\nposition = 15\nmass = 'inf'\n",
      "[time]\nto = 3\n[box]\nx = [0, 20]\n[[body]]\nposition = 11\n",
      "[time]\nto = 3\n[box]\nx = [0, 21]\n[[body]]\nposition = 10\n",
      "[time]\nto = 3\n[box]\nx = [1, 20]\n[[body]]\nposition = 10\n",
      "[time]\nto = 3\n[box]\nx = [0, 'inf']\n[[body]]\nposition = 10\n",
      discs,
      discs + "radius = 2\n",
      discs + "velocity = [0, 1]\n",
      discs + "velocity = [1, 0]\n",
      discs + "[[wall]]\npoint = [0, 0]\nnormal = [1, 1]\n",
      discs + "[[wall]]\npoint = [0, 0]\nnormal = [1, 2]\n",
      discs + "[[wall]]\npoint = [0, -1]\nnormal = [1, 1]\n",
      "[time]\nto = 3\n[box]\nx = [0, 20]\ny = [0, 20]\n[[body]]\nposition = [10, 10]\n",
      "[time]\nto = 3\n[box]\nx = [0, 20]\ny = [0, 21]\n[[body]]\nposition = [10, 9]\n",
      "[time]\nto = 3\nallow-uncertain = true\n[box]\nx = [0, 20]\n[[body]]\nposition = 10\n",
      "",
      "[wall]\nmass = 3\n",
      "[wall]\nmass = 4\n",
  };
  // With one view, so that it is not what makes the difference.
  const std::string view = "[view]\nx = [-1, 30]\ny = [-1, 30]\n";
  std::set<std::vector<std::pair<std::string, std::string>>> seen;
  for (const std::string& text : texts) {
    EXPECT_TRUE(seen.insert(describe(load(view + text))).second) << text;
    EXPECT_FALSE(seen.insert(describe(load(view + text))).second) << text << " is not itself";
  }
}

TEST_F(BodiesFile, DescriptionsTellTheOrderOfBodies) {
  const std::string a = "[[body]]\nposition = 0\n";
  const std::string b = "[[body]]\nposition = 3\n";
  EXPECT_NE(describe(load(a + b)), describe(load(b + a)));
}

TEST_F(BodiesFile, KeysOfABodyAreChecked) {
  const std::string body = "[[body]]\nposition = 0\n";
  expect_problem(body + "size = 3\n", "3: body 1.size: unknown key");
  expect_problem(body + "mass = 'heavy'\n", "3: body 1.mass = heavy: not a number");
  expect_problem(body + "mass = '-inf'\n", "3: body 1.mass = -inf: not a number");
  expect_problem(body + "mass = 0\n", "1: body 1.mass = 0: must be greater than 0");
  expect_problem(body + "mass = [1, 2]\n", "3: body 1.mass = [1, 2]: must be one value");
  expect_problem(body + "width = -1\n", "1: body 1.width = -1: must be greater than 0");
  expect_problem(body + "velocity = [1, 2, 3]\n",
                 "3: body 1.velocity = [1, 2, 3]: must be a number, or two as [x, y]");
  expect_problem(body + "color = 'blue'\n",
                 "3: body 1.color = blue: must be a colour as \"#1f77b4\"");
  expect_problem(body + "color = '#12345g'\n",
                 "3: body 1.color = #12345g: must be a colour as \"#1f77b4\"");
  expect_problem(body + "label = \"a\\tb\"\n", "3: body 1.label = a\tb: must be one line of text");
  expect_problem("[[body]]\nwidth = 1\n", "1: body 1.position: is missing");
  expect_problem("[[body]]\nposition = 'here'\n", "2: body 1.position = here: not a number");
  expect_problem("[[body]]\nposition = []\n",
                 "2: body 1.position = []: must be a number, or two as [x, y]");
  expect_problem("[[body]]\nposition = { x = 1 }\n", "2: body 1.position.x: unknown key");
  expect_problem("[[body]]\nposition = '1e400'\n",
                 "1: body 1.position is beyond the range of a double (about 1.8e308)");
  expect_problem(body + "[[body]]\nposition = 5\n[[body]]\nposition = 9\nmas = 1\n",
                 "7: body 3.mas: unknown key");
}

TEST_F(BodiesFile, BodiesAreOfOneKind) {
  const std::string block = "[[body]]\nposition = 0\nwidth = 1\n";
  const std::string disc = "[[body]]\nposition = [3, 0]\nradius = 1\n";
  expect_problem("[[body]]\nposition = 0\nwidth = 1\nradius = 1\n",
                 "1: body 1: has a width and a radius; blocks have widths, discs have radii");
  expect_problem(block + disc,
                 "4: body 2: is a disc, and body 1 is a block; all must be of one kind");
  expect_problem(disc + block,
                 "4: body 2: is a block, and body 1 is a disc; all must be of one kind");
  const char* const two =
      ": is a block, and blocks move along x alone; give one number for position and velocity, or "
      "a "
      "radius instead of the width";
  expect_problem("[[body]]\nposition = [1, 2]\nwidth = 1\n", std::string("1: body 1") + two);
  expect_problem("[[body]]\nposition = 1\nvelocity = [1, 0]\nwidth = 1\n",
                 std::string("1: body 1") + two);
}

TEST_F(BodiesFile, BodiesHaveRoom) {
  const std::string blocks = "[[body]]\nposition = 0\n[[body]]\nposition = ";
  expect_problem(blocks + "'3/4'\n", "3: body 2.position = 3/4: overlaps body 1 by 1/4");
  expect_problem(blocks + "-0.5\n", "1: body 1.position = 0: overlaps body 2 by 1/2");
  EXPECT_TRUE(problems(blocks + "1\n").empty()) << "they may touch";
  const std::string discs = "[[body]]\nposition = [0, 0]\n[[body]]\nposition = ";
  expect_problem(discs + "[1.2, 1.59]\n", "3: body 2.position = [6/5, 159/100]: overlaps body 1");
  EXPECT_TRUE(problems(discs + "[1.2, 1.6]\n").empty()) << "they touch";
  const std::string box = "[time]\nto = 1\n[box]\nx = [0, 4]\ny = [0, 4]\n[[body]]\nposition = ";
  expect_problem(box + "[0.9, 2]\n", "6: body 1.position = [9/10, 2]: is beyond the left wall");
  expect_problem(box + "[2, 3.1]\n", "6: body 1.position = [2, 31/10]: is beyond the upper wall");
  EXPECT_TRUE(problems(box + "[1, 3]\n").empty()) << "it touches two walls";
  const std::string line = "[time]\nto = 1\n[box]\nx = [0, 4]\n[[body]]\nposition = ";
  expect_problem(line + "0\n", "5: body 1.position = 0: reaches 1/2 beyond the left wall");
  expect_problem(line + "3.75\n", "5: body 1.position = 15/4: reaches 1/4 beyond the right wall");
  const std::string wedge = "[[wall]]\npoint = [0, 0]\nnormal = [3, 4]\n[[body]]\nposition = ";
  expect_problem(wedge + "[0.6, 0.79]\n",
                 "4: body 1.position = [3/5, 79/100]: is beyond the slanted-1 wall");
  EXPECT_TRUE(problems(wedge + "[0.6, 0.8]\n").empty()) << "it touches";
}

TEST_F(BodiesFile, SomethingCanMove) {
  const std::string fixed = "[[body]]\nmass = 'inf'\nposition = 0\n";
  expect_problem(fixed, "1: body all have infinite mass: nothing can move");
  expect_problem(fixed + "[[body]]\nmass = 'inf'\nposition = 3\n",
                 "1: body all have infinite mass: nothing can move");
  expect_problem(fixed + "velocity = 1\n[[body]]\nposition = 3\n",
                 "1: body 1.velocity = [1, 0]: a body of infinite mass must be at rest");
}

TEST_F(BodiesFile, BodiesAreTables) {
  for (const char* text : {"body = 3\n", "body = []\n", "body = [1, 2]\n"}) {
    expect_problem(text, "1: body: is written [[body]], once for each");
  }
  expect_problem("[body]\nposition = 1\n", "2: body.position: unknown key");
}

TEST_F(BodiesFile, BoxesAreChecked) {
  const std::string body = "[[body]]\nposition = 1\n[time]\nto = 1\n[box]\n";
  const char* const two = ": must be two numbers, as [0, 10]; \"inf\" is no wall";
  expect_problem(body + "x = [0]\n", std::string("6: box.x = 0") + two);
  expect_problem(body + "x = [0, 1, 2]\n", std::string("6: box.x = [0, 1, 2]") + two);
  expect_problem(body + "x = [3, 0]\n",
                 "6: box.x = [3, 0]: must go from the lower to the higher end");
  expect_problem(body + "x = ['inf', 3]\n", "6: box.x = [inf, 3]: not a number");
  expect_problem(body + "z = [0, 3]\n", "6: box.z: unknown key");
  expect_problem(body + "y = [-1, 'inf']\n",
                 "6: box.y = [0, 1]: blocks on a line cannot meet the lower wall");
  expect_problem("box = 3\n[[body]]\nposition = 1\n", "1: box: unknown key");
  expect_problem("[box]\nx = [0, 3]\n", "2: box.x: is the box of bodies, and there is no [[body]]");
  expect_problem("[wall]\nmass = 3\n[box]\nx = [0, 30]\n",
                 "4: box.x: is the box of bodies, and there is no [[body]]");
}

TEST_F(BodiesFile, WallsAreChecked) {
  const std::string disc = "[[body]]\nposition = [5, 5]\n";
  const std::string wall = disc + "[[wall]]\npoint = [0, 0]\n";
  expect_problem(wall, "3: wall: needs a point on it and its normal");
  expect_problem(disc + "[[wall]]\nnormal = [0, 1]\n",
                 "3: wall: needs a point on it and its normal");
  expect_problem(wall + "normal = [1, 0]\nheight = 3\n", "6: wall.height: unknown key");
  expect_problem(wall + "normal = 3\n", "5: wall.normal = 3: must be two numbers, as [0, 1]");
  expect_problem(wall + "normal = [1, 'up']\n", "5: wall.normal = [1, up]: not a number");
  expect_problem(wall + "normal = [0, 0]\n", "3: wall 1.normal = [0, 0]: must not be 0");
  const std::string good = "[[wall]]\npoint = [0, 0]\nnormal = [1, 0]\n";
  expect_problem(disc + good + "[[wall]]\npoint = [0, 0]\nnormal = [0, 0]\n",
                 "6: wall 2.normal = [0, 0]: must not be 0");
  expect_problem("[[body]]\nposition = 5\n[[wall]]\npoint = [0, 0]\nnormal = [1, 1]\n",
                 "3: wall 1.normal = [1, 1]: blocks on a line cannot meet the slanted-1 wall");
  expect_problem(good, "1: wall: [[wall]] is a wall of bodies, and there is no [[body]]");
  std::string many = disc;
  for (int i = 0; i < 17; ++i) many += good;
  expect_problem(many, "3: wall = 17 of them: at most 16 are possible");
}

TEST_F(BodiesFile, AWallThatRecoilsIsChecked) {
  const std::string wall = "[wall]\nmass = 3\n";
  for (const char* mass : {"0", "-1", "'1e400'"}) {
    const auto found = problems(std::string("[wall]\nmass = ") + mass + "\n");
    ASSERT_EQ(found.size(), 1U) << mass;
    EXPECT_TRUE(found.front().starts_with(path_ + ":2: wall.mass = ")) << found.front();
    EXPECT_NE(found.front().find("must be greater than 0"), std::string::npos) << found.front();
  }
  expect_problem(wall + "restitution = 0.5\n",
                 "2: wall.mass: a wall that recoils is elastic; leave out the restitution, or the "
                 "mass");
  // In the words of the file, which has no bodies.
  expect_problem(wall + "[blue]\nmass = 0\n", "4: blue.mass = 0: must be greater than 0");
  const auto overlap = problems(wall + "[red]\nposition = 2.5\n");
  ASSERT_EQ(overlap.size(), 1U);
  EXPECT_TRUE(overlap.front().starts_with(path_ + ":4: red.position")) << overlap.front();
  const auto inside = problems(wall + "[blue]\nposition = 0.4\n");
  ASSERT_EQ(inside.size(), 1U);
  EXPECT_TRUE(inside.front().starts_with(path_ + ":4: blue.position")) << inside.front();
}

TEST_F(BodiesFile, KeysOfBlocksAreNotForBodies) {
  const std::string body = "[[body]]\nposition = 1\n";
  for (const auto& [line, key] : std::vector<std::pair<std::string, std::string>>{
           {"digits = 3\n", "digits"},
           {"mass-ratio = 3\n", "mass-ratio"},
           {"red.mass = 3\n", "red.mass"},
           {"red.width = 'by-mass'\n", "red.width"},
           {"blue.position = 3\n", "blue.position"},
           {"blocks.restitution = 0.5\n", "blocks.restitution"},
           {"wall.restitution = 0.5\n", "wall.restitution"},
           {"wall.face = 0\n", "wall.face"},
           {"wall.mass = 3\n", "wall.mass"}}) {
    expect_problem(line + body,
                   "1: " + key + ": this scene has [[body]] instead of blue, red and the wall");
  }
}

TEST_F(BodiesFile, WhatIsForTwoBlocksIsNotForBodies) {
  const std::string body = "[[body]]\nposition = 1\n";
  const std::string why = " is for two blocks and a wall, and this scene has [[body]]";
  expect_problem(body + "[view]\nshutter = 0.5\n", "4: view.shutter motion blur" + why);
  for (const char* loupe : {"auto", "1:2:10"}) {
    expect_problem(body + "[show]\nloupe = '" + loupe + "'\n", "4: show.loupe the loupe" + why);
  }
  EXPECT_TRUE(problems(body + "[show]\nloupe = 'off'\n").empty());
  expect_problem(body + "[time]\nslow-motion = 'auto'\n", "4: time.slow-motion 'auto'" + why);
  expect_problem(body + "[show]\noverlays = ['digits']\n", "4: show.overlays 'digits'" + why);
  expect_problem(body + "[show]\noverlays = ['ruler']\n", "4: show.overlays 'ruler'" + why);
  expect_problem(body + "[time]\nfrom = -1\n",
                 "4: time.from = -1: the motion of bodies begins at time 0");
  expect_problem(body + "[show]\noverlays = ['trails']\n",
                 "4: show.overlays 'trails' is for discs; blocks have the diagram 'time'");
  expect_problem("[show]\noverlays = ['trails']\n",
                 "2: show.overlays 'trails' is for a scene with [[body]]");
}

TEST_F(BodiesFile, DiagramsAreOfOneKindOfRun) {
  const std::vector<std::string> all = {"velocity",  "position", "unfolded",  "time",
                                        "count",     "ellipse",  "mirrors",   "conservation",
                                        "certainty", "speeds",   "separation"};
  const std::string line = "[[body]]\nposition = 1\nvelocity = 1\n[[body]]\nposition = 3\n";
  const std::string plane =
      "[[body]]\nposition = [1, 0]\nvelocity = [1, 0]\n[[body]]\nposition = [4, 0]\n";
  for (const std::string& panel : all) {
    const std::string show = "[show]\npanels = ['" + panel + "']\n";
    const bool is_general = panel == "count" || panel == "speeds";
    if (is_general || panel == "time") {
      EXPECT_TRUE(problems(show + line).empty()) << panel;
    } else {
      expect_problem(show + line, "2: show.panels '" + panel +
                                      "' is not for bodies on a line, which have time, count and "
                                      "speeds");
    }
    if (is_general || panel == "separation") {
      EXPECT_TRUE(problems(show + plane).empty()) << panel;
    } else {
      expect_problem(show + plane, "2: show.panels '" + panel +
                                       "' is not for discs, which have count, speeds and "
                                       "separation");
    }
    if (panel == "speeds" || panel == "separation") {
      expect_problem(show, "2: show.panels '" + panel + "' is for a scene with [[body]]");
    }
  }
}

TEST_F(BodiesFile, EveryProblemIsToldAtOnce) {
  const auto found = problems(
      "[[body]]\n"
      "position = 1\n"
      "mass = -1\n"
      "velocity = 'x'\n"
      "[[body]]\n"
      "width = 0\n"
      "[show]\n"
      "panels = ['velocity']\n");
  const std::vector<std::string> expected = {
      ":1: body 1.mass = -1: must be greater than 0", ":4: body 1.velocity = x: not a number",
      ":5: body 2.position: is missing", ":5: body 2.width = 0: must be greater than 0",
      ":8: show.panels 'velocity' is not for bodies on a line, which have time, count and speeds"};
  std::vector<std::string> sorted;
  for (const std::string& line : found) sorted.push_back(line.substr(path_.size()));
  std::ranges::sort(sorted);
  EXPECT_EQ(sorted, expected);
}

TEST_F(BodiesFile, CollisionsWithoutEndNeedATime) {
  const std::string box =
      "[box]\nx = [0, 10]\n[[body]]\nposition = 1\nvelocity = 1\n[[body]]\nposition = 3\nmass = "
      "2\n[[body]]\nposition = 5\nmass = 3\n";
  for (const char* to : {"", "[time]\nto = 'last+1'\n", "[time]\nto = '#5'\n"}) {
    const Scene scene = load(box + to);
    try {
      const RunLog run(scene);
      FAIL() << to;
    } catch (const UsageError& error) {
      EXPECT_STREQ(error.what(),
                   "time.to: bodies between walls may collide for ever; say until when, as time.to "
                   "= 10");
    }
  }
  EXPECT_GT(RunLog(load(box + "[time]\nto = 20\n")).timeline().size(), 4);
}

TEST_F(BodiesFile, PartsOfAStoryboardMayHaveBodies) {
  const Storyboard story = std::get<Storyboard>(script(R"(
    [[part]]
    digits = 1
    [[part]]
    time.to = 3
    [[part.body]]
    position = 1
    velocity = 1
    [[part.body]]
    position = 4
    [[part]]
    time.to = 2
    box.x = [0, 9]
    compare = [
      { body = [{ position = 1, velocity = 1 }, { position = 4 }] },
      { body = [{ position = 1, velocity = 2 }, { position = 4, mass = 3 }] },
      { body = [{ position = 1 }], box.x = [-1, 9] },
    ]
  )"));
  ASSERT_EQ(story.segments.size(), 3U);
  const auto scenes = [&](std::size_t part) -> const Scenes& {
    return std::get<Scenes>(story.segments.at(part).content);
  };
  EXPECT_FALSE(scenes(0).front().bodies) << "those of a later part";
  ASSERT_TRUE(scenes(1).front().bodies);
  EXPECT_EQ(scenes(1).front().bodies->system.bodies.size(), 2U);
  ASSERT_EQ(scenes(2).size(), 3U);
  EXPECT_EQ(scenes(2)[0].bodies->system.bodies[1].mass, Rational(1));
  EXPECT_EQ(scenes(2)[1].bodies->system.bodies[1].mass, Rational(3));
  EXPECT_EQ(scenes(2)[1].bodies->system.bodies[0].velocity[0], 2);
  EXPECT_EQ(scenes(2)[0].bodies->system.walls[0].point[0], 0);
  EXPECT_EQ(scenes(2)[2].bodies->system.bodies.size(), 1U);
  EXPECT_EQ(scenes(2)[2].bodies->system.walls[0].point[0], -1);
}

TEST_F(BodiesFile, ProblemsInPartsNameTheirLines) {
  expect_problem("[[part]]\ntime.to = 3\n[[part.body]]\nposition = 1\nmas = 3\n",
                 "5: body 1.mas: unknown key");
  expect_problem(
      "[[part]]\ntime.to = 3\n[[part.body]]\nposition = 1\n[[part.body]]\nposition = 1.5\n",
      "5: body 2.position = 3/2: overlaps body 1 by 1/2");
  expect_problem("[[part]]\ndigits = 3\n[[part.body]]\nposition = 1\n",
                 "2: digits: this scene has [[body]] instead of blue, red and the wall");
}

}  // namespace
}  // namespace piblocks
