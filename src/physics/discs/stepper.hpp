// The engine for discs from within: what it knows and what its parts do.
// In: a System without problems. Out: see physics/stepper.hpp.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "physics/discs/at_once.hpp"
#include "physics/discs/bounds.hpp"
#include "physics/discs/cells.hpp"
#include "physics/discs/event_tree.hpp"
#include "physics/stepper.hpp"

namespace piblocks::discs {

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

/// The discs that may be near one.
struct Near {
  std::uint32_t body = kNobody;
  std::vector<std::uint32_t> discs = {};  ///< some twice
};

/// Bodies that touch at one instant.
struct Cluster {
  std::vector<std::uint32_t> bodies = {};  ///< the movable ones
  std::vector<Touch> touches = {};         ///< in the order of TieRank
};

/// A body that takes part in several contacts at once, just before them.
struct Struck {
  std::uint32_t body = 0;
  double drift = 0;  ///< bound of the error of its place
  double velocity_error = 0;
  Vector velocity = {};
};

/// Each disc has one plan, its soonest. If the partner meets another disc first, the plan stays in
/// the queue until it is due: no sooner can the disc meet anybody else, so it is planned anew then.
/// (One event a disc: Lubachevsky, "How to simulate billiards and similar systems", J. Comput.
/// Phys. 94, 1991.)
class Stepper final : public piblocks::Stepper {
 public:
  /// Both searches give the same numbers.
  explicit Stepper(const System& system, Search search = Search::cells)
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
  /// While all is certain: how far the true flight of a body since its last collision may be from
  /// the computed one, in the units of the system.
  Bound bound_of(std::uint32_t body) const {
    const Bound& bound = system_.bounds[body];
    const Units& units = system_.units;
    return {bound.position * units.length, bound.velocity * units.speed,
            bound.time_error * units.time};
  }

 private:
  bool is_certain() const { return until_ == kNever; }
  bool is_disc(std::uint32_t partner) const { return partner < number_; }
  const WallLine& wall_of(std::uint32_t partner) const { return system_.walls[partner - number_]; }

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
  bool are_joint(std::uint32_t disc, const Plan& plan, const Plan& loser) const;
  static bool has_rival(const Plan& plan) { return plan.rival.possible < plan.time; }
  std::uint64_t rank_of(std::uint32_t disc, const Plan& plan) const;
  bool is_stale(std::uint32_t partner, std::uint32_t meetings) const {
    return is_disc(partner) && discs_[partner].meetings != meetings;
  }
  void doubt_graze(std::uint32_t disc);
  void enqueue(std::uint32_t disc);
  void cross(std::uint32_t body);

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
  /// @returns a list that is valid until the next call
  const std::vector<std::uint32_t>& discs_near(std::uint32_t body);
  void forget_near() { near_[0].body = near_[1].body = kNobody; }
  /// Calls visit(other) for all walls, and for each disc that may be near; for some twice.
  template <typename Visit>
  void visit_all(std::uint32_t body, Visit visit) {
    for (std::uint32_t wall = 0; wall < system_.walls.size(); ++wall) visit(number_ + wall);
    for (const std::uint32_t other : discs_near(body)) visit(other);
  }
  bool meet_alone(std::uint32_t disc, std::uint32_t partner, double time);
  Cluster cluster_of(std::uint32_t disc, std::uint32_t partner, double time);
  bool is_single(const Cluster& cluster) const;
  double least_speed(const Cluster& cluster) const;
  bool meet_at_once(std::uint32_t disc, std::uint32_t partner, double time);
  void strike(const Stage& stage, double time, std::vector<Struck>& struck);
  void widen_struck(const Struck& struck, double late);
  void apply(const Stage& stage, double time);
  void note_event(const Cluster& cluster, double least);
  double certify_at_once(Cluster& cluster, std::uint32_t disc, std::uint32_t partner, double time,
                         double least);
  bool is_clear(const Cluster& cluster, double time, double late);
  void end_certainty(double time);
  Vector place_of(std::uint32_t disc, double time) const;
  Motion motion_of(std::uint32_t disc, double time) const;
  SteppedCollision step_of(std::uint32_t disc, std::uint32_t partner, double time) const;

  double earliest(std::uint32_t disc, std::uint32_t partner) const;
  double earliest_but(std::uint32_t excepted, std::uint32_t body);
  std::optional<MeetingError> meeting_error(std::uint32_t disc, std::uint32_t partner,
                                            double time) const;
  std::optional<MeetingError> certify(std::uint32_t disc, std::uint32_t partner, double time);
  void raise_top_speed(std::uint32_t disc);

  DiscSystem system_;
  std::vector<Disc>& discs_;
  std::uint32_t number_;
  Cells cells_;
  std::array<Near, 2> near_ = {};  ///< of the two that were asked about last, until cells change
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

}  // namespace piblocks::discs
