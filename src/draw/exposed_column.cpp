#include <algorithm>
#include <array>
#include <cmath>

#include "draw/exposed_blocks.hpp"

namespace piblocks {
namespace {

/// How much of the pixel from `pixel` to `pixel` + 1 is between two places.
double overlap(double pixel, double begin, double end) {
  return std::clamp(std::min(pixel + 1, end) - std::max(pixel, begin), 0.0, 1.0);
}

Cover cover_of(double pixel, double begin, double length, double line_px) {
  return {overlap(pixel, begin, begin + length),
          overlap(pixel, begin + line_px, begin + length - line_px)};
}

/// What a block covers of a pixel.
struct PixelCover {
  const ExposedBlock& block;
  const Cover& column;
  const Cover& row;

  /// A sample after the block's fill, its line and its bars are painted over it, as Cairo does.
  double over(double sample, std::uint8_t Color::*channel) const {
    const double edge = block.stroke.color.*channel;
    const double outer = column.outer * row.outer;
    const double line = outer - column.inner * row.inner;
    const double filled = sample + outer * (block.fill.*channel - sample);
    const double edged = filled + line * (edge - filled);
    return edged + column.outer * row.bars * (edge - edged);
  }
};

}  // namespace

BlockCover::BlockCover(const ExposedBlock& block)
    : block_(block),
      // A shape thinner than its stroke is nothing but stroke.
      line_px_(std::min({block.stroke.width_px, block.bounds.width, block.bounds.height})),
      sums_{0} {
  for (const Dwell& dwell : block.dwells) sums_.push_back(sums_.back() + dwell.share);
}

Cover BlockCover::of_row(int y) const {
  Cover cover = cover_of(y, block_.bounds.y, block_.bounds.height, line_px_);
  // Each bar covers a part of what the ones before left uncovered.
  for (const Bar& bar : block_.bars) {
    cover.bars += (1 - cover.bars) * overlap(y, bar.y, bar.y + bar.height);
  }
  return cover;
}

Cover BlockCover::of_column(double column, double x) const {
  return cover_of(column, x, block_.bounds.width, line_px_);
}

std::size_t BlockCover::first_at(double x) const {
  return static_cast<std::size_t>(std::ranges::lower_bound(block_.dwells, x, {}, &Dwell::x) -
                                  block_.dwells.begin());
}

/// Adds up the dwells in [from, to), all of which cover the column in the same way.
void BlockCover::add_alike(double column, double from, double to) {
  const std::size_t begin = first_at(from);
  const std::size_t end = first_at(to);
  if (begin >= end) return;
  shares_.push_back({of_column(column, block_.dwells[begin].x), sums_[end] - sums_[begin]});
}

void BlockCover::add_each(double column, double from, double to) {
  for (std::size_t i = first_at(from); i < block_.dwells.size() && block_.dwells[i].x < to; ++i) {
    shares_.push_back({of_column(column, block_.dwells[i].x), block_.dwells[i].share});
  }
}

std::span<const BlockCover::Share> BlockCover::shares_of_column(double column) {
  shares_.clear();
  const double width = block_.bounds.width;
  if (block_.dwells.empty()) {
    const Cover still = of_column(column, block_.bounds.x);
    if (still.outer > 0) shares_.push_back({still, 1});
  } else if (line_px_ < 1 || width - 2 * line_px_ < 1) {
    add_each(column, column - width, column + 1);
  } else {
    // The column has, in this order: the block's right edge, only its line, the line's inner edge,
    // only its fill, and the same on the other side.
    add_each(column, column - width, column + 1 - width);
    add_alike(column, column + 1 - width, column - width + line_px_);
    add_each(column, column - width + line_px_, column + 1 - width + line_px_);
    add_alike(column, column + 1 - width + line_px_, column - line_px_);
    add_each(column, column - line_px_, column + 1 - line_px_);
    add_alike(column, column + 1 - line_px_, column);
    add_each(column, column, column + 1);
  }
  return shares_;
}

bool ExposedColumn::enter(int x) {
  x_ = x;
  known_.clear();
  behind_shares_ = behind_.shares_of_column(x);
  front_shares_ = front_.shares_of_column(x);
  const auto at = [&](double place) {
    return std::ranges::lower_bound(item_.contacts, place, {}, &Contact::behind_x);
  };
  contacts_ = {at(x), at(x + 1.0)};
  return !behind_shares_.empty() || !front_shares_.empty();
}

std::uint32_t ExposedColumn::pixel(const RowCover& row, std::uint32_t background) {
  for (const Known& known : known_) {
    if (known.background == background && known.row == row) return known.pixel;
  }
  const auto sample = [&](int shift, std::uint8_t Color::*channel) {
    const double light = light_of(row, background >> shift & 0xFF, channel);
    return static_cast<std::uint32_t>(Light::sample(light)) << shift;
  };
  const std::uint32_t pixel =
      sample(16, &Color::red) | sample(8, &Color::green) | sample(0, &Color::blue);
  known_.push_back({row, background, pixel});
  return pixel;
}

/// Each block changes the light behind it by its share of time. Where both are in one pixel at the
/// same time, these changes do not add up: contacts correct that.
double ExposedColumn::light_of(const RowCover& row, double background,
                               std::uint8_t Color::*channel) const {
  const double plain = light_.of(background);
  double sum = plain;
  const auto add = [&](const ExposedBlock& block, const Cover& of_row,
                       std::span<const BlockCover::Share> shares) {
    for (const auto& [cover, share] : shares) {
      const PixelCover pixel{block, cover, of_row};
      sum += share * (light_.of(pixel.over(background, channel)) - plain);
    }
  };
  add(item_.behind, row.behind, behind_shares_);
  add(item_.front, row.front, front_shares_);
  for (const Contact& contact : contacts_) {
    const Cover behind_column = behind_.of_column(x_, contact.behind_x);
    const Cover front_column = front_.of_column(x_, contact.front_x);
    const PixelCover front{item_.front, front_column, row.front};
    const double only_behind =
        PixelCover{item_.behind, behind_column, row.behind}.over(background, channel);
    const double only_front = front.over(background, channel);
    const double both = front.over(only_behind, channel);
    sum +=
        contact.share * (light_.of(both) - light_.of(only_behind) - light_.of(only_front) + plain);
  }
  return sum;
}

}  // namespace piblocks
