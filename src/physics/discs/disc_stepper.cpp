#include "physics/discs/disc_stepper.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "physics/discs/at_once.hpp"
#include "physics/discs/bounds.hpp"
#include "physics/discs/disc_system.hpp"
#include "physics/discs/event_tree.hpp"
#include "physics/discs/meeting.hpp"

namespace piblocks::discs {
namespace {

/// Another partner that the disc may truly meet before the planned one.
struct Rival {
  double possible = kNever;
  std::uint32_t partner = kNobody;
  std::uint32_t meetings = 0;  ///< of this partner when it was looked at
};

/// The next meeting of a disc as far as is known, and when it leaves its cell.
struct Plan {
  double time = kNever;
  double crossing = kNever;
  std::uint32_t partner = kNobody;  ///< a disc, or the number of discs + a wall
  std::uint32_t meetings = 0;       ///< of the partner when this was planned
  bool is_doubt = false;            ///< not a meeting, but from then on one cannot be ruled out
  double possible = kNever;         ///< while all is certain: they truly do not meet before
  Rival rival = {};
};

/// Bodies that touch at one instant.
struct Cluster {
  std::vector<std::uint32_t> bodies = {};  ///< the movable ones
  std::vector<Touch> touches = {};         ///< in the order of TieRank
};

/// Each disc has one plan, its soonest. If the partner meets another disc first, the plan stays in
/// the queue until it is due: no sooner can the disc meet anybody else, so it is planned anew then.
/// (One event a disc: Lubachevsky, "How to simulate billiards and similar systems", J. Comput.
/// Phys. 94, 1991.)
class Stepper final : public DiscStepper {
 public:
  Stepper(const System& system, Search search)
      : system_(disc_system_of(system)),
        discs_(system_.discs),
        number_(static_cast<std::uint32_t>(discs_.size())),
        cells_(discs_, search),
        plans_(number_),
        queue_(number_),
        is_at_once_(are_at_once(system)),
        events_(number_),
        touched_(number_) {
    for (std::uint32_t disc = 0; disc < number_; ++disc) raise_top_speed(disc);
    for (const WallLine& wall : system_.walls) {
      top_speed_ = std::max(top_speed_, std::abs(wall.speed) * (1 + 0x1p-40));
    }
    plan_all();
  }

  std::optional<SteppedCollision> step() override;
  double certain_until() const override { return until_ * system_.units.time; }
  Bound bound_of(std::uint32_t body) const override {
    const Bound& bound = system_.bounds[body];
    const Units& units = system_.units;
    return {bound.position * units.length, bound.velocity * units.speed,
            bound.time_error * units.time};
  }

 private:
  bool is_certain() const { return until_ == kNever; }
  bool is_disc(std::uint32_t partner) const { return partner < number_; }
  const WallLine& wall_of(std::uint32_t partner) const { return system_.walls[partner - number_]; }
  std::uint32_t end_of_walls() const {
    return number_ + static_cast<std::uint32_t>(system_.walls.size());
  }

  /// Whether the order in which a disc meets both does not matter: neither changes how the disc
  /// moves towards the other. True of a wall along x and one along y.
  bool are_independent(std::uint32_t one, std::uint32_t other) const {
    if (is_disc(one) || is_disc(other) || one == kNobody || other == kNobody) return false;
    const WallLine& a = wall_of(one);
    const WallLine& b = wall_of(other);
    return a.normal_error == 0 && b.normal_error == 0 && dot(a.normal, b.normal) == 0;
  }

  void plan_all();
  void plan(std::uint32_t disc);
  void plan_meeting(std::uint32_t disc, std::uint32_t partner);
  void plan_end_of_margin(std::uint32_t disc);
  bool have_just_met(std::uint32_t disc, std::uint32_t partner) const;
  bool propose(std::uint32_t disc, const Plan& proposal);
  bool note_rival(std::uint32_t disc, Plan& plan, const Plan& loser) const;
  static bool has_rival(const Plan& plan) { return plan.rival.possible < plan.time; }
  std::uint64_t rank_of(std::uint32_t disc, const Plan& plan) const;
  template <typename Planned>
  bool is_stale(const Planned& planned) const;
  void doubt_graze(std::uint32_t disc);
  void enqueue(std::uint32_t disc);
  void cross(std::uint32_t disc);

  SteppedCollision meet(std::uint32_t disc, std::uint32_t partner, double time);
  void collide_discs(std::uint32_t first, std::uint32_t second, double time);
  void reflect_disc(std::uint32_t disc, std::uint32_t wall, double time);
  void count_meeting(std::uint32_t disc, std::uint32_t partner, double time);
  void renew_cells(double time);

  bool are_of_one_event(std::uint32_t disc, std::uint32_t partner) const;
  double gap_between(std::uint32_t disc, std::uint32_t partner, double time) const;
  bool touch(std::uint32_t disc, std::uint32_t partner, double time) const;
  bool touch(double radius, Vector place, std::uint32_t partner, double time) const;
  Touch touch_of(std::uint32_t disc, std::uint32_t partner, double time) const;
  std::uint64_t rank_of(std::uint32_t disc, std::uint32_t partner) const;
  template <typename Visit>
  void visit_all(std::uint32_t body, Visit visit) const;
  bool meet_alone(std::uint32_t disc, std::uint32_t partner, double time) const;
  Cluster cluster_of(std::uint32_t disc, std::uint32_t partner, double time) const;
  bool is_single(const Cluster& cluster) const;
  double least_speed(const Cluster& cluster) const;
  bool meet_at_once(std::uint32_t disc, std::uint32_t partner, double time);
  void report(const Stage& stage, double time);
  void note_event(const Cluster& cluster, double least);
  double certify_at_once(Cluster& cluster, std::uint32_t disc, std::uint32_t partner, double time,
                         double least);
  bool is_clear(const Cluster& cluster, double time, double late) const;
  void end_certainty(double time);
  Vector place_of(std::uint32_t disc, double time) const;
  Motion motion_of(std::uint32_t disc, double time) const;
  static void require_finite(const SteppedCollision& step);

  double earliest(std::uint32_t disc, std::uint32_t partner) const;
  double earliest_but(std::uint32_t excepted, std::uint32_t body) const;
  std::optional<MeetingError> meeting_error(std::uint32_t disc, std::uint32_t partner,
                                            double time) const;
  std::optional<MeetingError> certify(std::uint32_t disc, std::uint32_t partner, double time);
  void raise_top_speed(std::uint32_t disc);

  DiscSystem system_;
  std::vector<Disc>& discs_;
  std::uint32_t number_;
  Cells cells_;
  std::vector<Plan> plans_;
  EventTree queue_;
  double until_ = kNever;
  double top_speed_ = 0;  ///< while all is certain: of all discs so far, at least
  std::uint32_t since_build_ = 0;
  bool is_at_once_;
  std::vector<SteppedCollision> pending_ = {};  ///< of the last event, the next one last
  std::uint32_t last_event_ = 0;
  std::vector<std::uint32_t>
      events_;  ///< of each disc, the last one at once if it met nobody since
  std::vector<std::vector<std::uint32_t>> touched_;  ///< whom each disc did not approach after it
};

// What is planned.

void Stepper::plan_all() {
  for (Plan& plan : plans_) plan = Plan{};
  for (std::uint32_t disc = 0; disc < number_; ++disc) plan(disc);
}

void Stepper::plan(std::uint32_t disc) {
  plans_[disc] = Plan{};
  plans_[disc].crossing = cells_.crossing_time(disc);
  if (system_.is_movable(disc)) {
    for (std::uint32_t wall = number_; wall < end_of_walls(); ++wall) plan_meeting(disc, wall);
    cells_.visit_near(disc, [&](std::uint32_t other) { plan_meeting(disc, other); });
  }
  if (is_certain()) plan_end_of_margin(disc);
  enqueue(disc);
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
    const bool may_be_before = proposal.possible < start && !are_independent(own.last, partner);
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
  Plan proposal;
  proposal.time = discs_[disc].time + (room > 0 ? room / bound.velocity : 0);
  proposal.is_doubt = true;
  if (proposal.time != kNever) propose(disc, proposal);
}

/// Two free bodies separate for ever. An immovable one is as if it had met nobody else.
/// @param disc  movable
bool Stepper::have_just_met(std::uint32_t disc, std::uint32_t partner) const {
  if (are_of_one_event(disc, partner)) {
    if (std::ranges::find(touched_[disc], partner) != touched_[disc].end()) return true;
  }
  if (discs_[disc].last != partner) return false;
  return !is_disc(partner) || discs_[partner].last == disc || !system_.is_movable(partner);
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
  if (are_independent(loser.partner, plan.partner) && !loser.is_doubt) return false;
  if (is_at_once_ && loser.possible < plan.time && !loser.is_doubt && !plan.is_doubt &&
      touch(disc, loser.partner, plan.time)) {
    return false;
  }
  plan.rival = {loser.possible, loser.partner, loser.meetings};
  return has_rival(plan);
}

/// The order of simultaneous events: doubts, then pairs as TieRank says, in one number.
std::uint64_t Stepper::rank_of(std::uint32_t disc, const Plan& plan) const {
  return plan.is_doubt ? 0 : rank_of(disc, plan.partner);
}

std::uint64_t Stepper::rank_of(std::uint32_t disc, std::uint32_t partner) const {
  const bool is_partner_movable = is_disc(partner) && system_.is_movable(partner);
  const TieRank rank = TieRank::of(disc, true, partner, is_partner_movable);
  const std::uint64_t group = rank.has_immovable ? std::uint64_t{1} << 63 : 0;
  return group | (std::uint64_t{rank.first} << 32) | rank.second;
}

template <typename Planned>
bool Stepper::is_stale(const Planned& planned) const {
  return is_disc(planned.partner) && discs_[planned.partner].meetings != planned.meetings;
}

/// A meeting that may truly be none is in doubt from when on it is possible.
void Stepper::doubt_graze(std::uint32_t disc) {
  Plan& plan = plans_[disc];
  if (!is_certain() || plan.is_doubt || plan.time == kNever || is_stale(plan)) return;
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

void Stepper::cross(std::uint32_t disc) {
  cells_.cross(disc, [&](std::uint32_t other) {
    if (system_.is_movable(disc)) {
      plan_meeting(disc, other);
    } else if (system_.is_movable(other)) {
      plan_meeting(other, disc);
      enqueue(other);
    }
  });
  plans_[disc].crossing = cells_.crossing_time(disc);
  enqueue(disc);
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
    } else if (is_stale(next) || (has_rival(next) && is_stale(next.rival))) {
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
  SteppedCollision step;
  step.time = {time * system_.units.time, 0};
  if (is_disc(partner)) {
    std::tie(step.first, step.second) = std::minmax(disc, partner);
    collide_discs(step.first, step.second, time);
    step.second_after = motion_of(step.second, time);
  } else {
    step.first = disc;
    step.second = partner;
    reflect_disc(disc, partner, time);
  }
  step.first_after = motion_of(step.first, time);
  require_finite(step);
  if (system_.is_movable(step.first)) plan(step.first);
  if (is_disc(partner) && system_.is_movable(step.second)) plan(step.second);
  renew_cells(time);
  return step;
}

void Stepper::require_finite(const SteppedCollision& step) {
  if (std::isfinite(step.time.hi)) return;
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
  widen(*meeting, a, system_.masses[first], system_.bounds[first], b, system_.masses[second],
        system_.bounds[second]);
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

// Several contacts at one instant.

/// Whether a disc has met nobody since several contacts at once; of a movable partner, the same
/// ones.
bool Stepper::are_of_one_event(std::uint32_t disc, std::uint32_t partner) const {
  if (events_[disc] == 0) return false;
  return !is_disc(partner) || !system_.is_movable(partner) || events_[partner] == events_[disc];
}

double Stepper::gap_between(std::uint32_t disc, std::uint32_t partner, double time) const {
  const Disc& own = discs_[disc];
  if (!is_disc(partner)) return gap_to(wall_of(partner), own, time);
  const Disc& other = discs_[partner];
  return length(position_at(other, time) - position_at(own, time)) - own.radius - other.radius;
}

bool Stepper::touch(std::uint32_t disc, std::uint32_t partner, double time) const {
  return touch(discs_[disc].radius, position_at(discs_[disc], time), partner, time);
}

bool Stepper::touch(double radius, Vector place, std::uint32_t partner, double time) const {
  if (!is_disc(partner)) {
    const WallLine& wall = wall_of(partner);
    return dot(wall.normal, place) - (wall.offset + wall.speed * time) <= radius * (1 + kTouch);
  }
  const Disc& other = discs_[partner];
  const Vector apart = position_at(other, time) - place;
  const double reach = (radius + other.radius) * (1 + kTouch);
  return dot(apart, apart) <= reach * reach;
}

/// Calls visit(other) for all walls, and for each disc that may be near; for some twice.
template <typename Visit>
void Stepper::visit_all(std::uint32_t body, Visit visit) const {
  for (std::uint32_t wall = number_; wall < end_of_walls(); ++wall) visit(wall);
  cells_.visit_near(body, [&](std::uint32_t other) {
    if (other != body) visit(other);
  });
}

/// Whether these two are all that touches at the place where they meet.
bool Stepper::meet_alone(std::uint32_t disc, std::uint32_t partner, double time) const {
  bool are_alone = true;
  const auto look_around = [&](std::uint32_t body, std::uint32_t met) {
    if (!is_disc(body) || !system_.is_movable(body)) return;
    const double radius = discs_[body].radius;
    const Vector place = position_at(discs_[body], time);
    visit_all(body, [&](std::uint32_t other) {
      if (other != met && touch(radius, place, other, time)) are_alone = false;
    });
  };
  look_around(disc, partner);
  look_around(partner, disc);
  return are_alone;
}

Touch Stepper::touch_of(std::uint32_t disc, std::uint32_t partner, double time) const {
  Touch touch{disc, partner, {}, 0, system_.restitution(disc, partner)};
  if (is_disc(partner)) {
    const Vector apart = position_at(discs_[partner], time) - position_at(discs_[disc], time);
    touch.normal = (1 / length(apart)) * apart;
  } else {
    touch.normal = -1 * wall_of(partner).normal;
    touch.normal_error = wall_of(partner).normal_error;
  }
  return touch;
}

/// All that touch these two directly or through movable bodies.
Cluster Stepper::cluster_of(std::uint32_t disc, std::uint32_t partner, double time) const {
  Cluster cluster;
  const auto add = [&](std::uint32_t body) {
    if (!is_disc(body) || !system_.is_movable(body)) return false;
    const bool is_known = std::ranges::find(cluster.bodies, body) != cluster.bodies.end();
    if (!is_known) cluster.bodies.push_back(body);
    return true;
  };
  add(disc);
  add(partner);
  for (std::size_t i = 0; i < cluster.bodies.size(); ++i) {
    const std::uint32_t body = cluster.bodies[i];
    visit_all(body, [&](std::uint32_t other) {
      const bool is_pair = std::minmax(body, other) == std::minmax(disc, partner);
      if (!is_pair && !touch(body, other, time)) return;
      if (add(other) && body > other) return;
      cluster.touches.push_back(touch_of(body, other, time));
    });
  }
  const auto rank = [&](const Touch& touch) { return rank_of(touch.first, touch.second); };
  std::ranges::sort(cluster.touches, {}, rank);
  const auto repeated = std::ranges::unique(cluster.touches, {}, rank);
  cluster.touches.erase(repeated.begin(), repeated.end());
  return cluster;
}

/// Whether the order of the touches does not matter: there is one, or a disc is in a corner.
bool Stepper::is_single(const Cluster& cluster) const {
  const std::vector<Touch>& touches = cluster.touches;
  for (std::size_t i = 1; i < touches.size(); ++i) {
    if (!are_independent(touches[0].second, touches[i].second)) return false;
  }
  return touches.size() < 3;
}

double Stepper::least_speed(const Cluster& cluster) const {
  double fastest = 0;
  const auto look_at = [&](std::uint32_t body) {
    const double speed =
        is_disc(body) ? length(discs_[body].velocity) : std::abs(wall_of(body).speed);
    fastest = std::max(fastest, speed);
  };
  for (const Touch& touch : cluster.touches) {
    look_at(touch.first);
    look_at(touch.second);
  }
  return kTouch * fastest;
}

/// @return false if these two meet alone, or cannot be taken together with others
bool Stepper::meet_at_once(std::uint32_t disc, std::uint32_t partner, double time) {
  constexpr int kMostStages = 64;
  if (meet_alone(disc, partner, time)) return false;
  Cluster cluster = cluster_of(disc, partner, time);
  if (is_single(cluster)) return false;
  const double least = least_speed(cluster);
  std::optional<Stage> stage = stage_of(system_, cluster.touches, least);
  if (!stage || stage->touches.empty()) return false;
  const double late = is_certain() ? certify_at_once(cluster, disc, partner, time, least) : 0;
  if (is_certain()) stage = stage_of(system_, cluster.touches, least);  // with errors of normals
  std::vector<std::pair<std::uint32_t, Bound>> struck;
  std::vector<Vector> before;
  for (int k = 0; stage && !stage->touches.empty() && k < kMostStages; ++k) {
    for (const Touch& touch : stage->touches) {
      for (const std::uint32_t body : {touch.first, touch.second}) {
        if (!is_disc(body) || !system_.is_movable(body)) continue;
        const auto is_body = [&](const auto& one) { return one.first == body; };
        if (std::ranges::any_of(struck, is_body)) continue;
        Bound& bound = system_.bounds[body];
        bound.position = drift(discs_[body], bound, time);
        struck.emplace_back(body, bound);
        before.push_back(discs_[body].velocity);
        count_meeting(body, kNobody, time);
      }
    }
    if (is_certain() && !widen(system_, *stage)) end_certainty(time - late);
    apply(system_, *stage);
    report(*stage, time);
    if (is_certain() && !are_decided(system_, cluster.touches, least)) end_certainty(time - late);
    stage = stage_of(system_, cluster.touches, least);
  }
  if (is_certain() && (!stage || !stage->touches.empty())) end_certainty(time - late);
  std::ranges::reverse(pending_);
  note_event(cluster, least);
  for (std::size_t i = 0; i < struck.size(); ++i) {
    const auto& [body, old] = struck[i];
    Bound& bound = system_.bounds[body];
    const double change = length(discs_[body].velocity - before[i]);
    // The new flight begins late, or early: at another place by that much.
    bound.position =
        (old.position + (change + old.velocity + bound.velocity) * late) * (1 + 0x1p-40);
    bound.time_error = late;
    raise_top_speed(body);
  }
  for (const auto& [body, old] : struck) plan(body);
  renew_cells(time);
  return true;
}

void Stepper::report(const Stage& stage, double time) {
  for (const Touch& touch : stage.touches) {
    SteppedCollision step;
    step.time = {time * system_.units.time, 0};
    step.is_tied = stage.is_tied();
    step.first = is_disc(touch.second) ? std::min(touch.first, touch.second) : touch.first;
    step.second = std::max(touch.first, touch.second);
    step.first_after = motion_of(step.first, time);
    if (is_disc(step.second)) step.second_after = motion_of(step.second, time);
    require_finite(step);
    pending_.push_back(step);
  }
}

/// From now on those that touch and do not approach have just met.
void Stepper::note_event(const Cluster& cluster, double least) {
  ++last_event_;
  for (const std::uint32_t body : cluster.bodies) {
    events_[body] = last_event_;
    touched_[body].clear();
  }
  for (const Touch& touch : cluster.touches) {
    if (closing_speed(system_, touch) > least) continue;
    touched_[touch.first].push_back(touch.second);
    if (!is_disc(touch.second) || !system_.is_movable(touch.second)) continue;
    touched_[touch.second].push_back(touch.first);
  }
}

/// Only when discs have met: discs that fly apart for ever need no cells.
void Stepper::renew_cells(double time) {
  if (++since_build_ < std::max(number_, 1000u)) return;
  since_build_ = 0;
  if (!cells_.is_outgrown(time)) return;
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
  const std::vector<Bound>& bounds = system_.bounds;
  if (is_disc(partner)) {
    return earliest_meeting(discs_[disc], bounds[disc], discs_[partner], bounds[partner],
                            top_speed_, are_of_one_event(disc, partner));
  }
  if (are_independent(discs_[disc].last, partner)) {
    return earliest_meeting_aside(discs_[disc], bounds[disc], wall_of(partner));
  }
  return earliest_meeting(discs_[disc], bounds[disc], wall_of(partner), top_speed_);
}

/// Before which time a disc meets nobody, except one.
double Stepper::earliest_but(std::uint32_t excepted, std::uint32_t body) const {
  double soonest = kNever;
  const auto look_at = [&](std::uint32_t other) {
    if (other == body || other == excepted || have_just_met(body, other)) return;
    if (are_independent(other, excepted)) return;
    soonest = std::min(soonest, earliest(body, other));
  };
  for (std::uint32_t wall = number_; wall < end_of_walls(); ++wall) look_at(wall);
  cells_.visit_near(body, look_at);
  return soonest;
}

/// Nothing if rounding leaves in doubt whether the two meet, or when.
std::optional<MeetingError> Stepper::meeting_error(std::uint32_t disc, std::uint32_t partner,
                                                   double time) const {
  const std::vector<Bound>& bounds = system_.bounds;
  std::optional<MeetingError> meeting =
      is_disc(partner)
          ? error_of_meeting(discs_[disc], bounds[disc], discs_[partner], bounds[partner], time)
          : error_of_meeting(discs_[disc], bounds[disc], wall_of(partner), time);
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
    if (is_disc(partner) && system_.is_movable(partner)) {
      other = std::min(other, earliest_but(disc, partner));
    }
    const double last = (time + meeting->time_error) * (1 + 0x1p-51);
    if (other <= last) doubt = std::min(other, time - meeting->time_error);
  }
  if (doubt == kNever) return meeting;
  until_ = std::max(doubt, 0.0);
  return std::nullopt;
}

/// Ends certainty if rounding leaves in doubt which bodies touch or which approach. Else fills in
/// the errors of the normals. @return by how much the time may be wrong
double Stepper::certify_at_once(Cluster& cluster, std::uint32_t disc, std::uint32_t partner,
                                double time, double least) {
  double late = 0;
  double doubt = time;
  bool is_known = true;
  for (const Touch& touch : cluster.touches) {
    const bool is_pair = std::minmax(touch.first, touch.second) == std::minmax(disc, partner);
    if (!have_just_met(touch.first, touch.second)) {
      doubt = std::min(doubt, earliest(touch.first, touch.second));
    }
    if (closing_speed(system_, touch) <= least) {
      is_known &= !is_pair;
      continue;
    }
    const auto meeting = meeting_error(touch.first, touch.second, time);
    is_known &= meeting.has_value();
    if (meeting) late = std::max(late, meeting->time_error);
  }
  for (Touch& touch : cluster.touches) {
    if (!is_disc(touch.second)) continue;
    const Disc& a = discs_[touch.first];
    const Disc& b = discs_[touch.second];
    const Bound& bound_a = system_.bounds[touch.first];
    const Bound& bound_b = system_.bounds[touch.second];
    const Vector w = b.velocity - a.velocity;
    const double sideways = std::abs(dot(w, {-touch.normal.y, touch.normal.x})) + bound_a.velocity +
                            bound_b.velocity + 0x1p-50 * length(w);
    const double moved = gap_error(a, bound_a, b, bound_b, time) + sideways * late;
    touch.normal_error = moved / (a.radius + b.radius) * (1 + 0x1p-30);
  }
  is_known = is_known && is_clear(cluster, time, late);
  if (!is_known || !are_decided(system_, cluster.touches, least)) end_certainty(doubt);
  return late;
}

/// Whether each body that is near one of these surely touches it, or surely does not.
bool Stepper::is_clear(const Cluster& cluster, double time, double late) const {
  bool is_clear = true;
  for (const std::uint32_t body : cluster.bodies) {
    visit_all(body, [&](std::uint32_t other) {
      const Disc& own = discs_[body];
      const std::vector<Bound>& bounds = system_.bounds;
      const double error =
          2 * top_speed_ * late +
          (is_disc(other) ? gap_error(own, bounds[body], discs_[other], bounds[other], time)
                          : gap_error(own, bounds[body], wall_of(other), time));
      const double limit = kTouch * (own.radius + (is_disc(other) ? discs_[other].radius : 0));
      const double beyond = std::abs(gap_between(body, other, time) - limit);
      // Touching discs may overlap, but not by much.
      if (!(beyond > 2 * error) || !(error < limit)) is_clear = false;
    });
  }
  return is_clear;
}

void Stepper::end_certainty(double time) { until_ = std::clamp(time, 0.0, until_); }

void Stepper::raise_top_speed(std::uint32_t disc) {
  const double speed = length(discs_[disc].velocity) + system_.bounds[disc].velocity;
  top_speed_ = std::max(top_speed_, speed * (1 + 0x1p-40) + 0x1p-440);
}

}  // namespace
}  // namespace piblocks::discs

namespace piblocks {

std::unique_ptr<DiscStepper> make_disc_stepper(const System& system, discs::Search search) {
  return std::make_unique<discs::Stepper>(system, search);
}

std::unique_ptr<Stepper> make_disc_stepper(const System& system) {
  return make_disc_stepper(system, discs::Search::cells);
}

}  // namespace piblocks
