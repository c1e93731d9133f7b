// Keys, overlays, diagrams and times that scenes with bodies cannot have.
#include <gtest/gtest.h>
#include <piblocks/error.hpp>

#include <string>
#include <utility>
#include <vector>

#include "scene/file_fixture.hpp"
#include "scene/run_log.hpp"
#include "scene/schedule.hpp"
#include "support/message_of.hpp"

namespace piblocks {
namespace {

using testing_support::message_of;
using BodiesFile = FileFixture;

const std::string kNeedsPair =
    ", which needs two blocks beside one wall or fixed block, and no more; leave it out";

TEST_F(BodiesFile, KeysOfBlocksAreNotForBodies) {
  const std::string body = "[[body]]\nposition = 1\n";
  for (const auto& [line, key] :
       std::vector<std::pair<std::string, std::string>>{{"digits = 3\n", "digits"},
                                                        {"mass-ratio = 3\n", "mass-ratio"},
                                                        {"red.mass = 3\n", "red.mass"},
                                                        {"red.width = 'by-mass'\n", "red.width"},
                                                        {"blue.position = 3\n", "blue.position"},
                                                        {"wall.face = 0\n", "wall.face"},
                                                        {"wall.mass = 3\n", "wall.mass"}}) {
    expect_problem(line + body,
                   "1: " + key + ": this scene has [[body]] instead of blue, red and the wall");
  }
  const std::string bodies = body + "velocity = 1\n[[body]]\nposition = 3\n";
  for (const std::string key : {"restitution", "blocks.restitution", "wall.restitution"}) {
    expect_problem(key + " = 0.5\nshow.panels = ['speeds']\n" + bodies,
                   "2: show.panels has 'speeds', which needs elastic collisions; leave it out, or "
                   "leave out the restitution");
  }
}

TEST_F(BodiesFile, WhatIsForTwoBlocksIsNotForBodies) {
  const std::string body = "[[body]]\nposition = 1\n";
  const std::string& why = kNeedsPair;
  expect_problem(
      body + "[show]\nloupe = 'auto'\n",
      "4: show.loupe 'auto' is for two blocks beside one wall or fixed block, which have "
      "a turn; give a window with a collision, as 1.9:2.1:100");
  EXPECT_TRUE(problems(body + "[show]\nloupe = '1:2:10'\n").empty());
  EXPECT_TRUE(problems(body + "[show]\nloupe = 'off'\n").empty());
  expect_problem("[[body]]\nposition = [1, 0]\n[show]\nloupe = '1:2:10'\n",
                 "4: show.loupe is for blocks on a line; leave it out");
  expect_problem(body + "[show]\noverlays = ['digits']\n", "4: show.overlays has 'digits'" + why);
  EXPECT_TRUE(problems(body + "[show]\noverlays = ['ruler']\n").empty());
  expect_problem("[[body]]\nposition = [1, 0]\n[show]\noverlays = ['ruler']\n",
                 "4: show.overlays 'ruler' is for blocks on a line");
  expect_problem(
      body + "[time]\nfrom = -1\n",
      "4: time.from = -1: the motion of other bodies than two blocks and a wall begins at "
      "time 0");
  expect_problem(body + "[show]\noverlays = ['trails']\n",
                 "4: show.overlays 'trails' is for discs; blocks have the diagram 'time'");
  expect_problem(body + "[show]\noverlays = ['angles']\n",
                 "4: show.overlays 'angles' is for walls of discs; leave it out");
  expect_problem("[[body]]\nposition = 1\npath = true\n",
                 "1: body 1.path is for discs; blocks have the diagram 'time'");
  expect_problem("[show]\noverlays = ['trails']\n",
                 "2: show.overlays 'trails' is for discs; blocks have the diagram 'time'");
}

TEST_F(BodiesFile, DiagramsAreForWhatTheyCanShow) {
  const std::vector<std::string> all = {"velocity",  "position", "unfolded",  "time",
                                        "count",     "ellipse",  "mirrors",   "conservation",
                                        "certainty", "speeds",   "separation"};
  const std::string line = "[[body]]\nposition = 1\nvelocity = 1\n[[body]]\nposition = 3\n";
  const std::string pair = line + "[[body]]\nposition = 7\nmass = 'inf'\n";
  const std::string plane =
      "[[body]]\nposition = [1, 0]\nvelocity = [1, 0]\n[[body]]\nposition = [4, 0]\n";
  for (const std::string& panel : all) {
    SCOPED_TRACE(panel);
    const std::string show = "[show]\npanels = ['" + panel + "']\n";
    const bool is_for_all = panel == "count" || panel == "speeds";
    if (panel == "separation") {
      for (const std::string& blocks : {std::string(), line, pair}) {
        expect_problem(show + blocks, "2: show.panels 'separation' is for discs");
      }
      EXPECT_TRUE(problems(show + plane).empty());
      continue;
    }
    EXPECT_TRUE(problems(show).empty());
    EXPECT_TRUE(problems(show + pair).empty());
    if (is_for_all || panel == "time" || panel == "conservation") {
      EXPECT_TRUE(problems(show + line).empty());
    } else {
      expect_problem(show + line, "2: show.panels has '" + panel + "'" + kNeedsPair);
    }
    if (is_for_all) {
      EXPECT_TRUE(problems(show + plane).empty());
    } else {
      expect_problem(show + plane, "2: show.panels '" + panel +
                                       "' is not for discs, which have count, speeds and "
                                       "separation");
    }
  }
}

TEST_F(BodiesFile, CollisionsWithoutEndNeedATime) {
  const std::string box =
      "[box]\nx = [0, 10]\n[[body]]\nposition = 1\nvelocity = 1\n[[body]]\nposition = 3\nmass = "
      "2\n[[body]]\nposition = 5\nmass = 3\n";
  for (const char* to : {"", "[time]\nto = 'last+1'\n"}) {
    const Scene scene = load(box + to);
    EXPECT_EQ(message_of<UsageError>([&] { make_schedule(scene, *log_of(scene)); }),
              "time.to: these bodies may collide for ever; say until when, as time.to = 10");
  }
  EXPECT_GT(log_of(load(box + "[time]\nto = 20\n"))->last(), 4);
  const Scene fifth = load(box + "[time]\nto = '#5'\n");
  EXPECT_EQ(log_of(fifth)->count_at(span_of(fifth, *log_of(fifth)).to), 5);
}

TEST(Bodies, HaveTheProblemsThatNoFileCanWrite) {
  Scene scene;
  scene.styles[0].label = "two\nlines";
  ASSERT_EQ(problems_of(scene).size(), 1U);
  EXPECT_EQ(problems_of(scene)[0].key, "body 1.label");
  // The names alone do not make them blue, red and a wall on their left.
  System behind = article_system(3);
  behind.walls[0].normal = {-1};
  ASSERT_FALSE(problems_of(behind).empty());
  EXPECT_EQ(problems_of(behind)[0].reason, "= 2: reaches 5/2 beyond the wall");
  System discs = article_system(3);
  discs.dimensions = 2;
  discs.bodies[1].position = {Rational(16, 5), 0};  // touches blue as a block, overlaps as a disc
  ASSERT_FALSE(problems_of(discs).empty());
  EXPECT_EQ(problems_of(discs)[0].reason, "= [16/5, 0]: overlaps blue by 0.8");
  System fixed = article_system(3);
  fixed.bodies[0].mass = std::nullopt;
  EXPECT_FALSE(has_short_names(fixed));
}

}  // namespace
}  // namespace piblocks
