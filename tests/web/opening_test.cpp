// Scenes with what the page sets: what is left out, what is refused, what the page is told.
#include "web/opening.hpp"

#include <gtest/gtest.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <string>
#include <vector>

#include "core/text.hpp"
#include "scene/shipped_scenes.hpp"
#include "support/contains.hpp"
#include "support/script_of.hpp"
#include "web/choices.hpp"
#include "web/facts.hpp"

namespace piblocks::web {
namespace {

using testing_support::contains;
using testing_support::script_of;
using Texts = std::vector<std::string>;

const std::string kLecture = "view.size = [480, 270]\nview.theme = \"lecture\"\n";

OpenedScript open(const std::string& text, const std::string& settings = "",
                  const std::string& screen = "") {
  return open_script({text, settings, "frame 0", screen});
}

Texts left_out_of(const OpenedScript& opened) {
  Texts texts;
  for (const auto& [key, item, reason, part] : opened.left_out) {
    texts.push_back(key + (item.empty() ? "" : " " + item) + ": " + reason);
  }
  return texts;
}

/// What the page is told if the scene is refused; empty if it is not.
std::string refusal(const std::string& text, const std::string& settings) {
  try {
    open(text, settings);
  } catch (const std::exception& error) {
    return problems_json(error);
  }
  return {};
}

const Scene& scene_of(const OpenedScript& opened) { return std::get<Scene>(opened.live->script()); }

TEST(Open, LeavesOutWhatNeedsElasticCollisions) {
  const OpenedScript opened =
      open(kLecture + "show.panels = [\"position\", \"count\"]\nshow.overlays = [\"digits\"]\n",
           "wall.restitution=0.75");
  EXPECT_EQ(left_out_of(opened), (Texts{"show.panels position: needs elastic collisions",
                                        "show.overlays digits: needs elastic collisions"}));
  EXPECT_EQ(scene_of(opened).show.panels, std::vector{Panel::count});
  EXPECT_EQ(opened.picture->list.width_px, 480);
}

TEST(Open, RefusesWhatHasJustBeenChanged) {
  const std::string settings = "blocks.restitution=0.25\nshow.panels=count\tmirrors";
  EXPECT_EQ(refusal(kLecture, settings),
            R"({"problems":[{"origin":"show.panels","key":"show.panels",)"
            R"("reason":"has 'mirrors', which needs elastic collisions; leave it out, or leave )"
            R"(out the restitution"}]})");
  // It stands first now.
  EXPECT_EQ(left_out_of(open(kLecture, "show.panels=count\tmirrors\nblocks.restitution=0.25")),
            Texts{"show.panels mirrors: needs elastic collisions"});
}

TEST(Open, TellsOnlyWhatStandsInTheWay) {
  const std::string text = kLecture + "wall.restitution = 0.5\nshow.panels = [\"ellipse\"]\n";
  EXPECT_EQ(refusal(text, "red.mass=0"), R"({"problems":[{"origin":"red.mass","key":"red.mass",)"
                                         R"("reason":"= 0: must be greater than 0"}]})");
}

TEST(Open, LeavesOutInstantsThatTheRunHasNot) {
  const std::string text =
      kLecture +
      "digits = 3\ntime.freeze = [\"#40:1\", \"#2:1\"]\ntime.slow-motion = \"#50:#60:4\"\n";
  EXPECT_EQ(open(text).left_out.size(), 0U);
  const OpenedScript opened = open(text, "digits=1");
  EXPECT_EQ(opened.left_out.size(), 2U);
  EXPECT_EQ(scene_of(opened).pacing.freezes.size(), 1U);
  EXPECT_TRUE(scene_of(opened).pacing.slow_motion.empty());
  EXPECT_TRUE(opened.live->frame_count());
  const OpenedScript ended = open(kLecture + "digits = 2\ntime.to = \"#20\"\n", "digits=1");
  EXPECT_EQ(left_out_of(ended).size(), 1U);
  EXPECT_EQ(scene_of(ended).time.to.anchor, Instant::Anchor::last);
}

TEST(Open, GivesAnEndToRunsThatHaveNone) {
  // No collision happens, so the default of time.to is no end either.
  const OpenedScript opened = open(kLecture, "red.velocity=2");
  ASSERT_EQ(opened.left_out.size(), 1U);
  EXPECT_EQ(opened.left_out[0].key, "time.to");
  EXPECT_TRUE(opened.live->frame_count());
  const OpenedScript past = open(kLecture + "time.from = 3\n", "red.velocity=1");
  EXPECT_TRUE(past.picture);
  EXPECT_EQ(scene_of(past).time.from.offset, 0);
  // Who asks for an end that there is not is told so.
  const OpenedScript asked = open(kLecture + "red.velocity = 2\n", "time.to=last+2");
  EXPECT_FALSE(asked.live->film_problems().empty());
}

TEST(Open, LeavesOutWhatHasNoRoom) {
  const std::string text =
      kLecture + "show.title = \"A title\"\nshow.panels = [\"velocity\", \"time\", \"count\"]\n";
  const OpenedScript opened = open(text, "view.size=300x60");
  EXPECT_FALSE(opened.left_out.empty());
  EXPECT_EQ(opened.picture->list.height_px, 60);
}

/// A count of 38 digits has room in the theme of the article alone.
TEST(Open, ACountThatIsTooLongTakesThePlainTheme) {
  const std::string scene(find_shipped_scene("twenty-digits").text);
  const OpenedScript opened = open(scene, "restitution=0");
  EXPECT_EQ(scene_of(opened).view.theme, Theme::article);
  EXPECT_EQ(std::ranges::count(opened.left_out, "view.theme", &LeftOut::key), 1);
  EXPECT_TRUE(
      contains(refusal(scene, "restitution=0\nview.theme=chalkboard"), R"("key":"view.theme")"));
}

TEST(Open, RefusesTextsThatMeanNothing) {
  for (const char* const text :
       {"show.panels = [\"nonsense\"]\n", "show.panel = \"time\"\n", "time.freeze = \"soon\"\n"}) {
    EXPECT_NE(refusal(text, "digits=2"), "") << text;
  }
  EXPECT_EQ(refusal("x = [\n", ""),
            R"({"problems":[{"origin":"scene:1","key":"",)"
            R"("reason":"Error while parsing array: encountered end-of-file"}]})");
}

TEST(Open, GivesKeysTheirDefaults) {
  const std::string text = kLecture + "digits = 4\nshow.title = \"One\"\ntime.speed = 3\n";
  const OpenedScript opened =
      open(text, "show.title=Two\nshow.title\ntime.speed\nred.mass=5\ndigits");
  EXPECT_EQ(scene_of(opened).show.title, "");
  EXPECT_EQ(scene_of(opened).time.speed, 1);
  EXPECT_EQ(scene_of(opened).system.bodies[1].mass, 10'000);
  EXPECT_EQ(scene_of(open(text, "show.title\nshow.title=Three")).show.title, "Three");
}

TEST(Open, ChangesBodies) {
  const std::string text = kLecture +
                           "time.to = 3\nbox.x = [0, 20]\n[[body]]\nposition = 3\nvelocity = 1\n"
                           "[[body]]\nposition = 9\nlabel = \"b\"\n";
  const OpenedScript opened = open(text, "body 3.position=15\nbody 1\nbody 2.mass=7\nbody 2.label");
  const System& system = scene_of(opened).system;
  ASSERT_EQ(system.bodies.size(), 2U);
  EXPECT_EQ(system.bodies[0].mass, 7);
  EXPECT_EQ(scene_of(opened).styles[0].label, "");
  EXPECT_TRUE(contains(refusal(text, "body 1.position=8.5"), R"("key":"body 2.position")"));
}

TEST(Open, AWallOfFiniteMassIsABody) {
  const OpenedScript opened =
      open(kLecture + "digits = 2\n", "wall.mass=50\nbody 2.mass=7\nbody 3.mass=60");
  const System& system = scene_of(opened).system;
  ASSERT_EQ(system.bodies.size(), 3U);
  EXPECT_EQ(system.bodies[1].mass, 7);
  EXPECT_EQ(system.bodies[2].mass, 60);
  EXPECT_TRUE(contains(refusal(kLecture, "body 2.mass=7"), "there is no [[body]]"));
}

TEST(Open, LeavesOutLabelsThatDoNotFit) {
  const std::string text = kLecture +
                           "time.to = 3\nbox.x = [0, 20]\n[[body]]\nposition = 3\n"
                           "[[body]]\nposition = 9\nwidth = 5\nlabel = \"quite long\"\nmass = 3\n"
                           "[[body]]\nposition = 14\nwidth = 4\nlabel = \"too long\"\n";
  const OpenedScript opened = open(text, "body 1\nbody 3.width=0.5\nbody 2.width=0.5");
  for (const LeftOut& out : opened.left_out) EXPECT_TRUE(out.key.ends_with(".label")) << out.key;
  EXPECT_EQ(scene_of(opened).system.bodies[0].size, Rational(1, 2));
}

TEST(Open, HasTheSizeOfTheScreenIfItFits) {
  EXPECT_EQ(open(kLecture, "", "300x500").picture->list.height_px, 500);
  const std::string full = kLecture + "show.panels = [\"velocity\", \"position\", \"time\"]\n";
  const OpenedScript opened = open(full, "", "300x60");
  EXPECT_EQ(opened.picture->list.height_px, 270);
  EXPECT_TRUE(opened.left_out.empty());
  EXPECT_EQ(open(kLecture, "", "0x0").picture->list.width_px, 480);
  EXPECT_TRUE(contains(facts_of(open(kLecture, "", "300x500")), R"("width":300,"height":500)"));
  EXPECT_TRUE(contains(facts_of(open(kLecture, "", "300x500")), R"("view.size":["480x270"])"));
}

TEST(Open, ShowsTheFirstPlaceThatThereIs) {
  const OpenedScript opened =
      open_script({kLecture + "digits = 1\n", "", "instant #9\nframe 30", ""});
  EXPECT_EQ(opened.picture->place.frame, 30);
  EXPECT_TRUE(contains(opened.place_problem, "#9"));
  EXPECT_FALSE(open_script({kLecture}).picture);
}

TEST(Open, EveryPanelAndOverlayGivesWay) {
  for (const ShippedScene& shipped : shipped_scenes()) {
    const Script script = script_of(std::string(shipped.text));
    const auto* const scene = std::get_if<Scene>(&script);
    if (scene == nullptr || !has_short_names(scene->system)) continue;
    for (const char* const setting : {"blocks.restitution=0.5", "wall.restitution=0.5", "digits=2",
                                      "digits=7", "base=5", "base=16"}) {
      const OpenedScript opened = open(std::string(shipped.text), setting);
      EXPECT_TRUE(opened.picture) << shipped.name << ' ' << setting;
    }
  }
}

TEST(Open, EveryPanelAndOverlayOfATheme) {
  Texts lists = {"show.panels=" + panel_names(), "show.overlays=" + overlay_names()};
  std::vector<std::string> settings;
  for (const std::string& list : lists) {
    const std::string key = list.substr(0, list.find('=') + 1);
    for (const std::string& name : split(list.substr(key.size()), ',')) {
      settings.push_back(key + std::string(name.substr(name.find_first_not_of(' '))));
    }
  }
  EXPECT_EQ(settings.size(), 20U);
  for (const std::string& setting : settings) {
    for (const char* const change :
         {"digits=1", "blocks.restitution=0", "blue.velocity=1", "base=7", "red.width=0.2"}) {
      EXPECT_TRUE(open(kLecture, setting + "\n" + change).picture) << setting << change;
    }
  }
}

TEST(Open, LeavesOutWhatThePartsOfAStoryboardShow) {
  int tried = 0;
  for (const ShippedScene& shipped : shipped_scenes()) {
    const std::string text(shipped.text);
    if (!contains(text, "[[part]]")) continue;
    ++tried;
    EXPECT_EQ(refusal(text, "view.theme=article"), "") << shipped.name;
  }
  EXPECT_GT(tried, 5);
  const OpenedScript opened = open(
      "[[part]]\nsplit = \"rows\"\ncompare = [{ show.title = \"A\" }, { digits = 2, "
      "show.title = \"B\" }, { digits = 1 }]\n[[part]]\nshow.title = \"It has room\"\n",
      "view.theme=article\nview.size=960x540");
  EXPECT_EQ(left_out_of(opened).size(), 1U);
  const auto& story = std::get<Storyboard>(opened.live->script());
  EXPECT_EQ(std::get<Scenes>(story.segments[0].content)[1].show.title, "");
  EXPECT_EQ(std::get<Scenes>(story.segments[1].content)[0].show.title, "It has room");
}

TEST(Open, LeavesOutWhatPartsHaveFromTheWholeFilm) {
  const std::string title(300, 'x');
  const OpenedScript opened =
      open("show.title = \"" + title + "\"\n[[part]]\ndigits = 2\n[[part]]\nshow.title = \"B\"\n",
           "view.size=640x360");
  EXPECT_FALSE(left_out_of(opened).empty());
  const auto& story = std::get<Storyboard>(opened.live->script());
  EXPECT_EQ(std::get<Scenes>(story.segments[0].content)[0].show.title, "");
  EXPECT_EQ(std::get<Scenes>(story.segments[1].content)[0].show.title, "B");
}

TEST(Choices, AreThoseThatCanBeAdded) {
  const OpenedScript opened = open(kLecture + "wall.restitution = 0.9\n");
  const std::string choices = choices_json(*opened.live);
  EXPECT_TRUE(contains(choices, R"("unfolded":"needs elastic collisions")")) << choices;
  EXPECT_TRUE(contains(choices, R"("trails":"is for discs")")) << choices;
  EXPECT_FALSE(contains(choices, R"("count":)"));
  EXPECT_FALSE(contains(choices, R"("time":)"));
  EXPECT_EQ(choices_json(*open("[[part]]\ncard = [\"A\"]\n").live),
            R"({"show.panels":{},"show.overlays":{},"room":null})");
}

TEST(Choices, AgreeWithOpening) {
  for (const std::string& text :
       {kLecture, kLecture + "digits = 9\n", kLecture + "blue.velocity = 1\n",
        kLecture + "view.size = [300, 150]\nshow.panels = [\"time\"]\n"}) {
    // TOML has each key once.
    const std::string small = contains(text, "300") ? text.substr(kLecture.size()) : text;
    const OpenedScript opened = open(small);
    const std::string choices = choices_json(*opened.live);
    const std::size_t second = choices.find("show.overlays");
    for (const std::string& name : split(panel_names(), ',')) {
      const std::string panel = name.substr(name.find_first_not_of(' '));
      Texts shown;
      for (const Panel one : scene_of(opened).show.panels) shown.push_back(exact_text(one));
      if (std::ranges::count(shown, panel) > 0) continue;
      shown.push_back(panel);
      std::string setting = "show.panels=";
      for (const std::string& one : shown) setting += (setting.ends_with('=') ? "" : "\t") + one;
      const bool is_refused = contains(choices.substr(0, second), '"' + panel + "\":");
      EXPECT_EQ(refusal(small, setting) != "", is_refused) << small << setting << choices;
    }
  }
}

TEST(Decimals, AreExact) {
  for (const auto& [number, text] :
       {std::pair("5/2", "2.5"), std::pair("-1/8", "-0.125"), std::pair("7", "7"),
        std::pair("1/3", "1/3"), std::pair("-3/2000", "-0.0015"), std::pair("7/12", "7/12"),
        std::pair("123456789/1000", "123456.789")}) {
    EXPECT_EQ(decimal_text(parse_rational(number)), text);
  }
  EXPECT_EQ(decimal_text(Rational(1) / power(10, 21)), "1/1000000000000000000000");
  EXPECT_EQ(with_decimals("turn-3/10:turn+1/4:10"), "turn-0.3:turn+0.25:10");
  EXPECT_EQ(with_decimals("#31+1/1000, 2/3 a/b 1/ 1/0"), "#31+0.001, 2/3 a/b 1/ 1/0");
}

TEST(Facts, HaveDecimals) {
  const std::string facts = facts_of(
      open(kLecture +
           "blue.mass = \"1/4\"\nred.mass = \"1/3\"\nred.position = 6.125\nview.fps = \"25/2\"\n"
           "time.to = \"turn+1/2\"\nshow.title = \"1/2\"\n"));
  for (const char* const part :
       {R"("blue.mass":["0.25"])", R"("red.mass":["1/3"])", R"("red.position":["6.125"])",
        R"("view.fps":["12.5"])", R"("time.to":["turn+0.5"])", R"("show.title":["1/2"])",
        R"("digits":[])", R"("mass-ratio":["4/3"])", R"("wall.mass":["inf"])"}) {
    EXPECT_TRUE(contains(facts, part)) << part << facts;
  }
  EXPECT_TRUE(
      contains(facts_of(open("base = 2\ndigits = 7\n")), R"("digits":["7"],"mass-ratio":["4^6"])"));
  // 2997/100 is not what 29.97 means.
  EXPECT_TRUE(contains(facts_of(open("view.fps = \"2997/100\"\n")), R"("view.fps":["2997/100"])"));
}

/// The numbers of a list in JSON.
std::vector<double> numbers_of(const std::string& json, const std::string& before) {
  std::vector<double> numbers;
  const std::size_t begin = json.find(before) + before.size();
  for (const std::string& text : split(json.substr(begin, json.find(']', begin) - begin), ',')) {
    numbers.push_back(std::stod(text));
  }
  return numbers;
}

double number_of(const std::string& json, const std::string& name) {
  return std::stod(json.substr(json.find('"' + name + "\":") + name.size() + 3));
}

TEST(Stage, IsWhereBlocksArePainted) {
  for (const std::string theme : {"article", "lecture", "print"}) {
    const LiveScript live(script_of("view.size = [800, 450]\nview.theme = \"" + theme +
                                    "\"\nview.shutter = 0\nshow.overlays = [\"velocities\"]\n"));
    const LiveScript::Place place = live.place_of(parse_instant("1.25"));
    const DrawList picture = live.picture(place);
    const std::string shown = shown_json(live, place, picture);
    std::vector<Rect> found;
    for (const DrawItem& item : picture.items) {
      const auto* const block = std::get_if<RectangleItem>(&item);
      if (block == nullptr) continue;
      if (block->id == ItemId::blue_block || block->id == ItemId::red_block) {
        found.push_back(block->bounds);
      }
    }
    ASSERT_EQ(found.size(), 2U) << theme;
    for (const auto& [name, rect] : {std::pair("blue", found[1]), std::pair("red", found[0])}) {
      const auto numbers = numbers_of(shown, "\"key\":\"" + std::string(name) + R"(","rect":[)");
      ASSERT_EQ(numbers.size(), 4U) << shown;
      EXPECT_NEAR(numbers[0], rect.x, 1e-9);
      EXPECT_NEAR(numbers[1], rect.y, 1e-9);
      EXPECT_NEAR(numbers[2], rect.width, 1e-9);
      EXPECT_NEAR(numbers[3], rect.height, 1e-9);
    }
    EXPECT_TRUE(contains(shown, R"("arrow":null)")) << "blue is at rest";
    const auto arrow = numbers_of(shown, R"("arrow":[)");
    EXPECT_GT(arrow[0], arrow[2]) << "red goes to the left";
    const double length = arrow[0] - arrow[2];
    const double longest = number_of(shown, "longestArrow");
    const double scale = number_of(shown, "arrowScale");
    EXPECT_NEAR(length / (1 - length / longest) / scale, 1, 1e-6);
  }
  const LiveScript plain(script_of("show.overlays = []\n"));
  const LiveScript::Place start = plain.place_of_frame(0);
  EXPECT_TRUE(contains(shown_json(plain, start, plain.picture(start)), R"("arrowScale":0,)"));
  const LiveScript other(script_of("time.to = 1\n[[body]]\nposition = 1\nvelocity = 1\n"));
  EXPECT_TRUE(contains(shown_json(other, start, other.picture(start)), R"("stage":null)"));
}

}  // namespace
}  // namespace piblocks::web
