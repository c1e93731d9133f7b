#include "web/room.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace piblocks::web {
namespace {

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

}  // namespace

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

}  // namespace piblocks::web
