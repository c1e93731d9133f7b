// Draw items of every kind, of any size and anywhere, for tests of properties.
// In: a source of random numbers, the size of a frame. Out: items in or around it.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "draw/draw_list.hpp"
#include "support/property.hpp"

namespace piblocks {

/// A number of pixels in or around a frame of size `end`; half of them whole.
inline double anywhere(Random& random, int end) {
  const double position = random.uniform(-0.3 * end, 1.3 * end);
  return random.integer(0, 1) == 0 ? position : std::round(position);
}

inline Color any_color(Random& random) {
  const auto part = [&] { return static_cast<std::uint8_t>(random.integer(0, 255)); };
  return {part(), part(), part()};
}

inline std::string any_text(Random& random) {
  const std::string text = "3,141,592 Collisions: \xc3\x84\xc3\xb6j\xcf\x80";
  std::size_t length = static_cast<std::size_t>(random.integer(0, std::int64_t(text.size())));
  while (length < text.size() && (static_cast<unsigned char>(text[length]) & 0xc0) == 0x80)
    ++length;
  return text.substr(0, length);
}

inline std::optional<Stroke> any_stroke(Random& random) {
  if (random.integer(0, 2) == 0) return std::nullopt;
  return Stroke{any_color(random), random.uniform(0.5, 4),
                random.integer(0, 2) == 0 ? random.uniform(1, 6) : 0};
}

inline std::optional<Color> any_fill(Random& random) {
  return random.integer(0, 3) != 0 ? std::optional(any_color(random)) : std::nullopt;
}

inline Point any_point(Random& random, int width, int height) {
  return {anywhere(random, width), anywhere(random, height)};
}

inline TextItem any_line(Random& random, ItemId id, int width, int height) {
  return {id, any_point(random, width, height), any_text(random), random.uniform(4, 30),
          any_color(random)};
}

/// Half of them with round corners.
inline RectangleItem any_rectangle(Random& random, ItemId id, int width, int height) {
  RectangleItem item{id,
                     {anywhere(random, width), anywhere(random, height), random.uniform(1, width),
                      random.uniform(1, height)},
                     any_fill(random),
                     any_stroke(random)};
  if (random.integer(0, 1) == 0) item.corner_px = random.uniform(0, 6);
  return item;
}

inline GlowItem any_glow(Random& random, ItemId id, int width, int height) {
  const double radius = random.uniform(1, 60);
  const Point centre = any_point(random, width, height);
  return {id, Rect{centre.x, centre.y, 0, 0}.grown(radius).whole_pixels(), centre, radius,
          any_color(random)};
}

inline PathItem any_path(Random& random, ItemId id, int width, int height) {
  std::vector<Point> points(static_cast<std::size_t>(random.integer(0, 9)));
  for (Point& point : points) point = any_point(random, width, height);
  return {id, points, random.integer(0, 1) == 0, any_fill(random), any_stroke(random)};
}

inline DiscItem any_disc(Random& random, ItemId id, int width, int height) {
  return {id, any_point(random, width, height), random.uniform(0.5, 60), any_fill(random),
          any_stroke(random)};
}

inline ImageItem any_image(Random& random, ItemId id, int width, int height) {
  Image image{static_cast<int>(random.integer(1, 8)), static_cast<int>(random.integer(1, 8)), {}};
  for (int i = 0; i < image.width_px * image.height_px; ++i) {
    image.words.push_back(static_cast<std::uint32_t>(random.integer(0, 0xFFFFFFFF)));
  }
  return {id,
          {std::round(anywhere(random, width)), std::round(anywhere(random, height)),
           random.uniform(1, width), random.uniform(1, height)},
          std::make_shared<const Image>(image)};
}

inline DrawItem any_item(Random& random, ItemId id, int width, int height);

/// A picture of a few items, in or around the frame, often seen through, sometimes scaled.
inline GroupItem any_group(Random& random, ItemId id, int width, int height) {
  DrawList list{static_cast<int>(random.integer(1, width)),
                static_cast<int>(random.integer(1, height)),
                any_color(random),
                {}};
  for (const ItemId inner : {ItemId::wall, ItemId::red_block, ItemId::count}) {
    if (random.integer(0, 2) == 0) continue;
    list.items.push_back(any_item(random, inner, list.width_px, list.height_px));
  }
  const double scale = random.integer(0, 2) == 0 ? random.uniform(0.3, 2) : 1;
  return {id,
          {std::trunc(anywhere(random, width)), std::trunc(anywhere(random, height)),
           scale * list.width_px, scale * list.height_px},
          std::make_shared<const DrawList>(list),
          random.integer(0, 1) == 0 ? 1 : random.uniform(0, 1)};
}

inline ExposedBlock any_exposed_block(Random& random, int width, int height) {
  ExposedBlock block{{anywhere(random, width), anywhere(random, height), random.uniform(1, width),
                      random.uniform(1, height)},
                     any_color(random),
                     {any_color(random), random.uniform(0.5, 4), 0},
                     random.integer(0, 1) == 0 ? random.uniform(0, 5) : 0};
  for (std::int64_t i = random.integer(-2, 3); i > 0; --i) {
    const double down = random.uniform(0, block.bounds.height);
    block.bars.push_back({block.bounds.y + down, random.uniform(0, block.bounds.height - down)});
  }
  const auto count = random.integer(0, 2) == 0 ? 0 : random.integer(1, 40);
  double x = block.bounds.x;
  for (std::int64_t i = 0; i < count; ++i) {
    block.dwells.push_back({x, 1.0 / double(count)});
    x += random.uniform(0.01, 1);
  }
  return block;
}

inline ExposedBlocksItem any_exposed(Random& random, ItemId id, int width, int height) {
  ExposedBlocksItem item{
      id, any_exposed_block(random, width, height), any_exposed_block(random, width, height), {}};
  for (std::int64_t i = random.integer(-3, 5); i > 0; --i) {
    item.contacts.push_back({anywhere(random, width), anywhere(random, width), 0.1});
  }
  std::ranges::sort(item.contacts, {}, &TouchingBlocks::right_x);
  return item;
}

/// Blocks and discs of all sizes, which may overlap, along straight ways.
inline MovingShapesItem any_moving_shapes(Random& random, ItemId id, int width, int height) {
  const auto moments = random.integer(1, 30);
  MovingShapesItem item{
      id, std::vector<double>(static_cast<std::size_t>(moments), 1 / double(moments)), {}};
  for (std::int64_t i = random.integer(1, 4); i > 0; --i) {
    MovingShape moving;
    if (random.integer(0, 1) == 0) {
      ExposedBlock block = any_exposed_block(random, width, height);
      block.dwells.clear();
      moving.shape = std::move(block);
    } else {
      DiscItem disc{id, {}, std::exp(random.uniform(-3, 3)), any_color(random), any_stroke(random)};
      if (disc.stroke) disc.stroke->dash_px = 0;
      moving.shape = disc;
    }
    const Point from = any_point(random, width, height);
    const Point to = random.integer(0, 4) == 0 ? from : any_point(random, width, height);
    std::vector<Point> places;
    for (std::int64_t k = 0; k < moments; ++k) {
      const double part = double(k) / double(moments);
      places.push_back({from.x + part * (to.x - from.x), from.y + part * (to.y - from.y)});
    }
    moving.places = places;
    item.shapes.push_back(std::move(moving));
  }
  return item;
}

inline PlateItem any_plate(Random& random, ItemId id, int width, int height) {
  Plate plate;
  for (std::int64_t i = random.integer(0, 3); i > 0; --i) {
    plate.items.emplace_back(any_path(random, id, width, height));
    plate.items.emplace_back(any_disc(random, id, width, height));
    plate.items.emplace_back(any_line(random, id, width, height));
  }
  return {id,
          {std::round(anywhere(random, width)), std::round(anywhere(random, height)),
           double(random.integer(1, width)), double(random.integer(1, height))},
          std::make_shared<const Plate>(std::move(plate)),
          {double(random.integer(-9, 9)), double(random.integer(-9, 9))}};
}

inline DrawItem any_item(Random& random, ItemId id, int width, int height) {
  switch (random.integer(0, 9)) {
    case 0:
      return any_line(random, id, width, height);
    case 1:
      return any_path(random, id, width, height);
    case 2:
      return any_disc(random, id, width, height);
    case 3:
      return any_image(random, id, width, height);
    case 4:
      return any_exposed(random, id, width, height);
    case 5:
      return any_group(random, id, width, height);
    case 6:
      return any_plate(random, id, width, height);
    case 7:
      return any_moving_shapes(random, id, width, height);
    case 8:
      return any_glow(random, id, width, height);
    default:
      return any_rectangle(random, id, width, height);
  }
}

}  // namespace piblocks
