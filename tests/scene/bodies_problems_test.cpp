// Bodies, their box and their walls in scene files: what is wrong with them.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "scene/file_fixture.hpp"

namespace piblocks {
namespace {

using BodiesFile = FileFixture;

TEST_F(BodiesFile, KeysOfABodyAreChecked) {
  const std::string body = "[[body]]\nposition = 0\n";
  expect_problem(body + "size = 3\n", "3: body 1.size: unknown key");
  expect_problem(body + "mass = 'heavy'\n",
                 "3: body 1.mass = heavy: not a number such as 16, 2.5, 1/3 or 1e6");
  expect_problem(body + "mass = '-inf'\n",
                 "3: body 1.mass = -inf: not a number such as 16, 2.5, 1/3 or 1e6");
  expect_problem(body + "mass = 0\n", "1: body 1.mass = 0: must be greater than 0");
  expect_problem(body + "mass = [1, 2]\n", "3: body 1.mass = [1, 2]: must be one value");
  expect_problem(body + "width = -1\n", "1: body 1.width = -1: must be greater than 0");
  expect_problem(body + "velocity = [1, 2, 3]\n",
                 "3: body 1.velocity = [1, 2, 3]: must be a number, or two as [x, y]");
  for (const char* color : {"blue", "#12345g", "#12345", "#1234567", "1f77b4"}) {
    expect_problem(body + "color = '" + color + "'\n",
                   std::string("3: body 1.color = ") + color +
                       ": must be a colour as \"#1f77b4\": # and six hexadecimal digits");
  }
  expect_problem(body + "label = \"a\\tb\"\n", "3: body 1.label = a\tb: must be one line of text");
  expect_problem(body + "path = 'yes'\n", "3: body 1.path = yes: must be true or false");
  expect_problem("[[body]]\nwidth = 1\n", "1: body 1.position: is missing");
  expect_problem("[[body]]\nposition = 'here'\n",
                 "2: body 1.position = here: not a number such as 16, 2.5, 1/3 or 1e6");
  expect_problem("[[body]]\nposition = []\n",
                 "2: body 1.position = []: must be a number, or two as [x, y]");
  expect_problem("[[body]]\nposition = { x = 1 }\n",
                 "2: body 1.position.x: unknown key; did you mean 'position'?");
  expect_problem("[[body]]\nposition = '1e400'\n",
                 "1: body 1.position is beyond the range of a double (about 1.8e308)");
  expect_problem(body + "[[body]]\nposition = 5\n[[body]]\nposition = 9\nmas = 1\n",
                 "7: body 3.mas: unknown key; did you mean 'mass'?");
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

TEST_F(BodiesFile, ManyProblemsAreCounted) {
  std::string text;
  for (int i = 0; i < 300; ++i) text += "[[body]]\nposition = [0, 0]\n";
  const std::vector<std::string> found = problems(text);
  ASSERT_EQ(found.size(), UsageError::kMostProblems + 1);
  EXPECT_EQ(found.front(), path_ + ":3: body 2.position = [0, 0]: overlaps body 1 by 2");
  EXPECT_EQ(found.back(), "and 199 more problems");
}

TEST_F(BodiesFile, BodiesHaveRoom) {
  const std::string blocks = "[[body]]\nposition = 0\n[[body]]\nposition = ";
  expect_problem(blocks + "'3/4'\n", "3: body 2.position = 3/4: overlaps body 1 by 1/4");
  expect_problem(blocks + "-0.5\n", "1: body 1.position = 0: overlaps body 2 by 1/2");
  EXPECT_TRUE(problems(blocks + "1\n").empty()) << "they may touch";
  const std::string discs = "[[body]]\nposition = [0, 0]\n[[body]]\nposition = ";
  expect_problem(discs + "[1.2, 1.59]\n",
                 "3: body 2.position = [6/5, 159/100]: overlaps body 1 by 0.00799");
  EXPECT_TRUE(problems(discs + "[1.2, 1.6]\n").empty()) << "they touch";
  const std::string box = "[time]\nto = 1\n[box]\nx = [0, 4]\ny = [0, 4]\n[[body]]\nposition = ";
  expect_problem(box + "[0.9, 2]\n",
                 "6: body 1.position = [9/10, 2]: reaches 0.1 beyond the left wall");
  expect_problem(box + "[2, 3.1]\n",
                 "6: body 1.position = [2, 31/10]: reaches 0.1 beyond the upper wall");
  EXPECT_TRUE(problems(box + "[1, 3]\n").empty()) << "it touches two walls";
  const std::string line = "[time]\nto = 1\n[box]\nx = [0, 4]\n[[body]]\nposition = ";
  expect_problem(line + "0\n", "5: body 1.position = 0: reaches 1/2 beyond the left wall");
  expect_problem(line + "3.75\n", "5: body 1.position = 15/4: reaches 1/4 beyond the right wall");
  const std::string wedge = "[[wall]]\npoint = [0, 0]\nnormal = [3, 4]\n[[body]]\nposition = ";
  expect_problem(wedge + "[0.6, 0.79]\n",
                 "4: body 1.position = [3/5, 79/100]: reaches 0.008 beyond the slanted-1 wall");
  EXPECT_TRUE(problems(wedge + "[0.6, 0.8]\n").empty()) << "it touches";
}

TEST_F(BodiesFile, SomethingCanMove) {
  const std::string fixed = "[[body]]\nmass = 'inf'\nposition = 0\n";
  expect_problem(fixed, "1: body all have infinite mass: nothing can move");
  expect_problem(fixed + "[[body]]\nmass = 'inf'\nposition = 3\n",
                 "1: body all have infinite mass: nothing can move");
  EXPECT_TRUE(problems(fixed + "velocity = 1\n[[body]]\nposition = 3\n").empty()) << "it moves";
}

TEST_F(BodiesFile, BodiesAreTables) {
  for (const char* text : {"body = 3\n", "body = []\n", "body = [1, 2]\n"}) {
    expect_problem(text, "1: body: is written [[body]], once for each");
  }
}

TEST_F(BodiesFile, BoxesAreChecked) {
  const std::string body = "[[body]]\nposition = 1\n[time]\nto = 1\n[box]\n";
  const char* const two = ": must be two numbers, as [0, 10]; \"inf\" is no wall";
  expect_problem(body + "x = [0]\n", std::string("6: box.x = 0") + two);
  expect_problem(body + "x = [0, 1, 2]\n", std::string("6: box.x = [0, 1, 2]") + two);
  expect_problem(body + "x = [3, 0]\n",
                 "6: box.x = [3, 0]: must go from the lower to the higher end");
  expect_problem(body + "x = ['inf', 3]\n",
                 "6: box.x = [inf, 3]: not a number such as 16, 2.5, 1/3 or 1e6");
  expect_problem(body + "z = [0, 3]\n", "6: box.z: unknown key; did you mean 'box.x'?");
  expect_problem(
      body + "y = [-1, 'inf']\n",
      "6: box.y makes the lower wall, but blocks move along x alone; leave it out, or give the "
      "bodies a radius");
  expect_problem("box = 3\n[[body]]\nposition = 1\n",
                 "1: box: unknown key; a table is written [box]");
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
  expect_problem(wall + "normal = [1, 'up']\n",
                 "5: wall.normal = [1, up]: not a number such as 16, 2.5, 1/3 or 1e6");
  expect_problem(wall + "normal = [0, 0]\n", "3: wall 1.normal = [0, 0]: must not be 0");
  const std::string good = "[[wall]]\npoint = [0, 0]\nnormal = [1, 0]\n";
  expect_problem(disc + good + "[[wall]]\npoint = [0, 0]\nnormal = [0, 0]\n",
                 "6: wall 2.normal = [0, 0]: must not be 0");
  expect_problem(
      "[[body]]\nposition = 5\n[[wall]]\npoint = [0, 0]\nnormal = [1, 1]\n",
      "3: wall 1.normal makes the slanted-1 wall, but blocks move along x alone; leave it out, "
      "or give the bodies a radius");
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
    EXPECT_TRUE(contains(found.front(), "must be greater than 0"));
  }
  // In the words of the file, which has no bodies.
  expect_problem(wall + "[blue]\nmass = 0\n", "4: blue.mass = 0: must be greater than 0");
  const auto overlap = problems(wall + "[red]\nposition = 2.5\n");
  ASSERT_EQ(overlap.size(), 1U);
  EXPECT_TRUE(overlap.front().starts_with(path_ + ":4: red.position")) << overlap.front();
  const auto inside = problems(wall + "[blue]\nposition = 0.4\n");
  ASSERT_EQ(inside.size(), 1U);
  EXPECT_TRUE(inside.front().starts_with(path_ + ":4: blue.position")) << inside.front();
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
      ":1: body 1.mass = -1: must be greater than 0",
      ":4: body 1.velocity = x: not a number such as 16, 2.5, 1/3 or 1e6",
      ":5: body 2.position: is missing", ":5: body 2.width = 0: must be greater than 0",
      ":8: show.panels has 'velocity', which needs two blocks beside one wall or fixed block, and "
      "no more; leave it out"};
  std::vector<std::string> sorted;
  for (const std::string& line : found) sorted.push_back(line.substr(path_.size()));
  std::ranges::sort(sorted);
  EXPECT_EQ(sorted, expected);
}

TEST_F(BodiesFile, ProblemsInPartsNameTheirLines) {
  expect_problem("[[part]]\ntime.to = 3\n[[part.body]]\nposition = 1\nmas = 3\n",
                 "5: body 1.mas: unknown key; did you mean 'mass'?");
  expect_problem(
      "[[part]]\ntime.to = 3\n[[part.body]]\nposition = 1\n[[part.body]]\nposition = 1.5\n",
      "5: body 2.position = 3/2: overlaps body 1 by 1/2");
  expect_problem("[[part]]\ndigits = 3\n[[part.body]]\nposition = 1\n",
                 "2: digits: this scene has [[body]] instead of blue, red and the wall");
}

}  // namespace
}  // namespace piblocks
