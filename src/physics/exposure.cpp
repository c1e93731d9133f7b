#include "physics/exposure.hpp"

#include <algorithm>
#include <utility>

#include "physics/unfolded_log.hpp"

namespace piblocks {
namespace {

/// From collision to collision.
Exposure listed(const CollisionLog& log, const Rational& begin, const Rational& end) {
  const BlockState start = log.state_at(begin);
  const BlockState stop = log.state_at(end);
  PieceList pieces(start.blue.position, start.red.position);
  Time now = to_time(begin);
  const auto go_to = [&](const Time& time, const Motion& blue, const Motion& red) {
    // The times of an event loop can be out of order by their rounding.
    pieces.add(std::max(0.0, (time.hi - now.hi) + (time.lo - now.lo)), blue.position, red.position);
    now = time;
  };
  for (Integer index = start.count + 1; index <= stop.count; ++index) {
    const Collision collision = log.collision(index);
    go_to(collision.time, collision.blue, collision.red);
  }
  go_to(to_time(end), stop.blue, stop.red);
  return pieces.exposure();
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

Exposure PieceList::exposure() {
  double total = 0;
  for (const UniformPiece& piece : pieces_) total += piece.share;
  Exposure exposure{.pieces = take(total)};
  const UniformPiece& first = exposure.pieces.front();
  exposure.blue_range = {first.blue.from, first.blue.from};
  exposure.red_range = {first.red.from, first.red.from};
  for (const UniformPiece& piece : exposure.pieces) {
    exposure.blue_range.include(piece.blue);
    exposure.red_range.include(piece.red);
  }
  return exposure;
}

Exposure expose(const CollisionLog& log, const Rational& begin, const Rational& end) {
  const auto& [first, last] = std::minmax(begin, end);
  const UnfoldedLog* const form = closed_form(log);
  return form != nullptr ? form->expose(first, last) : listed(log, first, last);
}

}  // namespace piblocks
