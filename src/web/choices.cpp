#include "web/choices.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "draw/composition.hpp"
#include "scene/scene_keys.hpp"
#include "web/facts.hpp"
#include "web/json.hpp"
#include "web/opening.hpp"

namespace piblocks::web {
namespace {

constexpr double kLeastWidth = 0.1;
constexpr double kMostWidth = 3;

struct Limits {
  double low;
  double high;
};

/// The nearest double that is not beyond the number on the side of `inside`.
double inside_of(const Rational& limit, double inside) {
  const double near = to_double(limit);
  const Rational written = rational_from_decimal(near);
  const bool is_beyond = inside < near ? written > limit : written < limit;
  return is_beyond ? std::nextafter(near, inside) : near;
}

class Ranges {
 public:
  Ranges(const ScriptBuilder& builder, const Scene& scene) : builder_(builder), scene_(scene) {}

  std::string json() && {
    if (has_short_names(scene_.system)) {
      add_counts();
      add_blue();
      add_red();
      add_around("blue.velocity", {-2, 2}, scene_.system.bodies[0].velocity[0]);
      add_around("red.velocity", {-3, 3}, scene_.system.bodies[1].velocity[0]);
      add_around("blocks.restitution", {0, 1}, scene_.system.restitution);
      add_around("wall.restitution", {0, 1}, scene_.system.wall_restitution);
    }
    add_around("time.speed", {0.05, 4}, scene_.time.speed);
    const bool is_opaque = scene_.view.background == Background::opaque;
    add_around("view.shutter", {0, is_opaque ? 1.0 : 0.0}, scene_.view.shutter);
    return json_object(members_);
  }

 private:
  void add_counts() {
    constexpr int kMostDigits = 20;
    const std::optional<int> digits = digits_of(mass_ratio_of(scene_), scene_.show.base);
    add_whole("digits", {1, double(std::max(kMostDigits, digits.value_or(1)))}, digits.value_or(1));
    add_whole("base", {kMinBase, kMaxBase}, scene_.show.base);
  }

  void add_blue() {
    const Rational& place = position(0);
    const Rational reach = half(0) + half(1);
    const Rational low = std::max<Rational>(face() + half(0), scene_.view.x.low);
    add_between("blue.position", low, position(1) - reach, place);
    const Rational room = 2 * std::min<Rational>(place - face(), position(1) - half(1) - place);
    add_width("blue.width", room, scene_.system.bodies[0].size);
  }

  void add_red() {
    const Rational& place = position(1);
    const Rational high = scene_.view.x.high - half(1);
    add_between("red.position", position(0) + half(0) + half(1), high, place);
    const Rational room = 2 * std::min<Rational>(place - position(0) - half(0),
                                                 std::max<Rational>(scene_.view.x.high - place, 0));
    add_width("red.width", room, scene_.system.bodies[1].size);
  }

  const Rational& face() const { return scene_.system.walls[0].point[0]; }
  const Rational& position(std::size_t body) const {
    return scene_.system.bodies[body].position[0];
  }
  Rational half(std::size_t body) const { return scene_.system.bodies[body].size / 2; }

  void add_width(const char* key, const Rational& room, const Rational& width) {
    const double now = to_double(width);
    const double most = std::max(now, std::min(kMostWidth, inside_of(room, 0)));
    add(key, {std::min({kLeastWidth, now, most}), most}, now);
  }

  /// @param value  that the scene has; the range contains it
  void add_between(const char* key, const Rational& low, const Rational& high,
                   const Rational& value) {
    const double now = to_double(value);
    add(key, {std::min(now, inside_of(low, now)), std::max(now, inside_of(high, now))}, now);
  }

  /// For keys of which a scene accepts all values of their kind.
  void add_around(const char* key, const Limits& usual, const Rational& value) {
    const double now = to_double(value);
    if (!std::isfinite(now)) return;
    write(key, {std::min(usual.low, now), std::max(usual.high, now)});
  }

  void add_whole(const char* key, const Limits& wanted, int now) {
    const auto end = [&](double limit) {
      const double accepted = clipped(key, now, limit);
      return accepted < now ? std::ceil(accepted) : std::floor(accepted);
    };
    if (accepts(key, now)) write(key, {end(wanted.low), end(wanted.high)});
  }

  void add(const char* key, const Limits& wanted, double now) {
    if (!std::isfinite(now) || !std::isfinite(wanted.low) || !std::isfinite(wanted.high)) return;
    write(key, {clipped(key, now, wanted.low), clipped(key, now, wanted.high)});
  }

  void write(const char* key, const Limits& range) {
    members_.emplace_back(key, fmt::format("[{},{}]", range.low, range.high));
  }

  /// How far from the scene's own value towards the limit it accepts all values.
  double clipped(const char* key, double now, double limit) const {
    constexpr int kSteps = 12;
    if (accepts(key, limit)) return limit;
    double inside = now;
    double outside = limit;
    for (int step = 0; step < kSteps; ++step) {
      const double middle = (inside + outside) / 2;
      const bool is_whole = key == std::string_view("digits") || key == std::string_view("base");
      (accepts(key, is_whole ? std::floor(middle) : middle) ? inside : outside) = middle;
    }
    return inside;
  }

  bool accepts(const char* key, double value) const {
    ScriptBuilder trial(builder_);
    trial.set(key, key, fmt::format("{}", value));
    try {
      trial.build_scene();
      return true;
    } catch (const UsageError& error) {
      return std::ranges::all_of(error.problems(), can_be_left_out);
    }
  }

  const ScriptBuilder& builder_;
  const Scene& scene_;
  std::vector<std::pair<std::string, std::string>> members_;
};

/// A body takes at most this part of the room.
constexpr double kMostOfRoom = 0.5;
/// Less of what is seen is no room.
constexpr double kLeastRoom = 1e-3;
/// A plane is searched on a grid of so many places each way.
constexpr int kGrid = 40;

struct Place {
  double x = 0;
  double y = 0;
  double room = 0;  ///< on each side of the place
};

/// A number of few figures, at most a twentieth of the room away.
Rational rounded(double value, double room) {
  double step = 1;
  while (step > room / 10) step /= 10;
  while (step * 10 <= room / 10) step *= 10;
  const double whole = std::round(value / step);
  return rational_from_decimal(std::stod(fmt::format("{:.12g}", whole * step)));
}

Place place_on_line(const Scene& scene) {
  struct Taken {
    double from;
    double to;
  };
  std::vector<Taken> taken;
  double low = to_double(scene.view.x.low);
  double high = to_double(scene.view.x.high);
  for (const Wall& wall : scene.system.walls) {
    const double face = to_double(wall.point[0]);
    if (wall.normal[0] > 0) low = std::max(low, face);
    if (wall.normal[0] < 0) high = std::min(high, face);
  }
  for (const Body& body : scene.system.bodies) {
    const double middle = to_double(body.position[0]);
    const double half = to_double(body.size) / 2;
    taken.push_back({middle - half, middle + half});
  }
  taken.push_back({high, high});
  std::ranges::sort(taken, {}, &Taken::from);
  Place best;
  double end = low;
  for (const Taken& next : taken) {
    const double from = std::min(next.from, high);
    if ((from - end) / 2 > best.room) best = {(from + end) / 2, 0, (from - end) / 2};
    end = std::max(end, next.to);
  }
  return best;
}

/// What is in a plane, as doubles.
class Plane {
 public:
  explicit Plane(const Scene& scene)
      : left_(to_double(scene.view.x.low)),
        right_(to_double(scene.view.x.high)),
        lower_(to_double(scene.view.y.low)),
        upper_(to_double(scene.view.y.high)) {
    for (const Wall& wall : scene.system.walls) {
      const double x = to_double(wall.normal[0]);
      const double y = to_double(wall.normal[1]);
      const double length = std::sqrt(x * x + y * y);
      walls_.push_back({x / length, y / length,
                        (x * to_double(wall.point[0]) + y * to_double(wall.point[1])) / length});
    }
    for (const Body& body : scene.system.bodies) {
      discs_.push_back(
          {to_double(body.position[0]), to_double(body.position[1]), to_double(body.size)});
    }
  }

  Place best() const {
    Place best;
    for (int column = 1; column < kGrid; ++column) {
      for (int row = 1; row < kGrid; ++row) {
        Place place{left_ + (right_ - left_) * column / kGrid,
                    lower_ + (upper_ - lower_) * row / kGrid};
        place.room = room_at(place);
        if (place.room > best.room) best = place;
      }
    }
    return best;
  }

 private:
  /// How far a place is from the edge of the view, walls and discs.
  double room_at(const Place& place) const {
    const auto& [x, y, ignored] = place;
    double room = std::min({x - left_, right_ - x, y - lower_, upper_ - y});
    for (const auto& [normal_x, normal_y, face] : walls_) {
      room = std::min(room, normal_x * x + normal_y * y - face);
    }
    for (const auto& [disc_x, disc_y, radius] : discs_) {
      const double apart_x = x - disc_x;
      const double apart_y = y - disc_y;
      room = std::min(room, std::sqrt(apart_x * apart_x + apart_y * apart_y) - radius);
    }
    return room;
  }

  double left_;
  double right_;
  double lower_;
  double upper_;
  std::vector<std::array<double, 3>> walls_;  ///< normal of length 1, and the face along it
  std::vector<std::array<double, 3>> discs_;  ///< centre and radius
};

std::optional<std::string> reason_against(Scene scene, const LiveScript& live,
                                          const FrameSize& size) {
  scene.view.width_px = size.width_px;
  scene.view.height_px = size.height_px;
  try {
    const Composition composition(scene, live.run()->log());
    return std::nullopt;
  } catch (const UsageError& error) {
    return reason_alone(error.problems().front());
  } catch (const Error& error) {
    return error.what();
  }
}

/// Why the scene cannot be shown; nothing if it can.
std::optional<std::string> reason_against(const Scene& scene, const LiveScript& live) {
  for (const Problem& problem : problems_of(scene)) return reason_alone(problem);
  const View& view = live.view();
  std::optional<std::string> reason = reason_against(scene, live, {view.width_px, view.height_px});
  const FrameSize own{scene.view.width_px, scene.view.height_px};
  const bool is_other = own.width_px != view.width_px || own.height_px != view.height_px;
  // What does not fit on the screen may still fit into the scene's own size.
  return reason && is_other ? reason_against(scene, live, own) : reason;
}

/// @param list  of the names that are shown
std::string reasons_against(const LiveScript& live, const char* key, const std::string& names,
                            const Values& list) {
  const SceneKey* const scene_key = find_scene_key(key);
  std::vector<std::pair<std::string, std::string>> members;
  for (const std::string& name : list_of({names})) {
    if (std::ranges::count(list, name) > 0) continue;
    Values longer = list;
    longer.push_back(name);
    Scene scene = std::get<Scene>(live.script());
    scene_key->set(scene, longer);
    if (const auto reason = reason_against(scene, live))
      members.emplace_back(name, json_text(*reason));
  }
  return json_object(members);
}

}  // namespace

std::string ranges_json(const ScriptBuilder& builder, const LiveScript& live) {
  const auto* const scene = std::get_if<Scene>(&live.script());
  return scene == nullptr ? "{}" : Ranges(builder, *scene).json();
}

std::optional<Body> body_with_room(const Scene& scene) {
  const System& system = scene.system;
  const bool is_plane = system.dimensions == 2;
  const Place place = is_plane ? Plane(scene).best() : place_on_line(scene);
  const double seen = to_double(scene.view.x.high - scene.view.x.low);
  if (!(place.room > kLeastRoom * seen) || !std::isfinite(place.room)) return std::nullopt;
  Rational sizes = 0;
  for (const Body& body : system.bodies) sizes += body.size;
  const double usual = to_double(sizes) / double(system.bodies.size());
  // Of a block the width, of a disc the radius.
  const double most = kMostOfRoom * place.room * (is_plane ? 1 : 2);
  Body body;
  body.position[0] = rounded(place.x, place.room);
  if (is_plane) body.position[1] = rounded(place.y, place.room);
  const double size = std::min(usual, most);
  body.size = rounded(size, size);
  return body;
}

std::string choices_json(const LiveScript& live) {
  const auto* const scene = std::get_if<Scene>(&live.script());
  if (scene == nullptr) return R"({"show.panels":{},"show.overlays":{},"room":null})";
  Values panels;
  for (const Panel panel : scene->show.panels) panels.push_back(exact_text(panel));
  Values overlays;
  for (const Overlay overlay : overlays_of(*scene)) overlays.push_back(exact_text(overlay));
  std::optional<Body> room;
  if (scene->system.bodies.size() <= kMaxBodyRows) room = body_with_room(*scene);
  return fmt::format(R"({{"show.panels":{},"show.overlays":{},"room":{}}})",
                     reasons_against(live, "show.panels", panel_names(), panels),
                     reasons_against(live, "show.overlays", overlay_names(), overlays),
                     room ? body_json(*room, {}, scene->system.dimensions) : "null");
}

}  // namespace piblocks::web
