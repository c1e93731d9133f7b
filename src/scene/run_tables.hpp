// What is written of a run: the tables of its collisions and of its states.
// In: a scene and its log. Out: columns, and their rows. Blue and red have columns of their own;
// other bodies are numbered from 1 in the order of the scene.
#pragma once

#include <piblocks/log.hpp>
#include <piblocks/scene.hpp>

#include <memory>
#include <string>
#include <vector>

#include "scene/table.hpp"

namespace piblocks {

struct PositionBounds;

/// Reads rows of a table. Must not outlive what it reads from.
class RowStream {
 public:
  virtual ~RowStream() = default;
  /// The next rows, valid until the next call; nullptr if there are no more. @throws as Log
  virtual const TableRows* read() = 0;
};

/// A row of the table of states.
struct StateRow {
  Integer count;             ///< index of the last collision until then
  bool is_infinite = false;  ///< whether it stands for infinitely many
  std::vector<double> numbers = {};

  TableRows rows() const;
};

/// The tables of a run. Thread-safe, as its log is, which it must not outlive.
class RunTables {
 public:
  virtual ~RunTables() = default;
  RunTables(const RunTables&) = delete;
  RunTables& operator=(const RunTables&) = delete;

  /// The table of collisions. In NumPy a wall is -1, -2, … in the order of BodySystem::walls.
  virtual Table collisions() const = 0;
  /// The rows first … last of it; none if last < first.
  virtual std::unique_ptr<RowStream> read(const Integer& first, const Integer& last) const = 0;

  /// The table of states. @param has_bounds  whether it also has, of each position, how far from
  /// the truth it may be. @throws UsageError if the run can have no bounds.
  Table states(bool has_bounds) const;
  /// A row of states(has_bounds). @throws UsageError if the engine knows no bounds
  StateRow state_at(const Rational& time, bool has_bounds) const;

 protected:
  explicit RunTables(const Log& log) : log_(log) {}
  const Log& log() const { return log_; }

 private:
  virtual std::vector<Column> state_columns(bool has_bounds) const = 0;
  /// Count and numbers, without the time. @param bounds  nullptr if there are to be none
  virtual StateRow row_of_state(const Rational& time, const PositionBounds* bounds) const = 0;

  const Log& log_;
};

/// Which columns there are is decided here, by has_short_names(scene).
std::unique_ptr<RunTables> tables_of(const Scene& scene, const Log& log);

/// The state at a time as a JSON object in one line.
std::string state_text(const Scene& scene, const Log& log, const Rational& time);

}  // namespace piblocks
