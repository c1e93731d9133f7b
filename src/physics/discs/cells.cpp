#include "physics/discs/cells.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>

namespace piblocks::discs {
namespace {

/// So few discs are faster without a grid.
constexpr std::size_t kFew = 16;
/// A disc is large if its radius is that many times the radius of the sqrt(N)-th largest.
constexpr double kLarge = 3;

/// The side of a cell, in mean distances of discs, where these are not dense.
constexpr double kSpacing = 0.75;
/// Of contact: certainty ends when errors reach a quarter of the margin.
constexpr double kLeastMargin = 0x1p-4;
/// Half the diagonal of a zone's square, in cells, and a bit more.
constexpr double kStray = 1.5;

/// Where most of some numbers are: from the first fiftieth to the last, and a sixteenth more on
/// each side, as far as there are numbers.
struct Extent {
  double low;
  double high;

  explicit Extent(std::vector<double>& numbers) {
    const auto [least, greatest] = std::ranges::minmax(numbers);
    const auto fiftieth = static_cast<std::ptrdiff_t>(numbers.size() / 50);
    std::ranges::nth_element(numbers, numbers.begin() + fiftieth);
    low = numbers[static_cast<std::size_t>(fiftieth)];
    std::ranges::nth_element(numbers, numbers.end() - 1 - fiftieth);
    high = numbers[numbers.size() - 1 - static_cast<std::size_t>(fiftieth)];
    const double more = (high - low) / 16;
    low = std::max(low - more, least);
    high = std::min(high + more, greatest);
  }

  double size() const { return high - low; }
};

/// How far x is from an interval.
double distance_from(double x, double low, double high) {
  return std::max({low - x, x - high, 0.0});
}

double root_of_squares(double x, double y) { return std::sqrt(x * x + y * y); }

}  // namespace

Cells::Cells(std::vector<Disc>& discs, Search search) : discs_(discs), search_(search) {
  if (discs_.size() <= kFew) search_ = Search::all_pairs;
  places_.resize(discs_.size());
  if (search_ == Search::cells) choose_large_discs();
  build(0);
}

void Cells::choose_large_discs() {
  std::vector<double> radii;
  for (const Disc& disc : discs_) radii.push_back(disc.radius);
  std::ranges::sort(radii, std::greater<>());
  const auto most = static_cast<std::size_t>(std::sqrt(static_cast<double>(radii.size())));
  const double limit = kLarge * radii[most];
  largest_small_radius_ = *std::ranges::find_if(radii, [&](double r) { return r <= limit; });
  if (radii.front() <= limit) return;
  zone_of_.assign(discs_.size(), kNobody);
  for (std::uint32_t disc = 0; disc < discs_.size(); ++disc) {
    if (discs_[disc].radius <= limit) continue;
    zone_of_[disc] = static_cast<std::uint32_t>(zones_.size());
    zones_.push_back({disc, {}, {}});
  }
}

void Cells::choose_grid(double time) {
  if (search_ == Search::all_pairs) return;
  std::vector<double> xs;
  std::vector<double> ys;
  double farthest = 0;
  for (const Disc& disc : discs_) {
    const Vector now = position_at(disc, time);
    xs.push_back(now.x);
    ys.push_back(now.y);
    farthest = std::max({farthest, std::abs(now.x), std::abs(now.y)});
  }
  const Extent across(xs);
  const Extent up(ys);
  const auto number = static_cast<double>(discs_.size());
  // The last two keep the number of cells below a few times that of discs, and rounding errors of
  // positions far below a cell.
  const double contact = 2 * largest_small_radius_;
  side_ = std::max({contact * (1 + kLeastMargin),
                    kSpacing * std::sqrt(across.size()) * std::sqrt(up.size() / number),
                    std::max(across.size(), up.size()) / number, farthest * 0x1p-30});
  margin_ = side_ - contact;
  corner_ = {across.low, up.low};
  columns_ = 1 + static_cast<std::int32_t>(across.size() / side_);
  rows_ = 1 + static_cast<std::int32_t>(up.size() / side_);
}

void Cells::build(double time) {
  choose_grid(time);
  heads_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), kNobody);
  if (!zones_.empty()) guests_.assign(heads_.size(), {});
  for (std::uint32_t disc = 0; disc < discs_.size(); ++disc) {
    if (is_large(disc)) continue;
    enter(disc, place_of(position_at(discs_[disc], time)));
  }
  for (Zone& zone : zones_) {
    zone.cells.clear();
    place_zone(zone, position_at(discs_[zone.disc], time));
  }
}

bool Cells::is_outgrown(double time) const {
  if (search_ == Search::all_pairs) return false;
  std::size_t outside = 0;
  const Vector end = {corner_.x + side_ * columns_, corner_.y + side_ * rows_};
  for (const Disc& disc : discs_) {
    const Vector now = position_at(disc, time);
    const bool is_inside =
        now.x >= corner_.x && now.y >= corner_.y && now.x <= end.x && now.y <= end.y;
    if (!is_inside) ++outside;
  }
  return outside > discs_.size() / 4;
}

Cells::Place Cells::place_of(Vector position) const {
  if (columns_ == 1 && rows_ == 1) return {};
  const double column = std::floor((position.x - corner_.x) / side_);
  const double row = std::floor((position.y - corner_.y) / side_);
  return {static_cast<std::int32_t>(std::clamp(column, 0.0, columns_ - 1.0)),
          static_cast<std::int32_t>(std::clamp(row, 0.0, rows_ - 1.0))};
}

void Cells::enter(std::uint32_t disc, Place place) {
  places_[disc] = place;
  std::uint32_t& head = heads_[cell_at(place.column, place.row)];
  discs_[disc].next = head;
  discs_[disc].previous = kNobody;
  if (head != kNobody) discs_[head].previous = disc;
  head = disc;
}

void Cells::leave(std::uint32_t disc) {
  const Disc& leaving = discs_[disc];
  if (leaving.next != kNobody) discs_[leaving.next].previous = leaving.previous;
  if (leaving.previous != kNobody) {
    discs_[leaving.previous].next = leaving.next;
  } else {
    heads_[cell_at(places_[disc].column, places_[disc].row)] = leaving.next;
  }
}

/// The cell beyond the border that is reached first; kNever if there is none. The border between
/// cells is computed the same from both sides.
Cells::Step Cells::next_step(std::uint32_t disc) const {
  const Disc& flying = discs_[disc];
  const Place here = places_[disc];
  const Vector v = flying.velocity;
  Step across{kNever, v.x > 0 ? 1 : -1, 0};
  Step up{kNever, 0, v.y > 0 ? 1 : -1};
  if (v.x > 0 ? here.column + 1 < columns_ : v.x < 0 && here.column > 0) {
    const double border = corner_.x + side_ * (here.column + (v.x > 0 ? 1 : 0));
    across.time = flying.time + (border - flying.position.x) / v.x;
  }
  if (v.y > 0 ? here.row + 1 < rows_ : v.y < 0 && here.row > 0) {
    const double border = corner_.y + side_ * (here.row + (v.y > 0 ? 1 : 0));
    up.time = flying.time + (border - flying.position.y) / v.y;
  }
  return across.time <= up.time ? across : up;
}

/// Beyond the grid a zone consists of cells that reach to infinity and stays the same, so a disc
/// that flies away for ever leaves its last square for nothing.
double Cells::zone_exit(std::uint32_t disc) const {
  const Disc& flying = discs_[disc];
  const Vector centre = zones_[zone_of_[disc]].centre;
  const double reach = zone_reach(disc);
  const auto exit = [&](double position, double velocity, double middle, double low, double high) {
    if (velocity == 0) return kNever;
    if (velocity > 0 ? middle > high + reach : middle < low - reach) return kNever;
    const double border = middle + (velocity > 0 ? side_ : -side_);
    return flying.time + (border - position) / velocity;
  };
  const Vector end = {corner_.x + side_ * columns_, corner_.y + side_ * rows_};
  return std::min(exit(flying.position.x, flying.velocity.x, centre.x, corner_.x, end.x),
                  exit(flying.position.y, flying.velocity.y, centre.y, corner_.y, end.y));
}

double Cells::crossing_time(std::uint32_t disc) const {
  return is_large(disc) ? zone_exit(disc) : next_step(disc).time;
}

/// How far from the middle of a large disc's square the centre of a small one is that matters.
double Cells::zone_reach(std::uint32_t disc) const {
  return discs_[disc].radius + largest_small_radius_ + margin_ + kStray * side_;
}

void Cells::clear_zone(Zone& zone) {
  for (const std::uint32_t cell : zone.cells) std::erase(guests_[cell], zone.disc);
  zone.cells.clear();
}

/// Small discs cannot be inside a large one, so neither can cells of the zone.
void Cells::place_zone(Zone& zone, Vector centre) {
  clear_zone(zone);
  zone.centre = centre;
  const double radius = discs_[zone.disc].radius;
  const double stray = kStray * side_;
  const double reach = zone_reach(zone.disc);
  const Place first = place_of(centre - Vector{reach, reach});
  const Place last = place_of(centre + Vector{reach, reach});
  for (std::int32_t row = first.row; row <= last.row; ++row) {
    const double bottom = row == 0 ? -kNever : corner_.y + side_ * row;
    const double top = row == rows_ - 1 ? kNever : corner_.y + side_ * (row + 1);
    const double dy = distance_from(centre.y, bottom, top);
    const double far_y = std::max(centre.y - bottom, top - centre.y);
    for (std::int32_t column = first.column; column <= last.column; ++column) {
      const double left = column == 0 ? -kNever : corner_.x + side_ * column;
      const double right = column == columns_ - 1 ? kNever : corner_.x + side_ * (column + 1);
      const double dx = distance_from(centre.x, left, right);
      const double far_x = std::max(centre.x - left, right - centre.x);
      if (root_of_squares(dx, dy) > reach) continue;
      if (root_of_squares(far_x, far_y) < radius - stray) continue;
      const std::size_t cell = cell_at(column, row);
      zone.cells.push_back(static_cast<std::uint32_t>(cell));
      guests_[cell].push_back(zone.disc);
    }
  }
}

}  // namespace piblocks::discs
