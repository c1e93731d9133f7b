#include "scene/run_tables.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/two_blocks.hpp>

#include <algorithm>
#include <array>
#include <cstring>
#include <optional>

namespace piblocks {
namespace {

using Kind = TableLayout::Kind;
using Use = std::function<void(const TableRows&)>;

constexpr std::size_t kRowsAtOnce = PairBatch::kCapacity;

/// @param shape  of an array, after a comma
void add_type(TableLayout& layout, const std::string& name, const char* type,
              const char* shape = "") {
  layout.npy += fmt::format("{}('{}', '{}'{})", layout.npy.empty() ? "" : ", ", name, type, shape);
}

void add_column(TableLayout& layout, const std::string& name, Kind kind = Kind::number) {
  layout.columns.push_back({name, kind});
  layout.csv += fmt::format("{}<{}>", layout.csv.empty() ? "" : ",", name);
}

/// The same as a column of NumPy.
void add_column(TableLayout& layout, const std::string& name, Kind kind, const char* type) {
  add_column(layout, name, kind);
  add_type(layout, name, type);
}

/// Adds all positions, then all velocities. On a line these are "x_1", … "v_1", …; in a plane they
/// have the coordinates "x_1", "y_1", … "vx_1", "vy_1", ….
void add_motions(TableLayout& layout, const System& system,
                 const std::vector<std::string>& bodies) {
  const bool is_plane = system.dimensions == 2;
  const auto add = [&](const char* vector, const std::vector<const char*>& coordinates) {
    for (const std::string& body : bodies) {
      add_type(layout, fmt::format("{}_{}", vector, body), "<f8", is_plane ? ", (2,)" : "");
      for (const char* const one : coordinates) add_column(layout, fmt::format("{}_{}", one, body));
    }
  };
  is_plane ? add("x", {"x", "y"}) : add("x", {"x"});
  is_plane ? add("v", {"vx", "vy"}) : add("v", {"v"});
}

std::string bound_name(const std::string& body) { return fmt::format("x_{}_bound", body); }

/// The position and the velocity of a body in JSON, with the bound of the position between them.
std::string motion_text(const System& system, const std::string& body, bool has_bound = false) {
  const std::string bound =
      has_bound ? fmt::format(R"(,"position_bound":<{}>)", bound_name(body)) : std::string();
  return system.dimensions == 2
             ? fmt::format(R"({{"position":[<x_{0}>,<y_{0}>]{1},"velocity":[<vx_{0}>,<vy_{0}>]}})",
                           body, bound)
             : fmt::format(R"({{"position":<x_{0}>{1},"velocity":<v_{0}>}})", body, bound);
}

/// A number as NumPy has it.
std::string bytes_of(std::int32_t value) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  return bytes;
}

/// The numbers of the bodies, and the names of the walls.
std::vector<TableLayout::Word> words_of(const System& system) {
  std::vector<TableLayout::Word> words;
  for (std::int32_t body = 1; body <= std::int32_t(system.bodies.size()); ++body) {
    const std::string text = std::to_string(body);
    words.push_back({text, text, bytes_of(body)});
  }
  for (std::int32_t number = -1; const Wall& wall : system.walls) {
    words.push_back({wall.name, '"' + wall.name + '"', bytes_of(number--)});
  }
  return words;
}

/// @param words  columns of words. @param type  of these in NumPy
TableLayout collision_layout(const System& system, const std::vector<std::string>& words,
                             const char* type, const std::vector<std::string>& bodies) {
  TableLayout layout;
  add_column(layout, "index", Kind::index, "<i8");
  add_column(layout, "time", Kind::number, "<f8");
  layout.columns.push_back({"time_low"});  // what a double leaves out of the time; NumPy's alone
  add_type(layout, "time_low", "<f8");
  layout.json = R"({"index":"<index>","time":<time>)";
  for (const std::string& word : words) {
    add_column(layout, word, Kind::word, type);
    layout.json += fmt::format(R"(,"{0}":<{0}>)", word);
  }
  add_motions(layout, system, bodies);
  return layout;
}

void add_blue_and_red(TableLayout& layout, const System& system, bool has_bounds) {
  add_motions(layout, system, {"blue", "red"});
  for (const char* const body : {"blue", "red"}) {
    if (has_bounds) add_column(layout, bound_name(body), Kind::number, "<f8");
  }
  layout.json += fmt::format(R"("blue":{},"red":{})", motion_text(system, "blue", has_bounds),
                             motion_text(system, "red", has_bounds));
}

void add_bodies(TableLayout& layout, const System& system, bool has_bounds) {
  std::vector<std::string> bodies;
  std::vector<std::string> motions;
  for (std::size_t body = 1; body <= system.bodies.size(); ++body) {
    bodies.push_back(std::to_string(body));
    motions.push_back(motion_text(system, bodies.back(), has_bounds));
  }
  const std::string shape = fmt::format(", ({}, {})", bodies.size(), system.dimensions);
  const std::string before = layout.npy;
  add_motions(layout, system, bodies);
  layout.npy = before;  // NumPy has arrays of all bodies
  add_type(layout, "positions", "<f8", shape.c_str());
  add_type(layout, "velocities", "<f8", shape.c_str());
  if (has_bounds) {
    for (const std::string& body : bodies) add_column(layout, bound_name(body));
    add_type(layout, "position_bounds", "<f8", fmt::format(", ({},)", bodies.size()).c_str());
  }
  layout.json += fmt::format(R"("bodies":[{}])", fmt::join(motions, ","));
}

void read_pair(const PairLog& log, const Integer& first, const Integer& last, const Use& use) {
  PairBatch batch{};
  std::array<std::uint32_t, kRowsAtOnce> kinds{};
  TableRows rows;
  rows.columns = {nullptr,
                  batch.time_hi.data(),
                  batch.time_lo.data(),
                  kinds.data(),
                  batch.blue_position.data(),
                  batch.red_position.data(),
                  batch.blue_velocity.data(),
                  batch.red_velocity.data()};
  for (const auto stream = log.stream(first, last); stream->read(batch); use(rows)) {
    rows.first = batch.first;
    rows.size = batch.size;
    std::ranges::transform(batch.kind, kinds.begin(),
                           [](CollisionKind kind) { return std::uint32_t(kind); });
  }
}

void read_bodies(const Log& log, const Integer& first, const Integer& last, const Use& use) {
  const auto axes = std::size_t(log.system().dimensions);
  std::array<std::array<std::uint32_t, kRowsAtOnce>, 2> bodies{};
  std::vector<std::array<double, kRowsAtOnce>> numbers(2 + 4 * axes);
  TableRows rows;
  rows.columns = {nullptr, numbers[0].data(), numbers[1].data(), bodies[0].data(),
                  bodies[1].data()};
  for (std::size_t i = 2; i < numbers.size(); ++i) rows.columns.push_back(numbers[i].data());
  const auto add = [&](const Collision& c) {
    bodies[0].at(rows.size) = c.first;
    bodies[1].at(rows.size) = c.second;
    auto column = numbers.begin();
    const auto put = [&](double number) { (column++)->at(rows.size) = shown(number); };
    put(c.time.hi);
    put(c.time.lo);
    for (const auto* const vector : {&c.first_after.position, &c.second_after.position,
                                     &c.first_after.velocity, &c.second_after.velocity}) {
      std::for_each_n(vector->begin(), axes, put);
    }
  };
  for (Integer index = first; index <= last; use(rows)) {
    rows.first = index;
    for (rows.size = 0; rows.size < kRowsAtOnce && index <= last; ++rows.size) {
      add(log.collision(index++));
    }
  }
}

}  // namespace

Table collision_table(const System& system) {
  using namespace std::string_literals;
  if (has_short_names(system)) {
    TableLayout layout = collision_layout(system, {"kind"}, "|S6", {"blue", "red"});
    for (const char* const name : {"x_blue", "x_red", "v_blue", "v_red"}) {
      layout.json += fmt::format(R"(,"{0}":<{0}>)", name);
    }
    layout.json += '}';
    layout.words = {{"wall", "\"wall\"", "wall\0\0"s},  // in the order of CollisionKind
                    {"blocks", "\"blocks\"", "blocks"}};
    return Table(std::move(layout));
  }
  TableLayout layout = collision_layout(system, {"first", "second"}, "<i4", {"first", "second"});
  layout.json += fmt::format(R"(,"first_after":{},"second_after":{}}})",
                             motion_text(system, "first"), motion_text(system, "second"));
  layout.words = words_of(system);
  return Table(std::move(layout));
}

void read_collisions(const Log& log, const Integer& first, const Integer& last, const Use& use) {
  if (has_short_names(log.system())) return read_pair(*log.pair(), first, last, use);
  read_bodies(log, first, last, use);
}

Table state_table(const System& system, bool has_bounds) {
  TableLayout layout;
  add_column(layout, "time", Kind::number, "<f8");
  add_column(layout, "count", Kind::index, "<i8");
  layout.json = R"({"time":<time>,"collisions":"<count>",)";
  has_short_names(system) ? add_blue_and_red(layout, system, has_bounds)
                          : add_bodies(layout, system, has_bounds);
  layout.json += '}';
  return Table(std::move(layout));
}

StateRow state_row(const Log& log, const Rational& time, bool has_bounds) {
  std::optional<std::vector<double>> bounds;
  if (has_bounds) {
    bounds = log.position_bounds(time);
    if (!bounds) {
      throw UsageError(
          "--bounds: only known of two blocks beside something immovable, and with --engine "
          "unfolded; leave it out");
    }
  }
  const State state = log.state_at(time);
  const auto axes = std::ptrdiff_t{log.system().dimensions};
  StateRow row{state.count, state.is_infinite};
  row.numbers.reserve(3 + 2 * state.bodies.size() * std::size_t(axes));
  row.numbers.push_back(to_double(time));
  for (const auto part : {&Motion::position, &Motion::velocity}) {
    for (const Motion& body : state.bodies) {
      const auto& vector = body.*part;
      row.numbers.insert(row.numbers.end(), vector.begin(), vector.begin() + axes);
    }
  }
  if (bounds) row.numbers.insert(row.numbers.end(), bounds->begin(), bounds->end());
  return row;
}

TableRows StateRow::rows() const {
  TableRows rows{.first = count, .is_infinite = is_infinite, .size = 1};
  rows.columns.reserve(numbers.size() + 1);
  rows.columns = {numbers.data(), nullptr};  // time and count
  for (std::size_t i = 1; i < numbers.size(); ++i) rows.columns.push_back(&numbers[i]);
  return rows;
}

std::string state_text(const Table& states, const StateRow& row) {
  fmt::memory_buffer text;
  states.append(TableFormat::jsonl, row.rows(), text);
  return {text.data(), text.size() - 1};
}

}  // namespace piblocks
