#include "draw/exposed_column.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace piblocks {
namespace {

double overlap(double pixel, double begin, double end) {
  return std::clamp(std::min(pixel + 1, end) - std::max(pixel, begin), 0.0, 1.0);
}

/// A block's fill and its line, painted over a sample one after the other as Cairo does.
double painted(double sample, const ExposedBlock& block, const Cover& column, const Cover& row,
               std::uint8_t Color::*channel) {
  const double outer = column.outer * row.outer;
  const double line = outer - column.inner * row.inner;
  const double filled = sample + outer * (block.fill.*channel - sample);
  const double edged = filled + line * (block.stroke.color.*channel - filled);
  return edged + column.outer * row.bars * (block.stroke.color.*channel - edged);
}

}  // namespace

Cover cover_of(double pixel, double begin, double length, double line_px) {
  return {overlap(pixel, begin, begin + length),
          overlap(pixel, begin + line_px, begin + length - line_px)};
}

Cover row_cover_of(int row, const ExposedBlock& block, double line_px) {
  Cover cover = cover_of(row, block.bounds.y, block.bounds.height, line_px);
  // One after the other.
  for (const Bar& bar : block.bars) {
    cover.bars += (1 - cover.bars) * overlap(row, bar.y, bar.y + bar.height);
  }
  return cover;
}

BlockTimes::BlockTimes(const ExposedBlock& block)
    : block_(block),
      // A shape thinner than its stroke is all stroke.
      line_px_(std::min({block.stroke.width_px, block.bounds.width, block.bounds.height})),
      first_x_(block.dwells.empty() ? block.bounds.x : block.dwells.front().x) {
  sums_.reserve(block.dwells.size() + 1);
  sums_.push_back(0);
  for (const Dwell& stop : block.dwells) sums_.push_back(sums_.back() + stop.share);
}

std::size_t BlockTimes::first_at(double x) const {
  return static_cast<std::size_t>(std::ranges::lower_bound(block_.dwells, x, {}, &Dwell::x) -
                                  block_.dwells.begin());
}

/// Stops in [from, to), all of which cover the pixel in the same way.
void BlockTimes::add_alike(double pixel, double from, double to,
                           std::vector<Covered>& covered) const {
  const std::size_t begin = first_at(from);
  const std::size_t end = first_at(to);
  if (begin >= end) return;
  covered.push_back({cover(pixel, block_.dwells[begin].x), sums_[end] - sums_[begin]});
}

void BlockTimes::add_each(double pixel, double from, double to,
                          std::vector<Covered>& covered) const {
  for (std::size_t i = first_at(from); i < block_.dwells.size() && block_.dwells[i].x < to; ++i) {
    covered.push_back({cover(pixel, block_.dwells[i].x), block_.dwells[i].share});
  }
}

void BlockTimes::cover_column(double pixel, std::vector<Covered>& covered) const {
  covered.clear();
  const double width = block_.bounds.width;
  if (!moves()) {
    const Cover still = cover(pixel, first_x_);
    if (still.outer > 0) covered.push_back({still, 1});
    return;
  }
  if (line_px_ < 1 || width - 2 * line_px_ < 1) {
    add_each(pixel, pixel - width, pixel + 1, covered);
    return;
  }
  // From the left: the right edge in the pixel, only the line, the line's inner edge, only the
  // fill, and the same on the other side.
  add_each(pixel, pixel - width, pixel + 1 - width, covered);
  add_alike(pixel, pixel + 1 - width, pixel - width + line_px_, covered);
  add_each(pixel, pixel - width + line_px_, pixel + 1 - width + line_px_, covered);
  add_alike(pixel, pixel + 1 - width + line_px_, pixel - line_px_, covered);
  add_each(pixel, pixel - line_px_, pixel + 1 - line_px_, covered);
  add_alike(pixel, pixel + 1 - line_px_, pixel, covered);
  add_each(pixel, pixel, pixel + 1, covered);
}

ExposedColumn::ExposedColumn(const ExposedItem& item, const Light& light)
    : item_(item), light_(light), behind_(item.behind), front_(item.front) {}

void ExposedColumn::enter(int pixel) {
  pixel_ = pixel;
  known_.clear();
  behind_.cover_column(pixel, behind_covers_);
  front_.cover_column(pixel, front_covers_);
  const auto at = [&](double x) {
    return std::ranges::lower_bound(item_.contacts, x, {}, &Contact::behind_x);
  };
  contacts_ = {at(pixel), at(pixel + 1.0)};
}

std::uint32_t ExposedColumn::pixel(const RowCover& row, std::uint32_t background) {
  for (const Known& known : known_) {
    if (known.background == background && known.row == row) return known.result;
  }
  const std::uint32_t result = compute(row, background);
  known_.push_back({row, background, result});
  return result;
}

std::uint32_t ExposedColumn::compute(const RowCover& row, std::uint32_t background) const {
  constexpr std::array kChannels = {&Color::red, &Color::green, &Color::blue};
  std::uint32_t word = 0;
  for (const auto channel : kChannels) {
    const int shift = channel == &Color::red ? 16 : channel == &Color::green ? 8 : 0;
    const double light = light_of(row, background >> shift & 0xFF, channel);
    word |= static_cast<std::uint32_t>(Light::sample(light)) << shift;
  }
  return word;
}

/// What each block takes from the light behind it, and, since that is not additive where both are
/// in one pixel at the same time, how much more or less both take together.
double ExposedColumn::light_of(const RowCover& row, double background,
                               std::uint8_t Color::*channel) const {
  const ExposedBlock& behind = item_.behind;
  const ExposedBlock& front = item_.front;
  const double plain = light_.of(background);
  double sum = plain;
  for (const auto& [cover, share] : behind_covers_) {
    sum += share * (light_.of(painted(background, behind, cover, row.behind, channel)) - plain);
  }
  for (const auto& [cover, share] : front_covers_) {
    sum += share * (light_.of(painted(background, front, cover, row.front, channel)) - plain);
  }
  for (const Contact& contact : contacts_) {
    const Cover back = behind_.cover(pixel_, contact.behind_x);
    const Cover fore = front_.cover(pixel_, contact.front_x);
    const double only_behind = painted(background, behind, back, row.behind, channel);
    const double only_front = painted(background, front, fore, row.front, channel);
    const double both = painted(only_behind, front, fore, row.front, channel);
    sum +=
        contact.share * (light_.of(both) - light_.of(only_behind) - light_.of(only_front) + plain);
  }
  return sum;
}

}  // namespace piblocks
