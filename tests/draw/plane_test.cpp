// Discs in a plane: their window, their paths, and the angles between walls.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <piblocks/render.hpp>

#include <cstdint>
#include <string>
#include <vector>

#include "draw/composed_pictures.hpp"
#include "render/film.hpp"
#include "support/script_of.hpp"

namespace piblocks {
namespace {
using testing_support::script_of;

/// What is drawn in the window of discs, at an instant.
std::vector<DrawItem> window_at(const std::string& text, const Rational& time) {
  const Script script = script_of("view.theme = 'lecture'\nview.shutter = 0\n" + text);
  const DrawList frame = run_of(std::get<Scene>(script)).still(Instant(time));
  return std::get<GroupItem>(frame.items.front()).list->items;
}

/// The disc flies 2.5 to the wall, and by the time 3 it has come back by 0.5.
TEST(Plane, PathsStayInSight) {
  const std::string box = "box.x = [0, 4]\nbox.y = [0, 4]\ntime.to = 60\n";
  const std::string discs =
      "[[body]]\nposition = [1, 1]\nvelocity = [1, 0]\nradius = 0.5\npath = true\n"
      "[[body]]\nposition = [1, 3]\nvelocity = [1, 0]\nradius = 0.5\n";
  const auto paths_at = [](const std::string& text, const Rational& time) {
    return items_of<PathItem>(window_at(text, time), ItemId::wall);
  };
  const auto paths = paths_at(box + discs, 3);
  ASSERT_EQ(paths.size(), 1U) << "only one is asked for";
  const auto points = paths[0].points.view();
  ASSERT_EQ(points.size(), 3U);
  EXPECT_NEAR((points[1].x - points[0].x) / (points[1].x - points[2].x), 5, 1e-9);
  // It meets a wall every 3 units of time; the trail of the other one is that of 2 seconds.
  const auto both = paths_at(box + "show.overlays = ['trails']\n" + discs, 31);
  ASSERT_EQ(both.size(), 2U);
  EXPECT_EQ(both[0].points.view().size(), 12U);
  EXPECT_LE(both[1].points.view().size(), 3U);
}

TEST(Plane, DiscsWithAPathAreSeenHoweverSmallTheyAre) {
  const auto radius_of = [](const char* path) {
    return items_of<DiscItem>(
               window_at(std::string("view.size = '800x600'\nbox.x = [0, 4]\nbox.y = [0, 4]\n"
                                     "time.to = 1\n[[body]]\nposition = [1, 1]\nradius = 1e-6\n") +
                             path,
                         0))
        .at(0)
        .radius;
  };
  EXPECT_LT(radius_of(""), 0.01);
  EXPECT_NEAR(radius_of("path = true\n"), 0.011 * 600, 1e-9);
}

TEST(Plane, AnglesAreSaidWhereWallsMeet) {
  const auto texts_of = [](const std::string& walls) {
    std::vector<std::string> texts;
    const std::string disc = "[[body]]\nposition = [5, 0.3]\nradius = 0.1\n";
    for (const TextItem& text : items_of<TextItem>(window_at(
             "show.overlays = ['angles']\ntime.to = 1\nview.y = [-1, 2]\n" + walls + disc, 0))) {
      texts.push_back(text.text);
    }
    return texts;
  };
  const std::string slanted = "[[wall]]\npoint = [0, 0]\nnormal = [1, -10]\n";
  const std::string level = "[[wall]]\npoint = [0, 0]\nnormal = [0, 1]\n";
  const std::vector<std::string> wedge{"5.71°"};  // arctan 1/10
  EXPECT_EQ(texts_of("view.x = [0, 9]\n" + level + slanted), wedge);
  EXPECT_EQ(texts_of("view.x = [0, 9]\n" + slanted + level), wedge) << "in any order";
  EXPECT_TRUE(texts_of("view.x = [1, 9]\n" + level + slanted).empty()) << "their corner is hidden";
  EXPECT_EQ(texts_of("box.x = [1, 9]\nview.x = [0, 10]\n" + level + slanted).size(), 4U)
      << "walls cut the corner off";
}

TEST(Plane, DiscsAreCutOffWhereTheyLeave) {
  const std::string common =
      "view.size = '640x360'\nview.theme = 'lecture'\nview.fps = 4\n"
      "view.x = [0, 8]\nview.y = [0, 4]\ntime.to = 8\n"
      "show.title = 'A disc leaves'\nshow.panels = ['count']\n";
  std::string moving = common;
  for (int i = 0; i < 10; ++i) {
    const std::string body =
        fmt::format("[[body]]\nposition = [{}, 2]\nradius = 0.3\n", 0.4 + 0.7 * i);
    moving += body + fmt::format("velocity = [0, {}]\n", i % 2 == 0 ? 1 : -1);
  }
  const Film film(script_of(moving));
  const DrawList first = film.frame(0);
  const Rect window = std::get<GroupItem>(first.items.front()).bounds;
  for (std::int64_t k = 0; k < film.frame_count(); k += 4) {
    DrawList list = film.frame(k);
    const std::vector<std::uint32_t> all = painted(list);
    list.items.erase(list.items.begin());
    const std::vector<std::uint32_t> beside = painted(list);
    for (int y = 0; y < list.height_px; ++y) {
      for (int x = 0; x < list.width_px; ++x) {
        const bool is_in_window =
            x >= window.x && x < window.right() && y >= window.y && y < window.bottom();
        const auto at = std::size_t(y) * std::size_t(list.width_px) + std::size_t(x);
        if (is_in_window) continue;
        ASSERT_EQ(all[at], beside[at]) << k << ": " << x << ", " << y;
      }
    }
  }
}

}  // namespace
}  // namespace piblocks
