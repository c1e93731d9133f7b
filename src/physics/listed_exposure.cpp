#include "physics/listed_exposure.hpp"

#include <algorithm>
#include <utility>

namespace piblocks {

double share_below(const Travel& travel, double position) {
  const auto [low, high] = std::minmax({travel.from, travel.to});
  if (position >= high) return 1;
  if (position < low) return 0;
  return (position - low) / (high - low);
}

double area_below(const Travel& travel, double position) {
  const auto [low, high] = std::minmax({travel.from, travel.to});
  if (position >= high) return (position - low) / 2 + (position - high) / 2;
  if (position <= low) return 0;
  return (position - low) * ((position - low) / (high - low)) / 2;
}

void include(Travel& range, const Travel& piece) {
  range.from = std::min({range.from, piece.from, piece.to});
  range.to = std::max({range.to, piece.from, piece.to});
}

void PieceList::add(double duration, double blue, double red) {
  pieces_.push_back({duration, {blue_, blue}, {red_, red}});
  blue_ = blue;
  red_ = red;
}

ListedExposure::ListedExposure(std::vector<UniformPiece> pieces) : pieces_(std::move(pieces)) {
  double total = 0;
  for (const UniformPiece& piece : pieces_) total += piece.share;
  blue_range_ = {pieces_.front().blue.from, pieces_.front().blue.from};
  red_range_ = {pieces_.front().red.from, pieces_.front().red.from};
  for (UniformPiece& piece : pieces_) {
    // An instant has one piece, of no length.
    piece.share = total > 0 ? piece.share / total : 1.0 / double(pieces_.size());
    include(blue_range_, piece.blue);
    include(red_range_, piece.red);
  }
}

Travel ListedExposure::range(BlockName block) const {
  return block == BlockName::blue ? blue_range_ : red_range_;
}

double ListedExposure::share_below(BlockName block, double position) const {
  if (position >= range(block).to) return 1;
  double sum = 0;
  for (const UniformPiece& piece : pieces_) {
    sum += piece.share * piblocks::share_below(piece.of(block), position);
  }
  return std::min(sum, 1.0);
}

double ListedExposure::area_below(BlockName block, double position) const {
  double sum = 0;
  for (const UniformPiece& piece : pieces_) {
    sum += piece.share * piblocks::area_below(piece.of(block), position);
  }
  return sum;
}

}  // namespace piblocks
