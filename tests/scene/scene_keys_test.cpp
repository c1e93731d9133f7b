// Every key of a scene file: that it is read, and that a description tells it.
#include "scene/scene_keys.hpp"

#include <gtest/gtest.h>
#include <piblocks/error.hpp>
#include <piblocks/scene.hpp>
#include <piblocks/script.hpp>

#include <algorithm>
#include <map>
#include <string>

#include "support/contains.hpp"

namespace piblocks {
namespace {

using Description = std::vector<std::pair<std::string, std::string>>;

/// For each key a value that is not the default, and that suits the defaults of all others.
const std::map<std::string, Values> kOther = {
    {"base", {"2"}},
    {"wall.face", {"-1/3"}},
    {"contacts", {"in-order"}},
    {"blue.mass", {"2/3"}},
    {"blue.position", {"9/4"}},
    {"blue.velocity", {"1/10"}},
    {"blue.width", {"3/4"}},
    {"blue.color", {"#268bd2"}},
    {"red.mass", {"100^7/3"}},
    {"red.position", {"7"}},
    {"red.velocity", {"-3/2"}},
    {"red.width", {"5/4"}},
    {"red.color", {"#dc322f"}},
    {"blocks.restitution", {"4/5"}},
    {"wall.restitution", {"1/2"}},
    {"view.x", {"-2", "15/2"}},
    {"view.y", {"-3/2", "2"}},
    {"view.size", {"640x360"}},
    {"view.fps", {"30000/1001"}},
    {"view.shutter", {"1/3"}},
    {"view.background", {"transparent"}},
    {"view.theme", {"chalkboard"}},
    {"view.colors.ink", {"#073642"}},
    {"view.colors.accent", {"#b58900"}},
    {"view.colors.muted", {"#586e75"}},
    {"view.colors.done", {"#859900"}},
    {"view.colors.grid", {"#93a1a1"}},
    {"time.from", {"1/7"}},
    {"time.to", {"last+1/3"}},
    {"time.speed", {"1/4"}},
    {"time.duration", {"12"}},
    {"time.slow-motion", {"auto", "1:2:10"}},
    {"time.ease", {"3/4"}},
    {"time.freeze", {"last+0:2"}},
    {"time.hold-start", {"1/2"}},
    {"time.hold-end", {"1/3"}},
    {"time.allow-uncertain", {"true"}},
    {"time.loop", {"true"}},
    {"sound.on", {"true"}},
    {"show.overlays", {"ruler", "energy"}},
    {"show.panels", {"count", "time"}},
    {"show.title", {"One, two"}},
    {"show.caption", {"Three"}},
    {"show.logo", {"logos/a.png"}},
    {"show.hits", {"false"}},
    {"show.loupe", {"turn-1/100:turn+1/100:100"}},
    {"golden.frames", {"0", "#3"}},
    {"golden.size", {"64x48"}},
};

std::string differing_keys(const Description& one, const Description& other) {
  std::string keys;
  for (std::size_t i = 0; i < one.size(); ++i) {
    if (one[i] != other[i]) keys += (keys.empty() ? "" : " ") + one[i].first;
  }
  return keys;
}

void set(Scene& scene, const std::string& name) {
  const auto key = std::ranges::find(scene_keys(), std::string_view(name), &SceneKey::name);
  key->set(scene, kOther.at(name));
}

TEST(SceneKeys, ALoupeReadsBackAsTheSame) {
  for (const char* text : {"auto", "stage", "off", "turn-1/100:turn+1/100:100"}) {
    EXPECT_EQ(exact_text(parse_loupe(text)), text);
  }
  EXPECT_TRUE(parse_loupe("stage").is_stage);
}

TEST(SceneKeys, EachIsTold) {
  ASSERT_EQ(kOther.size(), scene_keys().size());
  for (const SceneKey& key : scene_keys()) {
    ASSERT_TRUE(kOther.contains(key.name)) << key.name;
    Scene scene;
    set(scene, key.name);
    EXPECT_EQ(differing_keys(describe(Scene{}), describe(scene)), key.name);
    EXPECT_TRUE(problems_of(scene).empty()) << key.name;
  }
}

/// Whatever a scene says can be said again in its own words: what parts of a rendering are told
/// apart by leaves nothing out.
TEST(SceneKeys, AllTogetherReadBackAsTheSame) {
  Scene scene;
  for (const auto& [name, values] : kOther) {
    // Another background has no light for the shutter; a duration replaces the speed.
    if (name != "view.background" && name != "time.speed") set(scene, name);
  }
  ASSERT_TRUE(problems_of(scene).empty());
  Scene read;
  for (const SceneKey& key : scene_keys()) {
    const Values values = key.get(scene);
    if (!values.empty()) key.set(read, values);
  }
  EXPECT_EQ(describe(read), describe(scene));
  EXPECT_FALSE(
      testing_support::contains(differing_keys(describe(Scene{}), describe(read)), "time.speed"));
}

TEST(SceneKeys, SayWhatIsShownAndHeard) {
  Scene scene;
  for (const char* name : {"view.theme", "view.background", "sound.on", "show.overlays",
                           "show.panels", "show.title", "show.caption", "show.logo"}) {
    set(scene, name);
  }
  EXPECT_EQ(scene.view.theme, Theme::chalkboard);
  EXPECT_EQ(scene.view.background, Background::transparent);
  EXPECT_TRUE(scene.sound.on);
  EXPECT_EQ(scene.show.overlays, (std::vector{Overlay::ruler, Overlay::energy}));
  EXPECT_EQ(scene.show.panels, (std::vector{Panel::count, Panel::time}));
  EXPECT_EQ(scene.show.title, "One, two");
  EXPECT_EQ(scene.show.caption, "Three");
  EXPECT_EQ(scene.show.logo, "logos/a.png");
}

TEST(SceneKeys, RefuseOtherNames) {
  for (const auto& [key, text] : {std::pair{"base", "1"},
                                  {"base", "37"},
                                  {"base", "5/2"},
                                  {"base", "two"},
                                  {"view.theme", "neon"},
                                  {"view.background", "blue"},
                                  {"sound.on", "yes"},
                                  {"show.overlays", "mass"},
                                  {"show.overlays", "time,time"},
                                  {"show.panels", "circle"}}) {
    ScriptBuilder builder;
    builder.set("--option", key, text);
    EXPECT_THROW(builder.build_scene(), SceneError) << key << " = " << text;
  }
}

using Keys = std::vector<std::pair<const char*, const char*>>;

TEST(SceneKeys, LectureThemesHaveAShutterUnlessTheSceneSaysOtherwise) {
  const auto shutter = [](const Keys& keys) {
    ScriptBuilder builder;
    for (const auto& [key, text] : keys) builder.set("--option", key, text);
    return builder.build_scene().view.shutter;
  };
  EXPECT_EQ(shutter({{"view.theme", "lecture"}}), Rational(1, 2));
  EXPECT_EQ(shutter({{"view.theme", "lecture-light"}}), Rational(1, 2));
  EXPECT_EQ(shutter({{"view.theme", "lecture"}, {"view.shutter", "0"}}), 0);
  EXPECT_EQ(shutter({{"view.shutter", "1/4"}, {"view.theme", "lecture"}}), Rational(1, 4));
  EXPECT_EQ(shutter({{"view.theme", "lecture"}, {"view.background", "transparent"}}), 0);
  EXPECT_EQ(shutter({{"view.theme", "dark"}}), 0);
}

TEST(SceneKeys, LectureThemesShowMassesOfFewBlocksUnlessTheSceneSaysOtherwise) {
  const auto shown = [](const Keys& keys) {
    ScriptBuilder builder;
    for (const auto& [key, text] : keys) builder.set("--option", key, text);
    return overlays_of(builder.build_scene());
  };
  const std::vector masses = {Overlay::masses};
  EXPECT_EQ(shown({}), masses);
  EXPECT_EQ(shown({{"view.theme", "lecture"}}), masses);
  EXPECT_EQ(shown({{"restitution", "0.9"}}), masses) << "the digits of pi would be rejected";
  for (const char* theme : {"article", "chalkboard", "dark", "print", "colorblind"}) {
    EXPECT_TRUE(shown({{"view.theme", theme}}).empty()) << theme;
  }
  EXPECT_EQ(shown({{"show.overlays", "time"}}), std::vector{Overlay::time});
  EXPECT_TRUE(shown({{"show.overlays", "none"}}).empty());
  EXPECT_TRUE(shown({{"show.overlays", ""}}).empty());
  Scene scene;
  scene.system = {1, std::vector<Body>(12), {}};
  EXPECT_EQ(overlays_of(scene), masses);
  scene.system.bodies.resize(13);
  EXPECT_TRUE(overlays_of(scene).empty());
  scene.system = {2, std::vector<Body>(2), {}};
  EXPECT_TRUE(overlays_of(scene).empty()) << "discs";
}

TEST(SceneKeys, NoOverlaysAreToldFromTheThemesOverlays) {
  Scene none;
  none.show.overlays.emplace();
  EXPECT_EQ(differing_keys(describe(Scene{}), describe(none)), "show.overlays");
  ScriptBuilder builder;
  builder.read_text("scene", scene_toml(none));
  EXPECT_EQ(describe(builder.build_scene()), describe(none));
}

TEST(SceneKeys, DigitsAreThoseOfTheBaseInTheEnd) {
  ScriptBuilder builder;
  builder.set("test", "blue.mass", "3");
  builder.set("--digits", "digits", "4");
  EXPECT_EQ(builder.build_scene().system.bodies[1].mass.value(), 3'000'000);
  builder.set("--base", "base", "2");
  EXPECT_EQ(builder.build_scene().system.bodies[1].mass.value(), 192);
  builder.set("--mass-ratio", "mass-ratio", "16");
  EXPECT_EQ(builder.build_scene().system.bodies[1].mass.value(), 48);
  builder.set("test", "digits", "2");
  EXPECT_EQ(builder.build_scene().system.bodies[1].mass.value(), 12);
  builder.set("test", "red.mass", "5");
  EXPECT_EQ(builder.build_scene().system.bodies[1].mass.value(), 5);
  EXPECT_EQ(builder.build_scene().show.base, 2);
}

TEST(SceneKeys, RestitutionIsThatOfBlocksAndWall) {
  ScriptBuilder builder;
  const auto expect = [&](const char* key, const char* text, const Rational& blocks,
                          const Rational& wall) {
    builder.set("test", key, text);
    const System system = builder.build_scene().system;
    EXPECT_EQ(system.restitution, blocks) << key;
    EXPECT_EQ(system.wall_restitution, wall) << key;
  };
  expect("blocks.restitution", "1/3", Rational(1, 3), 1);
  expect("restitution", "0.5", Rational(1, 2), Rational(1, 2));
  expect("wall.restitution", "0", Rational(1, 2), 0);
  expect("restitution", "1", 1, 1);
}

TEST(SceneKeys, AWrongBaseIsAProblemOfTheScene) {
  for (const int base : {kMinBase - 1, kMaxBase + 1}) {
    Scene scene;
    scene.show.base = base;
    ASSERT_EQ(problems_of(scene).size(), 1U);
    EXPECT_EQ(problems_of(scene).front().key, "base");
  }
}

TEST(SceneKeys, WidthByMassFollowsTheMassesInTheEnd) {
  ScriptBuilder builder;
  builder.set("--width-by-mass", "red.width", "by-mass");
  builder.set("--digits", "digits", "3");
  EXPECT_EQ(builder.build_scene().system.bodies[1].size, Rational(5, 4));
  builder.set("test", "red.width", "2");
  EXPECT_EQ(builder.build_scene().system.bodies[1].size, 2);
  builder.set("test", "blue.width", "by-mass");
  EXPECT_THROW(builder.build_scene(), SceneError) << "red alone is wide by its mass";
}

}  // namespace
}  // namespace piblocks
