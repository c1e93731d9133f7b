// What is written of a run: the tables of its collisions and of its states.
// In: a log. Out: layouts, and rows. Blue and red have columns of their own; other bodies are
// numbered from 1 in the order of the scene, and walls have names.
#pragma once

#include <piblocks/log.hpp>

#include <functional>
#include <string>
#include <vector>

#include "scene/table.hpp"

namespace piblocks {

/// The table of collisions. In NumPy a wall is -1, -2, … in the order of System::walls.
Table collision_table(const System& system);

/// Calls `use` with rows of that table, some at a time: collisions first … last; none if
/// last < first. @throws as Log::collision()
void read_collisions(const Log& log, const Integer& first, const Integer& last,
                     const std::function<void(const TableRows&)>& use);

/// The table of states; it has no CSV.
/// @param has_bounds  whether it has, of each position, how far it may be from the truth
Table state_table(const System& system, bool has_bounds);

/// A row of the table of states.
struct StateRow {
  Integer count;                     ///< index of the last collision until then
  bool is_infinite = false;          ///< whether it stands for infinitely many
  std::vector<double> numbers = {};  ///< all but the count

  TableRows rows() const;
};

/// The state at a time.
/// @throws UsageError if it is to have bounds that the log does not know; as Log::state_at()
StateRow state_row(const Log& log, const Rational& time, bool has_bounds);

/// The same as a JSON object, in one line without its end.
std::string state_text(const Table& states, const StateRow& row);

}  // namespace piblocks
