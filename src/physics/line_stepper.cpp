#include <piblocks/error.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/two_sum.hpp"
#include "physics/exact_line.hpp"
#include "physics/stepper.hpp"
#include "physics/tournament.hpp"

namespace piblocks {
namespace {

constexpr double kUnitRoundoff = 0x1p-53;
/// Roundings of an advanced position, and of a velocity after a collision, with some to spare.
constexpr double kPositionRoundings = 6 * kUnitRoundoff;
constexpr double kVelocityRoundings = 12 * kUnitRoundoff;
/// Most that the time of a certain collision of a lossy system may be off, relative to all time
/// until then.
constexpr double kTimeError = 0x1p-20;
/// Makes up for the rounding of the bounds themselves.
constexpr double kSpare = 1 + 0x1p-40;
/// Doubts are predicted for errors so many times larger than those so far.
constexpr double kBudget = 8;

double inverse_mass(const LineElement& element) {
  return element.mass ? to_double(1 / *element.mass) : 0;
}

double factor_of(const LineElement& own, const LineElement& other, const Rational& restitution) {
  return to_double(
      velocity_change(Rational(1), share_of_change(own.mass, other.mass), restitution));
}

/// What no collision moves has no weight in the norms of errors.
double speed_rounding(const LineElement& element) {
  return element.mass ? 0 : 2 * kUnitRoundoff * std::fabs(to_double(element.velocity));
}

/// README.md, "Blocks on a line", derives the bound. Each element has its own clock; clocks count
/// from the instant at which the line begins.
class CertifiedLine final : public Stepper {
 public:
  CertifiedLine(std::span<const LineElement> elements, const Rational& begin, bool is_at_once)
      : pairs_(elements.size() - 1),
        next_(pairs_.size(), Earlier{*this}),
        begin_(to_time(begin)),
        is_at_once_(is_at_once) {
    for (const LineElement& exact : elements) {
      Element& element = elements_.emplace_back();
      element.id = exact.id;
      element.half_width = to_double(exact.half_width);
      element.position = to_double(exact.position_at(begin));
      element.velocity = to_double(exact.velocity);
      element.root_mass = exact.mass ? std::sqrt(to_double(*exact.mass)) : 0;
      element.is_movable = exact.mass.has_value();
      is_lossy_ = is_lossy_ || exact.restitution < 1;
      position_error_ += element.root_mass * kUnitRoundoff * std::fabs(element.position);
      velocity_error_ += element.root_mass * kUnitRoundoff * std::fabs(element.velocity);
    }
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      const LineElement& left = elements[i];
      const LineElement& right = elements[i + 1];
      Pair& pair = pairs_[i];
      pair.rank = rank_of(left, right);
      pair.left_factor = factor_of(left, right, left.restitution);
      pair.right_factor = factor_of(right, left, left.restitution);
      pair.gap_per_norm = kSpare * std::sqrt(inverse_mass(left) + inverse_mass(right));
      pair.speed_rounding = speed_rounding(left) + speed_rounding(right);
      // Exact numbers tell that they have just met, or are at rest beside each other.
      pair.has_met = left.position_at(begin) + left.half_width ==
                         right.position_at(begin) - right.half_width &&
                     left.velocity <= right.velocity;
    }
    position_budget_ = kBudget * position_error_;
    velocity_budget_ = kBudget * velocity_error_;
    predict_all();
  }

  std::optional<SteppedCollision> step() override {
    if (pairs_.empty()) return std::nullopt;
    for (;;) {
      const std::size_t pair = next_.winner();
      const double due = pairs_[pair].due;
      if (due == kNever) return std::nullopt;
      if (is_certain() && !move_bounds_to(due)) {
        predict_all();
        continue;
      }
      if (pairs_[pair].is_doubt) {
        end_certainty(due);
        continue;
      }
      if (is_certain() && pairs_[pair].gap_per_norm > 0) check_order(pair, due);
      advance(elements_[pair], due);
      advance(elements_[pair + 1], due);
      collide(pair);
      pairs_[pair].has_met = true;
      replay_around(pair);
      const auto motion = [&](const Element& e) {
        return Motion{{e.position + e.velocity * (due - e.since), 0}, {e.velocity, 0}};
      };
      const Time sum = two_sum(begin_.hi, due);
      const Element& left = elements_[pair];
      const Element& right = elements_[pair + 1];
      return step_of(two_sum(sum.hi, sum.lo + begin_.lo), left.id, motion(left), right.id,
                     motion(right));
    }
  }

  double certain_until() const override {
    if (is_certain()) return kForEver;
    return std::nextafter(begin_.hi, 0.0) + certain_until_ * (1 - 0x1p-50);
  }

 private:
  struct Element {
    std::uint32_t id = 0;
    double half_width = 0;
    double position = 0;
    double velocity = 0;
    double since = 0;      ///< clock of position
    double root_mass = 0;  ///< square root of the mass; 0 if no collision moves it
    bool is_movable = true;
  };
  /// Two neighbours.
  struct Pair {
    TieRank rank;
    double left_factor = 0;  ///< of the closing speed: by how much the left one's velocity changes
    double right_factor = 0;
    /// sqrt(1/m_left + 1/m_right): an error of norm E changes their gap by E times this at most.
    /// 0 if no collision moves them.
    double gap_per_norm = 0;
    double speed_rounding = 0;  ///< of the velocities that no collision changes
    bool has_met = false;       ///< and neither has met another since
    double due = kNever;        ///< clock of what comes next
    bool is_doubt = false;      ///< not a collision, but the earliest that there might be one
  };
  /// A gap, and how fast it closes.
  struct Approach {
    double clock = 0;
    double gap = 0;
    double rounding = 0;  ///< of the gap
    double closing = 0;
  };
  struct Earlier {
    const CertifiedLine& line;
    bool operator()(std::size_t a, std::size_t b) const {
      const Pair& first = line.pairs_[a];
      const Pair& second = line.pairs_[b];
      if (first.due != second.due) return first.due < second.due;
      return first.due < kNever && first.rank < second.rank;
    }
  };
  static constexpr double kNever = piblocks::kForEver;

  bool is_certain() const noexcept { return certain_until_ == kNever; }
  Approach approach(std::size_t pair) const {
    const Element& left = elements_[pair];
    const Element& right = elements_[pair + 1];
    const double clock = std::max(left.since, right.since);
    const double left_way = left.velocity * (clock - left.since);
    const double right_way = right.velocity * (clock - right.since);
    const double widths = left.half_width + right.half_width;
    const double largest = std::fabs(left.position) + std::fabs(left_way) +
                           std::fabs(right.position) + std::fabs(right_way) + widths;
    const double gap = ((right.position - left.position) + (right_way - left_way)) - widths;
    return {clock, gap, kPositionRoundings * largest, left.velocity - right.velocity};
  }
  /// The earliest clock at which the two may meet.
  double earliest(std::size_t pair, const Approach& approach) const {
    const Pair& p = pairs_[pair];
    if (p.has_met || p.gap_per_norm == 0) return kNever;
    const double speed_error = velocity_budget_ * p.gap_per_norm + p.speed_rounding +
                               kVelocityRoundings * std::fabs(approach.closing);
    const double closing = approach.closing + speed_error;
    if (!(closing > 0)) return kNever;
    const double gap = approach.gap - approach.rounding - position_budget_ * p.gap_per_norm;
    return approach.clock + std::max(0.0, gap) / (closing * kSpare);
  }
  void predict(std::size_t pair) {
    Pair& p = pairs_[pair];
    const Approach now = approach(pair);
    p.is_doubt = false;
    p.due = kNever;
    const std::optional<double> wait = time_to_contact(now.gap, now.closing);
    if (!p.has_met && wait) {
      p.due = now.clock + *wait;
    } else if (is_certain()) {
      p.due = earliest(pair, now);
      p.is_doubt = p.due < kNever;
    }
    if (std::isnan(p.due)) {
      throw SimulationError("bodies: the time of a collision is out of the range of a double");
    }
  }
  void replay_around(std::size_t pair) {
    for (std::size_t other = pair > 0 ? pair - 1 : 0;
         other <= std::min(pair + 1, pairs_.size() - 1); ++other) {
      if (other != pair) pairs_[other].has_met = false;
      predict(other);
      next_.replay(other);
    }
  }
  void predict_all() {
    for (std::size_t pair = 0; pair < pairs_.size(); ++pair) predict(pair);
    next_.replay_all();
  }
  void end_certainty(double clock) {
    certain_until_ = std::min(certain_until_, std::max(0.0, clock));
    predict_all();
  }
  /// Errors grow with the time of flight. Doubts have to be predicted anew once they have outgrown
  /// what these were predicted with. @return whether that still holds.
  bool move_bounds_to(double clock) {
    const double elapsed = std::max(0.0, clock - clock_);
    position_error_ = (position_error_ + velocity_error_ * elapsed) * kSpare;
    clock_ = std::max(clock_, clock);
    if (position_error_ <= position_budget_ && velocity_error_ <= velocity_budget_) return true;
    position_budget_ = kBudget * position_error_;
    velocity_budget_ = kBudget * velocity_error_;
    return false;
  }
  /// Ends certainty unless these two truly meet now, before either can meet another.
  void check_order(std::size_t pair, double clock) {
    const Pair& p = pairs_[pair];
    const Approach now = approach(pair);
    const double flight = clock - now.clock;
    const double rest = std::fabs(now.gap - now.closing * flight) + now.rounding +
                        p.speed_rounding * flight + kVelocityRoundings * std::fabs(now.gap);
    const double gap_error = position_error_ * p.gap_per_norm + rest;
    const double slowest = now.closing - velocity_error_ * p.gap_per_norm - p.speed_rounding -
                           kVelocityRoundings * now.closing;
    if (!(slowest > 0)) return end_certainty(earliest(pair, now));
    const double tolerance = gap_error / slowest * kSpare + kPositionRoundings * clock;
    double other = kNever;
    if (pair > 0) other = std::min(other, earliest(pair - 1, approach(pair - 1)));
    if (pair + 1 < pairs_.size()) other = std::min(other, earliest(pair + 1, approach(pair + 1)));
    const bool is_vague = is_lossy_ && tolerance > kTimeError * (begin_.hi + clock);
    const bool is_next_stage = is_at_once_ && flight <= tolerance;
    if (is_vague || is_next_stage || other <= clock + tolerance) {
      return end_certainty(std::min(clock - tolerance, other));
    }
    // Reflected while a rest of the gap is left, they are off by twice this rest at most.
    position_error_ += 2 * rest / p.gap_per_norm * kSpare;
  }
  void advance(Element& element, double clock) {
    // Its place is rounded once as long as it stays the product of velocity and time.
    if (!element.is_movable && element.velocity != 0) return;
    const double way = element.velocity * (clock - element.since);
    position_error_ += element.root_mass * kPositionRoundings *
                       (std::fabs(element.position) + std::fabs(way)) * kSpare;
    element.position += way;
    element.since = clock;
  }
  void collide(std::size_t pair) {
    Element& left = elements_[pair];
    Element& right = elements_[pair + 1];
    const double closing = left.velocity - right.velocity;
    velocity_error_ += (left.root_mass + right.root_mass) * kVelocityRoundings *
                       (std::fabs(left.velocity) + std::fabs(right.velocity)) * kSpare;
    left.velocity -= closing * pairs_[pair].left_factor;
    right.velocity += closing * pairs_[pair].right_factor;
    if (!std::isfinite(left.velocity) || !std::isfinite(right.velocity) ||
        !std::isfinite(left.position) || !std::isfinite(right.position)) {
      throw SimulationError("bodies: a position or velocity is out of the range of a double");
    }
  }

  std::vector<Element> elements_;
  std::vector<Pair> pairs_;
  Tournament<Earlier> next_;
  Time begin_;
  double clock_ = 0;
  double certain_until_ = kNever;  // on the clock
  bool is_lossy_ = false;
  bool is_at_once_;
  // Norms of the errors of all positions and of all velocities, each weighted by the root of its
  // mass; and the larger ones that doubts have been predicted with.
  double position_error_ = 0;
  double velocity_error_ = 0;
  double position_budget_ = 0;
  double velocity_budget_ = 0;
};

/// Exact as long as its numbers are short and its steps not too many.
class LineStepper final : public Stepper {
 public:
  explicit LineStepper(const System& system)
      : is_at_once_(are_at_once(system)), exact_(std::in_place, system) {}

  std::optional<SteppedCollision> step() override {
    if (certified_) return certified_->step();
    std::optional<SteppedCollision> step = exact_->step();
    const bool is_long = ++steps_ >= kMaxExactCollisions || exact_->bits() > kMaxExactBits;
    if (is_long && !exact_->is_within_stage()) {
      certified_ = make_certified_line(exact_->elements(), exact_->time(), is_at_once_);
      exact_.reset();
    }
    return step;
  }

  double certain_until() const override {
    return certified_ ? certified_->certain_until() : kForEver;
  }

 private:
  bool is_at_once_;
  std::optional<ExactLine> exact_;  // one of the two
  std::unique_ptr<Stepper> certified_;
  std::int64_t steps_ = 0;
};

}  // namespace

std::unique_ptr<Stepper> make_certified_line(std::span<const LineElement> elements,
                                             const Rational& begin, bool is_at_once) {
  return std::make_unique<CertifiedLine>(elements, begin, is_at_once);
}

std::unique_ptr<Stepper> make_line_stepper(const System& system) {
  return std::make_unique<LineStepper>(system);
}

}  // namespace piblocks
