// Pictures of walls that move, and of bodies that lose energy.
#include <gtest/gtest.h>
#include <piblocks/log.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <variant>
#include <vector>

#include "draw/composition.hpp"
#include "draw/layout.hpp"
#include "support/script_of.hpp"

namespace piblocks {
namespace {

/// A scene of stepped bodies, and what it shows.
struct ComposedScene {
  explicit ComposedScene(const std::string& text)
      : scene(std::get<Scene>(testing_support::script_of(text))),
        log(make_log(scene.system, scene.time.to.offset)),
        composition(scene, *log) {}

  DrawList at(const Rational& time) const {
    return composition.frame({.state = log->state_at(time), .time = time});
  }
  double x_px(double x) const { return composition.layout().at(x, 0).x; }

  Scene scene;
  std::unique_ptr<Log> log;
  Composition composition;
};

/// Of a plane, all that its window shows is in one group.
std::vector<DrawItem> single_items(const DrawList& picture) {
  std::vector<DrawItem> items;
  for (const DrawItem& item : picture.items) {
    if (const auto* const group = std::get_if<GroupItem>(&item)) {
      items.insert(items.end(), group->list->items.begin(), group->list->items.end());
    } else {
      items.push_back(item);
    }
  }
  return items;
}

/// Around what shows walls that move; nothing if nothing does.
std::optional<Rect> moving_bounds(const DrawList& picture) {
  std::vector<Point> corners;
  const auto add = [&](const Rect& rect) {
    corners.push_back({rect.x, rect.y});
    corners.push_back({rect.x + rect.width, rect.y + rect.height});
  };
  for (const DrawItem& item : single_items(picture)) {
    const ItemId id = std::visit([](const auto& any) { return any.id; }, item);
    if (id < nth(ItemId::wall, 1000) || id >= ItemId::red_block) continue;
    if (const auto* path = std::get_if<PathItem>(&item)) add(path->points.bounds());
    if (const auto* rectangle = std::get_if<RectangleItem>(&item)) add(rectangle->bounds);
  }
  if (corners.empty()) return std::nullopt;
  return Points(corners).bounds();
}

TEST(MovingWalls, OfALineAreWhereTheyAreAtTheTime) {
  const ComposedScene piston(
      "view.theme = 'lecture'\ntime.to = 14\nbox.x = [0, 10]\n"
      "box.x-velocity = [0, -0.5]\n[[body]]\nposition = 2\nvelocity = 1\n");
  for (const int time : {0, 3, 13}) {
    const auto wall = moving_bounds(piston.at(time));
    ASSERT_TRUE(wall);
    EXPECT_NEAR(wall->x, piston.x_px(10 - 0.5 * time), 1e-6) << time;
  }
}

TEST(MovingWalls, OfTheArticleAreDashed) {
  const ComposedScene article("view.theme = 'article'\nwall.velocity = 0.5\ntime.to = 2\n");
  const DrawList picture = article.at(1);
  const auto wall = moving_bounds(picture);
  ASSERT_TRUE(wall);
  EXPECT_LT(wall->x, article.x_px(0.5));
  EXPECT_GT(wall->x, article.x_px(0.3));
  EXPECT_TRUE(std::ranges::any_of(picture.items, [](const DrawItem& item) {
    const auto* const path = std::get_if<PathItem>(&item);
    return path != nullptr && path->id == nth(ItemId::wall, 1000) && path->stroke->dash_px > 0;
  }));
}

const std::string kBox =
    "view.theme = 'lecture'\ntime.to = 6\nbox.x = [0, 16]\nbox.y = [0, 9]\n"
    "view.x = [-1, 24]\nview.y = [-1, 10]\n";
const std::string kDisc = "[[body]]\nposition = [8, 5]\nradius = 0.5\n";

TEST(MovingWalls, OfAPlaneAreCutWhereTheyAre) {
  const ComposedScene corner(
      kBox + "[[wall]]\npoint = [0, 0]\nnormal = [1, 1]\nvelocity = [0.3, 0.3]\n" + kDisc);
  EXPECT_FALSE(moving_bounds(corner.at(0)));  // in the corner it has no length
  const auto wall = moving_bounds(corner.at(4));
  ASSERT_TRUE(wall);
  // From (0, 2.4) to (2.4, 0), and its line and hatch.
  EXPECT_NEAR(wall->x + wall->width, corner.x_px(2.4), 12);
  EXPECT_LT(wall->x, corner.x_px(0) + 1);
}

TEST(MovingWalls, DoNotCutOffThoseThatRest) {
  const auto right_end = [](const ComposedScene& shown) {
    double right = 0;
    for (const DrawItem& item : single_items(shown.at(3))) {
      const auto* const plate = std::get_if<PlateItem>(&item);
      if (plate != nullptr && plate->id < nth(ItemId::wall, 1000)) {
        right = std::max(right, plate->bounds.x + plate->bounds.width);
      }
    }
    return right;
  };
  const ComposedScene resting(kBox + kDisc);
  EXPECT_LT(right_end(resting), resting.x_px(17));
  const ComposedScene expanding(kBox + "box.x-velocity = [0, 1]\n" + kDisc);
  EXPECT_GT(right_end(expanding), expanding.x_px(23.9));
}

std::vector<std::string> texts_of(const DrawList& picture) {
  std::vector<std::string> texts;
  for (const DrawItem& item : picture.items) {
    if (const auto* text = std::get_if<TextItem>(&item)) texts.push_back(text->text);
  }
  return texts;
}

TEST(RealBodies, SayWhatTheyLoseAndWhenNothingMoreIsComputed) {
  const ComposedScene balls(
      "view.theme = 'lecture'\nview.size = [960, 540]\nrestitution = 0.05\ntime.to = 6\n"
      "time.allow-uncertain = true\nshow.overlays = ['energy']\n"
      "[[body]]\nposition = 0\nvelocity = 1\n[[body]]\nposition = 3\n"
      "[[body]]\nposition = 6\nvelocity = -1.2\n");
  const auto before = texts_of(balls.at(1));
  EXPECT_EQ(std::ranges::count(before, "Energy 1.220, lost 0.000"), 1);
  const auto after = texts_of(balls.at(3));
  EXPECT_EQ(std::ranges::count(after, "Energy 0.007, lost 1.213"), 1);
  EXPECT_EQ(std::ranges::count(after, "∞"), 1);
  EXPECT_EQ(std::ranges::count(after, "from here on nothing is computed"), 1);
}

}  // namespace
}  // namespace piblocks
