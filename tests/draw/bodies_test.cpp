// Scenes with bodies: what is painted in pieces is what is painted whole; every theme and size
// shows or refuses them.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <piblocks/error.hpp>
#include <piblocks/render.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "draw/composed_pictures.hpp"
#include "render/film.hpp"
#include "support/script_of.hpp"
#include "support/uncertain_discs.hpp"

namespace piblocks {
namespace {
using testing_support::script_of;

constexpr std::array kShipped{"three-blocks", "two-walls", "row",  "cradle",
                              "superball",    "recoil",    "gas",  "billiard",
                              "brownian",     "wedge",     "touch"};

/// A shipped scene; of the storyboard `recoil` the run whose wall recoils.
Scene shipped(const std::string& name, const Settings& settings) {
  ScriptBuilder builder;
  if (name == "recoil") {
    builder.read_text(name,
                      "digits = 2\nwall.mass = 2000\nview.theme = 'lecture'\nview.x = [-3, 10]\n"
                      "time.to = 'last+2'\nshow.overlays = ['masses', 'time', 'momentum']\n"
                      "show.panels = ['time', 'count']\n");
  } else {
    builder.read_file(std::string(PIBLOCKS_SCENES) + "/" + name + ".toml");
  }
  for (const auto& [key, text] : settings) builder.set("test", key, text);
  return builder.build_scene();
}

/// Expects that frames in any order are those of a full paint. @returns how many there are
std::int64_t expect_full_paints(const Script& script) {
  const Film film(script);
  FrameRenderer renderer(script);
  EXPECT_EQ(renderer.frame_count(), film.frame_count());
  const auto is_painted = [&](std::int64_t frame) {
    return pixels_of(renderer.frame(frame)) == painted(film.frame(frame));
  };
  for (std::int64_t k = 0; k < film.frame_count(); ++k) {
    const bool is_right = is_painted(k) && is_painted(k * 37 % film.frame_count()) && is_painted(k);
    EXPECT_TRUE(is_right) << k << " or " << k * 37 % film.frame_count();
    if (!is_right) break;
  }
  return film.frame_count();
}

class ShippedBodies : public testing::TestWithParam<const char*> {};

TEST_P(ShippedBodies, EveryFrameIsThatOfAFullPaintInAnyOrder) {
  EXPECT_GT(expect_full_paints(shipped(GetParam(), {{"view.size", "480x270"}, {"view.fps", "6"}})),
            20);
}

TEST_P(ShippedBodies, IdsRiseFromBackToFront) {
  const Film film(shipped(GetParam(), {{"view.fps", "2"}}));
  for (std::int64_t k = 0; k < film.frame_count(); ++k) {
    ASSERT_TRUE(have_rising_ids(film.frame(k))) << "frame " << k;
  }
}

/// What is wrong with the texts of a picture.
std::string problem_of(const DrawList& list) {
  std::vector<Box> boxes = boxes_of(list);
  // Labels of discs are in a picture of their own.
  if (const auto* group = std::get_if<GroupItem>(&list.items.front())) {
    for (Box box : boxes_of(*group->list)) {
      box.x += group->bounds.x;
      box.y += group->bounds.y;
      boxes.push_back(box);
    }
  }
  return text_problem(boxes, whole_of(list));
}

/// Of type, in fractions of the shorter side; all texts but digits of scales are at least so large.
double smallest_type(const DrawList& list) {
  double smallest_px = 1e9;
  for (const TextItem& text : items_of<TextItem>(list.items)) {
    smallest_px = std::min(smallest_px, text.size_px);
  }
  return smallest_px / std::min(list.width_px, list.height_px);
}

/// Frames at the beginning, in the middle and at the end are legible, or the scene is refused by a
/// line. @return whether it is drawn
bool is_drawn(const Scene& scene, const std::string& what) {
  std::optional<Film> film;
  try {
    film.emplace(scene);
  } catch (const UsageError& error) {
    const std::string text = error.what();
    EXPECT_GT(text.size(), 20U) << what;
    EXPECT_EQ(text.find('\n'), std::string::npos) << what << ": " << text;
    return false;
  }
  for (const std::int64_t k : {std::int64_t{0}, film->frame_count() / 2, film->frame_count() - 1}) {
    const DrawList list = film->frame(k);
    EXPECT_EQ(problem_of(list), "") << what << ", frame " << k;
    EXPECT_GE(smallest_type(list), 0.0329) << what << ", frame " << k;
  }
  return true;
}

TEST_P(ShippedBodies, AreLegibleInEveryTheme) {
  for (const std::string theme : kThemeNames) {
    EXPECT_TRUE(is_drawn(shipped(GetParam(), {{"view.theme", theme}}), theme)) << theme;
  }
}

TEST_P(ShippedBodies, AreLegibleOrRefusedAtEverySize) {
  for (const std::string size :
       {"160x90", "320x180", "640x360", "1280x720", "1920x1080", "3840x2160", "1080x1920",
        "1080x1080", "720x1280", "1440x1080", "2560x1080", "90x160", "64x64", "16x16", "1x1"}) {
    const bool shows = is_drawn(shipped(GetParam(), {{"view.size", size}}), size);
    const bool is_usual = size == "640x360" || size == "1280x720" || size == "1920x1080" ||
                          size == "3840x2160" || size == "1440x1080";
    EXPECT_TRUE(shows || !is_usual) << size;
  }
}

/// Everything that there is for this kind of scene.
TEST_P(ShippedBodies, ShowAllThereIs) {
  const Scene plain = shipped(GetParam(), {});
  const bool is_plane = plain.system.dimensions == 2;
  const bool are_two = plain.system.bodies.size() == 2;
  const std::string panels = !is_plane ? "time,count,speeds"
                             : are_two ? "separation,count,speeds"
                                       : "count,speeds";
  for (const std::string theme : kThemeNames) {
    const Settings all{{"view.theme", theme},
                       {"show.overlays", std::string("masses,energy,momentum,time,") +
                                             (is_plane ? "trails" : "ruler")},
                       {"show.panels", panels},
                       {"show.title", "Many bodies"},
                       {"show.caption", "and their walls"}};
    try {
      const Film film(shipped(GetParam(), all));
      const std::int64_t last = film.frame_count() - 1;
      EXPECT_FALSE(painted(film.frame(0)) == painted(film.frame(last))) << theme;
    } catch (const UsageError& error) {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, ShippedBodies, testing::ValuesIn(kShipped),
                         [](const testing::TestParamInfo<const char*>& one) {
                           std::string name = one.param;
                           std::erase(name, '-');
                           return name;
                         });

TEST(BodyPictures, BodiesAreWhereTheyAre) {
  const std::string colors[] = {"#ff0000", "#00ff00", "#0000ff"};
  std::string text =
      "[view]\nx = [0, 16]\ny = [0, 9]\nsize = '1600x900'\ntheme = 'lecture'\nfps = 1\nshutter = "
      "0\n"
      "[time]\nto = 4\n";
  const double starts[][2] = {{2, 2}, {8, 4}, {13, 6}};
  for (int i = 0; i < 3; ++i) {
    text += fmt::format(
        "[[body]]\nposition = [{}, {}]\nvelocity = [{}, 0]\nradius = 0.9\ncolor = '{}'\n",
        starts[i][0], starts[i][1], i == 1 ? -1 : 0, colors[i]);
  }
  const Film film(script_of(text));
  for (std::int64_t k = 0; k < film.frame_count(); ++k) {
    const DrawList frame = film.frame(k);
    const auto& group = std::get<GroupItem>(frame.items.front());
    const auto discs = items_of<DiscItem>(group.list->items);
    ASSERT_EQ(discs.size(), 3U);
    const double scale = (discs[2].centre.x - discs[0].centre.x) / 11;
    EXPECT_NEAR(discs[1].centre.x, discs[0].centre.x + (6 - double(k)) * scale, 1e-6);
    EXPECT_NEAR(discs[0].centre.y - discs[1].centre.y, 2 * scale, 1e-6);
    EXPECT_NEAR(discs[0].centre.y - discs[2].centre.y, 4 * scale, 1e-6);
    EXPECT_EQ(discs[0].fill, (Color{255, 0, 0}));
    EXPECT_EQ(discs[1].fill, (Color{0, 255, 0}));
    EXPECT_EQ(discs[2].fill, (Color{0, 0, 255}));
  }
}

/// The names of axes replace figures, but for two that say how long a unit is.
TEST(BodyPictures, AxesHaveNames) {
  const auto texts_of = [](const std::string& name, const Settings& settings) {
    std::set<std::string> texts;
    const Shown shown(Film(shipped(name, settings)).frame(0));
    for (const TextItem& text : shown.texts) {
      if (text.id >= ItemId::panels) texts.insert(text.text);
    }
    return texts;
  };
  EXPECT_TRUE(texts_of("gas", {}).contains("speed"));
  EXPECT_TRUE(texts_of("touch", {}).contains("time"));
  EXPECT_TRUE(texts_of("three-blocks", {}).contains("time"));
  const std::set<std::string> wide = texts_of("touch", {{"view.size", "1280x720"}});
  EXPECT_TRUE(wide.contains("0") && wide.contains("2")) << "figures beside the name";
}

/// A wedge is flat: beside a diagram it would be small.
TEST(BodyPictures, DiagramsAreBelowAFlatView) {
  const auto window_width = [](int top) {
    Scene scene = shipped("wedge", {{"view.size", "1280x720"}});
    scene.view.y.high = top;
    return std::get<GroupItem>(Film(scene).frame(0).items.front()).bounds.width;
  };
  EXPECT_EQ(window_width(2), 1280);
  EXPECT_LT(window_width(8), 800) << "this view is less than twice as wide as high";
}

/// Discs that touch when the scene begins collide then if they approach each other.
TEST(BodyPictures, SeparationHasTheCollisionAtTheBeginning) {
  const auto make = [](const char* speed, const char* from) {
    return Film(script_of(fmt::format("[[body]]\nposition = [-2, 0]\nradius = 1\n"
                                      "velocity = [{}, 0.5]\n[[body]]\nradius = 1\n"
                                      "position = [0, 0]\n[time]\nfrom = {}\nto = 3\n"
                                      "[show]\npanels = ['separation']\n",
                                      speed, from)))
        .frame_count();
  };
  EXPECT_GT(make("1", "0"), 0);
  EXPECT_THROW(make("-1", "0"), UsageError) << "they part";
  EXPECT_THROW(make("1", "0.01"), UsageError) << "they have met before";
}

/// A picture that may be wrong says so, from the time on from which it may be.
TEST(BodyPictures, SayWhatIsNotCertain) {
  const Scene scene = std::get<Scene>(
      script_of("view.theme = 'lecture'\nview.fps = 1\ntime.allow-uncertain = true\n" +
                testing_support::uncertain_discs()));
  const auto until =
      make_log(scene.system, scene.time.to.offset)->certain_until(scene.time.to.offset);
  ASSERT_TRUE(until);
  const Film film(scene);
  ASSERT_GT(double(film.frame_count() - 1), *until);
  for (std::int64_t k = 0; k < film.frame_count(); ++k) {
    const bool says = std::ranges::count(boxes_of(film.frame(k)),
                                         "from here on rounding may decide", &Box::what) == 1;
    EXPECT_EQ(says, double(k) >= *until) << k;
  }
}

constexpr std::array kLines{"three-blocks", "two-walls", "row", "cradle", "superball", "recoil"};

TEST(BodyPictures, ArrowsAndTextsKeepApart) {
  for (const std::string name : kLines) {
    for (const std::string size : {"640x360", "480x480", "400x711"}) {
      std::optional<Film> film;
      try {
        film.emplace(shipped(name, {{"view.size", size},
                                    {"view.fps", "5"},
                                    {"show.panels", ""},
                                    {"show.overlays", "masses,velocities"}}));
      } catch (const UsageError&) {
        continue;  // a label has no room
      }
      std::size_t arrows = 0;
      for (std::int64_t k = 0; k < film->frame_count(); ++k) {
        const DrawList list = film->frame(k);
        ASSERT_EQ(problem_of(list), "") << name << " " << size << ", frame " << k;
        for (const PathItem& arrow : items_of<PathItem>(list.items, ItemId::velocities)) {
          ++arrows;
          Rect bounds = arrow.points.bounds();
          bounds.height += 0.6;
          for (const Box& text : boxes_of(list)) {
            ASSERT_FALSE(overlap(bounds, text))
                << name << " " << size << ", frame " << k << ": " << text.what;
          }
        }
      }
      EXPECT_GT(arrows, 10U) << name;
    }
  }
}

/// In a row of a split screen the counter is beside the stage.
TEST(BodyPictures, BlocksPassBehindTheCounterOfARow) {
  const auto frame_with = [](int position) {
    Scene scene = std::get<Scene>(
        script_of(fmt::format("view.theme = 'lecture'\nview.x = [0, 10]\n[[body]]\nposition = 1\n"
                              "[[body]]\nposition = {}\nvelocity = 1\n",
                              position)));
    scene.view.width_px = 1280;
    scene.view.height_px = 240;
    scene.view.short_side_px = 720;
    scene.view.shutter = 0;
    scene.time.to = Rational(1);
    return Film(scene).frame(0);
  };
  const DrawList far_away = frame_with(1000);
  const std::vector<std::uint32_t> wanted = painted(far_away);
  const std::vector<Box> texts = boxes_of(far_away);
  const double left = std::ranges::min_element(texts, {}, &Box::x)->x;
  for (int position = 11; position <= 18; ++position) {
    const std::vector<std::uint32_t> pixels = painted(frame_with(position));
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      if (double(i % 1280) < left) continue;
      ASSERT_EQ(pixels[i], wanted[i]) << position << ": " << i % 1280 << ", " << i / 1280;
    }
  }
}

TEST(BodyPictures, HitsAreMarkedWhereBodiesTouch) {
  for (const std::string name : {"three-blocks", "row", "superball", "touch", "billiard"}) {
    Scene scene = shipped(name, {{"view.shutter", "0"}, {"view.fps", "60"}});
    const auto log = make_log(
        scene.system, scene.time.to.is_time() ? std::optional(scene.time.to.offset) : std::nullopt);
    const Film film(scene);
    int marks = 0;
    for (Integer k = 1; k <= std::min<Integer>(log->last(), 8); ++k) {
      const double seen_s = log->collision_time(k).hi / to_double(scene.time.speed);
      const auto number = static_cast<std::int64_t>(std::ceil(seen_s * 60));
      if (number >= film.frame_count()) break;
      const DrawList frame = film.frame(number);
      const auto* const window = std::get_if<GroupItem>(&frame.items.front());
      const DrawList& list = window != nullptr ? *window->list : frame;
      for (const PathItem& mark : items_of<PathItem>(list.items, ItemId::hits)) {
        ++marks;
        EXPECT_LE(mark.points.bounds().width, 0.13 * 720) << name;
        EXPECT_GT(mark.points.bounds().height, 0) << name;
      }
    }
    EXPECT_GE(marks, name == "touch" ? 1 : 2) << name;
  }
}

/// The energy always, the momentum where there are no walls and nothing is fixed.
TEST(BodyPictures, SumsThatNothingTakesNeverChange) {
  for (const std::string name : kShipped) {
    const Scene scene = shipped(
        name, {{"view.fps", "4"}, {"show.overlays", "energy,momentum"}, {"view.size", "640x360"}});
    const bool is_free = scene.system.walls.empty() && name != "billiard";
    const Film film(scene);
    std::set<std::string> energies;
    std::set<std::string> momenta;
    for (std::int64_t k = 0; k < film.frame_count(); ++k) {
      for (const Box& text : boxes_of(film.frame(k))) {
        // Two blocks have names, and the sum is written behind their shares.
        const std::string sum = text.what.substr(text.what.rfind('=') + 1);
        if (text.what.starts_with("Energy")) energies.insert(sum);
        if (text.what.starts_with("Momentum")) momenta.insert(sum);
      }
    }
    EXPECT_EQ(energies.size(), 1U) << name;
    EXPECT_EQ(momenta.size() == 1, is_free) << name;
  }
}

TEST(BodyPictures, ConservationAddsUp) {
  for (const std::string name : {"three-blocks", "cradle", "superball", "recoil"}) {
    const Film film(shipped(name, {{"view.fps", "2"},
                                   {"view.size", "720x720"},
                                   {"show.overlays", ""},
                                   {"show.panels", "conservation"}}));
    std::optional<double> first;
    for (std::int64_t k = 0; k < film.frame_count(); ++k) {
      double momentum = 0;
      double share = 0;
      for (const TextItem& text : items_of<TextItem>(film.frame(k).items)) {
        if (text.id < ItemId::panels) continue;
        std::string number = text.text;
        if (number.starts_with("−")) number.replace(0, std::string("−").size(), "-");
        (number.ends_with("%") ? share : momentum) += std::stod(number);
      }
      EXPECT_LE(share, 100 + 1e-9) << name;
      if (!first) first = momentum;
      EXPECT_NEAR(momentum, *first, 0.004) << name << ", frame " << k;
    }
  }
}

/// A film of parts, compared runs among them.
TEST(BodyPictures, OfAStoryboardAreThoseOfAFullPaint) {
  const Script script = script_of(R"(
    view.size = [640, 360]
    view.fps = 10
    view.theme = "lecture"
    [[part]]
    time.to = 4
    show.panels = ["time"]
    [[part.body]]
    position = 0
    velocity = 1
    [[part.body]]
    position = 3
    mass = 2
    [[part]]
    fade = 0.5
    time.to = 3
    box.x = [0, 9]
    box.y = [0, 3]
    show.overlays = ["trails"]
    compare = [
      { body = [{ position = [1.1, 1.1], velocity = [1, 0] }, { position = [5, 1.5] }] },
      { body = [{ position = [1.1, 1.1], velocity = [3, 0] }, { position = [5, 1.5] }] },
    ]
  )");
  EXPECT_EQ(expect_full_paints(script), 65);
}

}  // namespace
}  // namespace piblocks
