#include "support/disc_certainty.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <cmath>
#include <deque>
#include <iterator>
#include <optional>
#include <utility>

#include "physics/discs/stepper.hpp"
#include "support/precise_discs.hpp"

namespace piblocks {
namespace {

constexpr mpfr_prec_t kBits = 400;

/// A collision of the engine with the bounds of both bodies after it.
struct BoundedStep {
  SteppedCollision step;
  std::array<discs::Bound, 2> bounds;
  bool has_time = true;    ///< false: of the step before, which was swapped with this one
  bool has_motion = true;  ///< false: see the step after, which was swapped with this one
  std::array<bool, 2> is_last = {true, true};  ///< of what happens to each body at that time
};

Real difference(double computed, const Real& truth) {
  return Real(kBits, Rational(computed)) - truth;
}

double distance(const std::array<double, 2>& computed, const std::array<Real, 2>& truth) {
  const Real x = difference(computed[0], truth[0]);
  const Real y = difference(computed[1], truth[1]);
  return sqrt(x * x + y * y).to_double();
}

class Comparison {
 public:
  Comparison(const System& system, std::size_t limit)
      : system_(system), engine_(system), truth_(system) {
    take_certain_steps(limit);
  }

  CertaintyCheck result() {
    for (const BoundedStep& bounded : steps_) {
      const SteppedCollision& step = bounded.step;
      for (const std::uint32_t body : {step.first, step.second}) {
        if (is_changed_by_hits(body)) queue_of(body).push_back(&bounded);
      }
    }
    check_.certain = steps_.size();
    std::size_t left = 2 * steps_.size() + 1;
    while (met_ < steps_.size() && left-- > 0) {
      if (!compare_next()) break;
    }
    if (met_ < steps_.size()) complain("collisions are certain that do not happen");
    look_for_missed();
    return std::move(check_);
  }

 private:
  void take_certain_steps(std::size_t limit) {
    while (steps_.size() < limit) {
      const std::optional<SteppedCollision> step = next_step();
      if (!step) {
        check_.is_complete = engine_.certain_until() == kForEver && !is_out_of_range_;
        break;
      }
      const bool is_pair = step->second < system_.bodies.size();
      if (engine_.certain_until() != kForEver) break;
      steps_.push_back({*step,
                        {engine_.bound_of(step->first),
                         is_pair ? engine_.bound_of(step->second) : discs::Bound{}}});
    }
    until_ = engine_.certain_until();
    // The last ones may lack what happens at the same time.
    const double last = steps_.size() < limit ? until_ : steps_.back().step.time.hi * (1 - 0x1p-30);
    std::erase_if(steps_, [&](const BoundedStep& s) { return s.step.time.hi >= last; });
    queues_.resize(system_.bodies.size());
    mark_stages();
  }

  /// Bounds are those after all that happens to a body at one instant.
  void mark_stages() {
    std::vector<BoundedStep*> last(system_.bodies.size());
    for (BoundedStep& bounded : steps_) {
      for (const std::size_t side : {0u, 1u}) {
        const std::uint32_t body = side == 0 ? bounded.step.first : bounded.step.second;
        if (body >= last.size()) continue;
        if (last[body] != nullptr && last[body]->step.time.hi == bounded.step.time.hi) {
          last[body]->is_last[last[body]->step.first == body ? 0 : 1] = false;
        }
        last[body] = &bounded;
      }
    }
  }

  /// Between walls that close in, speeds leave the range of a double some day.
  std::optional<SteppedCollision> next_step() {
    try {
      return engine_.step();
    } catch (const SimulationError&) {
      is_out_of_range_ = true;
      return std::nullopt;
    }
  }

  std::vector<const BoundedStep*>& queue_of(std::uint32_t body) { return queues_[body]; }

  /// Whether collisions change the body. Those of another one at one instant have no order to
  /// compare.
  bool is_changed_by_hits(std::uint32_t body) const {
    return body < system_.bodies.size() && system_.bodies[body].mass;
  }

  /// The next true collision has to be the next of each body that it moves, if they have one.
  bool compare_next() {
    const std::optional<PreciseDiscs::Step> next = truth_.step();
    if (!next) return false;
    swap_walls(next->first, next->second);
    const BoundedStep* of_first =
        is_changed_by_hits(next->first) ? take_from(next->first) : nullptr;
    const BoundedStep* of_second =
        is_changed_by_hits(next->second) ? take_from(next->second) : of_first;
    if (!is_changed_by_hits(next->first)) of_first = of_second;
    if (of_first == nullptr && of_second == nullptr) {
      note_uncertain(next->time);
      return true;
    }
    if (of_first != of_second || of_first->step.first != next->first ||
        of_first->step.second != next->second) {
      complain(fmt::format("bodies {} and {} meet at {}, not those of the engine", next->first,
                           next->second, next->time.to_double()));
      return false;
    }
    ++met_;
    compare_numbers(*of_first);
    return true;
  }

  /// A disc in a corner may meet the wall along x and the one along y in the other order.
  void swap_walls(std::uint32_t body, std::uint32_t wall) {
    std::vector<const BoundedStep*>& queue = queue_of(body);
    if (queue.size() < 2 || queue[1]->step.second != wall) return;
    if (!are_perpendicular(wall, queue[0]->step.second)) return;
    swapped_.push_back(*queue[1]);
    swapped_.back().has_motion = false;
    swapped_.push_back(*queue[1]);
    swapped_.back().step.second = queue[0]->step.second;
    swapped_.back().has_time = false;
    queue[0] = &*std::prev(swapped_.end(), 2);
    queue[1] = &swapped_.back();
  }

  bool are_perpendicular(std::size_t one, std::size_t other) const {
    const std::size_t bodies = system_.bodies.size();
    if (one < bodies || other < bodies) return false;
    const ExactVector& a = system_.walls[one - bodies].normal;
    const ExactVector& b = system_.walls[other - bodies].normal;
    return (a[0] == 0 && b[1] == 0) || (a[1] == 0 && b[0] == 0);
  }

  /// The body's next certain collision; none if there is none any more.
  const BoundedStep* take_from(std::uint32_t body) {
    std::vector<const BoundedStep*>& queue = queue_of(body);
    if (queue.empty()) return nullptr;
    const BoundedStep* next = queue.front();
    queue.erase(queue.begin());
    return next;
  }

  void compare_numbers(const BoundedStep& bounded) {
    const SteppedCollision& step = bounded.step;
    largest_time_error_ =
        std::max({largest_time_error_, bounded.bounds[0].time_error, bounded.bounds[1].time_error});
    if (bounded.is_last[0]) {
      compare_motion(bounded, step.first, step.first_after, bounded.bounds[0]);
    }
    if (step.second < system_.bodies.size() && bounded.is_last[1]) {
      compare_motion(bounded, step.second, step.second_after, bounded.bounds[1]);
    }
  }

  void compare_motion(const BoundedStep& bounded, std::uint32_t body, const Motion& motion,
                      const discs::Bound& bound) {
    if (!system_.bodies[body].mass) return;
    const SteppedCollision& step = bounded.step;
    const PreciseDiscs::Flight& flight = truth_.flight(body);
    const Real late = difference(step.time.hi, flight.time);
    const std::array<Real, 2> there = {flight.position[0] + late * flight.velocity[0],
                                       flight.position[1] + late * flight.velocity[1]};
    if (bounded.has_time) hold(step, "time", std::abs(late.to_double()), bound.time_error);
    if (!bounded.has_motion) return;
    hold(step, "position", distance(motion.position, there), bound.position);
    hold(step, "velocity", distance(motion.velocity, flight.velocity), bound.velocity);
  }

  void hold(const SteppedCollision& step, const char* what, double error, double bound) {
    if (error > 0) check_.widest = std::max(check_.widest, error / bound);
    if (error <= bound) return;
    complain(fmt::format("{} of {} and {} at {}: off by {}, bound {}", what, step.first,
                         step.second, step.time.hi, error, bound));
  }

  /// A true collision of bodies that have no more certain ones must not be before the end.
  void note_uncertain(const Real& time) { uncertain_.push_back(time.to_double()); }

  void look_for_missed() {
    for (std::size_t k = 0; k < 1 + system_.bodies.size(); ++k) {
      const std::optional<PreciseDiscs::Step> next = truth_.step();
      if (!next) break;
      note_uncertain(next->time);
    }
    for (const double time : uncertain_) {
      if (time >= until_ - 2 * largest_time_error_) continue;
      if (until_ == kForEver && !check_.is_complete) continue;
      complain(fmt::format("a collision at {} is missing before {}", time, until_));
    }
  }

  void complain(const std::string& what) { check_.wrong.push_back(what); }

  const System& system_;
  discs::Stepper engine_;
  PreciseDiscs truth_;
  double until_ = kForEver;
  bool is_out_of_range_ = false;
  std::vector<BoundedStep> steps_ = {};
  std::vector<std::vector<const BoundedStep*>> queues_ = {};
  std::deque<BoundedStep> swapped_ = {};
  std::vector<double> uncertain_ = {};
  std::size_t met_ = 0;
  double largest_time_error_ = 0;
  CertaintyCheck check_ = {};
};

}  // namespace

CertaintyCheck check_certainty(const System& system, std::size_t limit) {
  return Comparison(system, limit).result();
}

}  // namespace piblocks
