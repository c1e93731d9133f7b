#include "scene/body_keys.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <charconv>
#include <functional>
#include <utility>

#include "core/nearest_name.hpp"

namespace piblocks {
namespace {

/// A body as it is read: what it has, besides its values.
struct ReadBody {
  Body body;
  BodyStyle style;
  bool is_block = false;
  bool is_disc = false;
  bool has_position = false;
  bool is_plane = false;  ///< some vector has two coordinates
};

ExactVector parse_vector(const Values& values, ReadBody& body) {
  if (values.size() == 2) {
    body.is_plane = true;
    return {parse_rational(values[0]), parse_rational(values[1])};
  }
  if (values.size() != 1) throw UsageError("must be a number, or two as [x, y]");
  return {parse_rational(values[0]), 0};
}

std::string parse_label(const std::string& text) {
  SceneProblems problems;
  check_line("label", text, problems);
  if (!problems.empty()) throw UsageError(problems.take().front().reason);
  return text;
}

std::optional<Rational> parse_end(const std::string& text, const char* none) {
  if (text == none || (text == "+inf" && none == std::string_view("inf"))) return std::nullopt;
  return parse_rational(text);
}

template <typename Read>
struct TableKey {
  const char* name;
  void (*set)(Read& read, const Values& values);
};

constexpr auto kBodyKeys = std::to_array<TableKey<ReadBody>>({
    {"mass", [](ReadBody& body,
                const Values& values) { body.body.mass = parse_end(single(values), "inf"); }},
    {"position",
     [](ReadBody& body, const Values& values) { body.body.position = parse_vector(values, body); }},
    {"velocity",
     [](ReadBody& body, const Values& values) { body.body.velocity = parse_vector(values, body); }},
    {"restitution",
     [](ReadBody& body, const Values& values) {
       body.body.restitution = parse_restitution(values);
     }},
    {"width",
     [](ReadBody& body, const Values& values) {
       body.body.size = parse_rational(single(values));
       body.is_block = true;
     }},
    {"radius",
     [](ReadBody& body, const Values& values) {
       body.body.size = parse_rational(single(values));
       body.is_disc = true;
     }},
    {"color",
     [](ReadBody& body, const Values& values) { body.style.color = parse_color(single(values)); }},
    {"label",
     [](ReadBody& body, const Values& values) { body.style.label = parse_label(single(values)); }},
    {"path", [](ReadBody& body, const Values& values) { body.style.path = parse_bool(values); }},
});

ExactVector parse_pair(const Values& values) {
  if (values.size() != 2) throw UsageError("must be two numbers, as [0, 1]");
  return {parse_rational(values[0]), parse_rational(values[1])};
}

/// Reads "[a, b]", in which "inf" and "-inf" stand for no wall. @throws UsageError
BoxSide parse_box_side(const Values& values) {
  if (values.size() != 2) throw UsageError("must be two numbers, as [0, 10]; \"inf\" is no wall");
  BoxSide side{parse_end(values[0], "-inf"), parse_end(values[1], "inf")};
  if (side.low && side.high && *side.low >= *side.high) {
    throw UsageError("must go from the lower to the higher end");
  }
  return side;
}

constexpr auto kWallKeys = std::to_array<TableKey<Wall>>({
    {"point", [](Wall& wall, const Values& values) { wall.point = parse_pair(values); }},
    {"normal", [](Wall& wall, const Values& values) { wall.normal = parse_pair(values); }},
    {"velocity", [](Wall& wall, const Values& values) { wall.velocity = parse_pair(values); }},
    {"restitution",
     [](Wall& wall, const Values& values) { wall.restitution = parse_restitution(values); }},
});

std::vector<std::string> names_of(const auto& keys) {
  std::vector<std::string> names;
  names.reserve(keys.size());
  for (const auto& key : keys) names.emplace_back(key.name);
  return names;
}

/// Adds the walls of a box across an axis, 0 for x, 1 for y.
void add_walls(const BoxSide& side, const std::array<Rational, 2>& velocity, std::size_t axis,
               std::vector<Wall>& walls) {
  constexpr std::array<std::array<const char*, 2>, 2> kNames = {
      {{"left", "right"}, {"lower", "upper"}}};
  const std::array ends = {side.low, side.high};
  for (const std::size_t end : {0U, 1U}) {
    if (!ends.at(end)) continue;
    Wall wall{kNames.at(axis).at(end), {}, {}};
    wall.point.at(axis) = *ends.at(end);
    wall.normal.at(axis) = end == 0 ? 1 : -1;
    wall.velocity.at(axis) = velocity.at(end);
    walls.push_back(std::move(wall));
  }
}

std::string text_of(const ExactVector& vector) {
  return fmt::format("[{}, {}]", vector[0].get_str(), vector[1].get_str());
}

std::string restitution_text(const std::optional<Rational>& restitution) {
  return restitution ? ", restitution " + restitution->get_str() : "";
}

/// The body that a table describes. @param add  takes line and property of what is wrong
ReadBody read_properties(
    const TomlTable& table,
    const std::function<void(std::size_t line, const std::string& property, Problem)>& add) {
  ReadBody read;
  for (const TomlEntry& entry : table.entries) {
    if (entry.key.starts_with("position")) read.has_position = true;  // perhaps one with a problem
    const auto add_unread = [&](const std::string& reason) {
      add(entry.line, entry.key, {.reason = ": " + reason, .means_nothing = true});
    };
    const auto* const key =
        std::ranges::find(kBodyKeys, std::string_view(entry.key), &TableKey<ReadBody>::name);
    if (key == kBodyKeys.end()) {
      add_unread("unknown key" + did_you_mean(entry.key, names_of(kBodyKeys)));
    } else if (!entry.problem.empty()) {
      add_unread(entry.problem);
    } else {
      try {
        key->set(read, entry.values);
      } catch (const UsageError& error) {
        add(entry.line, entry.key, problem_of_text("", entry.values, error));
      }
    }
  }
  return read;
}

/// Where bodies begin and end at time 0, and where walls across the axis are at both times.
std::vector<Rational> seen_places(const System& system, std::size_t axis, const Rational& end) {
  std::vector<Rational> places;
  for (const Body& body : system.bodies) {
    const Rational reach = system.dimensions == 1 ? Rational(body.size / 2) : body.size;
    places.emplace_back(body.position.at(axis) - reach);
    places.emplace_back(body.position.at(axis) + reach);
  }
  for (const Wall& wall : system.walls) {
    // Nothing tells where a slanted wall ends.
    if (wall.normal.at(axis) == 0 || wall.normal.at(1 - axis) != 0) continue;
    places.push_back(wall.point.at(axis));
    places.emplace_back(wall.point.at(axis) + wall.velocity.at(axis) * end);
  }
  return places;
}

}  // namespace

Rational parse_restitution(const Values& values) {
  Rational share = parse_rational(single(values));
  if (share < 0 || share > 1) {
    throw UsageError("must be from 0 (no rebound) to 1 (elastic)");
  }
  return share;
}

void BodyDraft::read(const std::string& path, std::vector<TomlTable> tables,
                     ProblemLines& problems) {
  path_ = path;
  tables_.clear();
  removed_.clear();
  origins_.clear();
  if (tables.size() > kMaxBodies) {
    return problems.add(path, tables[kMaxBodies].line,
                        {.reason = fmt::format("there must be at most {} of them", kMaxBodies)});
  }
  tables_ = std::move(tables);
  for (const std::string& key : left_out_) {
    const std::size_t number = number_in(key, "body ");
    if (number > tables_.size()) continue;
    const std::size_t dot = key.find('.');
    if (dot == std::string::npos) {
      removed_.insert(number);
    } else {
      erase_property(number, key.substr(dot + 1));
    }
  }
}

void BodyDraft::erase_property(std::size_t number, const std::string& property) {
  std::erase_if(tables_[number - 1].entries,
                [&](const TomlEntry& entry) { return entry.key == property; });
}

void BodyDraft::set(const std::string& origin, const std::string& key, const Values& values) {
  const std::size_t number = number_in(key, "body ");
  const std::size_t dot = key.find('.');
  if (dot == std::string::npos) throw UsageError("must be a property, as body 2.mass");
  if (tables_.empty()) throw UsageError("there is no [[body]]");
  if (number > tables_.size() + 1) {
    throw UsageError(fmt::format("there are {} bodies; the next one is body {}", tables_.size(),
                                 tables_.size() + 1));
  }
  if (number > tables_.size()) tables_.emplace_back();
  const std::string property = key.substr(dot + 1);
  erase_property(number, property);
  tables_[number - 1].entries.push_back({property, values, {}, 0, {}});
  origins_[key] = origin;
}

bool BodyDraft::set_box(const std::string& key, const Values& values) {
  const std::size_t axis = key.starts_with("box.x") ? 0 : 1;
  if (key == "box.x" || key == "box.y") {
    sides_.at(axis) = parse_box_side(values);
  } else if (key == "box.x-velocity" || key == "box.y-velocity") {
    velocities_.at(axis) = parse_pair(values);
  } else {
    return false;
  }
  return true;
}

void BodyDraft::put_bodies_into(Scene& scene, ProblemLines& problems) const {
  scene.system.bodies.clear();
  scene.styles.clear();
  for (std::size_t number = 1; number <= tables_.size(); ++number) {
    if (!removed_.contains(number)) {
      put_body_into(scene, number, problems);
    } else if (number == tables_.size() && scene.styles.empty()) {
      problems.add(path_,
                   {fmt::format("body {}", number), ": cannot be removed: a scene needs a body"});
      put_body_into(scene, number, problems);
    }
  }
}

void BodyDraft::put_body_into(Scene& scene, std::size_t number, ProblemLines& problems) const {
  const TomlTable& table = tables_[number - 1];
  const std::string name = fmt::format("body {}", number);
  const auto add = [&](std::size_t line, const std::string& property, Problem problem) {
    problem.key = name + (property.empty() ? "" : '.' + property);
    const auto origin = origins_.find(problem.key);
    if (origin != origins_.end()) return problems.add(origin->second, std::move(problem));
    if (line == 0) return problems.add(name, std::move(problem));  // of a body that was added
    problems.add(path_, line, std::move(problem));
  };
  const auto problem = [&](const std::string& text) { add(table.line, "", {.reason = text}); };
  ReadBody read = read_properties(table, add);
  if (!read.has_position) add(table.line, "position", {.reason = ": is missing"});
  if (read.is_block && read.is_disc) {
    problem(": has a width and a radius; blocks have widths, discs have radii");
  }
  if (read.is_block && read.is_plane) {
    problem(
        ": is a block, and blocks move along x alone; give one number for "
        "position and velocity, or a radius instead of the width");
  }
  std::vector<Body>& bodies = scene.system.bodies;
  const int dimensions = read.is_disc || read.is_plane ? 2 : 1;
  if (bodies.empty()) {
    scene.system.dimensions = dimensions;
  } else if (scene.system.dimensions != dimensions) {
    const auto kind_of = [](int count) { return count == 1 ? "block" : "disc"; };
    problem(fmt::format(": is a {}, and {} is a {}; all must be of one kind", kind_of(dimensions),
                        body_key(scene.system, 0), kind_of(scene.system.dimensions)));
  }
  if (number != bodies.size() + 1) read.body.name = name;
  bodies.push_back(std::move(read.body));
  scene.styles.push_back(std::move(read.style));
}

void BodyDraft::read_walls(const std::string& path, const std::vector<TomlTable>& tables,
                           ProblemLines& problems) {
  path_ = path;
  slanted_.clear();
  slanted_lines_.clear();
  for (const TomlTable& table : tables) {
    Wall wall{fmt::format("slanted-{}", slanted_.size() + 1), {}, {}};
    std::size_t found = 0;
    bool is_read = true;
    for (const TomlEntry& entry : table.entries) {
      const auto* const key =
          std::ranges::find(kWallKeys, std::string_view(entry.key), &TableKey<Wall>::name);
      if (key == kWallKeys.end()) {
        problems.add(
            path, entry.line,
            {"wall." + entry.key,
             fmt::format(": unknown key{}", did_you_mean(entry.key, names_of(kWallKeys)))});
        continue;
      }
      if (entry.key == "point" || entry.key == "normal") ++found;
      try {
        key->set(wall, entry.values);
      } catch (const UsageError& error) {
        is_read = false;
        problems.add(path, entry.line, problem_of_text("wall." + entry.key, entry.values, error));
      }
    }
    if (found != 2) {
      problems.add(path, table.line, {"wall", ": needs a point on it and its normal"});
    }
    if (!is_read || found != 2) continue;  // what follows would only repeat it
    slanted_.push_back(std::move(wall));
    slanted_lines_.push_back(table.line);
  }
}

void BodyDraft::put_into(Scene& scene, ProblemLines& problems) const {
  put_bodies_into(scene, problems);
  std::vector<Wall>& walls = scene.system.walls;
  walls.clear();
  for (const std::size_t axis : {0U, 1U}) {
    add_walls(sides_.at(axis), velocities_.at(axis), axis, walls);
  }
  walls.insert(walls.end(), slanted_.begin(), slanted_.end());
}

bool BodyDraft::moves_no_wall(std::size_t axis) const {
  const auto& [low, high] = sides_.at(axis);
  const auto& [low_velocity, high_velocity] = velocities_.at(axis);
  return (low_velocity != 0 && !low) || (high_velocity != 0 && !high);
}

std::string BodyDraft::origin_of(const std::string& key) const {
  if (const auto set = origins_.find(key); set != origins_.end()) return set->second;
  const auto origin = [&](std::size_t count, std::size_t number, const auto& line_of) {
    const bool is_there = number > 0 && number <= count;
    return is_there ? fmt::format("{}:{}", path_, line_of(number - 1)) : std::string();
  };
  const auto body = [&](std::size_t number) {
    const bool is_added = number > 0 && number <= tables_.size() && tables_[number - 1].line == 0;
    if (is_added) return fmt::format("body {}", number);
    return origin(tables_.size(), number, [&](std::size_t i) { return tables_[i].line; });
  };
  const auto wall = [&](std::size_t number) {
    return origin(slanted_lines_.size(), number, [&](std::size_t i) { return slanted_lines_[i]; });
  };
  if (const std::size_t number = number_in(key, "body ")) return body(number);
  if (const std::size_t number = number_in(key, "wall ")) return wall(number);
  if (key == "wall") return wall(1);
  return body(key == "body" ? 1 : 0);
}

std::size_t number_in(std::string_view text, std::string_view beginning) {
  if (!text.starts_with(beginning)) return 0;
  const std::string_view rest = text.substr(beginning.size());
  const char* const end = rest.data() + rest.size();
  std::size_t number = 0;
  const char* const after = std::from_chars(rest.data(), end, number).ptr;
  return after == end || *after == '.' ? number : 0;
}

void show_all(const System& system, const TimeSpan& time, View& view) {
  const Rational end = time.to.is_time() ? time.to.offset : 0;
  const auto show = [&](std::size_t axis, Range& shown) {
    const auto [low, high] = std::ranges::minmax(seen_places(system, axis, end));
    const Rational margin = (high - low) / 20;
    shown = {low - margin, high + margin};
  };
  show(0, view.x);
  if (system.dimensions == 2) show(1, view.y);
}

Values coordinates_of(const ExactVector& vector, int dimensions) {
  Values texts = {vector[0].get_str()};
  if (dimensions == 2) texts.push_back(vector[1].get_str());
  return texts;
}

std::string color_text(const BodyStyle& style) {
  return style.color ? exact_text(*style.color) : "";
}

std::vector<std::pair<std::string, std::string>> describe_bodies(const Scene& scene) {
  const System& system = scene.system;
  std::vector<std::pair<std::string, std::string>> lines;
  for (std::size_t i = 0; i < system.bodies.size(); ++i) {
    const Body& body = system.bodies[i];
    const BodyStyle& style = scene.styles[i];
    lines.emplace_back(fmt::format("body {}", i + 1),
                       fmt::format("{} {} at {} with {}, size {}, color '{}', label '{}', path {}",
                                   system.dimensions == 1 ? "block" : "disc",
                                   body.mass ? body.mass->get_str() : "inf", text_of(body.position),
                                   text_of(body.velocity), body.size.get_str(), color_text(style),
                                   style.label, style.path));
    lines.back().second += restitution_text(body.restitution);
  }
  for (const Wall& wall : system.walls) {
    lines.emplace_back(fmt::format("{} wall", wall.name),
                       fmt::format("{} facing {}", text_of(wall.point), text_of(wall.normal)));
    if (is_moving(wall)) lines.back().second += ", moving with " + text_of(wall.velocity);
    lines.back().second += restitution_text(wall.restitution);
  }
  return lines;
}

}  // namespace piblocks
