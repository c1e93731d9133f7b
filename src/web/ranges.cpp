#include "web/ranges.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

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

}  // namespace

std::string ranges_json(const ScriptBuilder& builder, const LiveScript& live) {
  const auto* const scene = std::get_if<Scene>(&live.script());
  return scene == nullptr ? "{}" : Ranges(builder, *scene).json();
}

}  // namespace piblocks::web
