// Who may be near a disc.
// In: discs that fly. Out: for each disc a few others, those that it can touch soon among them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "physics/discs/disc_system.hpp"

namespace piblocks::discs {

enum class Search : std::uint8_t {
  cells,     ///< as fast as possible
  all_pairs  ///< one cell: to compare with
};

/// A grid of square cells, no smaller than a disc. The cells at its edge reach to infinity, so that
/// no disc ever leaves the grid. Two discs in cells that are not next to each other are further
/// apart than the sum of their radii, by margin() at least.
///
/// The few discs that are much larger than the others are not in cells. Such a disc has a zone: the
/// cells in which a small disc may be that touches it while its own centre stays in a square. The
/// large disc is a guest of these cells. Large discs see all large discs.
class Cells {
 public:
  /// @param discs  outlives this object. Their positions are used, and their list pointers.
  Cells(std::vector<Disc>& discs, Search search);

  /// Arranges everything anew around where the discs are at a time.
  void build(double time);
  /// Whether so many discs have left the middle of the grid that another would be faster.
  bool is_outgrown(double time) const;

  /// How much further than contact the neighbourhood reaches; infinite if there is one cell.
  double margin() const { return margin_; }

  /// When a disc leaves its cell or the square of its zone.
  double crossing_time(std::uint32_t disc) const;

  /// Moves a disc to its next cell, or its zone to where it is, and calls visit(other) for all that
  /// may be near now and were not before.
  template <typename Visit>
  void cross(std::uint32_t disc, Visit visit);

  /// Calls visit(other) for each disc that may be near; for some twice, and for the disc itself.
  template <typename Visit>
  void visit_near(std::uint32_t disc, Visit visit) const {
    if (is_large(disc)) {
      for (const std::uint32_t cell : zones_[zone_of_[disc]].cells) visit_cell(cell, visit);
      for (const Zone& zone : zones_) visit(zone.disc);
      return;
    }
    const Place here = places_[disc];
    visit_block({here.column - 1, here.row - 1}, {here.column + 1, here.row + 1}, visit);
    if (guests_.empty()) return;
    for (const std::uint32_t large : guests_[cell_at(here.column, here.row)]) visit(large);
  }

 private:
  struct Place {
    std::int32_t column = 0;
    std::int32_t row = 0;
  };
  struct Zone {
    std::uint32_t disc;
    Vector centre;  ///< of the square, whose half side is side_
    std::vector<std::uint32_t> cells;
  };
  struct Step {
    double time;
    std::int32_t columns;
    std::int32_t rows;
  };

  void choose_large_discs();
  void choose_grid(double time);
  void enter(std::uint32_t disc, Place place);
  void leave(std::uint32_t disc);
  Step next_step(std::uint32_t disc) const;
  double zone_exit(std::uint32_t disc) const;
  double zone_reach(std::uint32_t disc) const;
  void place_zone(Zone& zone, Vector centre);
  void clear_zone(Zone& zone);

  bool is_large(std::uint32_t disc) const { return !zone_of_.empty() && zone_of_[disc] != kNobody; }
  std::size_t cell_at(std::int32_t column, std::int32_t row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }
  Place place_of(Vector position) const;
  template <typename Visit>
  void visit_cell(std::size_t cell, Visit visit) const {
    for (std::uint32_t other = heads_[cell]; other != kNobody;) {
      const std::uint32_t next = discs_[other].next;
      visit(other);
      other = next;
    }
  }
  template <typename Visit>
  void visit_block(Place first, Place last, Visit visit) const {
    const std::int32_t left = std::max(first.column, 0);
    const std::int32_t right = std::min(last.column, columns_ - 1);
    const std::int32_t bottom = std::max(first.row, 0);
    const std::int32_t top = std::min(last.row, rows_ - 1);
    for (std::int32_t row = bottom; row <= top; ++row) {
      for (std::int32_t column = left; column <= right; ++column) {
        visit_cell(cell_at(column, row), visit);
      }
    }
  }

  std::vector<Disc>& discs_;
  Search search_;
  Vector corner_ = {};
  double side_ = kNever;
  double margin_ = kNever;
  double largest_small_radius_ = 0;
  std::int32_t columns_ = 1;
  std::int32_t rows_ = 1;
  std::vector<std::uint32_t> heads_ = {};  ///< of each cell's list
  std::vector<Place> places_ = {};
  std::vector<std::uint32_t> zone_of_ = {};  ///< empty if there are no zones
  std::vector<Zone> zones_ = {};
  std::vector<std::vector<std::uint32_t>> guests_ = {};  ///< of each cell; empty if no zones
};

template <typename Visit>
void Cells::cross(std::uint32_t disc, Visit visit) {
  if (is_large(disc)) {
    Zone& zone = zones_[zone_of_[disc]];
    place_zone(zone, position_at(discs_[disc], zone_exit(disc)));
    visit_near(disc, visit);
    return;
  }
  const Step step = next_step(disc);
  const Place from = places_[disc];
  const Place to = {from.column + step.columns, from.row + step.rows};
  leave(disc);
  enter(disc, to);
  const Place ahead = {to.column + step.columns, to.row + step.rows};
  const std::int32_t beside_columns = step.columns == 0 ? 1 : 0;
  const std::int32_t beside_rows = step.rows == 0 ? 1 : 0;
  visit_block({ahead.column - beside_columns, ahead.row - beside_rows},
              {ahead.column + beside_columns, ahead.row + beside_rows}, visit);
  if (guests_.empty()) return;
  for (const std::uint32_t large : guests_[cell_at(to.column, to.row)]) visit(large);
}

}  // namespace piblocks::discs
