#include <algorithm>
#include <optional>

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

}  // namespace

BodyExposure expose(const Log& log, const Rational& begin, const Rational& end) {
  if (end < begin) return expose(log, end, begin);
  if (const CollisionLog* const pair = log.pair()) {
    const TwoBlocks& blocks = pair->blocks();
    return {{},
            ClosedExposure{pair->expose(begin, end), blocks.blue_id, blocks.red_id, blocks.side}};
  }
  // What is stepped can be listed: a log has no more than kMaxBodyCollisions.
  constexpr auto kAll = static_cast<std::size_t>(kMaxBodyCollisions);
  BodyExposure exposure;
  for (const std::vector<PathPoint>& path : log.paths(begin, end, kAll)) {
    exposure.pieces.push_back(pieces_of(path));
  }
  return exposure;
}

}  // namespace piblocks
