#include <algorithm>
#include <utility>

#include "physics/body_logs.hpp"
#include "physics/exposure.hpp"

namespace piblocks {
namespace {

std::vector<BodyPiece> pieces_of(const std::vector<PathPoint>& path) {
  const double length = path.back().after;
  if (!(length > 0)) return {{0, 1, path.front().position, path.back().position}};
  std::vector<BodyPiece> pieces;
  double begin = 0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    // Rounding may put the times of two collisions in the wrong order.
    const double end = std::clamp(path[i].after / length, begin, 1.0);
    const auto stays = [&](const BodyPiece& piece) {
      return piece.from == path[i].position && piece.to == path[i].position;
    };
    // One that never moves may be met by others very often.
    if (!pieces.empty() && stays(pieces.back()) && path[i - 1].position == path[i].position) {
      pieces.back().end = end;
    } else {
      pieces.push_back({begin, end, path[i - 1].position, path[i].position});
    }
    begin = end;
  }
  return pieces;
}

/// Of one of two blocks, which are together in every piece.
std::vector<BodyPiece> pieces_of(const Exposure& blocks, BlockName block, int sign) {
  std::vector<BodyPiece> pieces;
  double begin = 0;
  for (const UniformPiece& piece : blocks.pieces) {
    const Travel& way = piece.of(block);
    const double end = begin + piece.share;
    pieces.push_back({begin, end, {sign * way.from, 0}, {sign * way.to, 0}});
    begin = end;
  }
  return pieces;
}

/// G of a body, whose positions are those of a block times `sign`.
double area_below(const Exposure& blocks, BlockName block, int sign, double position) {
  if (sign > 0) return blocks.area_below(block, position);
  // The share of time that the mirrored block is below y is that of the block above -y.
  const double last = blocks.range(block).to;
  if (-position >= last) return 0;
  return (last + position) - (blocks.area_below(block, last) - blocks.area_below(block, -position));
}

Travel scaled(const Travel& range, int sign) {
  return sign > 0 ? range : Travel{-range.to, -range.from};
}

/// Where the bodies are two blocks, the closed form sums up what cannot be listed.
void use_closed_form(const CollisionLog& log, const Rational& begin, const Rational& end,
                     BodyExposure& exposure) {
  const TwoBlocks& closed = log.two_blocks();
  Exposure blocks = log.expose(begin, end);
  exposure.pieces[closed.blue] = pieces_of(blocks, BlockName::blue, closed.side);
  exposure.pieces[closed.red] = pieces_of(blocks, BlockName::red, closed.side);
  exposure.ranges[closed.blue] = scaled(blocks.blue_range, closed.side);
  exposure.ranges[closed.red] = scaled(blocks.red_range, closed.side);
  if (!blocks.area_below) return;
  exposure.area_below = [blocks = std::move(blocks), blue = closed.blue, sign = closed.side](
                            std::size_t body, double position) {
    return area_below(blocks, body == blue ? BlockName::blue : BlockName::red, sign, position);
  };
}

Travel range_of(const std::vector<BodyPiece>& pieces) {
  Travel range{pieces.front().from[0], pieces.front().from[0]};
  for (const BodyPiece& piece : pieces) range.include({piece.from[0], piece.to[0]});
  return range;
}

}  // namespace

BodyExposure expose(const Log& log, const Rational& begin, const Rational& end) {
  if (end < begin) return expose(log, end, begin);
  BodyExposure exposure;
  if (const CollisionLog* const closed = log.pair()) {
    // A third body, if there is one, is the wall.
    for (const BodyMotion& at_rest : motions_at_start(log.system())) {
      exposure.pieces.push_back({{0, 1, at_rest.position, at_rest.position}});
      exposure.ranges.push_back(range_of(exposure.pieces.back()));
    }
    use_closed_form(*closed, begin, end, exposure);
    return exposure;
  }
  // What is stepped can be listed: a log has no more than kMaxBodyCollisions.
  constexpr auto kAll = static_cast<std::size_t>(kMaxBodyCollisions);
  for (const std::vector<PathPoint>& path : log.paths(begin, end, kAll)) {
    exposure.pieces.push_back(pieces_of(path));
    exposure.ranges.push_back(range_of(exposure.pieces.back()));
  }
  return exposure;
}

}  // namespace piblocks
