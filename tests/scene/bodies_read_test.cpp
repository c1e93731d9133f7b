// Bodies, their box and their walls in scene files: what is read, and how it is described.
#include <gtest/gtest.h>
#include <piblocks/script.hpp>

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "scene/file_fixture.hpp"

namespace piblocks {
namespace {

using BodiesFile = FileFixture;

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
  const auto& [system, styles] = std::tie(scene.system, scene.styles);
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
  const System& system = scene.system;
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
  EXPECT_EQ(scene.system.dimensions, 2);
  EXPECT_EQ(scene.system.bodies[0].size, 1);
}

TEST_F(BodiesFile, AWallOfFiniteMassIsABlock) {
  const Scene scene = load(R"(
    mass-ratio = 16
    blue.mass = 2
    [wall]
    mass = "7/2"
    face = -0.25
  )");
  const std::vector<Body>& bodies = scene.system.bodies;
  ASSERT_EQ(bodies.size(), 3U);
  EXPECT_TRUE(scene.system.walls.empty());
  EXPECT_EQ(bodies[0].mass, Rational(2));
  EXPECT_EQ(bodies[0].position[0], 2);
  EXPECT_EQ(bodies[1].mass, Rational(32));
  EXPECT_EQ(bodies[1].velocity[0], -1);
  EXPECT_EQ(bodies[2].mass, Rational(7, 2));
  EXPECT_EQ(bodies[2].position[0] + bodies[2].size / 2, Rational(-1, 4)) << "its face";
  EXPECT_EQ(bodies[2].velocity[0], 0);
  EXPECT_EQ(scene.styles[2].label, "wall");
  EXPECT_TRUE(has_short_names(load("[wall]\nmass = 'inf'\n").system));
  EXPECT_TRUE(has_short_names(load("[wall]\nmass = inf\nface = -1\n").system));
}

TEST_F(BodiesFile, TheViewShowsEverything) {
  const auto shown = [](const Range& range) { return std::pair(range.low, range.high); };
  const std::string block = "[[body]]\nposition = 2\nwidth = 2\n";
  const Scene blocks = load(block + "[[body]]\nposition = 10\nwidth = 4\n");
  EXPECT_EQ(shown(blocks.view.x), std::pair(parse_rational("0.45"), parse_rational("12.55")));
  EXPECT_EQ(shown(blocks.view.y), shown(View().y));
  const Scene boxed = load("[box]\nx = [-10, 10]\n[time]\nto = 1\n" + block);
  EXPECT_EQ(shown(boxed.view.x), std::pair(Rational(-11), Rational(11)));
  const Scene moving =
      load("[box]\nx = [-10, 10]\nx-velocity = [-2, -3]\n[time]\nto = 5\n" + block);
  EXPECT_EQ(shown(moving.view.x), std::pair(Rational(-43, 2), Rational(23, 2)));
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
      discs + "path = true\n",
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
  EXPECT_TRUE(has_short_names(scenes(0).front().system)) << "those of a later part";
  ASSERT_FALSE(has_short_names(scenes(1).front().system));
  EXPECT_EQ(scenes(1).front().system.bodies.size(), 2U);
  ASSERT_EQ(scenes(2).size(), 3U);
  EXPECT_EQ(scenes(2)[0].system.bodies[1].mass, Rational(1));
  EXPECT_EQ(scenes(2)[1].system.bodies[1].mass, Rational(3));
  EXPECT_EQ(scenes(2)[1].system.bodies[0].velocity[0], 2);
  EXPECT_EQ(scenes(2)[0].system.walls[0].point[0], 0);
  EXPECT_EQ(scenes(2)[2].system.bodies.size(), 1U);
  EXPECT_EQ(scenes(2)[2].system.walls[0].point[0], -1);
}

}  // namespace
}  // namespace piblocks
