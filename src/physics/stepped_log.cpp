#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <cmath>
#include <exception>
#include <mutex>
#include <shared_mutex>
#include <utility>

#include "core/stop.hpp"
#include "physics/logs.hpp"
#include "physics/stepper.hpp"

namespace piblocks {
namespace {

/// A binary fraction from `time` on and before `next`, of as few digits as there may be.
Rational short_time(const Rational& time, const std::optional<Rational>& next) {
  constexpr std::size_t kShort_bits = 256;
  if (mpz_sizeinbase(time.get_den_mpz_t(), 2) <= kShort_bits) return time;
  for (unsigned long bits = 64;; bits *= 2) {
    const Rational unit = power(2, bits);
    Rational later = Rational(ceil(time * unit)) / unit;
    if (!next || later < *next) return later;
  }
}

/// The fastest body crosses everything in this time, as all is at time 0.
double crossing_time(const System& system) {
  double size = 0;
  double speed = 0;
  for (const Body& body : system.bodies) {
    for (std::size_t axis = 0; axis < body.position.size(); ++axis) {
      size = std::max(size, 2 * std::abs(to_double(body.position[axis])) + to_double(body.size));
      speed = std::max(speed, std::abs(to_double(body.velocity[axis])));
    }
  }
  for (const Wall& wall : system.walls) {
    for (const Rational& x : wall.point) size = std::max(size, 2 * std::abs(to_double(x)));
    for (const Rational& v : wall.velocity) speed = std::max(speed, std::abs(to_double(v)));
  }
  return size / speed;
}

Motion moved(Motion motion, double duration) {
  for (const std::size_t axis : {0U, 1U}) {
    motion.position.at(axis) += motion.velocity.at(axis) * duration;
  }
  return motion;
}

/// Steps are computed when they are first asked for, and stay.
class SteppedLog final : public Log {
 public:
  SteppedLog(const System& system, std::optional<Rational> horizon, std::stop_token stop,
             Engine engine)
      : Log(system),
        stop_(std::move(stop)),
        stepper_(engine == Engine::events ? make_event_stepper(system)
                 : system.dimensions == 1 ? make_line_stepper(system)
                                          : make_disc_stepper(system)),
        start_(motions_at_start(system)),
        never_ends_(may_never_end(system)),
        horizon_(never_ends_ ? std::move(horizon) : std::nullopt),
        crossing_time_(crossing_time(system)),
        is_elastic_(is_elastic(system)),
        of_body_(system.bodies.size()) {}

  bool has(const Integer& index) const override {
    compute([&] { return jam_ || is_complete_ || steps_.size() >= index; });
    const std::shared_lock lock(mutex_);
    // A jam counts as one more: collision() throws its message.
    return index >= 1 && index <= steps_.size() + (jam_ ? 1 : 0);
  }

  Integer last() const override {
    if (never_ends_) {
      if (horizon_) return count_at(*horizon_);
      throw UsageError("time.to",
                       "these bodies may collide for ever; say until when, as time.to = 10");
    }
    compute([&] { return is_complete_; });
    const std::shared_lock lock(mutex_);
    return {steps_.size()};
  }

  bool never_ends() const override { return never_ends_; }
  std::optional<Rational> horizon() const override { return horizon_; }

  Collision collision(const Integer& index) const override {
    compute_up_to(index);
    const std::shared_lock lock(mutex_);
    const auto number = static_cast<std::uint32_t>(index.get_ui() - 1);
    const StoredStep& step = steps_.at(number);
    return {index,
            step.time,
            step.first,
            step.second,
            step.first_after,
            step.second_after,
            velocity_before(step.first, number),
            velocity_before(step.second, number)};
  }

  State state_at(const Rational& time) const override {
    require_not_negative(time);
    compute_until(time);
    const std::shared_lock lock(mutex_);
    const std::size_t count = steps_until(time);
    const Time now = to_time(time);
    State state{Integer(count), start_};
    for (std::size_t body = 0; body < state.bodies.size(); ++body) {
      const auto next = std::ranges::lower_bound(of_body_[body], count);
      state.bodies[body] = motion_at(body, now, next);
    }
    state.is_infinite = collapse_ && count == steps_.size();
    return state;
  }

  Integer count_at(const Rational& time) const override {
    if (time < 0) return 0;
    compute_until(time);
    const std::shared_lock lock(mutex_);
    return {steps_until(time)};
  }

  Rational time_after(const Integer& index) const override {
    const Rational time = exact_time(index);
    compute_until(time);
    const std::shared_lock lock(mutex_);
    std::size_t last = index.get_ui() - 1;
    while (last + 1 < steps_.size() && time_of(last + 1) <= time) ++last;
    require_last(index, Integer(last + 1));
    const bool has_next = last + 1 < steps_.size();
    return short_time(time, has_next ? std::optional(time_of(last + 1)) : std::nullopt);
  }

  std::vector<std::vector<PathPoint>> paths(const Rational& from, const Rational& to,
                                            std::size_t most) const override {
    require_not_negative(from);
    compute_until(to);
    const std::shared_lock lock(mutex_);
    const Interval interval{to_time(from), to_time(to), to_double(to - from), steps_until(from),
                            steps_until(to)};
    std::vector<std::vector<PathPoint>> paths;
    paths.reserve(of_body_.size());
    for (std::size_t body = 0; body < of_body_.size(); ++body) {
      paths.push_back(path(body, interval, most));
    }
    return paths;
  }

  bool is_exact(const Integer& index) const override {
    compute_up_to(index);
    const std::shared_lock lock(mutex_);
    return exact_times_.size() >= index;
  }
  std::optional<Integer> first_tie(const Integer& last) const override {
    compute_up_to(last);
    const std::shared_lock lock(mutex_);
    return first_tie_ && *first_tie_ <= last ? first_tie_ : std::nullopt;
  }
  std::optional<double> certain_until(const std::optional<Rational>& time) const override {
    compute([&] { return time ? is_computed_until(*time) : is_complete_; });
    const std::shared_lock lock(mutex_);
    const double end = time ? to_double(*time) : end_of_run();
    return certain_until_ && !(*certain_until_ > end) ? certain_until_ : std::nullopt;
  }
  std::optional<Collapse> collapse(const std::optional<Rational>& until) const override {
    const std::optional<Rational>& end = until ? until : horizon_;
    if (is_elastic_ || (!end && never_ends_)) return std::nullopt;
    compute([&] { return end ? is_computed_until(*end) : is_complete_; });
    const std::shared_lock lock(mutex_);
    return collapse_ && !(end && *end < to_rational(*collapse_->time)) ? collapse_ : std::nullopt;
  }

 private:
  static const Motion& after(const StoredStep& step, std::size_t body) {
    return step.first == body ? step.first_after : step.second_after;
  }
  /// @param next  the body's first step after that time
  Motion motion_at(std::size_t body, const Time& time, StepNumbers::const_iterator next) const {
    Motion motion = start_[body];
    Time since;
    if (next != of_body_[body].begin()) {
      const StoredStep& last = steps_[*std::prev(next)];
      motion = after(last, body);
      since = last.time;
    }
    return moved(motion, flight(since, time));
  }
  /// @param id  as in Collision
  std::array<double, 2> velocity_before(std::uint32_t id, std::uint32_t step) const {
    if (id >= of_body_.size()) return motion_at_start(system(), id).velocity;
    const auto own = std::ranges::lower_bound(of_body_[id], step);
    return motion_at(id, steps_[step].time, own).velocity;
  }

  struct Interval {
    Time from;
    Time to;
    double length = 0;
    std::size_t first = 0;  ///< the first step after `from`
    std::size_t last = 0;   ///< the first step after `to`
  };

  std::vector<PathPoint> path(std::size_t body, const Interval& interval, std::size_t most) const {
    const StepNumbers& own = of_body_[body];
    const auto begin = std::ranges::lower_bound(own, interval.first);
    const auto end = std::lower_bound(begin, own.end(), interval.last);
    const auto collisions = static_cast<std::size_t>(end - begin);
    std::vector<PathPoint> points;
    if (collisions > most) {
      auto next = begin;
      for (const double share : sample_times(most)) {
        const double after = share * interval.length;
        while (next != end && flight(interval.from, steps_[*next].time) <= after) ++next;
        const Time now{interval.from.hi, interval.from.lo + after};
        points.push_back({after, motion_at(body, now, next).position});
      }
      return points;
    }
    points.reserve(collisions + 2);
    points.push_back({0, motion_at(body, interval.from, begin).position});
    for (auto number = begin; number != end; ++number) {
      const StoredStep& step = steps_[*number];
      points.push_back({flight(interval.from, step.time), after(step, body).position});
    }
    points.push_back({interval.length, motion_at(body, interval.to, end).position});
    return points;
  }

  /// Steps until this is true, which asks under the lock.
  template <typename IsComputed>
  void compute(const IsComputed& is_computed) const {
    {
      const std::shared_lock lock(mutex_);
      if (is_computed()) return;
    }
    const std::unique_lock lock(mutex_);
    if (failure_) std::rethrow_exception(failure_);
    try {
      while (!is_computed()) {
        check_stop(stop_);
        add_step();
      }
    } catch (...) {
      failure_ = std::current_exception();  // the engine cannot go on from here
      throw;
    }
  }

  Rational exact_time(const Integer& index) const {
    compute_up_to(index);
    const std::shared_lock lock(mutex_);
    return time_of(index.get_ui() - 1);
  }

  void compute_up_to(const Integer& index) const {
    compute([&] { return is_complete_ || steps_.size() >= index; });
  }

  /// Unless the last step is later than that, or there are no more.
  void compute_until(const Rational& time) const {
    compute([&] { return is_computed_until(time); });
  }

  bool is_computed_until(const Rational& time) const {
    if (jam_ && time < to_rational(jam_->time)) return true;
    return is_complete_ || (!steps_.empty() && time_of(steps_.size() - 1) > time);
  }

  void add_step() const {
    if (jam_) {
      throw SimulationError(fmt::format(
          "bodies: {} and {} meet at t = {:.6g}, and neither can give way; end the run earlier",
          noun_of(system(), jam_->first), noun_of(system(), jam_->second), jam_->time.hi));
    }
    const std::optional<SteppedCollision> step = stepper_->step();
    note_certainty();
    is_complete_ = !step;
    if (is_complete_) return;
    if (is_immovable(system(), step->first) && is_immovable(system(), step->second)) {
      jam_ = step;
      return;
    }
    if (steps_.size() == static_cast<std::size_t>(kMaxSteppedCollisions)) {
      throw SimulationError(fmt::format(
          "bodies: more than {} collisions until time {:.6g}; show or count those until an earlier "
          "time, as --to {:.4g}",
          readable(to_integer(kMaxSteppedCollisions)), step->time.hi, step->time.hi * 0.9));
    }
    const auto number = static_cast<std::uint32_t>(steps_.size());
    if (step->exact_time) exact_times_.push_back(*step->exact_time);
    if (step->is_tied && !first_tie_) first_tie_ = Integer(number + 1);
    for (const std::uint32_t body : {step->first, step->second}) {
      if (body < of_body_.size()) of_body_[body].push_back(number);
    }
    steps_.push_back(*step);
    if (step->second >= of_body_.size()) {
      steps_.back().second_after = moved(motion_at_start(system(), step->second), step->time.hi);
    }
    if (!is_elastic_) find_collapse();
  }

  void find_collapse() const {
    const Time& now = steps_.back().time;
    const bool is_exact = exact_times_.size() == steps_.size();
    const double window = kCollapseWindow * std::max(now.hi, crossing_time_);
    const auto end = end_of_steps(system(), steps_, of_body_, window, is_exact);
    if (!end) return;
    if (end->is_collapse) collapse_ = Collapse{now, Integer(steps_.size()), end->bodies};
    certain_until_ = std::min(certain_until_.value_or(kForEver), now.hi);
    is_complete_ = true;
  }

  /// By then a run of which all is computed has ended, if rounding has not changed it: bodies that
  /// would still meet need far less time, those that drift by rounding errors far more.
  double end_of_run() const {
    const double last = steps_.empty() ? 0 : steps_.back().time.hi;
    return 0x1p30 * (last + crossing_time_);
  }

  /// All steps so far are certain if the new one is the first that is not.
  void note_certainty() const {
    const double until = stepper_->certain_until();
    if (certain_until_ || until == kForEver) return;
    certain_until_ = steps_.empty() ? until : std::max(until, steps_.back().time.hi);
  }

  /// The steps up to this time, which have been computed.
  std::size_t steps_until(const Rational& time) const {
    const auto has_happened = [&](const StoredStep& step) {
      return time_of(static_cast<std::size_t>(&step - steps_.data())) <= time;
    };
    const auto next = std::ranges::partition_point(steps_, has_happened);
    return static_cast<std::size_t>(next - steps_.begin());
  }

  Rational time_of(std::size_t step) const {
    return step < exact_times_.size() ? exact_times_[step] : to_rational(steps_[step].time);
  }

  std::stop_token stop_;
  mutable std::shared_mutex mutex_;
  std::unique_ptr<Stepper> stepper_;
  std::vector<Motion> start_;
  bool never_ends_;
  std::optional<Rational> horizon_;
  double crossing_time_;
  bool is_elastic_;
  mutable bool is_complete_ = false;
  mutable std::vector<StoredStep> steps_;
  mutable std::vector<Rational> exact_times_;  // of the first steps
  mutable std::vector<StepNumbers> of_body_;   // numbers of its steps
  mutable std::optional<Integer> first_tie_;
  mutable std::optional<double> certain_until_;
  mutable std::optional<Collapse> collapse_;
  mutable std::optional<SteppedCollision> jam_;  // of two that no collision moves
  mutable std::exception_ptr failure_;           // of the engine
};

}  // namespace

std::unique_ptr<Log> make_stepped_log(const System& system, const std::optional<Rational>& horizon,
                                      const std::stop_token& stop, Engine engine) {
  return std::make_unique<SteppedLog>(system, horizon, stop, engine);
}

}  // namespace piblocks
