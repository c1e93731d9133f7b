#include "physics/exposure.hpp"

#include <utility>

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

void Travel::include(const Travel& piece) {
  *this = {std::min({from, piece.from, piece.to}), std::max({to, piece.from, piece.to})};
}

void PieceList::add(double duration, double blue, double red) {
  pieces_.push_back({duration, {blue_, blue}, {red_, red}});
  blue_ = blue;
  red_ = red;
}

std::vector<UniformPiece> PieceList::take(double total) {
  for (UniformPiece& piece : pieces_) {
    // An instant has one piece, of no length.
    piece.share = total > 0 ? piece.share / total : 1.0 / double(pieces_.size());
  }
  return std::move(pieces_);
}

PairExposure PieceList::exposure() {
  double total = 0;
  for (const UniformPiece& piece : pieces_) total += piece.share;
  PairExposure exposure{.pieces = take(total)};
  const UniformPiece& first = exposure.pieces.front();
  exposure.blue_range = {first.blue.from, first.blue.from};
  exposure.red_range = {first.red.from, first.red.from};
  for (const UniformPiece& piece : exposure.pieces) {
    exposure.blue_range.include(piece.blue);
    exposure.red_range.include(piece.red);
  }
  return exposure;
}

PairExposure PairLog::expose(const Rational& from, const Rational& to) const {
  const PairState start = blocks_at(from);
  const PairState stop = blocks_at(to);
  PieceList pieces(start.blue.position, start.red.position);
  Time now = to_time(from);
  const auto go_to = [&](const Time& time, const BlockMotion& blue, const BlockMotion& red) {
    // The times of an event loop can be out of order by their rounding.
    pieces.add(std::max(0.0, (time.hi - now.hi) + (time.lo - now.lo)), blue.position, red.position);
    now = time;
  };
  for (Integer index = start.count + 1; index <= stop.count; ++index) {
    const PairCollision collision = blocks_collision(index);
    go_to(collision.time, collision.blue, collision.red);
  }
  go_to(to_time(to), stop.blue, stop.red);
  return pieces.exposure();
}

Exposure expose(const Log& log, const Rational& begin, const Rational& end) {
  if (end < begin) return expose(log, end, begin);
  const PairLog* const pair = log.pair();
  if (pair && is_elastic(pair->blocks())) {
    const TwoBlocks& blocks = pair->blocks();
    return {{},
            ClosedExposure{pair->expose(begin, end), blocks.blue_id, blocks.red_id, blocks.side}};
  }
  // What is stepped can be listed: a log has no more than kMaxSteppedCollisions. Of two blocks that
  // lose energy more than can be seen are sampled.
  const std::size_t most =
      pair ? 2 * kMaxListedCollisions : static_cast<std::size_t>(kMaxSteppedCollisions);
  Exposure exposure;
  for (const std::vector<PathPoint>& path : log.paths(begin, end, most)) {
    exposure.pieces.push_back(pieces_of(path));
  }
  return exposure;
}

}  // namespace piblocks
