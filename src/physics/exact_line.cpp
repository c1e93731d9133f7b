#include "physics/exact_line.hpp"

#include <piblocks/contact.hpp>

#include <algorithm>
#include <tuple>
#include <utility>

namespace piblocks {
namespace {

std::size_t bits_of(const Rational& value) {
  return mpz_sizeinbase(value.get_num_mpz_t(), 2) + mpz_sizeinbase(value.get_den_mpz_t(), 2);
}

Motion motion_of(const LineElement& element) {
  return {{to_double(element.position), 0}, {to_double(element.velocity), 0}};
}

void collide(LineElement& left, LineElement& right) {
  const Rational closing = left.velocity - right.velocity;
  const Rational& e = left.restitution;
  left.velocity -= velocity_change(closing, share_of_change(left.mass, right.mass), e);
  right.velocity += velocity_change(closing, share_of_change(right.mass, left.mass), e);
}

/// The wall on one side of all blocks that is next to them; nothing if there is none.
/// @param sign  of the normal: 1 for walls on the left
std::optional<LineElement> nearest_wall(const System& system, int sign) {
  std::optional<LineElement> nearest;
  for (std::size_t i = 0; i < system.walls.size(); ++i) {
    const Wall& wall = system.walls[i];
    const Rational& face = wall.point[0];
    if (sgn(wall.normal[0]) != sign) continue;
    if (nearest && sign * face <= sign * nearest->position) continue;
    const auto id = static_cast<std::uint32_t>(system.bodies.size() + i);
    nearest = LineElement{id, std::nullopt, 0, face, wall.velocity[0]};
  }
  return nearest;
}

}  // namespace

TieRank rank_of(const LineElement& a, const LineElement& b) {
  return TieRank::of(a.id, a.mass.has_value(), b.id, b.mass.has_value());
}

std::vector<LineElement> elements_of(const System& system) {
  std::vector<LineElement> elements;
  for (std::size_t i = 0; i < system.bodies.size(); ++i) {
    const Body& body = system.bodies[i];
    elements.push_back({static_cast<std::uint32_t>(i), body.mass, body.size / 2, body.position[0],
                        body.velocity[0]});
  }
  std::ranges::sort(elements, {}, &LineElement::position);
  if (auto left = nearest_wall(system, 1)) elements.insert(elements.begin(), std::move(*left));
  if (auto right = nearest_wall(system, -1)) elements.push_back(std::move(*right));
  for (std::size_t i = 0; i + 1 < elements.size(); ++i) {
    elements[i].restitution = restitution_of(system, elements[i].id, elements[i + 1].id);
  }
  return elements;
}

SteppedCollision step_of(const Time& time, std::uint32_t left_id, const Motion& left,
                         std::uint32_t right_id, const Motion& right) {
  SteppedCollision step{.time = time};
  const bool is_left_first = left_id < right_id;
  std::tie(step.first, step.second) = std::minmax(left_id, right_id);
  step.first_after = is_left_first ? left : right;
  step.second_after = is_left_first ? right : left;
  return step;
}

ExactLine::ExactLine(const System& system)
    : elements_(elements_of(system)),
      meetings_(elements_.size() - 1),
      next_(std::max<std::size_t>(meetings_.size(), 1), Earlier{*this}) {
  for (std::size_t pair = 0; pair < meetings_.size(); ++pair) predict(pair);
  if (!meetings_.empty()) next_.replay_all();
}

bool ExactLine::Earlier::operator()(std::size_t a, std::size_t b) const {
  const auto& [meetings, elements] = std::tie(line.meetings_, line.elements_);
  if (meetings.empty() || !meetings[a]) return false;
  if (!meetings[b]) return true;
  const int order = cmp(*meetings[a], *meetings[b]);
  if (order != 0) return order < 0;
  return rank_of(elements[a], elements[a + 1]) < rank_of(elements[b], elements[b + 1]);
}

void ExactLine::predict(std::size_t pair) {
  const LineElement& left = elements_[pair];
  const LineElement& right = elements_[pair + 1];
  const Rational gap =
      (right.position_at(time_) - right.half_width) - (left.position_at(time_) + left.half_width);
  const std::optional<Rational> wait =
      time_to_contact(gap, Rational(left.velocity - right.velocity));
  meetings_[pair].reset();
  if (wait) meetings_[pair] = time_ + *wait;
}

std::optional<SteppedCollision> ExactLine::step() {
  if (meetings_.empty()) return std::nullopt;
  const std::size_t pair = next_.winner();
  if (!meetings_[pair]) return std::nullopt;
  time_ = *meetings_[pair];
  LineElement& left = elements_[pair];
  LineElement& right = elements_[pair + 1];
  bits_ = bits_of(time_);
  for (LineElement* const element : {&left, &right}) {
    element->position = element->position_at(time_);
    element->since = time_;
  }
  collide(left, right);
  for (const LineElement* const element : {&left, &right}) {
    bits_ = std::max({bits_, bits_of(element->position), bits_of(element->velocity)});
  }
  const bool is_tied = is_due(pair + 1) || (pair > 0 && is_due(pair - 1));
  meetings_[pair].reset();
  next_.replay(pair);
  if (pair > 0) {
    predict(pair - 1);
    next_.replay(pair - 1);
  }
  if (pair + 1 < meetings_.size()) {
    predict(pair + 1);
    next_.replay(pair + 1);
  }
  SteppedCollision step =
      step_of(to_time(time_), left.id, motion_of(left), right.id, motion_of(right));
  step.exact_time = time_;
  step.is_tied = is_tied;
  return step;
}

}  // namespace piblocks
