#include "support/precise_discs.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

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
  const auto have_touched = [](const Disc& one, std::size_t other) {
    return std::ranges::find(one.touched, other) != one.touched.end();
  };
  if (a.mass && b.mass && a.event != 0 && a.event == b.event && have_touched(a, second))
    return true;
  if (a.mass && !b.mass && a.event != 0 && have_touched(a, second)) return true;
  if (b.mass && !a.mass && b.event != 0 && have_touched(b, first)) return true;
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
    const Disc& disc = bodies_[body];
    const bool has_touched =
        disc.event != 0 && std::ranges::find(disc.touched, place) != disc.touched.end();
    if (disc.last != place && !has_touched) {
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
  disc.event = 0;
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

/// Nothing unless they touch.
std::optional<PreciseDiscs::Contact> PreciseDiscs::contact(std::size_t first, std::size_t second,
                                                           const Real& time) const {
  if (!is_movable(first)) std::swap(first, second);
  const Disc& own = bodies_[first];
  const Vector here = position_at(own, time);
  const Real zero(bits_, 0);
  Contact result{first, second, {zero, zero}, zero, rebound(first, second), zero};
  const Real share(bits_, Rational(1) / power(2, 40));
  if (second >= bodies_.size()) {
    const Line& wall = walls_[second - bodies_.size()];
    const Vector apart = minus(here, plus(wall.point, time, wall.velocity));
    result.normal = {-wall.normal[0], -wall.normal[1]};
    const Real gap = dot(wall.normal, apart) - own.radius;
    return is_less(share * own.radius, gap) ? std::nullopt : std::optional(result);
  }
  const Vector apart = minus(position_at(bodies_[second], time), here);
  const Real distance = sqrt(dot(apart, apart));
  result.normal = {apart[0] / distance, apart[1] / distance};
  const Real reach = own.radius + bodies_[second].radius;
  return is_less(reach + share * reach, distance) ? std::nullopt : std::optional(result);
}

/// All contacts of the two and of what touches them, directly or through movable bodies.
std::vector<PreciseDiscs::Contact> PreciseDiscs::cluster_of(const Step& step) const {
  std::vector<std::size_t> bodies;
  std::vector<Contact> contacts;
  const auto add = [&](std::size_t body) {
    if (is_movable(body) && std::ranges::find(bodies, body) == bodies.end()) bodies.push_back(body);
  };
  add(step.first);
  add(step.second);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    for (std::size_t other = 0; other < bodies_.size() + walls_.size(); ++other) {
      if (other == bodies[i]) continue;
      const auto found = contact(bodies[i], other, step.time);
      if (!found) continue;
      add(other);
      if (!is_movable(other) || bodies[i] < other) contacts.push_back(*found);
    }
  }
  std::ranges::sort(contacts, {}, [&](const Contact& c) {
    return std::tuple(!is_movable(c.second), c.first, c.second);
  });
  return contacts;
}

/// Of walls along x and y, whose order does not matter.
bool PreciseDiscs::is_corner(const std::vector<Contact>& contacts) const {
  if (contacts.size() != 2) return false;
  const auto& [a, b] = std::tie(contacts[0], contacts[1]);
  if (a.second < bodies_.size() || b.second < bodies_.size()) return false;
  return (a.normal[0].sign() == 0 && b.normal[1].sign() == 0) ||
         (a.normal[1].sign() == 0 && b.normal[0].sign() == 0);
}

PreciseDiscs::Vector PreciseDiscs::velocity_of(std::size_t body, const Contact& contact) const {
  if (body < bodies_.size()) return bodies_[body].flight.velocity;
  const Real speed = dot(walls_[body - bodies_.size()].velocity, contact.normal);
  return {speed * contact.normal[0], speed * contact.normal[1]};
}

Real PreciseDiscs::closing(const Contact& contact) const {
  return dot(contact.normal,
             minus(velocity_of(contact.first, contact), velocity_of(contact.second, contact)));
}

Real PreciseDiscs::inverse_mass(std::size_t body) const {
  return is_movable(body) ? Real(bits_, 1) / *bodies_[body].mass : Real(bits_, 0);
}

/// Gauss's elimination. @return whether there is one solution
bool PreciseDiscs::solve(std::vector<Contact>& contacts) const {
  const std::size_t size = contacts.size();
  std::vector<std::vector<Real>> rows;
  for (const Contact& one : contacts) {
    rows.emplace_back();
    for (const Contact& other : contacts) {
      Real sum(bits_, 0);
      if (one.first == other.first) sum = sum + inverse_mass(one.first);
      if (one.first == other.second) sum = sum - inverse_mass(one.first);
      if (one.second == other.first) sum = sum - inverse_mass(one.second);
      if (one.second == other.second) sum = sum + inverse_mass(one.second);
      rows.back().push_back(sum * dot(one.normal, other.normal));
    }
    rows.back().push_back(one.rebound * one.closing);
  }
  for (std::size_t k = 0; k < size; ++k) {
    if (!(rows[k][k].to_double() > 1e-9)) return false;
    for (std::size_t i = 0; i < size; ++i) {
      if (i == k) continue;
      const Real factor = rows[i][k] / rows[k][k];
      for (std::size_t j = k; j <= size; ++j) rows[i][j] = rows[i][j] - factor * rows[k][j];
    }
  }
  for (std::size_t k = 0; k < size; ++k) contacts[k].impulse = rows[k][size] / rows[k][k];
  return true;
}

bool PreciseDiscs::solve_without_pulling(std::vector<Contact>& contacts) const {
  while (solve(contacts)) {
    if (std::erase_if(contacts, [](const Contact& c) { return c.impulse.sign() < 0; }) == 0) {
      return true;
    }
  }
  return false;
}

bool PreciseDiscs::meet_at_once(const Step& step) {
  std::vector<Contact> contacts = cluster_of(step);
  if (contacts.size() < 2 || is_corner(contacts)) return false;
  Real fastest(bits_, 0);
  for (const Contact& contact : contacts) {
    for (const std::size_t body : {contact.first, contact.second}) {
      const Vector v = velocity_of(body, contact);
      if (is_less(fastest, sqrt(dot(v, v)))) fastest = sqrt(dot(v, v));
    }
  }
  const Real least = Real(bits_, Rational(1) / power(2, 40)) * fastest;
  std::vector<std::size_t> moved;
  for (int stage = 0; stage < 64; ++stage) {
    std::vector<Contact> active;
    for (Contact& contact : contacts) {
      contact.closing = closing(contact);
      if (is_less(least, contact.closing)) active.push_back(contact);
    }
    if (active.empty() || !solve_without_pulling(active)) break;
    for (const Contact& c : active) {
      for (const std::size_t body : {c.first, c.second}) {
        if (!is_movable(body)) continue;
        if (std::ranges::find(moved, body) == moved.end()) {
          moved.push_back(body);
          move(body, step.time, bodies_.size() + walls_.size());
        }
        Vector& velocity = bodies_[body].flight.velocity;
        const Real change = c.impulse * inverse_mass(body);
        velocity = plus(velocity, body == c.first ? -change : change, c.normal);
      }
      const auto [low, high] = std::minmax(c.first, c.second);
      pending_.push_back(
          {step.time, static_cast<std::uint32_t>(low), static_cast<std::uint32_t>(high)});
    }
  }
  if (moved.empty()) return false;
  std::ranges::reverse(pending_);
  note_event(contacts, least);
  for (const std::size_t body : moved) predict(body);
  return true;
}

void PreciseDiscs::note_event(const std::vector<Contact>& contacts, const Real& least) {
  ++events_;
  for (const Contact& contact : contacts) {
    for (const std::size_t body : {contact.first, contact.second}) {
      if (!is_movable(body)) continue;
      if (bodies_[body].event != events_) bodies_[body].touched.clear();
      bodies_[body].event = events_;
      const std::size_t other = body == contact.first ? contact.second : contact.first;
      if (!is_less(least, closing(contact))) bodies_[body].touched.push_back(other);
    }
  }
}

std::optional<PreciseDiscs::Step> PreciseDiscs::step() {
  if (!pending_.empty()) {
    const Step next = pending_.back();
    pending_.pop_back();
    return next;
  }
  std::optional<Step> next;
  for (std::size_t first = 0; first < times_.size(); ++first) {
    for (std::size_t second = first + 1; second < times_[first].size(); ++second) {
      const std::optional<Real>& time = times_[first][second];
      if (!time || (next && !is_less(*time, next->time))) continue;
      next = {*time, static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(second)};
    }
  }
  if (!next) return std::nullopt;
  if (are_at_once(system_) && meet_at_once(*next)) return step();
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
