#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "draw/stage/stage.hpp"

namespace piblocks {
namespace {

using Exposures = std::span<const WeightedExposure>;
using Still = std::variant<ExposedBlock, DiscItem>;
using PlacedBodies = std::vector<const PlacedBody*>;

/// Above the ids of bodies, and of the bars of the last of them.
constexpr ItemId kMovingBodies = nth(ItemId::blue_block, 500);

// Moments per mean: the least number, and one more for each pixel of the longest way. The tests
// hold blocks to 6 steps of 255 beside a mean of 1,000 pictures of instants. Round edges need
// fewer.
constexpr double kLeastMoments = 16;
constexpr double kLeastMomentsOfDiscs = 8;
constexpr double kMostMoments = 4096;
// A picture's cost and memory: pixels of edges that are painted in all moments, and places.
constexpr double kMostEdges_px = 1e8;
constexpr double kMostPlaces = 1 << 22;
/// Of very many bodies.
constexpr double kFewMoments = 8;

/// Calls visit(begin, end, piece) for each piece of a body's motion and its part of the exposure.
template <typename Visit>
void each_piece(Exposures exposures, std::size_t body, const Visit& visit) {
  double before = 0;
  for (const auto& [share, exposure] : exposures) {
    for (const BodyPiece& piece : exposure.pieces[body]) {
      visit(before + share * piece.begin, before + share * piece.end, piece);
    }
    before += share;
  }
}

/// How far a body moves, in pixels.
double way_of(Exposures exposures, std::size_t body, const Layout& map) {
  double way = 0;
  each_piece(exposures, body, [&](double, double, const BodyPiece& piece) {
    way += length({piece.to[0] - piece.from[0], piece.to[1] - piece.from[1]});
  });
  return way * map.scale;
}

/// How many pixels the edges of a body have. Each is computed by itself.
double edges_px(const Still& body, const PixelRect& frame) {
  constexpr double kFade_px = 3;  // on both sides of the line
  const double most = 2.0 * (frame.width_px + frame.height_px);
  if (const auto* disc = std::get_if<DiscItem>(&body)) {
    const double line = disc->stroke ? disc->stroke->width_px : 0;
    return std::min(6.3 * disc->radius + 4, most) * (line + kFade_px);
  }
  const auto& block = std::get<ExposedBlock>(body);
  return std::min(2 * block.bounds.height, most) * (block.stroke.width_px + kFade_px);
}

/// What the mean is taken of.
struct Moments {
  std::vector<double> times;   ///< shares of the exposure that have passed
  std::vector<double> shares;  ///< for which they stand
};

/// When bodies change their velocity, and both ends of the exposure, in order.
std::vector<double> velocity_changes(Exposures exposures, const PlacedBodies& movers) {
  std::vector<double> changes{0, 1};
  for (const PlacedBody* const mover : movers) {
    each_piece(exposures, mover->body, [&](double begin, double, const BodyPiece&) {
      if (begin > 0 && begin < 1) changes.push_back(begin);
    });
  }
  std::ranges::sort(changes);
  changes.erase(std::unique(changes.begin(), changes.end()), changes.end());
  return changes;
}

/// Splits the time between changes of velocity into equal parts, or the whole exposure if there are
/// more changes than moments. Each part has one moment: in the middle if bodies bounce rarely, else
/// at an irregular offset. A regular one would see the same places in each flight.
/// @param most_pieces  of the motion of one body
Moments moments_for(std::size_t count, std::vector<double> changes, std::size_t most_pieces) {
  constexpr double kGolden = 0.6180339887498949;
  constexpr std::size_t kFewPieces = 16;
  bool is_regular = most_pieces <= kFewPieces;
  if (changes.size() > count) {
    changes = {0, 1};
    is_regular = 4 * most_pieces < count;
  }
  Moments moments;
  for (std::size_t i = 1; i < changes.size(); ++i) {
    const double length = changes[i] - changes[i - 1];
    const double parts = std::ceil(length * double(count));
    for (double part = 0; part < parts; ++part) {
      const double turns = kGolden * double(moments.times.size());
      const double offset = is_regular ? 0.5 : turns - std::floor(turns);
      moments.times.push_back(changes[i - 1] + length * (part + offset) / parts);
      moments.shares.push_back(length / parts);
    }
  }
  return moments;
}

/// Of a body's corner, at each moment.
std::vector<Point> places_of(Exposures exposures, std::size_t body, const Layout& map,
                             const Point& corner, const std::vector<double>& moments) {
  std::vector<Point> places;
  places.reserve(moments.size());
  Point last;
  each_piece(exposures, body, [&](double begin, double end, const BodyPiece& piece) {
    const Point from = map.at(piece.from);
    const Point to = map.at(piece.to);
    for (; places.size() < moments.size() && moments[places.size()] < end;) {
      const double part = std::max(0.0, (moments[places.size()] - begin) / (end - begin));
      places.push_back(on_way(from, to, part) - corner);
    }
    last = to - corner;
  });
  places.resize(moments.size(), last);  // shares add up to 1 but for their rounding
  return places;
}

void add_still(const PlacedBody& placed, std::vector<DrawItem>& items) {
  if (const auto* disc = std::get_if<DiscItem>(&placed.still)) {
    items.emplace_back(*disc);
  } else {
    add_rectangles(placed.id, std::get<ExposedBlock>(placed.still), items);
  }
}

/// From a block's upper left corner to the middle of its lower edge; nothing for a disc.
Point corner_of(const Still& body) {
  if (std::holds_alternative<DiscItem>(body)) return {};
  const Rect& bounds = std::get<ExposedBlock>(body).bounds;
  return {bounds.width / 2, bounds.height};
}

/// The columns that a block is in while the picture is exposed, and a pixel beside them.
Travel columns_of(const ExposedBlock& block, std::size_t body, const Layout& map,
                  Exposures exposures) {
  Travel columns{HUGE_VAL, -HUGE_VAL};
  each_piece(exposures, body, [&](double, double, const BodyPiece& piece) {
    columns.include({map.at(piece.from).x, map.at(piece.to).x});
  });
  const double reach = block.bounds.width / 2 + 1;
  return {columns.from - reach, columns.to + reach};
}

/// The picture of the closed form, turned round in a frame.
void mirror(ExposedBlocksItem& item, double frame_px) {
  const auto turned = [&](double x, const ExposedBlock& block) {
    return frame_px - x - block.bounds.width;
  };
  for (ExposedBlock* block : {&item.behind, &item.front}) {
    for (Dwell& dwell : block->dwells) dwell.x = turned(dwell.x, *block);
    std::ranges::reverse(block->dwells);
  }
  for (TouchingBlocks& contact : item.contacts) {
    contact.behind_x = turned(contact.behind_x, item.behind);
    contact.front_x = turned(contact.front_x, item.front);
  }
  std::ranges::sort(item.contacts, {}, &TouchingBlocks::right_x);
}

void turn_over(ExposedBlocksItem& item) {
  std::swap(item.behind, item.front);
  for (TouchingBlocks& contact : item.contacts) std::swap(contact.behind_x, contact.front_x);
}

ExposedBlocksItem closed_blocks_item(std::span<const PlacedBody> bodies, const Layout& map,
                                     Exposures exposures) {
  const double frame_px = std::ceil(map.visible_right_px);  // on the grid of pixels, mirrored too
  const auto block_of = [&](std::size_t body) {
    return std::get<ExposedBlock>(std::ranges::find(bodies, body, &PlacedBody::body)->still);
  };
  const ClosedExposure& closed = *exposures.front().exposure.closed;
  const bool is_mirrored = closed.sign < 0;
  const AxisPlace axis{is_mirrored ? frame_px - map.origin.x : map.origin.x, map.scale,
                       is_mirrored ? frame_px : map.visible_right_px};
  ExposedBlocksItem item =
      exposed_blocks(block_of(closed.red), block_of(closed.blue), axis, exposures);
  if (is_mirrored) mirror(item, frame_px);
  if (closed.red < closed.blue) turn_over(item);  // the first body is in front
  item.id = kMovingBodies;
  return item;
}

/// Adds the bodies that stay. @return the others, which are painted moment by moment
PlacedBodies add_still_bodies(std::span<const PlacedBody> bodies, const Layout& map,
                              Exposures exposures, std::vector<DrawItem>& items) {
  PlacedBodies moving;
  std::vector<Travel> columns;  // of the blocks among these
  for (const PlacedBody& placed : bodies) {
    bool is_moving = way_of(exposures, placed.body, map) > kStill_px;
    // A block that stays shares pixels with those that touch it, and is painted after some of them.
    if (const auto* const block = std::get_if<ExposedBlock>(&placed.still)) {
      const Travel own = columns_of(*block, placed.body, map, exposures);
      is_moving = is_moving || std::ranges::any_of(columns, [&](const Travel& other) {
                    return own.from < other.to && other.from < own.to;
                  });
      if (is_moving) columns.push_back(own);
    }
    if (is_moving) {
      moving.push_back(&placed);
    } else {
      add_still(placed, items);
    }
  }
  return moving;
}

Moments moments_of(const PlacedBodies& moving, const Layout& map, const PixelRect& frame,
                   Exposures exposures) {
  double longest_px = 0;
  double edges = 0;
  std::size_t most_pieces = 0;
  for (const PlacedBody* const placed : moving) {
    longest_px = std::max(longest_px, way_of(exposures, placed->body, map));
    edges += edges_px(placed->still, frame);
    std::size_t pieces = 0;
    for (const auto& [share, exposure] : exposures) pieces += exposure.pieces[placed->body].size();
    most_pieces = std::max(most_pieces, pieces);
  }
  const double most = std::min(kMostEdges_px / edges, kMostPlaces / double(moving.size()));
  const bool are_discs = std::holds_alternative<DiscItem>(moving.front()->still);
  const double least = are_discs ? kLeastMomentsOfDiscs : kLeastMoments;
  const double count = std::min({least + longest_px, kMostMoments, most});
  return moments_for(static_cast<std::size_t>(std::max(count, kFewMoments)),
                     velocity_changes(exposures, moving), most_pieces);
}

}  // namespace

void add_exposed(std::span<const PlacedBody> bodies, const Layout& map, const PixelRect& frame,
                 Exposures exposures, std::vector<DrawItem>& items) {
  if (!exposures.empty() && exposures.front().exposure.closed) {
    const ClosedExposure& closed = *exposures.front().exposure.closed;
    for (const PlacedBody& placed : bodies) {
      if (!closed.has(placed.body)) add_still(placed, items);
    }
    items.emplace_back(closed_blocks_item(bodies, map, exposures));
    return;
  }
  const PlacedBodies moving = add_still_bodies(bodies, map, exposures, items);
  if (moving.empty()) return;
  Moments moments = moments_of(moving, map, frame, exposures);
  MovingShapesItem item{kMovingBodies, std::move(moments.shares), {}};
  for (const PlacedBody* const placed : moving) {
    item.shapes.push_back({placed->still, places_of(exposures, placed->body, map,
                                                    corner_of(placed->still), moments.times)});
  }
  items.emplace_back(std::move(item));
}

}  // namespace piblocks
