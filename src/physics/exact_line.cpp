#include "physics/exact_line.hpp"

#include <piblocks/contact.hpp>

#include <algorithm>
#include <tuple>
#include <utility>

#include "core/real.hpp"

namespace piblocks {
namespace {

Motion motion_of(const LineElement& element) {
  return {{to_double(element.position), 0}, {to_double(element.velocity), 0}};
}

void collide(LineElement& left, LineElement& right) {
  const Rational closing = left.velocity - right.velocity;
  const Rational& e = left.restitution;
  left.velocity -= velocity_change(closing, share_of_change(left.mass, right.mass), e);
  right.velocity += velocity_change(closing, share_of_change(right.mass, left.mass), e);
}

/// How much velocity an impulse of 1 gives it.
Rational mobility(const LineElement& element) {
  return element.mass ? Rational(1 / *element.mass) : Rational(0);
}

/// The impulses J with which neighbours that approach part, all at once: G J = (1 + e) c, as
/// src/physics/README.md has it. G has entries beside its diagonal only for pairs that share a
/// block, and these are negative. So no J is, and elimination needs no pivots.
/// @param pairs  in the order of the line
/// @return nothing if G is singular: two that no collision moves squeeze what is between them
std::optional<std::vector<Rational>> impulses_at_once(const std::vector<LineElement>& elements,
                                                      const std::vector<std::size_t>& pairs) {
  std::vector<Rational> impulses;
  std::vector<Rational> pivots;
  // How much closing speed an impulse of 1 of the pair before adds to this one; 0 if they share no
  // movable block.
  const auto coupling = [&](std::size_t k) {
    const bool is_shared = k > 0 && k < pairs.size() && pairs[k - 1] + 1 == pairs[k];
    return is_shared ? mobility(elements[pairs[k]]) : Rational(0);
  };
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const LineElement& left = elements[pairs[k]];
    const LineElement& right = elements[pairs[k] + 1];
    Rational pivot = mobility(left) + mobility(right);
    Rational change = (1 + left.restitution) * (left.velocity - right.velocity);
    if (k > 0) {
      const Rational factor = coupling(k) / pivots.back();
      pivot -= factor * coupling(k);
      change += factor * impulses.back();
    }
    if (pivot == 0) return std::nullopt;
    pivots.push_back(pivot);
    impulses.push_back(change);
  }
  for (std::size_t k = pairs.size(); k-- > 0;) {
    if (k + 1 < pairs.size()) impulses[k] += coupling(k + 1) * impulses[k + 1];
    impulses[k] /= pivots[k];
  }
  return impulses;
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
  SteppedCollision step;
  step.time = time;
  const bool is_left_first = left_id < right_id;
  std::tie(step.first, step.second) = std::minmax(left_id, right_id);
  step.first_after = is_left_first ? left : right;
  step.second_after = is_left_first ? right : left;
  return step;
}

ExactLine::ExactLine(const System& system)
    : elements_(elements_of(system)),
      meetings_(elements_.size() - 1),
      next_(meetings_.size(), Earlier{*this}),
      is_at_once_(are_at_once(system)) {
  for (std::size_t pair = 0; pair < meetings_.size(); ++pair) predict(pair);
  next_.replay_all();
}

bool ExactLine::Earlier::operator()(std::size_t a, std::size_t b) const {
  const auto& [meetings, elements] = std::tie(line.meetings_, line.elements_);
  if (!meetings[a]) return false;
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
  if (pending_.empty() && !meet()) return std::nullopt;
  SteppedCollision step = std::move(pending_.back());
  pending_.pop_back();
  return step;
}

/// @return false if there is no further meeting
bool ExactLine::meet() {
  if (meetings_.empty() || !meetings_[next_.winner()]) return false;
  take_stage();
  bits_ = size_bits(time_);
  if (stage_.size() == 1 || !strike_at_once()) {
    put_back_all_but_first();
    collide(elements_[stage_[0]], elements_[stage_[0] + 1]);
    report(stage_[0]);
  }
  std::ranges::reverse(pending_);
  for (const std::size_t pair : stage_) {
    for (const std::size_t beside : {pair - 1, pair + 1}) {
      if (beside >= meetings_.size() || is_in_stage(beside)) continue;
      predict(beside);
      next_.replay(beside);
    }
  }
  return true;
}

/// Takes the next pair. With contacts at once it takes all other pairs that meet at that time, too;
/// pairs without a common block do not influence each other.
void ExactLine::take_stage() {
  time_ = *meetings_[next_.winner()];
  stage_.clear();
  do {
    const std::size_t pair = next_.winner();
    stage_.push_back(pair);
    for (const std::size_t n : {pair, pair + 1}) {
      elements_[n].position = elements_[n].position_at(time_);
      elements_[n].since = time_;
    }
    meetings_[pair].reset();
    next_.replay(pair);
    if (!is_at_once_ || is_jam(pair)) return;
  } while (is_due(next_.winner()) && !is_jam(next_.winner()));
}

void ExactLine::put_back_all_but_first() {
  while (stage_.size() > 1) {
    meetings_[stage_.back()] = time_;
    next_.replay(stage_.back());
    stage_.pop_back();
  }
}

/// Gives all pairs of the stage their impulses at once. @return false, and changes nothing, if
/// these are not determined
bool ExactLine::strike_at_once() {
  std::vector<std::size_t> pairs = stage_;
  std::ranges::sort(pairs);
  const auto impulses = impulses_at_once(elements_, pairs);
  if (!impulses) return false;
  for (const std::size_t pair : stage_) {
    const auto number = std::ranges::lower_bound(pairs, pair) - pairs.begin();
    const Rational& impulse = (*impulses)[static_cast<std::size_t>(number)];
    elements_[pair].velocity -= impulse * mobility(elements_[pair]);
    elements_[pair + 1].velocity += impulse * mobility(elements_[pair + 1]);
    report(pair);
  }
  return true;
}

void ExactLine::report(std::size_t pair) {
  const LineElement& left = elements_[pair];
  const LineElement& right = elements_[pair + 1];
  for (const LineElement* const element : {&left, &right}) {
    bits_ = std::max({bits_, size_bits(element->position), size_bits(element->velocity)});
  }
  SteppedCollision step =
      step_of(to_time(time_), left.id, motion_of(left), right.id, motion_of(right));
  step.exact_time = time_;
  const auto is_now = [&](std::size_t beside) { return is_due(beside) || is_in_stage(beside); };
  step.is_tied = is_now(pair + 1) || (pair > 0 && is_now(pair - 1));
  pending_.push_back(step);
}

}  // namespace piblocks
