// What is written and drawn beside the blocks keeps clear of them, of the wall and of each other.
#include <gtest/gtest.h>
#include <piblocks/composition.hpp>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "draw/font.hpp"
#include "support/state_after.hpp"

namespace piblocks {
namespace {

using Settings = std::vector<std::pair<const char*, std::string>>;

class Labels {
 public:
  Labels(int digits, const Settings& settings)
      : scene_(scene_with(digits, settings)),
        log_(make_collision_log(scene_.system)),
        composition_(scene_, *log_) {}

  DrawList at(const Rational& time) const {
    return composition_.frame({state_at(*log_, time), time});
  }
  DrawList after(int count) const { return composition_.frame({state_after(*log_, count)}); }

 private:
  static Scene scene_with(int digits, const Settings& settings) {
    SceneBuilder builder;
    builder.set_mass_ratio("test", power(100, static_cast<unsigned long>(digits - 1)));
    for (const auto& [key, text] : settings) builder.set("test", key, text);
    return builder.build();
  }

  Scene scene_;
  std::unique_ptr<CollisionLog> log_;
  Composition composition_;
};

bool shows(ItemId item, ItemId thing) {
  return static_cast<std::uint32_t>(item) >> 16 == static_cast<std::uint32_t>(thing) >> 16;
}

std::vector<TextItem> texts_of(const DrawList& list, ItemId thing) {
  std::vector<TextItem> texts;
  for (const DrawItem& item : list.items) {
    const auto* text = std::get_if<TextItem>(&item);
    if (text != nullptr && shows(text->id, thing)) texts.push_back(*text);
  }
  return texts;
}

double right_of_wall(const DrawList& list) {
  const Rectangle& wall = std::get<RectangleItem>(list.items.front()).bounds;
  return wall.x + wall.width;
}

/// From the leftmost to the rightmost point of an arrow; the wrong way round if none is drawn.
std::pair<double, double> reach_of_arrow(const DrawList& list, std::size_t n) {
  std::pair<double, double> reach{1e9, -1e9};
  for (const DrawItem& item : list.items) {
    const auto* path = std::get_if<PathItem>(&item);
    if (path == nullptr ||
        (path->id != nth(ItemId::velocities, n) && path->id != nth(ItemId::velocities, n + 1))) {
      continue;
    }
    const Rectangle& bounds = path->points.bounds();
    reach = {std::min(reach.first, bounds.x), std::max(reach.second, bounds.x + bounds.width)};
  }
  return reach;
}

TEST(Labels, ArrowsOfVelocitiesNeverMeet) {
  for (const char* width : {"1/2", "1", "3/2"}) {
    const Labels labels(3, {{"show.overlays", "velocities"}, {"red.width", width}});
    int pairs = 0;
    for (int count = 1; count <= 314; ++count) {
      const DrawList list = labels.after(count);
      const auto red = reach_of_arrow(list, 0);
      const auto blue = reach_of_arrow(list, 4);
      EXPECT_LT(blue.second, red.first) << count;
      pairs += blue.second > 0 && red.second > 0 ? 1 : 0;
    }
    EXPECT_GT(pairs, 200);
  }
}

TEST(Labels, FiguresOfVelocitiesMeetNeitherEachOtherNorTheWall) {
  const Font font;
  for (const int digits : {3, 9, 20}) {
    for (const char* size : {"1920x1080", "640x360", "450x800"}) {
      const Labels labels(digits, {{"show.overlays", "velocities"}, {"view.size", size}});
      const DrawList list = labels.at(Rational(7, 2));
      const std::vector<TextItem> figures = texts_of(list, ItemId::velocities);
      ASSERT_EQ(figures.size(), 2U);
      const TextItem& blue = figures[1];
      EXPECT_GT(blue.origin.x, right_of_wall(list));
      EXPECT_LT(blue.origin.x + font.width_em(blue.text) * blue.size_px, figures[0].origin.x);
    }
  }
}

TEST(Labels, FiguresOfTheRulerStandBetweenWallAndEdge) {
  const Font font;
  for (const char* size : {"640x360", "480x360", "1080x1920", "3840x2160"}) {
    const Labels labels(3, {{"show.overlays", "ruler"}, {"view.size", size}});
    const DrawList list = labels.at(0);
    const std::vector<TextItem> figures = texts_of(list, ItemId::ruler);
    EXPECT_GT(figures.size(), 3U);
    for (const TextItem& figure : figures) {
      EXPECT_GT(figure.origin.x, right_of_wall(list)) << figure.text;
      const double right = figure.origin.x + font.width_em(figure.text) * figure.size_px;
      EXPECT_LT(right, list.width_px) << figure.text;
    }
  }
}

TEST(Labels, TitlesOfNarrowDiagramsAreBriefRatherThanSmall) {
  const Labels labels(6, {{"view.size", "480x360"},
                          {"show.overlays", "digits,masses,velocities,energy,momentum,time,ruler"},
                          {"show.panels", "velocity,position,unfolded,time,rate"}});
  std::vector<std::string> titles;
  for (const DrawItem& item : labels.at(4).items) {
    const auto* plate = std::get_if<PlateItem>(&item);
    if (plate == nullptr) continue;
    const auto& title = std::get<TextItem>(plate->plate->items.front());
    EXPECT_GE(title.size_px, 8);
    titles.push_back(title.text);
  }
  EXPECT_EQ(titles, (std::vector<std::string>{"Velocities √m·v", "Positions", "Unfolded",
                                              "Distances", "Collision rate"}));
}

}  // namespace
}  // namespace piblocks
