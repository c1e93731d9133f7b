// Exposed frames of bodies against the mean of many instants.
#include <gtest/gtest.h>
#include <piblocks/error.hpp>
#include <piblocks/render.hpp>
#include <piblocks/system.hpp>

#include <array>
#include <optional>
#include <stop_token>
#include <utility>
#include <variant>
#include <vector>

#include "draw/found_items.hpp"
#include "mean_light.hpp"
#include "render/film.hpp"
#include "support/random_discs.hpp"

namespace piblocks {
namespace {

Scene scene_of(System system, const Rational& end) {
  Scene scene;
  const std::size_t count = system.bodies.size();
  scene.system = std::move(system);
  scene.styles.resize(count);
  scene.view.theme = Theme::article;
  scene.view.width_px = 320;
  scene.view.height_px = 180;
  scene.view.x = {0, 8};
  scene.view.y = {0, 4};
  scene.view.shutter = Rational(1, 2);
  scene.view.frame_rate = 10;
  scene.time.to = end;
  return scene;
}

System box(std::vector<Body> bodies, int dimensions) {
  std::vector<Wall> walls = piblocks::box(8, 4);
  walls.resize(2 * static_cast<std::size_t>(dimensions));
  return {dimensions, std::move(bodies), std::move(walls)};
}

LightDifference exposed_difference(const Scene& scene, std::int64_t frame) {
  const auto samples = [](const ImageView& picture) { return samples_of(picture); };
  FrameRenderer renderer(scene);
  return difference_of(samples(renderer.frame(frame)), mean_of_instants(scene, frame, samples));
}

TEST(BodyShutter, FramesOfBlocksAreMeansOfInstants) {
  // Three that collide with each other and with both walls, and one that stays.
  const Scene scene =
      scene_of(box({{.mass = 1, .position = {1, 0}, .velocity = {3, 0}},
                    {.mass = 4, .position = {Rational(7, 3), 0}, .size = Rational(4, 7)},
                    {.mass = 9, .position = {4, 0}, .velocity = {-5, 0}},
                    {.mass = 2, .position = {7, 0}, .size = Rational(1, 3)}},
                   1),
               3);
  for (const std::int64_t frame : {0, 3, 7, 20}) {
    EXPECT_LE(exposed_difference(scene, frame).worst, 5.5) << frame;
  }
}

TEST(BodyShutter, FramesOfTouchingBlocksAreMeansOfInstants) {
  std::vector<Body> bodies{{.position = {1, 0}, .velocity = {7, 0}, .size = Rational(3, 7)}};
  for (int i = 0; i < 4; ++i) {
    bodies.push_back({.position = {3 + i * Rational(3, 7), 0}, .size = Rational(3, 7)});
  }
  const Scene scene = scene_of(box(std::move(bodies), 1), 2);
  for (const std::int64_t frame : {1, 3, 8}) {
    EXPECT_LE(exposed_difference(scene, frame).worst, 3) << frame;
  }
}

/// A row of blocks, touching, which goes back and forth by some pixels.
struct MovingRow {
  double block_px = 1;
  double line_px = 0;
  double way_px = 1;
  int blocks = 100;

  double left_at(double time) const {  // of the first block
    return 20.3 + way_px * (time < 0.25 ? time / 0.25 : 1 - (time - 0.25) / 0.75);
  }
  ExposedBlock block(int i, double time) const {
    const std::array<Color, 3> fills = {Color{200, 30, 60}, {20, 160, 90}, {240, 220, 40}};
    return {{left_at(time) + i * block_px, 5.5, block_px, 20},
            fills[static_cast<std::size_t>(i % 3)],
            {Color{10, 10, 40}, line_px},
            {}};
  }
  /// From left to right, but painted in another order.
  MovingShapesItem item() const {
    const int moments = static_cast<int>(16 + 2 * way_px);
    MovingShapesItem item{ItemId::red_block,
                          std::vector<double>(static_cast<std::size_t>(moments), 1.0 / moments),
                          {}};
    for (const int i : order()) {
      std::vector<Point> places;
      for (int k = 0; k < moments; ++k) {
        const Rect bounds = block(i, (k + 0.5) / moments).bounds;
        places.push_back({bounds.x, bounds.y});
      }
      item.shapes.push_back({block(i, 0), places});
    }
    return item;
  }
  std::vector<DrawItem> at(double time) const {
    std::vector<DrawItem> items;
    for (const int i : order()) add_rectangles(ItemId::red_block, block(i, time), items);
    return items;
  }
  std::vector<int> order() const {
    std::vector<int> order;
    for (int i = 0; i < blocks; ++i) order.push_back(i * 7 % blocks);
    return order;
  }
};

double worst_difference(const MovingRow& row) {
  constexpr int kInstants = 2000;
  const Color background{250, 250, 250};
  Canvas canvas(160, 40);
  MeanLight mean;
  for (int i = 0; i < kInstants; ++i) {
    canvas.update({160, 40, background, row.at((i + 0.5) / kInstants)});
    mean.add(samples_of(canvas.view()));
  }
  canvas.paint({160, 40, background, {row.item()}});
  return difference_of(samples_of(canvas.view()), mean.samples()).worst;
}

/// Up to six blocks are in one pixel at the same time.
TEST(BodyShutter, NarrowBlocksAreMeansOfInstants) {
  for (const double block_px : {0.21, 0.5, 0.93, 1.7}) {
    for (const double way_px : {0.3, 5.0, 61.0}) {
      EXPECT_LE(worst_difference({.block_px = block_px, .way_px = way_px}), 4)
          << block_px << ", " << way_px;
    }
  }
  for (const double way_px : {0.3, 5.0, 61.0}) {
    const MovingRow row{.block_px = 2.3, .line_px = 1, .way_px = way_px, .blocks = 40};
    EXPECT_LE(worst_difference(row), 4) << way_px;
  }
}

/// A body that bounces exactly once, or twice, between samples at even times would seem to stay.
TEST(BodyShutter, FramesOfManyCollisionsAreMeansOfInstants) {
  for (const int bounces : {511, 1022, 2044}) {
    System system{1, {}, {}};
    system.bodies.push_back({.mass = std::nullopt, .position = {1, 0}});
    system.bodies.push_back({.mass = 1,
                             .position = {3, 0},
                             .velocity = {2 * Rational(9, 2) * bounces * 20, 0},
                             .size = Rational(1, 2)});
    system.bodies.push_back({.mass = std::nullopt, .position = {7, 0}});
    Scene scene = scene_of(std::move(system), Rational(1, 10));
    scene.time.allow_uncertain = true;
    EXPECT_LE(exposed_difference(scene, 0).worst, 2.5) << bounces;
  }
}

/// A train that passes by: what a frame holds of it does not depend on how fast it is.
TEST(BodyShutter, BlocksTakeNoMoreMemoryTheFasterTheyAre) {
  constexpr int kBlocks = 2000;
  std::vector<Body> bodies;
  for (int i = 0; i < kBlocks; ++i) {
    bodies.push_back({.position = {Rational(101, 1000) * i, 0},
                      .velocity = {-1000, 0},
                      .size = Rational(1, 10)});
  }
  const Film film(scene_of({1, std::move(bodies), {}}, 1));
  std::size_t parts = 0;
  for (const auto& exposed : items_of<MovingShapesItem>(film.frame(0).items)) {
    for (const MovingShape& shape : exposed.shapes) parts += shape.places.view().size();
  }
  EXPECT_GT(parts, 0U);
  EXPECT_LE(parts, std::size_t{1} << 22);
}

/// What happens after it may not be certain, or too much to compute.
TEST(BodyShutter, AnExposureStopsAtTheEndOfTheFilm) {
  const std::vector<Body> bodies{{.position = {1, 0}, .velocity = {3, 0}},
                                 {.mass = 4, .position = {6, 0}, .velocity = {-1, 0}}};
  Scene scene = scene_of(box(bodies, 1), 1);
  scene.time.speed = 10'000'000;
  FrameRenderer film(scene);
  ASSERT_EQ(film.frame_count(), 1);
  const std::vector<int> exposed = samples_of(film.frame(0));
  // Almost all of the exposure is after the end, when all stand still.
  scene.view.shutter = 0;
  scene.time = {.from = Rational(999'999, 1'000'000), .to = Rational(1)};
  FrameRenderer end(scene);
  const std::vector<int> still = samples_of(end.frame(0));
  EXPECT_LE(difference_of(exposed, {still.begin(), still.end()}).worst, 2);
}

/// Two blocks and a wall by other names, in both directions and orders: thousands of collisions a
/// frame.
TEST(BodyShutter, FramesOfTheClosedFormAreMeansOfInstants) {
  for (const auto& [sign, is_inner_first] :
       {std::pair(1, true), std::pair(1, false), std::pair(-1, true), std::pair(-1, false)}) {
    SCOPED_TRACE(testing::Message() << sign << (is_inner_first ? "" : ", the outer block first"));
    System system{1, {}, {{"side", {sign > 0 ? 0 : 8, 0}, {sign, 0}}}};
    const auto at = [&](const Rational& distance) -> Rational {
      return sign > 0 ? distance : Rational(8 - distance);
    };
    system.bodies.push_back({.mass = 1, .position = {at(2), 0}});
    system.bodies.push_back({.mass = 100'000'000, .position = {at(5), 0}, .velocity = {-sign, 0}});
    if (!is_inner_first) std::swap(system.bodies[0], system.bodies[1]);
    const Scene scene = scene_of(std::move(system), 8);
    // The turn is at 4.
    for (const std::int64_t frame : {30, 39, 40}) {
      EXPECT_LE(exposed_difference(scene, frame).worst, 2.5) << frame;
    }
  }
}

/// Edges fade by the distance from the centre; at an instant, by the area that is covered. A few
/// pixels along slanted edges show that.
TEST(BodyShutter, FramesOfDiscsAreMeansOfInstants) {
  Scene scene =
      scene_of(box({{.mass = 1, .position = {1, 1}, .velocity = {9, 4}, .size = Rational(1, 2)},
                    {.mass = 4, .position = {5, 2}, .velocity = {-7, 1}, .size = Rational(7, 10)},
                    {.mass = 1, .position = {7, 3}, .velocity = {-1, -11}, .size = Rational(1, 10)},
                    {.mass = std::nullopt, .position = {3, 3}, .size = Rational(1, 3)}},
                   2),
               2);
  for (const std::int64_t frame : {0, 1, 3, 9}) {
    const LightDifference difference = exposed_difference(scene, frame);
    // At an instant Cairo paints small discs at multiples of 1/8 pixel.
    EXPECT_LE(difference.worst, 20) << frame;
    EXPECT_LE(difference.mean, 0.1) << frame;
  }
  scene.system.bodies[2].size = Rational(1, 2);  // now all are large
  scene.view.width_px = 640;
  scene.view.height_px = 360;
  for (const std::int64_t frame : {0, 5}) {
    EXPECT_LE(exposed_difference(scene, frame).worst, 16) << frame;
  }
}

/// Of the items in the picture of the bodies.
template <typename Item>
std::size_t block_count(const DrawList& frame) {
  return items_of<Item>(std::get<GroupItem>(frame.items.front()).list->items).size();
}

TEST(BodyShutter, DiscsThatStayAreDiscItems) {
  Scene scene = scene_of(box({{.position = {1, 1}, .velocity = {1, 0}, .size = Rational(1, 4)},
                              {.position = {4, 3}, .size = Rational(1, 4)}},
                             2),
                         2);
  const Film film(scene);
  EXPECT_EQ(block_count<DiscItem>(film.frame(3)), 1U);
  EXPECT_EQ(block_count<MovingShapesItem>(film.frame(3)), 1U);
}

/// Each pixel between them has a part of two or three discs all the time.
TEST(BodyShutter, FramesOfTouchingDiscsAreMeansOfInstants) {
  std::vector<Body> bodies;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      bodies.push_back({.mass = 1 + i + 3 * j,
                        .position = {2 + i, 1 + j},
                        .velocity = {Rational(3, 10), Rational(1, 7)},
                        .size = Rational(1, 2)});
    }
  }
  Scene scene = scene_of({2, std::move(bodies), {}}, 2);
  scene.time.allow_uncertain = true;  // they touch from the beginning
  for (const std::int64_t frame : {0, 3}) {
    const LightDifference difference = exposed_difference(scene, frame);
    EXPECT_LE(difference.worst, 24) << frame;
    EXPECT_LE(difference.mean, 0.1) << frame;
  }
}

/// No disc is wider than two pixels, and each pixel has parts of four.
TEST(BodyShutter, FramesOfTinyDiscsAreMeansOfInstants) {
  for (const Rational& radius : {Rational(1, 40), Rational(1, 80), Rational(1, 200)}) {
    std::vector<Body> bodies;
    for (int i = 0; i < 20; ++i) {
      for (int j = 0; j < 20; ++j) {
        bodies.push_back({.position = {2 + Rational(2001, 1000) * i * radius,
                                       1 + Rational(2001, 1000) * j * radius},
                          .velocity = {3, 2},
                          .size = radius});
      }
    }
    const Scene scene = scene_of({2, std::move(bodies), {}}, 2);
    const LightDifference difference = exposed_difference(scene, 1);
    EXPECT_LE(difference.worst, 16) << radius;
    EXPECT_LE(difference.mean, 0.1) << radius;
  }
}

TEST(BodyShutter, DiscsThatMoveByLessThanCanBeSeenAreDiscs) {
  const Scene scene =
      scene_of(box({{.position = {1, 1},
                     .velocity = {Rational(1, 1'000'000'000), 0},
                     .size = Rational(1, 4)},
                    {.position = {4, 3}, .velocity = {1, 0}, .size = Rational(1, 4)}},
                   2),
               2);
  const Film film(scene);
  EXPECT_EQ(block_count<DiscItem>(film.frame(3)), 1U);
}

/// Light is neither lost nor made: far from its edges a disc's mean is its time there.
TEST(BodyShutter, ManyDiscsThatPassOnePlaceAddUp) {
  constexpr std::size_t kDiscs = 4;
  MovingShapesItem item{ItemId::red_block, std::vector<double>(kDiscs, 1.0 / kDiscs), {}};
  for (std::size_t i = 0; i < kDiscs; ++i) {
    // Each is over the middle for a quarter of the time.
    std::vector<Point> places(kDiscs, {1000, 1000});
    places[i] = {50, 50};
    item.shapes.push_back({DiscItem{{}, {}, 30, Color{255, 255, 255}, std::nullopt}, places});
  }
  DrawList list{100, 100, Color{0, 0, 0}, {item}};
  Canvas canvas(100, 100);
  canvas.paint(list);
  EXPECT_EQ(canvas.view().row(50)[4 * 50], 255);
  EXPECT_EQ(canvas.view().row(50)[4 * 95], 0);
}

/// Edge pixels times moments have a limit, at any speed and number.
TEST(BodyShutter, NoFrameCostsMoreThanItsLimit) {
  for (const int count : {1, 1500}) {
    std::vector<Body> bodies;
    for (int i = 0; i < count; ++i) {
      bodies.push_back({.position = {Rational(1 + i % 50) / 7, Rational(1 + i / 50) / 8},
                        .velocity = {20 + i % 7, i % 11 - 5},
                        .size = Rational(1, 20)});
    }
    Scene scene = scene_of(box(std::move(bodies), 2), 1);
    scene.view.frame_rate = 1;
    scene.view.shutter = 1;
    scene.view.width_px = 3200;
    scene.view.height_px = 1800;
    scene.time.allow_uncertain = true;
    const DrawList frame = Film(scene).frame(0);
    const auto& group = std::get<GroupItem>(frame.items.front());
    const auto& moving = std::get<MovingShapesItem>(group.list->items.back());
    double edges_px = 0;
    for (const MovingShape& shape : moving.shapes) {
      edges_px += 6.28 * std::get<DiscItem>(shape.shape).radius;
    }
    const auto moments = moving.shapes.front().places.view().size();
    EXPECT_LE(edges_px * double(moments), 1e8) << count;
    EXPECT_LE(moments, 2U * 4096U) << count;
    EXPECT_GE(moments, 16U) << count;
  }
}

/// Where a request to stop comes while one picture is painted.
TEST(BodyShutter, PaintingStopsWithinAFrame) {
  MovingShapesItem item{ItemId::red_block, std::vector<double>(8, 1.0 / 8), {}};
  item.shapes.push_back(
      {DiscItem{{}, {}, 40, Color{255, 255, 255}, std::nullopt}, std::vector<Point>(8, {50, 50})});
  const DrawList list{100, 100, Color{0, 0, 0}, {item}};
  std::stop_source stop;
  Canvas canvas(100, 100);
  canvas.listen(stop.get_token());
  EXPECT_NO_THROW(canvas.paint(list));
  stop.request_stop();
  EXPECT_THROW(canvas.paint(list), Interrupted);
  canvas.listen({});
  EXPECT_NO_THROW(canvas.update(list));
  EXPECT_EQ(canvas.view().row(50)[4 * 50], 255);
}

}  // namespace
}  // namespace piblocks
