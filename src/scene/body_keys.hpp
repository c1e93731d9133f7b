// Bodies and their box, as a scene file gives them.
// In: the tables [[body]] and the keys of [box]. Out: a system and how it is drawn; problems.
#pragma once

#include <piblocks/scene.hpp>

#include <array>
#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "scene/scene_keys.hpp"
#include "scene/toml_file.hpp"

namespace piblocks {

/// @throws UsageError unless it is from 0 to 1
Rational parse_restitution(const Values& values);

/// The ends of a box along one axis. Nothing: there is no wall.
struct BoxSide {
  std::optional<Rational> low = {};
  std::optional<Rational> high = {};
};

/// Collects bodies and box while a scene is read.
class BodyDraft {
 public:
  /// Replaces the bodies by those of the tables in this file.
  void read(const std::string& path, std::vector<TomlTable> tables, ProblemLines& problems);
  /// Replaces the slanted walls by those of the tables.
  void read_walls(const std::string& path, const std::vector<TomlTable>& tables,
                  ProblemLines& problems);
  /// Sets a property, as "body 2.mass"; the number after the last one is that of a new body.
  /// @throws UsageError if there is no such body
  void set(const std::string& origin, const std::string& key, const Values& values);
  /// Ignores "body 2.mass", or all of "body 2", in tables that are read later. Numbers stay.
  void leave_out(const std::string& key) { left_out_.push_back(key); }
  /// Ignores nothing in tables that are read from now on.
  void leave_out_nothing() { left_out_.clear(); }
  /// Sets a key of the box. @returns false if this is none. @throws UsageError
  bool set_box(const std::string& key, const Values& values);

  bool empty() const noexcept { return tables_.empty(); }
  /// Replaces the bodies of a scene, and walls. Adds what is wrong with the texts of bodies.
  void put_into(Scene& scene, ProblemLines& problems) const;
  /// Whether a velocity is given to an end of the box that is no wall.
  bool moves_no_wall(std::size_t axis) const;
  bool has_slanted_walls() const noexcept { return !slanted_.empty(); }
  /// File and line of the table for this key of problems_of(), as "body 3.mass"; empty if there is
  /// none.
  std::string origin_of(const std::string& key) const;

 private:
  void erase_property(std::size_t number, const std::string& property);
  void put_bodies_into(Scene& scene, ProblemLines& problems) const;
  void put_body_into(Scene& scene, std::size_t number, ProblemLines& problems) const;

  std::string path_;
  std::vector<TomlTable> tables_;               // of the file, and of bodies that were added
  std::set<std::size_t> removed_;               // numbers of bodies
  std::vector<std::string> left_out_;           // keys
  std::map<std::string, std::string> origins_;  // of properties that were set
  // Of the box, by axis: where its walls are at time 0, and their velocities along the axis.
  std::array<BoxSide, 2> sides_;
  std::array<std::array<Rational, 2>, 2> velocities_;
  std::vector<Wall> slanted_;
  std::vector<std::size_t> slanted_lines_;
};

/// The number that follows `beginning`: the 3 of "body 3.mass" after "body "; else 0.
std::size_t number_in(std::string_view text, std::string_view beginning);

/// The least range of both axes that shows, with a margin, the bodies at time 0, and the box until
/// its end if that is a time.
void show_all(const System& system, const TimeSpan& time, View& view);

/// As many coordinates as there are dimensions, as exact texts.
Values coordinates_of(const ExactVector& vector, int dimensions);

/// "#1f77b4"; empty if the scene gives no colour.
std::string color_text(const BodyStyle& style);

/// The bodies and walls as exact text, in the order of describe().
std::vector<std::pair<std::string, std::string>> describe_bodies(const Scene& scene);

}  // namespace piblocks
