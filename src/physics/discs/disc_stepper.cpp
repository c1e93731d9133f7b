#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <tuple>
#include <vector>

#include "physics/discs/meeting.hpp"
#include "physics/discs/stepper.hpp"

namespace piblocks::discs {

// What is planned.

void Stepper::plan_all() {
  for (Plan& plan : plans_) plan = Plan{};
  for (std::uint32_t disc = 0; disc < number_; ++disc) plan(disc);
}

void Stepper::plan(std::uint32_t disc) {
  plans_[disc] = Plan{};
  plans_[disc].crossing = cells_.crossing_time(disc);
  if (system_.is_movable(disc)) {
    visit_all(disc, [&](std::uint32_t other) { plan_meeting(disc, other); });
  }
  if (is_certain()) plan_end_of_margin(disc);
  enqueue(disc);
}

/// One collision asks several times who is near, and following the lists of cells takes long.
const std::vector<std::uint32_t>& Stepper::discs_near(std::uint32_t body) {
  if (near_[0].body != body) std::swap(near_[0], near_[1]);
  Near& near = near_[0];
  if (near.body == body) return near.discs;
  near.discs.clear();
  cells_.visit_near(body, [&](std::uint32_t other) {
    if (other != body) near.discs.push_back(other);
  });
  near.body = body;
  return near.discs;
}

/// Plans for both: the other disc may not have known this one when it was planned.
void Stepper::plan_meeting(std::uint32_t disc, std::uint32_t partner) {
  if (disc == partner || have_just_met(disc, partner)) return;
  const Disc& own = discs_[disc];
  Plan proposal;
  proposal.partner = partner;
  proposal.time =
      is_disc(partner) ? meeting_time(own, discs_[partner]) : meeting_time(own, wall_of(partner));
  if (is_certain()) {
    const double start = is_disc(partner) ? std::max(own.time, discs_[partner].time) : own.time;
    proposal.possible = earliest(disc, partner);
    const bool may_be_before =
        proposal.possible < start &&
        !(are_independent(own.last, partner) && meeting_error(disc, partner, proposal.time));
    proposal.is_doubt = proposal.time == kNever || may_be_before;
    if (proposal.is_doubt) proposal.time = proposal.possible;
  }
  if (proposal.time == kNever) return;
  if (!is_disc(partner)) {
    propose(disc, proposal);
    return;
  }
  proposal.meetings = discs_[partner].meetings;
  propose(disc, proposal);
  const double first = std::min(proposal.time, proposal.possible);
  if (first > plans_[partner].time || !system_.is_movable(partner)) return;
  proposal.partner = disc;
  proposal.meetings = own.meetings;
  if (propose(partner, proposal)) enqueue(partner);
}

/// Beyond its margin a disc could truly be next to discs that its cell does not know.
void Stepper::plan_end_of_margin(std::uint32_t disc) {
  const Bound& bound = system_.bounds[disc];
  const double room = cells_.margin() / 4 - bound.position;
  if (room > 0 && bound.velocity == 0) return;
  const double time = discs_[disc].time + (room > 0 ? room / bound.velocity : 0);
  if (time != kNever) propose(disc, {.time = time, .is_doubt = true});
}

/// Two free bodies separate for ever. An immovable one is as if it had met nobody else.
/// @param disc  movable
bool Stepper::have_just_met(std::uint32_t disc, std::uint32_t partner) const {
  if (are_of_one_event(disc, partner)) {
    if (std::ranges::find(touched_[disc], partner) != touched_[disc].end()) return true;
  }
  if (discs_[disc].last != partner) return false;
  return !system_.is_movable(partner) || discs_[partner].last == disc;
}

/// Makes the proposal the disc's plan if it is sooner. @return whether the disc's next event
/// changes
bool Stepper::propose(std::uint32_t disc, const Plan& proposal) {
  Plan& plan = plans_[disc];
  const bool is_sooner =
      proposal.time < plan.time ||
      (proposal.time == plan.time && rank_of(disc, proposal) < rank_of(disc, plan));
  if (!is_sooner) return note_rival(disc, plan, proposal);
  const Plan loser = plan;
  plan = proposal;
  plan.crossing = loser.crossing;
  plan.rival = loser.rival;
  note_rival(disc, plan, loser);
  return true;
}

/// @return whether it becomes the rival of the disc's plan, and may be before it
bool Stepper::note_rival(std::uint32_t disc, Plan& plan, const Plan& loser) const {
  if (loser.possible >= plan.rival.possible || loser.partner == plan.partner) return false;
  // A plan that comes later forgets this one, so the doubt must be short.
  const bool is_soon = top_speed_ * (plan.time - loser.possible) < 0x1p-20 * discs_[disc].radius;
  if (is_soon && are_independent(loser.partner, plan.partner) && !loser.is_doubt) return false;
  if (are_joint(disc, plan, loser)) return false;
  plan.rival = {loser.possible, loser.partner, loser.meetings};
  return has_rival(plan);
}

/// Whether both will be contacts of one meeting, if that turns out to be certain.
bool Stepper::are_joint(std::uint32_t disc, const Plan& plan, const Plan& loser) const {
  if (!is_at_once_ || loser.possible >= plan.time || loser.is_doubt || plan.is_doubt) return false;
  const bool is_soon = top_speed_ * (plan.time - loser.possible) < kTouch * discs_[disc].radius;
  return is_soon && touch(disc, loser.partner, plan.time);
}

/// The order of simultaneous events: doubts, then pairs as TieRank says, in one number.
std::uint64_t Stepper::rank_of(std::uint32_t disc, const Plan& plan) const {
  return plan.is_doubt ? 0 : rank_of(disc, plan.partner);
}

std::uint64_t Stepper::rank_of(std::uint32_t disc, std::uint32_t partner) const {
  const TieRank rank = TieRank::of(disc, true, partner, system_.is_movable(partner));
  const std::uint64_t group = rank.has_immovable ? std::uint64_t{1} << 63 : 0;
  return group | (std::uint64_t{rank.first} << 32) | rank.second;
}

/// A meeting that may truly be none is in doubt from when on it is possible.
void Stepper::doubt_graze(std::uint32_t disc) {
  Plan& plan = plans_[disc];
  if (!is_certain() || plan.is_doubt || plan.time == kNever) return;
  if (is_stale(plan.partner, plan.meetings)) return;
  if (meeting_error(disc, plan.partner, plan.time)) return;
  plan.is_doubt = true;
  plan.time = plan.possible;
}

void Stepper::enqueue(std::uint32_t disc) {
  doubt_graze(disc);
  const Plan& plan = plans_[disc];
  const EventKey next =
      has_rival(plan) ? EventKey{plan.rival.possible, 0} : EventKey{plan.time, rank_of(disc, plan)};
  queue_.set(disc, plan.crossing <= next.time ? EventKey{plan.crossing, 0} : next);
}

void Stepper::cross(std::uint32_t body) {
  forget_near();
  cells_.cross(body, [&](std::uint32_t near) {
    if (system_.is_movable(body)) {
      plan_meeting(body, near);
    } else if (system_.is_movable(near)) {
      plan_meeting(near, body);
      enqueue(near);
    }
  });
  plans_[body].crossing = cells_.crossing_time(body);
  enqueue(body);
}

// What happens.

std::optional<SteppedCollision> Stepper::step() {
  if (number_ == 0) return std::nullopt;
  while (true) {
    if (!pending_.empty()) {
      const SteppedCollision next = pending_.back();
      pending_.pop_back();
      return next;
    }
    const std::uint32_t disc = queue_.first();
    if (queue_.first_time() == kNever) return std::nullopt;
    const Plan& next = plans_[disc];
    const double time = queue_.first_time();
    if (next.crossing <= time) {
      cross(disc);
    } else if (is_stale(next.partner, next.meetings) ||
               (has_rival(next) && is_stale(next.rival.partner, next.rival.meetings))) {
      plan(disc);
    } else if (next.is_doubt || has_rival(next)) {
      if (is_certain()) until_ = std::max(time, 0.0);
      plan(disc);
    } else if (!is_at_once_ || !meet_at_once(disc, next.partner, next.time)) {
      return meet(disc, next.partner, next.time);
    }
  }
}

SteppedCollision Stepper::meet(std::uint32_t disc, std::uint32_t partner, double time) {
  const auto [first, second] = std::minmax({disc, partner});
  if (is_disc(partner)) {
    collide_discs(first, second, time);
  } else {
    reflect_disc(disc, partner, time);
  }
  SteppedCollision step = step_of(first, second, time);
  if (system_.is_movable(first)) plan(first);
  if (system_.is_movable(second)) plan(second);
  renew_cells(time);
  return step;
}

/// The collision of two bodies that have just met.
SteppedCollision Stepper::step_of(std::uint32_t disc, std::uint32_t partner, double time) const {
  SteppedCollision step;
  step.time = {time * system_.units.time, 0};
  std::tie(step.first, step.second) = std::minmax(disc, partner);
  step.first_after = motion_of(step.first, time);
  if (is_disc(step.second)) step.second_after = motion_of(step.second, time);
  if (std::isfinite(step.time.hi)) return step;
  throw SimulationError(fmt::format(
      "simulation: bodies {} and {}: the time of a collision is out of the range of a double",
      step.first + 1, step.second + 1));
}

void Stepper::collide_discs(std::uint32_t first, std::uint32_t second, double time) {
  const auto meeting = is_certain() ? certify(first, second, time) : std::nullopt;
  count_meeting(first, second, time);
  count_meeting(second, first, time);
  Disc& a = discs_[first];
  Disc& b = discs_[second];
  collide(a, system_.masses[first], b, system_.masses[second],
          place_of(second, time) - place_of(first, time), system_.restitution(first, second));
  if (!meeting) return;
  widen(*meeting, system_, first, second);
  raise_top_speed(first);
  raise_top_speed(second);
}

void Stepper::reflect_disc(std::uint32_t disc, std::uint32_t wall, double time) {
  const auto meeting = is_certain() ? certify(disc, wall, time) : std::nullopt;
  count_meeting(disc, wall, time);
  const double restitution = system_.restitution(disc, wall);
  reflect(discs_[disc], wall_of(wall), restitution);
  if (!meeting) return;
  widen(*meeting, wall_of(wall), restitution, system_.bounds[disc]);
  raise_top_speed(disc);
}

void Stepper::count_meeting(std::uint32_t disc, std::uint32_t partner, double time) {
  if (!system_.is_movable(disc)) return;
  Disc& moved = discs_[disc];
  moved.position = position_at(moved, time);
  moved.time = time;
  ++moved.meetings;
  moved.last = partner;
  events_[disc] = 0;
}

/// Only when discs have met: discs that fly apart for ever need no cells.
void Stepper::renew_cells(double time) {
  if (++since_build_ < std::max(number_, 1000u)) return;
  since_build_ = 0;
  if (!cells_.is_outgrown(time)) return;
  forget_near();
  cells_.build(time);
  plan_all();
}

/// Collisions do not advance immovable discs, whose flight has no error but that of the start.
Vector Stepper::place_of(std::uint32_t disc, double time) const {
  return system_.is_movable(disc) ? discs_[disc].position : position_at(discs_[disc], time);
}

Motion Stepper::motion_of(std::uint32_t disc, double time) const {
  constexpr double kMost = 0x1p450;  // squares of the engine's numbers remain finite
  const Vector place = place_of(disc, time);
  const Vector velocity = discs_[disc].velocity;
  const Units& units = system_.units;
  const Motion motion = {{place.x * units.length, place.y * units.length},
                         {velocity.x * units.speed, velocity.y * units.speed}};
  const auto is_in_range = [](double own, double outside) {
    return std::abs(own) < kMost && std::isfinite(outside);
  };
  if (!is_in_range(place.x, motion.position[0]) || !is_in_range(place.y, motion.position[1]) ||
      !is_in_range(velocity.x, motion.velocity[0]) ||
      !is_in_range(velocity.y, motion.velocity[1])) {
    throw SimulationError(fmt::format(
        "simulation: body {}: its position or velocity is out of the range of a double", disc + 1));
  }
  return motion;
}

// What is certain.

double Stepper::earliest(std::uint32_t disc, std::uint32_t partner) const {
  const Flight own = system_.flight(disc);
  if (is_disc(partner)) {
    return earliest_meeting(own, system_.flight(partner), top_speed_,
                            are_of_one_event(disc, partner));
  }
  if (are_independent(own.disc.last, partner)) {
    return earliest_meeting_aside(own, wall_of(partner));
  }
  return earliest_meeting(own, wall_of(partner), top_speed_);
}

/// Before which time a disc meets nobody, except one.
double Stepper::earliest_but(std::uint32_t excepted, std::uint32_t body) {
  double soonest = kNever;
  visit_all(body, [&](std::uint32_t near) {
    if (near == excepted || have_just_met(body, near)) return;
    if (are_independent(near, excepted)) return;
    soonest = std::min(soonest, earliest(body, near));
  });
  return soonest;
}

/// Nothing if rounding leaves in doubt whether the two meet, or when.
std::optional<MeetingError> Stepper::meeting_error(std::uint32_t disc, std::uint32_t partner,
                                                   double time) const {
  const Flight own = system_.flight(disc);
  std::optional<MeetingError> meeting = is_disc(partner)
                                            ? error_of_meeting(own, system_.flight(partner), time)
                                            : error_of_meeting(own, wall_of(partner), time);
  const bool is_late = meeting && 8 * top_speed_ * meeting->time_error > cells_.margin() / 4;
  return is_late ? std::nullopt : meeting;
}

/// Ends certainty unless this meeting truly is the next one of both. @return nothing then
std::optional<MeetingError> Stepper::certify(std::uint32_t disc, std::uint32_t partner,
                                             double time) {
  const std::optional<MeetingError> meeting = meeting_error(disc, partner, time);
  double doubt = kNever;
  if (!meeting) {
    doubt = std::min(earliest(disc, partner), time);
  } else {
    double other = kNever;
    if (system_.is_movable(disc)) other = earliest_but(partner, disc);
    if (system_.is_movable(partner)) {
      other = std::min(other, earliest_but(disc, partner));
    }
    const double last = (time + meeting->time_error) * (1 + 0x1p-51);
    if (other <= last) doubt = std::min(other, time - meeting->time_error);
  }
  if (doubt == kNever) return meeting;
  until_ = std::max(doubt, 0.0);
  return std::nullopt;
}

void Stepper::raise_top_speed(std::uint32_t disc) {
  const double speed = length(discs_[disc].velocity) + system_.bounds[disc].velocity;
  top_speed_ = std::max(top_speed_, speed * (1 + 0x1p-40) + 0x1p-440);
}

}  // namespace piblocks::discs

namespace piblocks {

std::unique_ptr<Stepper> make_disc_stepper(const System& system) {
  return std::make_unique<discs::Stepper>(system);
}

}  // namespace piblocks
