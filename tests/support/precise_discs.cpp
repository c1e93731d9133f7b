#include "support/precise_discs.hpp"

#include <algorithm>

namespace piblocks {
namespace {

using Vector = std::array<Real, 2>;

Real dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1]; }
Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1]}; }
Vector plus(const Vector& a, const Real& factor, const Vector& b) {
  return {a[0] + factor * b[0], a[1] + factor * b[1]};
}
bool is_less(const Real& a, const Real& b) { return (a - b).sign() < 0; }

}  // namespace

PreciseDiscs::PreciseDiscs(const System& system, mpfr_prec_t bits) : system_(system), bits_(bits) {
  const auto vector = [&](const ExactVector& exact) {
    return Vector{Real(bits, exact[0]), Real(bits, exact[1])};
  };
  const std::size_t nobody = system.bodies.size() + system.walls.size();
  for (const Body& body : system.bodies) {
    const Flight flight{vector(body.position), vector(body.velocity), Real(bits, 0)};
    std::optional<Real> mass;
    if (body.mass) mass = Real(bits, *body.mass);
    bodies_.push_back({flight, Real(bits, body.size), mass, nobody});
  }
  for (const Wall& wall : system.walls) {
    const Vector normal = vector(wall.normal);
    const Real norm = sqrt(dot(normal, normal));
    walls_.push_back(
        {{normal[0] / norm, normal[1] / norm}, vector(wall.point), vector(wall.velocity)});
  }
  times_.assign(bodies_.size(), std::vector<std::optional<Real>>(nobody));
  for (std::size_t body = 0; body < bodies_.size(); ++body) predict(body);
}

Vector PreciseDiscs::position_at(const Disc& disc, const Real& time) const {
  return plus(disc.flight.position, time - disc.flight.time, disc.flight.velocity);
}

std::optional<Real> PreciseDiscs::pair_time(const Disc& a, const Disc& b) const {
  if (!a.mass && !b.mass) return std::nullopt;
  const Real& start = is_less(a.flight.time, b.flight.time) ? b.flight.time : a.flight.time;
  const Vector d = minus(position_at(b, start), position_at(a, start));
  const Vector w = minus(b.flight.velocity, a.flight.velocity);
  const Real along = dot(d, w);
  if (along.sign() >= 0) return std::nullopt;
  const Real reach = a.radius + b.radius;
  const Real gap = dot(d, d) - reach * reach;
  const Real discriminant = along * along - dot(w, w) * gap;
  if (discriminant.sign() <= 0) return std::nullopt;
  if (gap.sign() <= 0) return start;
  return start + gap / (sqrt(discriminant) - along);
}

std::optional<Real> PreciseDiscs::wall_time(const Disc& disc, const Line& wall) const {
  const Real speed = dot(wall.normal, minus(disc.flight.velocity, wall.velocity));
  if (!disc.mass || speed.sign() >= 0) return std::nullopt;
  const Vector point = plus(wall.point, disc.flight.time, wall.velocity);
  const Real gap = dot(wall.normal, minus(disc.flight.position, point)) - disc.radius;
  if (gap.sign() <= 0) return disc.flight.time;
  return disc.flight.time - gap / speed;
}

bool PreciseDiscs::have_just_met(std::size_t first, std::size_t second) const {
  const Disc& a = bodies_[first];
  const Disc& b = bodies_[second];
  return (!a.mass || a.last == second) && (!b.mass || b.last == first);
}

void PreciseDiscs::predict(std::size_t body) {
  for (std::size_t other = 0; other < bodies_.size(); ++other) {
    if (other == body) continue;
    const std::size_t first = std::min(body, other);
    const std::size_t second = std::max(body, other);
    times_[first][second].reset();
    if (have_just_met(first, second)) continue;
    times_[first][second] = pair_time(bodies_[first], bodies_[second]);
  }
  for (std::size_t wall = 0; wall < walls_.size(); ++wall) {
    const std::size_t place = bodies_.size() + wall;
    times_[body][place].reset();
    if (bodies_[body].last != place) {
      times_[body][place] = wall_time(bodies_[body], walls_[wall]);
    }
  }
}

void PreciseDiscs::move(std::size_t body, const Real& time, std::size_t partner) {
  Disc& disc = bodies_[body];
  if (!disc.mass) return;
  disc.flight.position = position_at(disc, time);
  disc.flight.time = time;
  disc.last = partner;
}

/// 1 + the coefficient of restitution
Real PreciseDiscs::rebound(std::size_t first, std::size_t second) const {
  return Real(bits_, Rational(1 + restitution_of(system_, first, second)));
}

void PreciseDiscs::collide(std::size_t first, std::size_t second, const Real& time) {
  Disc& a = bodies_[first];
  Disc& b = bodies_[second];
  const Vector d = minus(position_at(b, time), position_at(a, time));
  const Vector w = minus(b.flight.velocity, a.flight.velocity);
  const Real change = rebound(first, second) * dot(d, w) / dot(d, d);
  const Real one(bits_, 1);
  const Real share = !a.mass ? Real(bits_, 0) : !b.mass ? one : *b.mass / (*a.mass + *b.mass);
  a.flight.velocity = plus(a.flight.velocity, change * share, d);
  b.flight.velocity = plus(b.flight.velocity, change * (share - one), d);
}

void PreciseDiscs::reflect(std::size_t body, std::size_t wall) {
  Flight& flight = bodies_[body].flight;
  const Line& line = walls_[wall - bodies_.size()];
  const Real closing = dot(line.normal, minus(line.velocity, flight.velocity));
  flight.velocity = plus(flight.velocity, rebound(body, wall) * closing, line.normal);
}

std::optional<PreciseDiscs::Step> PreciseDiscs::step() {
  std::optional<Step> next;
  for (std::size_t first = 0; first < times_.size(); ++first) {
    for (std::size_t second = first + 1; second < times_[first].size(); ++second) {
      const std::optional<Real>& time = times_[first][second];
      if (!time || (next && !is_less(*time, next->time))) continue;
      next = {*time, static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(second)};
    }
  }
  if (!next) return std::nullopt;
  move(next->first, next->time, next->second);
  if (next->second < bodies_.size()) {
    move(next->second, next->time, next->first);
    collide(next->first, next->second, next->time);
    predict(next->second);
  } else {
    reflect(next->first, next->second);
  }
  predict(next->first);
  return next;
}

}  // namespace piblocks
