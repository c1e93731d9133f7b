// Bodies and their box, as a scene file gives them.
// In: the tables [[body]] and the keys of [box]. Out: a system and how it is drawn; problems.
#pragma once

#include <piblocks/scene.hpp>

#include <functional>
#include <string>
#include <vector>

#include "scene/scene_keys.hpp"
#include "scene/toml_file.hpp"

namespace piblocks {

/// The ends of a box along one axis. Nothing: there is no wall.
struct BoxSide {
  std::optional<Rational> low = {};
  std::optional<Rational> high = {};
};

/// Reads "[a, b]", in which "inf" and "-inf" stand for no wall. @throws UsageError
BoxSide parse_box_side(const Values& values);

/// Collects bodies and box while a scene is read.
class BodyDraft {
 public:
  /// Says what is wrong on a line of the file.
  using OnProblem = std::function<void(std::size_t line, const std::string& text)>;

  /// Replaces the bodies by those of the tables.
  void read(const std::vector<TomlTable>& tables, const OnProblem& on_problem);
  /// Replaces the slanted walls by those of the tables.
  void read_walls(const std::vector<TomlTable>& tables, const OnProblem& on_problem);
  void set_box_x(BoxSide side) { x_ = std::move(side); }
  void set_box_y(BoxSide side) { y_ = std::move(side); }

  bool empty() const noexcept { return bodies_.bodies.empty(); }
  Bodies bodies() const;
  /// The line on which this body begins; 0 for one that is not there.
  std::size_t line(std::size_t body) const { return body < lines_.size() ? lines_[body] : 0; }
  bool has_slanted_walls() const noexcept { return !slanted_.empty(); }
  /// The line on which this [[wall]] begins; 0 for one that is not there.
  std::size_t slanted_line(std::size_t wall) const {
    return wall < slanted_lines_.size() ? slanted_lines_[wall] : 0;
  }

 private:
  struct Read {
    std::vector<Body> bodies;
    std::vector<BodyStyle> styles;
    int dimensions = 1;
  };

  void read_body(const TomlTable& table, const OnProblem& on_problem);

  Read bodies_;
  std::vector<std::size_t> lines_;
  std::optional<BoxSide> x_;
  std::optional<BoxSide> y_;
  std::vector<Wall> slanted_;
  std::vector<std::size_t> slanted_lines_;
};

/// The least range of both axes that shows the box, or the bodies at time 0, with a margin.
void show_all(const BodySystem& system, View& view);

/// The bodies and walls as exact text, in the order of describe().
std::vector<std::pair<std::string, std::string>> describe(const Bodies& bodies);

}  // namespace piblocks
