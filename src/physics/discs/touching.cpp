// Several contacts at one instant: who touches whom then, and whether that is certain.
// In: discs that meet. Out: their collisions, and their plans from then on.
// src/physics/README.md, "Contacts at once", has the rule.
#include <algorithm>
#include <cmath>

#include "physics/discs/meeting.hpp"
#include "physics/discs/stepper.hpp"

namespace piblocks::discs {

/// Whether a disc has met nobody since several contacts at once; of a movable partner, the same
/// ones.
bool Stepper::are_of_one_event(std::uint32_t disc, std::uint32_t partner) const {
  if (events_[disc] == 0) return false;
  return !system_.is_movable(partner) || events_[partner] == events_[disc];
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

/// Whether these two are all that touches at the place where they meet.
bool Stepper::meet_alone(std::uint32_t disc, std::uint32_t partner, double time) {
  bool are_alone = true;
  const auto look_around = [&](std::uint32_t body, std::uint32_t met) {
    if (!system_.is_movable(body)) return;
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
Cluster Stepper::cluster_of(std::uint32_t disc, std::uint32_t partner, double time) {
  Cluster cluster;
  const auto add = [&](std::uint32_t body) {
    if (!system_.is_movable(body)) return false;
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
  const auto is_same = [&](const Touch& a, const Touch& b) { return !(rank(a) < rank(b)); };
  const auto repeated = std::unique(cluster.touches.begin(), cluster.touches.end(), is_same);
  cluster.touches.erase(repeated, cluster.touches.end());
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
  std::vector<Struck> struck;
  for (int k = 0; k < kMostStages; ++k) {
    stage = stage_of(system_, cluster.touches, least);  // with the errors of normals
    if (!stage || stage->touches.empty()) break;
    strike(*stage, time, struck);
    if (is_certain() && !widen(system_, *stage)) end_certainty(time - late);
    apply(*stage, time);
    if (is_certain() && !are_decided(system_, cluster.touches, least)) end_certainty(time - late);
  }
  if (is_certain() && (!stage || !stage->touches.empty())) end_certainty(time - late);
  std::ranges::reverse(pending_);
  note_event(cluster, least);
  for (const Struck& one : struck) widen_struck(one, late);
  for (const Struck& one : struck) plan(one.body);
  renew_cells(time);
  return true;
}

/// Brings those of a stage to where they are, if no stage before has.
void Stepper::strike(const Stage& stage, double time, std::vector<Struck>& struck) {
  for (const Touch& touch : stage.touches) {
    for (const std::uint32_t body : {touch.first, touch.second}) {
      if (!system_.is_movable(body)) continue;
      const auto is_body = [&](const Struck& one) { return one.body == body; };
      if (std::ranges::any_of(struck, is_body)) continue;
      const double off = drift(system_.flight(body), time);
      struck.push_back({body, off, system_.bounds[body].velocity, discs_[body].velocity});
      count_meeting(body, kNobody, time);
    }
  }
}

/// The new flight begins late, or early: at another place by that much.
void Stepper::widen_struck(const Struck& struck, double late) {
  Bound& bound = system_.bounds[struck.body];
  const double change = length(discs_[struck.body].velocity - struck.velocity) +
                        struck.velocity_error + bound.velocity;
  bound.position = (struck.drift + change * late) * (1 + 0x1p-40);
  bound.time_error = late;
  raise_top_speed(struck.body);
}

/// One impulse after the other, so that each collision shows its own.
void Stepper::apply(const Stage& stage, double time) {
  const bool is_tied = stage.is_tied();
  for (std::size_t i = 0; i < stage.touches.size(); ++i) {
    const Touch& touch = stage.touches[i];
    discs::apply(system_, touch, stage.impulses[i]);
    pending_.push_back(step_of(touch.first, touch.second, time));
    pending_.back().is_tied = is_tied;
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
    if (system_.is_movable(touch.second)) touched_[touch.second].push_back(touch.first);
  }
}

/// Ends certainty if rounding leaves in doubt which bodies touch or which approach. Else fills in
/// the errors of the normals. @return by how much the time may be wrong
double Stepper::certify_at_once(Cluster& cluster, std::uint32_t disc, std::uint32_t partner,
                                double time, double least) {
  double late = 0;
  double doubt = time;
  double other = kNever;
  bool is_known = true;
  for (const Touch& touch : cluster.touches) {
    const bool is_pair = std::minmax(touch.first, touch.second) == std::minmax(disc, partner);
    const bool is_over = have_just_met(touch.first, touch.second);
    const double possible = is_over ? kNever : earliest(touch.first, touch.second);
    doubt = std::min(doubt, possible);
    if (closing_speed(system_, touch) <= least) {
      is_known &= !is_pair;
      other = std::min(other, possible);
      continue;
    }
    const auto meeting = meeting_error(touch.first, touch.second, time);
    is_known &= meeting.has_value();
    if (meeting) late = std::max(late, meeting->time_error);
  }
  for (Touch& touch : cluster.touches) {
    if (!is_disc(touch.second)) continue;
    const Flight a = system_.flight(touch.first);
    const Flight b = system_.flight(touch.second);
    const Vector w = b.disc.velocity - a.disc.velocity;
    const double sideways = std::abs(dot(w, {-touch.normal.y, touch.normal.x})) + a.bound.velocity +
                            b.bound.velocity + 0x1p-50 * length(w);
    const double moved = gap_error(a, b, time) + sideways * late;
    touch.normal_error = moved / (a.disc.radius + b.disc.radius) * (1 + 0x1p-30);
  }
  is_known = is_known && other > (time + late) * (1 + 0x1p-51) && is_clear(cluster, time, late);
  if (!is_known || !are_decided(system_, cluster.touches, least)) end_certainty(doubt);
  return late;
}

/// Whether each body that is near one of these surely touches it, or surely does not.
bool Stepper::is_clear(const Cluster& cluster, double time, double late) {
  bool is_clear = true;
  for (const std::uint32_t body : cluster.bodies) {
    visit_all(body, [&](std::uint32_t other) {
      const Flight own = system_.flight(body);
      const double error =
          2 * top_speed_ * late + (is_disc(other) ? gap_error(own, system_.flight(other), time)
                                                  : gap_error(own, wall_of(other), time));
      const double limit = kTouch * (own.disc.radius + (is_disc(other) ? discs_[other].radius : 0));
      const double beyond = std::abs(gap_between(body, other, time) - limit);
      // Touching discs may overlap, but not by much.
      if (!(beyond > 2 * error) || !(error < limit)) is_clear = false;
    });
  }
  return is_clear;
}

void Stepper::end_certainty(double time) { until_ = std::clamp(time, 0.0, until_); }

}  // namespace piblocks::discs
