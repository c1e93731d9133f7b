// Blocks on a line by an exact program that shares nothing with the engines but the masses.
// In: a System of one dimension. Out: its collisions, one after the other, and the bodies after
// each.
#pragma once

#include <gtest/gtest.h>
#include <piblocks/system.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace piblocks {

/// A collision as the exact program finds it.
struct ExactCollision {
  Rational time;
  std::size_t first;
  std::size_t second;
};

/// Walks through all collisions of blocks on a line, comparing all pairs at each step. It knows no
/// neighbours: pairs that cannot meet are found by their gap alone.
class ExactWalk {
 public:
  explicit ExactWalk(const System& system)
      : walls_(system.walls),
        bodies_(system.bodies),
        of_movable_(system.restitution),
        of_immovable_(system.wall_restitution),
        is_at_once_(are_at_once(system)) {}

  std::optional<ExactCollision> next() {
    if (due_.empty()) find_due();
    if (due_.empty()) return std::nullopt;
    const Due now = due_.front();
    due_.erase(due_.begin());
    strike(now.collision.first, -now.impulse);
    strike(now.collision.second, now.impulse);
    return now.collision;
  }

  const std::vector<Body>& bodies() const { return bodies_; }
  /// Of the longest number, numerator and denominator together.
  std::size_t bits() const {
    std::size_t most = bits_of(time_);
    for (const Body& body : bodies_) {
      most = std::max({most, bits_of(body.position[0]), bits_of(body.velocity[0])});
    }
    return most;
  }

 private:
  struct Due {
    ExactCollision collision;
    Rational impulse = 0;  ///< on the second one
  };

  /// Finds all that happens next at one time, and goes there.
  void find_due() {
    const auto consider = [&](const std::optional<Rational>& wait, std::size_t i, std::size_t j) {
      if (!wait || (!due_.empty() && time_ + *wait > due_[0].collision.time)) return;
      if (!due_.empty() && time_ + *wait < due_[0].collision.time) due_.clear();
      due_.push_back({{time_ + *wait, i, j}});
    };
    // Pairs of movable blocks come first, then those with something immovable.
    for (const bool has_immovable : {false, true}) {
      for (std::size_t i = 0; i < bodies_.size(); ++i) {
        if (!bodies_[i].mass) continue;
        for (std::size_t j = has_immovable ? 0 : i + 1; j < bodies_.size(); ++j) {
          const bool is_immovable = !bodies_[j].mass;
          if (is_immovable == has_immovable) consider(wait(i, j), std::min(i, j), std::max(i, j));
        }
        for (std::size_t w = 0; has_immovable && w < walls_.size(); ++w) {
          consider(wait_for_wall(i, w), i, bodies_.size() + w);
        }
      }
    }
    if (due_.empty()) return;
    const Rational time = due_[0].collision.time;
    for (Body& body : bodies_) body.position[0] += body.velocity[0] * (time - time_);
    for (Wall& wall : walls_) wall.point[0] += wall.velocity[0] * (time - time_);
    time_ = time;
    if (is_at_once_ && find_impulses()) return;
    due_.resize(1);
    find_impulses();
  }

  static std::size_t bits_of(const Rational& value) {
    return mpz_sizeinbase(value.get_num_mpz_t(), 2) + mpz_sizeinbase(value.get_den_mpz_t(), 2);
  }
  std::optional<Rational> wait(std::size_t i, std::size_t j) const {
    const bool is_ordered = bodies_[i].position[0] < bodies_[j].position[0];
    const Body& left = bodies_[is_ordered ? i : j];
    const Body& right = bodies_[is_ordered ? j : i];
    const Rational speed = left.velocity[0] - right.velocity[0];
    if (speed <= 0) return std::nullopt;
    return (right.position[0] - left.position[0] - (left.size + right.size) / 2) / speed;
  }
  std::optional<Rational> wait_for_wall(std::size_t i, std::size_t w) const {
    const Body& body = bodies_[i];
    const Wall& wall = walls_[w];
    const int side = sgn(wall.normal[0]);
    const Rational speed = side * (wall.velocity[0] - body.velocity[0]);
    if (speed <= 0) return std::nullopt;
    return (side * (body.position[0] - wall.point[0]) - body.size / 2) / speed;
  }
  /// 1 if the second is on the left of the first, else -1.
  int side(const ExactCollision& pair) const {
    if (pair.second >= bodies_.size()) return sgn(walls_[pair.second - bodies_.size()].normal[0]);
    return bodies_[pair.first].position[0] < bodies_[pair.second].position[0] ? -1 : 1;
  }
  Rational velocity(std::size_t id) const {
    return id < bodies_.size() ? bodies_[id].velocity[0] : walls_[id - bodies_.size()].velocity[0];
  }
  std::optional<Rational> mass(std::size_t id) const {
    return id < bodies_.size() ? bodies_[id].mass : std::nullopt;
  }
  void strike(std::size_t id, const Rational& impulse) {
    if (mass(id)) bodies_[id].velocity[0] += impulse / *mass(id);
  }
  Rational restitution(const ExactCollision& pair) const {
    const Rational& usual = mass(pair.first) && mass(pair.second) ? of_movable_ : of_immovable_;
    const std::size_t n = bodies_.size();
    const auto& second =
        pair.second < n ? bodies_[pair.second].restitution : walls_[pair.second - n].restitution;
    return lower(bodies_[pair.first].restitution.value_or(usual), second.value_or(usual));
  }
  /// By how much the relative velocity of a pair changes for a unit of the impulse of another.
  Rational response(const ExactCollision& pair, const ExactCollision& other) const {
    Rational sum;
    for (const std::size_t a : {pair.first, pair.second}) {
      for (const std::size_t b : {other.first, other.second}) {
        if (a != b || !mass(a)) continue;
        const int sign = (a == pair.second) == (b == other.second) ? 1 : -1;
        sum += sign / *mass(a);
      }
    }
    return sum;
  }

  /// All pairs part as their coefficients say: as many linear equations as there are pairs, solved
  /// with pivots. @return false if there is no single solution
  bool find_impulses() {
    const std::size_t n = due_.size();
    std::vector<std::vector<Rational>> rows(n);
    for (std::size_t i = 0; i < n; ++i) {
      const ExactCollision& pair = due_[i].collision;
      for (const Due& other : due_) rows[i].push_back(response(pair, other.collision));
      rows[i].push_back((1 + restitution(pair)) * (velocity(pair.first) - velocity(pair.second)));
    }
    for (std::size_t i = 0; i < n; ++i) {
      const auto pivot = std::find_if(rows.begin() + std::ptrdiff_t(i), rows.end(),
                                      [&](const auto& row) { return row[i] != 0; });
      if (pivot == rows.end()) return false;
      std::swap(rows[i], *pivot);
      for (std::size_t j = 0; j < n; ++j) {
        const Rational factor = rows[j][i] / rows[i][i];
        for (std::size_t k = 0; j != i && k <= n; ++k) rows[j][k] -= factor * rows[i][k];
      }
    }
    for (std::size_t i = 0; i < n; ++i) {
      due_[i].impulse = rows[i][n] / rows[i][i];
      // It pushes, never pulls.
      EXPECT_GT(due_[i].impulse * -side(due_[i].collision), 0);
    }
    return true;
  }
  static Rational lower(const Rational& a, const Rational& b) { return a < b ? a : b; }

  std::vector<Wall> walls_;
  std::vector<Body> bodies_;
  Rational of_movable_;
  Rational of_immovable_;
  bool is_at_once_;
  Rational time_ = 0;
  std::vector<Due> due_;
};

}  // namespace piblocks
