// Blocks on a line, from collision to collision, in any number type: the plain program that
// somebody would write, and in many bits the right answers.
// In: a System whose bodies are in their order along the axis. Out: where they are.
#pragma once

#include <piblocks/system.hpp>

#include <cstddef>
#include <vector>

#include "bodies/contest.hpp"

namespace piblocks::benchmark {

/// Positions are absolute, and so is the time. All neighbours are compared at each step.
template <typename Number>
class LineLoop {
 public:
  explicit LineLoop(const System& system) {
    for (const Wall& wall : system.walls) {
      if (wall.normal[0] > 0) add_wall(wall);
    }
    for (const Body& body : system.bodies) {
      elements_.push_back({to_number<Number>(*body.mass), to_number<Number>(body.size / 2),
                           to_number<Number>(body.position[0]), to_number<Number>(body.velocity[0]),
                           true});
    }
    for (const Wall& wall : system.walls) {
      if (wall.normal[0] < 0) add_wall(wall);
    }
    find_next();
  }

  /// When the next collision is due.
  Number next_time() const { return time_ + wait_; }

  void step() {
    for (Element& element : elements_) element.position += element.velocity * wait_;
    time_ += wait_;
    collide(elements_[next_], elements_[next_ + 1]);
    find_next();
  }

  /// Of all blocks, at a time before the next collision.
  void add_positions(const Number& time, std::vector<Number>& positions) const {
    for (const Element& element : elements_) {
      if (!element.is_movable) continue;
      positions.push_back(element.position + element.velocity * (time - time_));
    }
  }

 private:
  struct Element {
    Number mass;
    Number half_width;
    Number position;
    Number velocity;
    bool is_movable;
  };

  void add_wall(const Wall& wall) {
    elements_.push_back({Number(1), Number(0), to_number<Number>(wall.point[0]), Number(0), false});
  }

  static void collide(Element& a, Element& b) {
    if (!a.is_movable) {
      b.velocity = -b.velocity;
    } else if (!b.is_movable) {
      a.velocity = -a.velocity;
    } else {
      const Number change = 2 * (a.velocity - b.velocity) / (a.mass + b.mass);
      a.velocity -= b.mass * change;
      b.velocity += a.mass * change;
    }
  }

  /// There always is one: blocks between two walls do not come to rest.
  void find_next() {
    bool is_found = false;
    for (std::size_t i = 0; i + 1 < elements_.size(); ++i) {
      const Element& a = elements_[i];
      const Element& b = elements_[i + 1];
      const Number closing = a.velocity - b.velocity;
      if (closing <= 0) continue;
      const Number gap = b.position - a.position - a.half_width - b.half_width;
      const Number wait = gap > 0 ? Number(gap / closing) : Number(0);
      if (is_found && wait >= wait_) continue;
      wait_ = wait;
      next_ = i;
      is_found = true;
    }
  }

  std::vector<Element> elements_ = {};
  Number time_ = Number(0);
  Number wait_ = Number(0);
  std::size_t next_ = 0;
};

/// Of all blocks at each of these times.
template <typename Number>
std::vector<Number> loop_positions(const System& system, const std::vector<double>& instants) {
  LineLoop<Number> loop(system);
  std::vector<Number> positions;
  for (const double instant : instants) {
    const Number time(instant);
    while (loop.next_time() <= time) loop.step();
    loop.add_positions(time, positions);
  }
  return positions;
}

}  // namespace piblocks::benchmark
