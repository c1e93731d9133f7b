// Updating a picture against painting it anew: every byte must be equal, and no pixel may change
// outside of the rectangles that are said to have changed.
#include <gtest/gtest.h>

#include <algorithm>
#include <span>
#include <vector>

#include "draw/canvas.hpp"
#include "draw/composed_pictures.hpp"
#include "draw/montage.hpp"
#include "draw/random_items.hpp"
#include "support/traced_random.hpp"

namespace piblocks {
namespace {

constexpr Color kBlack = {0, 0, 0};

/// What a list has to be painted on.
Background background_for(const DrawList& list) {
  return list.background ? Background::opaque : Background::transparent;
}

bool contains(const PixelRect& r, int x, int y) {
  return x >= r.x_px && x < r.right_px() && y >= r.y_px && y < r.bottom_px();
}

/// Updates `canvas`, and checks it against a fresh one.
void expect_update(Canvas& canvas, const DrawList& list) {
  const std::vector<std::uint32_t> before = pixels_of(canvas.view());
  const auto span = canvas.update(list);
  const std::vector<PixelRect> changed(span.begin(), span.end());
  const std::vector<std::uint32_t> after = pixels_of(canvas.view());
  const std::vector<std::uint32_t> wanted = painted(list);
  const auto wrong = after == wanted ? std::ssize(after)
                                     : std::ranges::mismatch(after, wanted).in1 - after.begin();
  ASSERT_EQ(wrong, std::ssize(after)) << "an update is not what painting gives, first at pixel "
                                      << wrong % list.width_px << ", " << wrong / list.width_px;
  for (std::size_t at = 0; at < after.size(); ++at) {
    if (before[at] == after[at]) continue;
    const int x = static_cast<int>(at) % list.width_px;
    const int y = static_cast<int>(at) / list.width_px;
    ASSERT_TRUE(std::ranges::any_of(changed, [&](const auto& r) { return contains(r, x, y); }))
        << "pixel " << x << ", " << y << " has changed, and nobody was told";
  }
}

double area(std::span<const PixelRect> rects) {
  double sum = 0;
  for (const PixelRect& r : rects) sum += double(r.width_px) * r.height_px;
  return sum;
}

void expect_exact_updates(Background background) {
  for (const auto& [width, height] : {std::pair{320, 180}, {101, 75}, {64, 240}}) {
    Scene scene;
    scene.view.theme = Theme::article;
    scene.view.background = background;
    scene.view.width_px = width;
    scene.view.height_px = height;
    const Pictures pictures(scene);
    Canvas canvas(width, height, background);
    for (int i = 0; i < 120; ++i) {
      expect_update(canvas, pictures.at(Rational(i) / 12));
      ASSERT_FALSE(testing::Test::HasFailure())
          << "frame " << i << " of " << width << "x" << height;
    }
  }
}

TEST(Region, OfWholeScenesIsExact) { expect_exact_updates(Background::opaque); }

TEST(Region, OfWholeScenesWithoutABackgroundIsExact) {
  expect_exact_updates(Background::transparent);
}

TEST(Region, OfAScenesFrameIsSmall) {
  const Pictures pictures(scene_with({{"view.size", "1280x720"}}));
  Canvas canvas(1280, 720);
  EXPECT_EQ(area(canvas.update(pictures.at(1))), 1280 * 720);
  EXPECT_TRUE(canvas.update(pictures.at(1)).empty()) << "nothing has changed";
  EXPECT_LT(area(canvas.update(pictures.at(Rational(61, 60)))), 0.005 * 1280 * 720);
}

TEST(Region, OfPicturesWithAllThatCanBeShownIsExact) {
  for (const auto& [theme, panels] : {std::pair{"article", "velocity,time"},
                                      {"colorblind", "position,count"},
                                      {"lecture", "unfolded,ellipse"}}) {
    const Pictures pictures(scene_with({{"view.size", "800x600"},
                                        {"view.theme", theme},
                                        {"show.title", "π"},
                                        {"show.overlays", "digits,masses,velocities,time"},
                                        {"show.panels", panels}}));
    Canvas canvas(800, 600);
    for (int i = 0; i < 60; ++i) {
      expect_update(canvas, pictures.at(Rational(29 + i % 45) / 9));
      ASSERT_FALSE(HasFailure()) << theme << ", step " << i;
    }
  }
}

/// As from frame to frame: all of its path, or where it stays.
void move(Random& random, ExposedBlock& block) {
  const double step = random.uniform(-5, 5);
  block.bounds.x += step;
  for (Dwell& dwell : block.dwells) dwell.x += step;
  if (random.integer(0, 4) == 0) block.dwells.clear();
}

/// All places but the first.
void move(Random& random, MovingShape& moving) {
  const double step = random.uniform(-5, 5);
  std::vector<Point> places(moving.places.view().begin(), moving.places.view().end());
  for (std::size_t i = 1; i < places.size(); ++i) places[i].x += step;
  moving.places = std::move(places);
}

void change(Random& random, DrawList& list);

/// The picture within a picture, or how much of it is seen.
void change_group(Random& random, GroupItem& group) {
  DrawList list = *group.list;
  change(random, list);
  group.list = std::make_shared<const DrawList>(list);
  if (random.integer(0, 3) == 0) group.opacity = random.uniform(0, 1);
}

/// A level line whose second end moves, maybe past the first one or onto it.
void grow(Random& random, PathItem& path, int width) {
  const std::span<const Point> points = path.points.view();
  const bool is_level = points.size() == 2 && points[0].y == points[1].y;
  const Point first = is_level ? points[0] : any_point(random, width, width);
  const double step = random.integer(0, 3) == 0 ? 0 : random.uniform(-20, 20);
  path.points = std::vector<Point>{first, {first.x + step, first.y}};
  path.closed = false;
  path.fill.reset();
  if (!is_level) path.stroke = Stroke{any_color(random), random.uniform(0.3, 5)};
}

/// Moves, resizes, recolours or rewrites one item, or a few, or none.
void change(Random& random, DrawList& list) {
  for (DrawItem& item : list.items) {
    const auto kind = random.integer(0, 5);
    if (kind == 0) {
      item = any_item(random, id_of(item), list.width_px, list.height_px);
    } else if (auto* rectangle = std::get_if<RectangleItem>(&item); rectangle && kind < 3) {
      rectangle->bounds.x += random.uniform(-5, 5);
    } else if (auto* text = std::get_if<TextItem>(&item); text && kind < 3) {
      text->text = any_text(random);
    } else if (auto* disc = std::get_if<DiscItem>(&item); disc && kind < 3) {
      disc->centre.x += random.uniform(-5, 5);
    } else if (auto* path = std::get_if<PathItem>(&item); path && kind < 3) {
      grow(random, *path, list.width_px);
    } else if (auto* group = std::get_if<GroupItem>(&item); group && kind < 3) {
      change_group(random, *group);
    } else if (auto* exposed = std::get_if<ExposedBlocksItem>(&item); exposed && kind < 3) {
      move(random, random.integer(0, 1) == 0 ? exposed->behind : exposed->front);
      if (random.integer(0, 1) == 0) exposed->contacts.clear();
    } else if (auto* moving = std::get_if<MovingShapesItem>(&item); moving && kind < 3) {
      move(random, moving->shapes.back());
      if (random.integer(0, 3) == 0) moving->shapes.push_back(moving->shapes.front());
    }
  }
}

/// Takes an item away, or puts one in its place among the others.
void add_or_remove(Random& random, DrawList& list) {
  const auto n = static_cast<std::size_t>(random.integer(0, 9));
  const ItemId id = nth(ItemId::blue_block, n);
  const auto at = std::ranges::lower_bound(list.items, id, {}, id_of);
  if (at != list.items.end() && id_of(*at) == id) {
    list.items.erase(at);
  } else {
    list.items.insert(at, any_item(random, id, list.width_px, list.height_px));
  }
}

TEST(Region, OfRandomPicturesIsExact) {
  TracedRandom random(271);
  for (int i = 0; i < many(100); ++i) {
    // Some are large enough for slanted lines to be cut.
    const int larger = i % 16 == 0 ? 4 : 1;
    const int width = static_cast<int>(random.integer(1, larger * 90));
    const int height = static_cast<int>(random.integer(1, larger * 70));
    DrawList list{width, height, any_color(random), {}};
    if (i % 2 == 1) list.background.reset();
    for (const ItemId id :
         {ItemId::wall, ItemId::red_block, ItemId::blue_block, ItemId::label, ItemId::count}) {
      list.items.push_back(any_item(random, id, width, height));
    }
    Canvas canvas(width, height, background_for(list));
    for (int step = 0; step < 20; ++step) {
      expect_update(canvas, list);
      ASSERT_FALSE(HasFailure()) << "picture " << i << ", step " << step;
      change(random, list);
    }
  }
}

TEST(Region, OfItemsThatComeAndGoIsExact) {
  TracedRandom random(828);
  for (int i = 0; i < 200; ++i) {
    const int width = static_cast<int>(random.integer(1, 90));
    const int height = static_cast<int>(random.integer(1, 70));
    DrawList list{width, height, any_color(random), {}};
    Canvas canvas(width, height);
    for (int step = 0; step < 20; ++step) {
      expect_update(canvas, list);
      ASSERT_FALSE(HasFailure()) << "picture " << i << ", step " << step;
      add_or_remove(random, list);
      change(random, list);
    }
  }
}

TEST(Region, OfAnItemThatComesIsItsOwn) {
  DrawList list{200, 100, kWhite, {}};
  const auto dot = [](std::size_t n) {
    return DiscItem{nth(ItemId::count, n), {10.0 * double(n), 50}, 4, kGreen, std::nullopt};
  };
  for (std::size_t n = 1; n < 10; ++n) list.items.push_back(dot(n));
  Canvas canvas(200, 100);
  expect_update(canvas, list);
  list.items.push_back(dot(10));
  list.items.erase(list.items.begin());
  EXPECT_LT(area(canvas.update(list)), 2 * 11 * 11);
}

TEST(Region, OfOtherItemsInAnyOrderIsTheWholeFrame) {
  const RectangleItem wall{ItemId::wall, {1, 1, 5, 5}, kGreen, std::nullopt};
  const TextItem count{ItemId::count, {2, 20}, "31", 18, kBlack};
  Canvas canvas(40, 30);
  expect_update(canvas, {40, 30, kWhite, {wall, count}});
  EXPECT_EQ(area(canvas.update({40, 30, kWhite, {count, wall}})), 40 * 30);
  EXPECT_EQ(area(canvas.update({40, 30, kBlack, {count, wall}})), 40 * 30);
}

DrawList counter(const char* text) {
  return {200, 40, kWhite, {TextItem{ItemId::count, {10, 30}, text, 20, kBlack}}};
}

/// Of two cells, one of which changes, with a line between them.
TEST(Region, WithinAPictureIsAsSmallAsItsOwn) {
  const auto list = [](const char* text) {
    const auto cell = std::make_shared<const DrawList>(counter(text));
    return DrawList{420, 40, kWhite, {GroupItem{ItemId::compared, {220, 0, 200, 40}, cell, 1}}};
  };
  Canvas canvas(420, 40);
  expect_update(canvas, list("3,141,591"));
  EXPECT_TRUE(canvas.update(list("3,141,591")).empty());
  const auto changed = canvas.update(list("3,141,592"));
  EXPECT_LT(area(changed), 0.1 * 420 * 40);
  for (const PixelRect& rect : changed) EXPECT_GT(rect.x_px, 220 + 90);
}

TEST(Region, OfAFadeIsTheFrameOnce) {
  const auto list = [](double opacity) {
    const DrawList next{40, 30, kGreen, {}};
    const RectangleItem block{ItemId::red_block, {10 * opacity, 1, 5, 5}, kBlack, std::nullopt};
    return DrawList{
        40,
        30,
        kWhite,
        {block,
         GroupItem{ItemId::fade, {0, 0, 40, 30}, std::make_shared<const DrawList>(next), opacity}}};
  };
  Canvas canvas(40, 30);
  expect_update(canvas, list(0.25));
  EXPECT_EQ(area(canvas.update(list(0.5))), 40 * 30);
}

/// Of a picture that fades into its own background only what is on it changes.
TEST(Region, OfAFadeIntoTheBackgroundIsWhatIsOnIt) {
  for (const Color& ground : {kWhite, kGreen, Color{1, 2, 3}}) {
    const auto list = [&](double opacity) {
      DrawList picture{40, 30, ground, {}};
      picture.items.emplace_back(
          RectangleItem{ItemId::red_block, {10 * opacity, 1, 5, 5}, kBlack, std::nullopt});
      return faded(std::move(picture), opacity);
    };
    Canvas canvas(40, 30);
    expect_update(canvas, list(0.01));
    for (int i = 2; i < 100; ++i) {
      expect_update(canvas, list(i / 100.0));
      ASSERT_FALSE(HasFailure()) << i;
    }
    EXPECT_LE(area(canvas.update(list(0.5))), 2 * 6 * 7);
  }
}

TEST(Region, OfACounterStartsAtTheFirstNewDigit) {
  Canvas canvas(200, 40);
  canvas.update(counter("3,141,591"));
  const double one_digit = area(canvas.update(counter("3,141,592")));
  const double all_digits = area(canvas.update(counter("4,141,592")));
  EXPECT_LT(one_digit, 0.4 * all_digits);
}

}  // namespace
}  // namespace piblocks
