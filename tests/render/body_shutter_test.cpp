// Exposed frames of bodies against the mean of many instants.
#include <gtest/gtest.h>
#include <piblocks/bodies.hpp>
#include <piblocks/render.hpp>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numeric>
#include <variant>
#include <vector>

#include "draw/canvas.hpp"
#include "draw/composition.hpp"
#include "mean_light.hpp"
#include "render/film.hpp"
#include "scene/schedule.hpp"

namespace piblocks {
namespace {

Scene scene_of(BodySystem system, const Rational& end) {
  Scene scene;
  const std::size_t count = system.bodies.size();
  scene.bodies = Bodies{std::move(system), std::vector<BodyStyle>(count)};
  scene.view.width_px = 320;
  scene.view.height_px = 180;
  scene.view.x = {0, 8};
  scene.view.y = {0, 4};
  scene.view.shutter = Rational(1, 2);
  scene.view.frame_rate = 10;
  scene.time.to = end;
  return scene;
}

BodySystem box(std::vector<Body> bodies, int dimensions) {
  BodySystem system{dimensions, std::move(bodies), {}};
  system.walls.push_back({"left", {0, 0}, {1, 0}});
  system.walls.push_back({"right", {8, 0}, {-1, 0}});
  if (dimensions == 2) {
    system.walls.push_back({"lower", {0, 0}, {0, 1}});
    system.walls.push_back({"upper", {0, 4}, {0, -1}});
  }
  return system;
}

std::vector<int> samples_of(const ImageView& picture) {
  std::vector<int> samples;
  for (int y = 0; y < picture.height_px; ++y) {
    for (int i = 0; i < 4 * picture.width_px; ++i) {
      if (i % 4 != 3) samples.push_back(picture.row(y)[i]);
    }
  }
  return samples;
}

/// The mean of the pictures of instants at which a frame's shutter is open.
std::vector<double> mean_of_instants(const Scene& open, std::int64_t frame) {
  constexpr int kInstants = 1000;
  Scene scene = open;
  scene.view.shutter = 0;
  const auto log = make_body_log(scene.bodies->system, Rational(scene.time.to.offset));
  const Schedule schedule = make_schedule(scene, *log);
  const Composition composition(scene, *log);
  const Integer count = log->count_at(schedule.time_of(frame));
  Canvas canvas(scene.view.width_px, scene.view.height_px);
  MeanLight mean;
  for (int i = 0; i < kInstants; ++i) {
    const Rational time = schedule.time_of(frame) + open.view.shutter *
                                                        Rational(2 * i + 1, 2 * kInstants) /
                                                        open.view.frame_rate;
    FrameState shown{.state = {count, {}, {}}, .time = time};
    shown.bodies = log->state_at(time).bodies;
    canvas.update(composition.frame(shown));
    mean.add(samples_of(canvas.view()));
  }
  return mean.samples();
}

struct Difference {
  double worst = 0;  ///< steps of 255
  double mean = 0;
};

Difference difference_of(const Scene& scene, std::int64_t frame) {
  FrameRenderer renderer(scene);
  const std::vector<int> samples = samples_of(renderer.frame(frame));
  const std::vector<double> wanted = mean_of_instants(scene, frame);
  Difference difference;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double apart = std::fabs(samples[i] - wanted[i]);
    difference.worst = std::max(difference.worst, apart);
    difference.mean += apart / double(samples.size());
  }
  return difference;
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
  for (const std::int64_t frame : {0, 2, 3, 4, 7, 11, 20}) {
    EXPECT_LE(difference_of(scene, frame).worst, 2.5) << frame;
  }
}

TEST(BodyShutter, FramesOfTouchingBlocksAreMeansOfInstants) {
  std::vector<Body> bodies{{.position = {1, 0}, .velocity = {7, 0}, .size = Rational(3, 7)}};
  for (int i = 0; i < 4; ++i) {
    bodies.push_back({.position = {3 + i * Rational(3, 7), 0}, .size = Rational(3, 7)});
  }
  const Scene scene = scene_of(box(std::move(bodies), 1), 2);
  for (const std::int64_t frame : {1, 2, 3, 5, 8}) {
    EXPECT_LE(difference_of(scene, frame).worst, 2.5) << frame;
  }
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
  int worst = 0;
  for (std::size_t i = 0; i < still.size(); ++i) {
    worst = std::max(worst, std::abs(still[i] - exposed[i]));
  }
  EXPECT_LE(worst, 2);
}

/// Two blocks and a wall by other names, in both directions: thousands of collisions a frame.
TEST(BodyShutter, FramesOfTheClosedFormAreMeansOfInstants) {
  for (const int sign : {1, -1}) {
    SCOPED_TRACE(sign);
    BodySystem system{1, {}, {{"side", {sign > 0 ? 0 : 8, 0}, {sign, 0}}}};
    const auto at = [&](const Rational& distance) -> Rational {
      return sign > 0 ? distance : Rational(8 - distance);
    };
    system.bodies.push_back({.mass = 1, .position = {at(2), 0}});
    system.bodies.push_back({.mass = 100'000'000, .position = {at(5), 0}, .velocity = {-sign, 0}});
    const Scene scene = scene_of(std::move(system), 8);
    // The turn is at 4.
    for (const std::int64_t frame : {15, 30, 38, 39, 40, 60}) {
      EXPECT_LE(difference_of(scene, frame).worst, 2.5) << frame;
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
  for (const std::int64_t frame : {0, 1, 2, 3, 5, 9, 14}) {
    const Difference difference = difference_of(scene, frame);
    // At an instant Cairo paints small discs at multiples of 1/8 pixel.
    EXPECT_LE(difference.worst, 20) << frame;
    EXPECT_LE(difference.mean, 0.1) << frame;
  }
  scene.bodies->system.bodies[2].size = Rational(1, 2);  // now all are large
  scene.view.width_px = 640;
  scene.view.height_px = 360;
  for (const std::int64_t frame : {0, 3, 5}) {
    EXPECT_LE(difference_of(scene, frame).worst, 16) << frame;
  }
}

TEST(BodyShutter, DiscsThatStayAreDiscItems) {
  Scene scene = scene_of(box({{.position = {1, 1}, .velocity = {1, 0}, .size = Rational(1, 4)},
                              {.position = {4, 3}, .size = Rational(1, 4)}},
                             2),
                         2);
  const Film film(scene);
  for (const DrawItem& item : film.frame(3).items) {
    const auto* const group = std::get_if<GroupItem>(&item);
    if (group == nullptr) continue;
    const auto count = [&](const auto& is_kind) {
      return std::ranges::count_if(group->list->items, is_kind);
    };
    EXPECT_EQ(count([](const DrawItem& part) { return std::holds_alternative<DiscItem>(part); }),
              1);
    EXPECT_EQ(
        count([](const DrawItem& part) { return std::holds_alternative<ExposedDiscsItem>(part); }),
        1);
  }
}

/// Light is neither lost nor made: far from its edges a disc's mean is its time there.
TEST(BodyShutter, ManyDiscsThatPassOnePlaceAddUp) {
  ExposedDiscsItem item{ItemId::red_block, {}};
  constexpr int kDiscs = 4;
  for (int i = 0; i < kDiscs; ++i) {
    const double away = 1000;
    // Each is over the middle for a quarter of the time, and away for the rest.
    ExposedDisc disc{30, 0, Color{255, 255, 255}, {}, {}};
    disc.paths = {{{50, 50}, {50, 50}, 1.0 / kDiscs},
                  {{away, away}, {away, away}, 1 - 1.0 / kDiscs}};
    item.discs.push_back(disc);
  }
  DrawList list{100, 100, Color{0, 0, 0}, {item}};
  Canvas canvas(100, 100);
  canvas.paint(list);
  EXPECT_EQ(canvas.view().row(50)[4 * 50], 255);
  EXPECT_EQ(canvas.view().row(50)[4 * 95], 0);
}

}  // namespace
}  // namespace piblocks
