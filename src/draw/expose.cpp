#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "draw/stage/stage.hpp"

namespace piblocks {
namespace {

/// Blocks beyond the frame's edge by more than this are not seen.
constexpr double kMargin_px = 4;

constexpr double kMaxDwells = 1 << 15;

/// Distance from one dwell to the next, between which a pixel's light is taken to change evenly.
/// The error falls with its square, and matters less if the block is in each pixel for less time.
double spacing_px(double range_px) {
  const double fine = range_px <= 64 ? 1.0 / 32 : range_px <= 512 ? 1.0 / 16 : 1.0 / 4;
  return std::max(fine, range_px / kMaxDwells);
}

/// The map from the position of a block's centre to the column of its left edge.
struct ToPixels {
  double zero_px;
  double scale;
  double block_px;          ///< width of the block
  double visible_right_px;  ///< blocks are seen up to here

  ToPixels(const AxisPlace& axis, const ExposedBlock& block)
      : zero_px(axis.origin_px - block.bounds.width / 2),
        scale(axis.scale),
        block_px(block.bounds.width),
        visible_right_px(axis.visible_right_px) {}
  double operator()(double position) const { return zero_px + position * scale; }
  Travel operator()(const Travel& path) const { return {(*this)(path.from), (*this)(path.to)}; }
  double back(double x_px) const { return (x_px - zero_px) / scale; }
};

/// Shares of time by place: the second differences of the integral of F, the share of time below a
/// place. With them, what changes evenly from place to place has its exact mean.
class DwellTable {
 public:
  DwellTable(const Travel& range_px, double spacing)
      : spacing_(spacing), first_(std::floor(range_px.from / spacing) - 1) {
    const double last = std::ceil(range_px.to / spacing) + 1;
    shares_.assign(static_cast<std::size_t>(last - first_) + 1, 0);
  }

  /// @param area  the integral of F up to a place; 0 below the range, rising by 1 a pixel above.
  template <typename Area>
  void add(double share, const Travel& range, const Area& area) {
    const std::size_t begin = index(std::floor(range.from / spacing_));
    const std::size_t end = index(std::ceil(range.to / spacing_)) + 1;
    double before = area(place(begin - 1));
    double here = area(place(begin));
    for (std::size_t i = begin; i < end; ++i) {
      const double after = area(place(i + 1));
      shares_[i] += share * ((after - here) - (here - before)) / spacing_;
      before = here;
      here = after;
    }
  }

  std::vector<Dwell> dwells() {
    std::vector<Dwell> dwells;
    for (std::size_t i = 0; i < shares_.size(); ++i) {
      // Less is what rounding leaves of equal areas.
      if (shares_[i] > 1e-12) dwells.push_back({place(i), shares_[i]});
    }
    return dwells;
  }

 private:
  double place(std::size_t i) const { return (first_ + double(i)) * spacing_; }
  std::size_t index(double place) const {
    return static_cast<std::size_t>(std::clamp(place - first_, 1.0, double(shares_.size() - 2)));
  }

  double spacing_;
  double first_;
  std::vector<double> shares_;
};

const PairExposure& blocks_of(const WeightedExposure& weighted) {
  return weighted.exposure.closed->blocks;
}

std::vector<Dwell> dwells_of(BlockName block, const ToPixels& to_px,
                             std::span<const WeightedExposure> exposures) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Travel range{kInfinity, -kInfinity};  // of the block's left edge
  for (const WeightedExposure& weighted : exposures) {
    range.include(to_px(blocks_of(weighted).range(block)));
  }
  if (!(range.to - range.from > kStill_px)) return {};
  range.from = std::max(range.from, -to_px.block_px - kMargin_px);
  range.to = std::min(range.to, to_px.visible_right_px + kMargin_px);
  if (!(range.to > range.from)) return {};
  DwellTable table(range, spacing_px(range.to - range.from));
  for (const WeightedExposure& weighted : exposures) {
    const double weight = weighted.share;
    const PairExposure& exposure = blocks_of(weighted);
    if (const auto& area_below = exposure.area_below) {
      table.add(weight, to_px(exposure.range(block)),
                [&](double x) { return area_below(block, to_px.back(x)) * to_px.scale; });
      continue;
    }
    for (const UniformPiece& piece : exposure.pieces) {
      const Travel path = to_px(piece.of(block));
      const Travel rising{std::min(path.from, path.to), std::max(path.from, path.to)};
      table.add(weight * piece.share, rising, [&](double x) { return rising.area_below(x); });
    }
  }
  return table.dwells();
}

/// Adds contacts where two blocks, which both pass evenly, are less than a pixel apart.
/// @param right, left  ways of their left edges @param share  of the exposure
void add_contacts(const Travel& right, const Travel& left, double left_width, double share,
                  std::vector<TouchingBlocks>& contacts) {
  constexpr double kPerPixel = 32;
  constexpr double kMost = 4096;
  const Travel gap{right.from - left.from - left_width, right.to - left.to - left_width};
  double begin = 0;
  double end = 1;
  if (gap.from >= 1 && gap.to >= 1) return;
  if (gap.from > 1) begin = (gap.from - 1) / (gap.from - gap.to);
  if (gap.to > 1) end = (gap.from - 1) / (gap.from - gap.to);
  const double way_px =
      std::max(std::fabs(right.to - right.from), std::fabs(left.to - left.from)) * (end - begin);
  if (!std::isfinite(way_px)) return;  // far outside of any frame
  const int count = static_cast<int>(std::clamp(std::ceil(way_px * kPerPixel), 1.0, kMost));
  for (int i = 0; i < count; ++i) {
    const double at = begin + (end - begin) * (i + 0.5) / count;
    const TouchingBlocks contact{right.from + (right.to - right.from) * at,
                                 left.from + (left.to - left.from) * at,
                                 share * (end - begin) / count};
    // Only if both reach into one pixel.
    if (contact.front_x + left_width > std::floor(contact.behind_x)) contacts.push_back(contact);
  }
}

}  // namespace

ExposedBlocksItem exposed_blocks(ExposedBlock red, ExposedBlock blue, const AxisPlace& axis,
                                 std::span<const WeightedExposure> exposures) {
  const ToPixels red_px(axis, red);
  const ToPixels blue_px(axis, blue);
  red.dwells = dwells_of(BlockName::red, red_px, exposures);
  blue.dwells = dwells_of(BlockName::blue, blue_px, exposures);
  const double blue_width = blue.bounds.width;
  ExposedBlocksItem item{ItemId::red_block, std::move(red), std::move(blue), {}};
  if (item.behind.is_still() && item.front.is_still()) return item;
  for (const WeightedExposure& weighted : exposures) {
    for (const UniformPiece& piece : blocks_of(weighted).pieces) {
      add_contacts(red_px(piece.red), blue_px(piece.blue), blue_width, weighted.share * piece.share,
                   item.contacts);
    }
  }
  std::ranges::sort(item.contacts, {}, &TouchingBlocks::right_x);
  return item;
}

void add_rectangles(ItemId id, const ExposedBlock& block, std::vector<DrawItem>& items) {
  items.emplace_back(RectangleItem{id, block.bounds, block.fill, block.stroke, block.corner_px});
  for (std::size_t i = 0; i < block.bars.size(); ++i) {
    const Bar& bar = block.bars[i];
    items.emplace_back(RectangleItem{nth(id, i + 1),
                                     {block.bounds.x, bar.y, block.bounds.width, bar.height},
                                     block.stroke.color});
  }
}

}  // namespace piblocks
