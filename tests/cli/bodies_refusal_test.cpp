// What the program refuses to do with bodies, and why.
#include <fmt/format.h>

#include "cli/bodies_fixture.hpp"

namespace piblocks {
namespace {

TEST_F(BodiesCli, WhatIsForTwoBlocksIsRefused) {
  expect_line({"state", "meeting.toml", "--at", "1", "--bounds"},
              "--bounds: only known of two blocks beside something immovable, and with --engine "
              "unfolded; leave it out");
  expect_line({"count", "meeting.toml", "--digits", "3"},
              "--digits: digits: this scene has [[body]] instead of blue, red and the wall");
  expect_line({"still", "meeting.toml", "--at", "1", "--loupe", "auto", "-o", "a.png"},
              "--loupe: show.loupe 'auto' is for two blocks beside one wall or fixed block, which "
              "have a turn; give a window with a collision, as 1.9:2.1:100");
}

TEST_F(BodiesCli, WhatCannotBePaintedIsRefused) {
  const auto expect = [&](const std::string& scene, const std::string& message) {
    write("scene.toml", scene);
    expect_line({"still", "scene.toml", "--at", "0", "--theme", "article", "--size", "640x480",
                 "-o", "a.png"},
                message);
  };
  expect(
      "[[body]]\nmass = 'inf'\nradius = 100000\nposition = [0, -100000]\n[[body]]\n"
      "position = [0, 1.5]\nradius = 0.5\nvelocity = [0, -1]\n"
      "[view]\nx = [-3, 3]\ny = [-1, 3]\n[time]\nto = 2\n",
      "body 1.radius: is 8.905e+06 pixels, and at most 3.8e+06 can be painted; make it smaller, "
      "show more of the plane, or use a wall");
  const std::string label(90, 'a');
  expect(
      "[box]\nx = [0, 12]\n[[body]]\nmass = 16\nwidth = 1.5\nposition = 4\nlabel = '" + label +
          "'\n[[body]]\nposition = 8\n[time]\nto = 2\n",
      "body 1.label: '" + label +
          "' does not fit on its block of 66x66 pixels; use a shorter one, make the block or the "
          "frame larger, or show less of the x axis");
  std::string fast = "[box]\nx = [0, 100]\n[time]\nto = '1e-155'\n[show]\npanels = ['speeds']\n";
  for (int i = 0; i < 20; ++i) {
    fast += fmt::format("[[body]]\nposition = {}\nvelocity = '{}'\n", 3 * i + 1,
                        i == 0 ? "1e155" : "0");
  }
  expect(fast,
         "show.panels: 'speeds' needs an energy within the range of a double (about 1.8e308); "
         "leave the diagram out, or use less extreme velocities");
}

TEST_F(BodiesCli, WhatIsNotCertainIsRefusedWithItsTime) {
  const Arguments small{"--size", "320x180", "--fps", "10", "--quiet", "-o", "a.mp4"};
  const std::string said = refusal({"count", "uncertain.toml"});
  ASSERT_EQ(lines(said).size(), 1U) << said;
  const std::string before = "certain only until time ";
  const std::size_t at = said.find(before);
  ASSERT_NE(at, std::string::npos) << said;
  const double until = std::stod(said.substr(at + before.size()));
  EXPECT_GT(until, 1);
  EXPECT_LT(until, 200);
  for (const Arguments& command :
       {Arguments{"log", "uncertain.toml"}, Arguments{"render", "uncertain.toml"} + small,
        Arguments{"render", "uncertain.toml", "--quiet", "-o", "a.wav"},
        Arguments{"still", "uncertain.toml", "--at", "150", "-o", "a.png"},
        Arguments{"sheet", "uncertain.toml", "-o", "a.pdf"},
        Arguments{"state", "uncertain.toml", "--at", "150"}}) {
    const std::string same = refusal(command);
    EXPECT_EQ(lines(same).size(), 1U) << same;
    EXPECT_TRUE(contains(same, fmt::format("{}{:.4g};", before, until)));
  }
  // What the message advises.
  const std::string to = "as with time.to = ";
  const std::string advised = split(said.substr(said.find(to) + to.size()), ',').front();
  const std::string count = first_line_of({"count", "uncertain.toml", "--to", advised});
  EXPECT_GT(std::stoi(first_line_of({"count", "uncertain.toml", "--allow-uncertain"})),
            std::stoi(count));
  EXPECT_NE(output_of({"state", "uncertain.toml", "--at", advised}).find('"' + count + '"'),
            std::string::npos)
      << "before it, all is certain";
  output_of(Arguments{"render", "uncertain.toml", "--to", "2"} + small);
  output_of({"still", "uncertain.toml", "--at", "150", "--allow-uncertain", "--size", "320x180",
             "-o", "a.png"});
  output_of({"state", "uncertain.toml", "--at", "150", "--allow-uncertain"});
}

TEST_F(BodiesCli, AComparisonOfUncertainBodiesIsRefused) {
  write("story.toml", std::string("view.size = '640x360'\n[[part]]\ntime.to = 200\nbox.x = [0, 4]\n"
                                  "box.y = [0, 3]\ncompare = [") +
                          R"({ body = [{ position = [1, 1], radius = 0.5 }] },
  { body = [{ position = [1, 1], velocity = [1, 0.7], radius = 0.5 },
            { position = [3, 1.2], velocity = [-1, 0.3], radius = 0.6 },
            { position = [2, 2.4], velocity = [0.2, -0.9], radius = 0.4 }] }]
)");
  const std::string said = refusal({"render", "story.toml", "-o", "a.mp4"});
  EXPECT_EQ(lines(said).size(), 1U) << said;
  EXPECT_TRUE(contains(said, "is certain only until time "));
}

}  // namespace
}  // namespace piblocks
