// What is set over the text of a scene file, and the parts of what is wrong with it.
#include <gtest/gtest.h>
#include <piblocks/error.hpp>
#include <piblocks/render.hpp>
#include <piblocks/script.hpp>

#include <string>
#include <vector>

#include "support/script_of.hpp"

namespace piblocks {
namespace {

const std::string kCrowd =
    "time.to = 4\nbox.x = [0, 30]\n"
    "[[body]]\nmass = 3\nposition = 2\nvelocity = 1\nlabel = \"one\"\n"
    "[[body]]\nposition = 7\n"
    "[[body]]\nmass = \"inf\"\nposition = 12\nwidth = 2\n";

using Edit = std::pair<std::string, std::vector<std::string>>;

ScriptBuilder& edited(ScriptBuilder& builder, const std::vector<Edit>& edits) {
  for (const auto& [key, texts] : edits) builder.set(key, key, texts);
  return builder;
}

/// The crowd without these keys and with these values.
Scene crowd(const std::vector<std::string>& left_out, const std::vector<Edit>& edits) {
  ScriptBuilder builder;
  for (const std::string& key : left_out) builder.leave_out(key);
  builder.read_text("scene", kCrowd);
  return edited(builder, edits).build_scene();
}

/// Origin, key and reason of each problem.
std::vector<std::string> parts(const std::vector<Problem>& problems) {
  std::vector<std::string> texts;
  for (const auto& [key, reason, item, origin, means_nothing] : problems) {
    texts.push_back(origin + " | " + key + " | " + reason + (item.empty() ? "" : " | " + item) +
                    (means_nothing ? " | unread" : ""));
  }
  return texts;
}

std::vector<std::string> problems_of(const auto& work) {
  try {
    work();
  } catch (const UsageError& error) {
    EXPECT_EQ(error.lines().size(), error.problems().size());
    return parts(error.problems());
  }
  return {};
}

using Texts = std::vector<std::string>;

TEST(BodyEdits, ChangeProperties) {
  const Scene scene = crowd({}, {{"body 1.mass", {"9/2"}},
                                 {"body 1.label", {"a b"}},
                                 {"body 2.position", {"6.5"}},
                                 {"body 2.velocity", {"-1/4"}},
                                 {"body 2.width", {"0.75"}},
                                 {"body 2.color", {"#102030"}}});
  const std::vector<Body>& bodies = scene.system.bodies;
  EXPECT_EQ(bodies[0].mass, Rational(9, 2));
  EXPECT_EQ(scene.styles[0].label, "a b");
  EXPECT_EQ(bodies[1].position[0], Rational(13, 2));
  EXPECT_EQ(bodies[1].velocity[0], Rational(-1, 4));
  EXPECT_EQ(bodies[1].size, Rational(3, 4));
  EXPECT_EQ(scene.styles[1].color, (RgbColor{0x10, 0x20, 0x30}));
  EXPECT_EQ(bodies[2].size, 2);
}

TEST(BodyEdits, GiveDefaultsAgain) {
  const Scene scene = crowd({"body 1.label", "body 1.mass"}, {});
  EXPECT_EQ(scene.styles[0].label, "");
  EXPECT_EQ(scene.system.bodies[0].mass, 1);
  // What is set later wins.
  EXPECT_EQ(crowd({"body 1.mass"}, {{"body 1.mass", {"5"}}}).system.bodies[0].mass, 5);
}

TEST(BodyEdits, AddAndRemoveByNumbersOfTheFile) {
  const Scene added =
      crowd({}, {{"body 4.mass", {"2"}}, {"body 4.position", {"20"}}, {"body 5.position", {"25"}}});
  ASSERT_EQ(added.system.bodies.size(), 5U);
  EXPECT_EQ(added.system.bodies[3].mass, 2);
  EXPECT_EQ(added.system.bodies[4].size, 1);
  const Scene removed = crowd({"body 1"}, {{"body 2.mass", {"8"}}, {"body 4.position", {"4"}}});
  ASSERT_EQ(removed.system.bodies.size(), 3U);
  EXPECT_EQ(removed.system.bodies[0].mass, 8);
  EXPECT_EQ(removed.system.bodies[2].position[0], 4);
  EXPECT_EQ(removed.styles.size(), 3U);
}

TEST(BodyEdits, ProblemsNameTheBodyOfTheFile) {
  EXPECT_EQ(problems_of([] {
              crowd({"body 1"}, {{"body 3.width", {"-1"}}});
            }),
            Texts{"body 3.width | body 3.width | = -1: must be greater than 0"});
  EXPECT_EQ(problems_of([] { crowd({}, {{"body 2.mass", {"much"}}}); }).size(), 1U);
  EXPECT_EQ(problems_of([] {
              crowd({}, {{"body 4.mass", {"2"}}});
            }).front(),
            "body 4 | body 4.position | : is missing");
  EXPECT_EQ(
      problems_of([] {
        crowd({}, {{"body 5.mass", {"2"}}});
      }),
      Texts{
          "body 5.mass | body 5.mass | = 2: there are 3 bodies; the next one is body 4 | unread"});
  EXPECT_EQ(problems_of([] {
              crowd({"body 1", "body 2", "body 3"}, {});
            }).front(),
            "scene | body 3 | : cannot be removed: a scene needs a body");
  // A value that is set right again leaves no problem.
  crowd({}, {{"body 2.width", {"x"}}, {"body 2.width", {"1/2"}}});
  // Another value leaves this one.
  EXPECT_EQ(problems_of([] {
              crowd({}, {{"body 9.mass", {"2"}}, {"body 2.mass", {"x"}}, {"body 1.mass", {"2"}}});
            }).size(),
            2U);
  EXPECT_EQ(problems_of([] { crowd({}, {{"body one.mass", {"2"}}}); }).size(), 1U);
}

TEST(BodyEdits, LabelsOfAPartAreLeftOutOfItAlone) {
  ScriptBuilder builder;
  builder.leave_out("body 1.label");
  builder.read_text("scene", kCrowd +
                                 "[[part]]\n[[part]]\n[[part.body]]\nposition = 3\n"
                                 "label = \"its own\"\n");
  const auto story = std::get<Storyboard>(builder.build());
  ASSERT_EQ(story.segments.size(), 2U);
  EXPECT_EQ(std::get<Scenes>(story.segments[0].content)[0].styles[0].label, "");
  EXPECT_EQ(std::get<Scenes>(story.segments[1].content)[0].styles[0].label, "its own");
}

TEST(BodyEdits, OfDiscs) {
  ScriptBuilder builder;
  builder.read_text("scene",
                    "time.to = 2\nbox.x = [0, 9]\nbox.y = [0, 9]\n"
                    "[[body]]\nposition = [2, 3]\nradius = 1\n");
  edited(builder, {{"body 1.position", {"4", "5/2"}},
                   {"body 1.radius", {"0.5"}},
                   {"body 2.position", {"7", "7"}}});
  const System system = builder.build_scene().system;
  EXPECT_EQ(system.bodies[0].position, (ExactVector{4, Rational(5, 2)}));
  EXPECT_EQ(system.bodies[0].size, Rational(1, 2));
  EXPECT_EQ(system.bodies[1].position[1], 7);
}

/// A scene without some names of its lists.
Scene without(const std::string& text, const std::vector<std::pair<std::string, std::string>>& out,
              const std::vector<Edit>& edits = {}) {
  ScriptBuilder builder;
  for (const auto& [key, item] : out) builder.leave_out(key, item);
  builder.read_text("scene", text);
  return edited(builder, edits).build_scene();
}

TEST(LeaveOut, ItemsOfLists) {
  const std::string text =
      "digits = 2\nshow.panels = [\"count\", \"time\"]\nshow.overlays = \"masses\"\n"
      "time.freeze = [\"1.50:2\", \"turn:3\"]\n";
  const Scene scene = without(
      text, {{"show.panels", "count"}, {"show.overlays", "masses"}, {"time.freeze", "3/2:2"}});
  EXPECT_EQ(scene.show.panels, std::vector{Panel::time});
  EXPECT_EQ(scene.show.overlays, std::vector<Overlay>());
  ASSERT_EQ(scene.pacing.freezes.size(), 1U);
  EXPECT_EQ(exact_text(scene.pacing.freezes[0]), "turn:3");
  const auto all = without(text, {{"show.panels", "count"}, {"show.panels", "time"}});
  EXPECT_TRUE(all.show.panels.empty());
  const auto set =
      without(text, {{"show.panels", "count"}}, {{"show.panels", {"velocity", "count"}}});
  EXPECT_EQ(set.show.panels, std::vector{Panel::velocity});
}

TEST(ScriptBuilder, CopiesGoTheirOwnWay) {
  ScriptBuilder builder;
  builder.read_text("scene", "digits = 4\n");
  ScriptBuilder copy(builder);
  copy.set("mass", "red.mass", "12");
  EXPECT_EQ(copy.build_scene().system.bodies[1].mass, 12);
  EXPECT_EQ(builder.build_scene().system.bodies[1].mass, 1'000'000);
}

TEST(ProblemParts, OfTexts) {
  EXPECT_EQ(problems_of([] {
              ScriptBuilder builder;
              builder.read_text("scene", "# first\nred.mass = -7\nview.sizes = 3\n");
              builder.set("--digits", "base", "99");
              builder.build();
            }),
            (Texts{"scene:3 | view.sizes | : unknown key; did you mean 'view.size'? | unread",
                   "--digits | base | = 99: must be a whole number from 2 to 36 | unread",
                   "scene:2 | red.mass | = -7: must be greater than 0"}));
  EXPECT_EQ(problems_of([] { testing_support::script_of("show.title = \"a\\tb\"\n"); }),
            Texts{"scene.toml:1 | show.title | must be one line of text"});
  EXPECT_EQ(problems_of([] {
              testing_support::script_of("wall.restitution = 0.25\nshow.panels = \"position\"\n");
            }),
            Texts{"scene.toml:2 | show.panels | has 'position', which needs elastic collisions; "
                  "leave it out, or leave out the restitution | position"});
}

}  // namespace
}  // namespace piblocks
