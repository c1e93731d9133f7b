#include "scene/run_tables.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/run.hpp>

#include <algorithm>
#include <array>
#include <cstring>
#include <optional>
#include <utility>

#include "scene/run_log.hpp"

namespace piblocks {
namespace {

using Kind = Column::Kind;

/// The rows of blue and red are where the log has written them.
class PairStream final : public RowStream {
 public:
  explicit PairStream(std::unique_ptr<CollisionStream> stream) : stream_(std::move(stream)) {
    for (const auto* const column :
         {&batch_.time_hi, &batch_.time_lo, &batch_.blue_position, &batch_.red_position,
          &batch_.blue_velocity, &batch_.red_velocity}) {
      rows_.numbers.push_back(column->data());
    }
    rows_.words = {kinds_.data()};
  }

  const TableRows* read() override {
    if (!stream_->read(batch_)) return nullptr;
    rows_.first = batch_.first;
    rows_.size = batch_.size;
    std::ranges::transform(batch_.kind.begin(), batch_.kind.begin() + std::ptrdiff_t(batch_.size),
                           kinds_.begin(), [](CollisionKind kind) { return std::uint32_t(kind); });
    return &rows_;
  }

 private:
  std::unique_ptr<CollisionStream> stream_;
  CollisionBatch batch_{};
  std::array<std::uint32_t, CollisionBatch::kCapacity> kinds_{};
  TableRows rows_;
};

/// The tables of blue and red.
class PairTables final : public RunTables {
 public:
  explicit PairTables(const CollisionLog& log) : RunTables(log), pair_(log) {}

  Table collisions() const override {
    const std::string wall("wall\0\0", 6);
    return Table({{"index", Kind::index},
                  {"time"},
                  {.name = "time_low", .key = ""},
                  {"kind", Kind::word},
                  {"x_blue"},
                  {"x_red"},
                  {"v_blue"},
                  {"v_red"}},
                 {"|S6", {{"wall", "\"wall\"", wall}, {"blocks", "\"blocks\"", "blocks"}}});
  }
  std::unique_ptr<RowStream> read(const Integer& first, const Integer& last) const override {
    return std::make_unique<PairStream>(pair_.stream(first, last));
  }

 private:
  std::vector<Column> state_columns(bool has_bounds) const override {
    std::vector<Column> columns = {{"x_blue", Kind::number, "blue", "position"},
                                   {"x_red", Kind::number, "red", "position"},
                                   {"v_blue", Kind::number, "blue", "velocity"},
                                   {"v_red", Kind::number, "red", "velocity"}};
    if (has_bounds) {
      columns.push_back({"x_blue_bound", Kind::number, "blue", "position_bound"});
      columns.push_back({"x_red_bound", Kind::number, "red", "position_bound"});
    }
    return columns;
  }
  StateRow row_of_state(const Rational& time, const PositionBounds* bounds) const override {
    const BlockState now = pair_.blocks_at(time);
    StateRow row{now.count,
                 false,
                 {now.blue.position, now.red.position, now.blue.velocity, now.red.velocity}};
    if (bounds != nullptr) row.numbers.insert(row.numbers.end(), {bounds->blue, bounds->red});
    return row;
  }

  const CollisionLog& pair_;
};

/// Reads one collision after the other.
class BodyStream final : public RowStream {
 public:
  BodyStream(const Log& log, Integer first, Integer last)
      : log_(log), next_(std::move(first)), last_(std::move(last)) {
    for (Numbers& column : numbers_) rows_.numbers.push_back(column.data());
    rows_.numbers.resize(2 + 4 * std::size_t(log.system().dimensions));
    for (const Places& column : places_) rows_.words.push_back(column.data());
  }

  const TableRows* read() override {
    rows_.first = next_;
    for (rows_.size = 0; rows_.size < kCapacity && next_ <= last_; ++rows_.size, ++next_) {
      add(log_.collision(next_));
    }
    return rows_.size > 0 ? &rows_ : nullptr;
  }

 private:
  static constexpr std::size_t kCapacity = 512;
  using Numbers = std::array<double, kCapacity>;
  using Places = std::array<std::uint32_t, kCapacity>;

  void add(const BodyCollision& c) {
    places_[0].at(rows_.size) = c.first;
    places_[1].at(rows_.size) = c.second;
    auto column = numbers_.begin();
    const auto put = [&](double number) { (column++)->at(rows_.size) = shown(number); };
    put(c.time.hi);
    put(c.time.lo);
    const auto axes = std::size_t(log_.system().dimensions);
    for (const auto* vector : {&c.first_after.position, &c.second_after.position,
                               &c.first_after.velocity, &c.second_after.velocity}) {
      for (std::size_t axis = 0; axis < axes; ++axis) put(vector->at(axis));
    }
  }

  const Log& log_;
  Integer next_;
  Integer last_;
  std::array<Numbers, 10> numbers_{};
  std::array<Places, 2> places_{};
  TableRows rows_;
};

/// A number as NumPy has it.
std::string bytes_of(std::int32_t value) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  return bytes;
}

/// The numbers of the bodies, and the names of the walls.
Words words_of(const BodySystem& system) {
  Words words{"<i4", {}};
  for (std::size_t body = 1; body <= system.bodies.size(); ++body) {
    const std::string text = fmt::format("{}", body);
    words.list.push_back({text, text, bytes_of(std::int32_t(body))});
  }
  for (const Wall& wall : system.walls) {
    const std::int32_t number = -1 - std::int32_t(words.list.size() - system.bodies.size());
    words.list.push_back({wall.name, '"' + wall.name + '"', bytes_of(number)});
  }
  return words;
}

/// The tables of bodies without names.
class BodyTables final : public RunTables {
 public:
  explicit BodyTables(const Log& log) : RunTables(log) {}

  Table collisions() const override {
    return Table({{"index", Kind::index},
                  {"time"},
                  {.name = "time_low", .key = ""},
                  {"first", Kind::word},
                  {"second", Kind::word},
                  vector_of('x', "first"),
                  vector_of('x', "second"),
                  vector_of('v', "first"),
                  vector_of('v', "second")},
                 words_of(log().system()));
  }
  std::unique_ptr<RowStream> read(const Integer& first, const Integer& last) const override {
    return std::make_unique<BodyStream>(log(), first, last);
  }

 private:
  /// "x_first" and, in a plane, its axes "x_first" and "y_first"; "v_first", "vx_first", "vy_first".
  Column vector_of(char what, const std::string& body) const {
    Column column{.name = what + ("_" + body), .key = body + "_after"};
    const bool is_position = what == 'x';
    column.inner_key = is_position ? "position" : "velocity";
    if (log().system().dimensions == 2) {
      column.axes = {(is_position ? "x_" : "vx_") + body, (is_position ? "y_" : "vy_") + body};
    }
    return column;
  }
  std::vector<Column> state_columns(bool has_bounds) const override {
    const BodySystem& system = log().system();
    std::vector<std::string> axes;
    if (system.dimensions == 2) axes = {"x", "y"};
    const std::size_t bodies = system.bodies.size();
    std::vector<Column> columns = {
        {"positions", Kind::number, "bodies", "position", axes, bodies},
        {"velocities", Kind::number, "bodies", "velocity", axes, bodies}};
    if (has_bounds) {
      columns.push_back({"position_bounds", Kind::number, "bodies", "position_bound", {}, bodies});
    }
    return columns;
  }
  StateRow row_of_state(const Rational& time, const PositionBounds* bounds) const override {
    const BodiesState now = log().state_at(time);
    const auto axes = std::size_t(log().system().dimensions);
    StateRow row{now.count};
    for (const auto part : {&BodyMotion::position, &BodyMotion::velocity}) {
      for (const BodyMotion& body : now.bodies) {
        const auto& vector = body.*part;
        row.numbers.insert(row.numbers.end(), vector.begin(), vector.begin() + axes);
      }
    }
    if (bounds == nullptr) return row;
    const std::size_t first = row.numbers.size();
    row.numbers.resize(first + now.bodies.size());
    row.numbers[first + log().pair()->two_blocks().blue] = bounds->blue;
    row.numbers[first + log().pair()->two_blocks().red] = bounds->red;
    return row;
  }
};

}  // namespace

Table RunTables::states(bool has_bounds) const {
  if (has_bounds) require_pair(log_, "--bounds");
  std::vector<Column> columns = {{"time"}, {"count", Kind::index, "collisions"}};
  for (Column& column : state_columns(has_bounds)) columns.push_back(std::move(column));
  return Table(columns);
}

StateRow RunTables::state_at(const Rational& time, bool has_bounds) const {
  std::optional<PositionBounds> bounds;
  if (has_bounds) {
    bounds = log_.pair()->bounds_at(time);
    if (!bounds) {
      throw UsageError(
          "--bounds: engines that step cannot say how exact they are; use --engine unfolded");
    }
  }
  StateRow row = row_of_state(time, bounds ? &*bounds : nullptr);
  row.is_infinite = row.count == infinite_count(log_);
  row.numbers.insert(row.numbers.begin(), to_double(time));
  std::ranges::transform(row.numbers, row.numbers.begin(), shown);
  return row;
}

TableRows StateRow::rows() const {
  TableRows rows{.first = count, .is_infinite = is_infinite, .size = 1};
  for (const double& number : numbers) rows.numbers.push_back(&number);
  return rows;
}

std::unique_ptr<RunTables> tables_of(const Scene& scene, const Log& log) {
  if (has_short_names(scene)) return std::make_unique<PairTables>(*log.pair());
  return std::make_unique<BodyTables>(log);
}

std::string state_text(const Scene& scene, const Log& log, const Rational& time) {
  const std::unique_ptr<RunTables> tables = tables_of(scene, log);
  return tables->states(false).json_line(tables->state_at(time, false).rows());
}

}  // namespace piblocks
