// Keys of bodies that lose energy, and of walls that move or are not there.
#include <gtest/gtest.h>
#include <piblocks/error.hpp>
#include <piblocks/script.hpp>

#include <string>
#include <vector>

#include "scene/scene_keys.hpp"
#include "support/script_of.hpp"

namespace piblocks {
namespace {

Scene scene_of(const std::string& text) {
  return std::get<Scene>(testing_support::script_of(text));
}

std::vector<std::string> problems_in(const std::string& text) {
  try {
    testing_support::script_of(text);
  } catch (const UsageError& error) {
    return error.lines();
  }
  return {};
}

const std::string kDisc = "time.to = 2\n[[body]]\nposition = [2, 3]\nradius = 1\n";

TEST(RealBodies, AreRead) {
  const System cart = scene_of("wall.face = \"-inf\"\nrestitution = \"1/2\"\n").system;
  EXPECT_TRUE(cart.walls.empty());
  EXPECT_EQ(cart.bodies.size(), 2U);
  const System piston = scene_of("wall.velocity = \"1/3\"\ntime.to = 3\n").system;
  ASSERT_EQ(piston.walls.size(), 1U);
  EXPECT_EQ(piston.walls[0].velocity[0], Rational(1, 3));
  EXPECT_TRUE(is_driven(piston));
  const System box = scene_of(
                         "box.x = [0, 9]\nbox.x-velocity = [0, -0.5]\nbox.y = [0, 8]\n"
                         "wall = [{ point = [0, 0], normal = [1, 1], velocity = [0, 1], "
                         "restitution = 0.25 }]\n" +
                         kDisc + "restitution = 0.75\n")
                         .system;
  EXPECT_EQ(box.walls[0].velocity[0], 0);
  EXPECT_EQ(box.walls[1].velocity[0], Rational(-1, 2));
  EXPECT_EQ(box.walls[4].velocity[1], 1);
  EXPECT_EQ(restitution_of(box, 0, 5), Rational(1, 4));
  EXPECT_EQ(restitution_of(box, 0, 1), Rational(3, 4));
}

TEST(RealBodies, LowerRestitutionOfTwoCounts) {
  const System system = scene_of(
                            "restitution = 0.9\nbox.x = [0, \"inf\"]\n[[body]]\nposition = 1\n"
                            "restitution = 0.5\n[[body]]\nposition = 4\nrestitution = 1\n"
                            "[[body]]\nposition = 8\n")
                            .system;
  EXPECT_EQ(restitution_of(system, 0, 1), Rational(1, 2));
  EXPECT_EQ(restitution_of(system, 1, 2), Rational(9, 10));
  EXPECT_EQ(restitution_of(system, 1, 3), Rational(9, 10));
}

TEST(RealBodies, AreWrittenAsTheyWereRead) {
  for (const std::string& text : std::vector<std::string>{
           "wall.face = \"-inf\"\n", "wall.velocity = 0.25\ntime.to = 3\n",
           "wall.velocity = 0.25\nwall.mass = 7\ntime.to = 3\n",
           "box.x = [0, \"inf\"]\nbox.x-velocity = [\"1/3\", 0]\n" + kDisc + "restitution = 0.5\n",
           "box.x = [0, 9]\n" + kDisc +
               "[[wall]]\npoint = [0, 0]\nnormal = [1, 1]\nvelocity = [0, 1]\n"}) {
    const Scene scene = scene_of(text);
    EXPECT_EQ(describe(scene_of(scene_toml(scene))), describe(scene)) << text;
  }
  EXPECT_NE(describe(scene_of(kDisc + "restitution = 0.5\n")), describe(scene_of(kDisc)));
}

TEST(RealBodies, ProblemsNameTheirKeys) {
  const auto has = [](const std::string& text, const std::string& words) {
    const std::vector<std::string> problems = problems_in(text);
    return problems.size() == 1 && problems[0].find(words) != std::string::npos
               ? std::string()
               : testing::PrintToString(problems);
  };
  EXPECT_EQ(has("restitution = 2\n", "restitution = 2: must be from 0"), "");
  EXPECT_EQ(has(kDisc + "restitution = -1\n", "body 1.restitution = -1: must be from 0"), "");
  EXPECT_EQ(has("box.x = [0, \"inf\"]\nbox.x-velocity = [0, 1]\n" + kDisc,
                "box.x-velocity: moves an end of the box that has no wall"),
            "");
  EXPECT_EQ(has("wall.face = \"-inf\"\nwall.mass = 5\n", "wall.mass: there is no wall"), "");
  EXPECT_EQ(has("box.x-velocity = 1\n" + kDisc, "box.x-velocity = 1: must be two numbers"), "");
  EXPECT_EQ(has("wall.velocity = 1\n" + kDisc, "wall.velocity: this scene has [[body]]"), "");
  EXPECT_EQ(has(kDisc + "[[wall]]\npoint = [0, 0]\nnormal = [1, 1]\nspeed = 3\n",
                "wall.speed: unknown key"),
            "");
}

}  // namespace
}  // namespace piblocks
