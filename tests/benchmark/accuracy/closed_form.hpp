// Closed forms in any number type: each event and each state by itself, without those before it.
// In: a TwoBlocks in which red comes to meet a resting blue. Out: Methods.
//
// Notation of src/physics/README.md. With blue at rest the phase is 0 in the infinite past and
// pi/theta in the infinite future. A formula is made from a TwoBlocks and has
//   Event event(std::int64_t k)    time and positions of collision k
//   Scalar blue_at(double time)    blue's position
//   std::int64_t count()           the number of collisions
#pragma once

#include <cmath>

#include "accuracy/log_writer.hpp"
#include "accuracy/method.hpp"

namespace piblocks::benchmark {

/// What both formulas start from, rounded once each.
template <typename Number>
class Unfolding {
 public:
  using Scalar = Number;
  struct Event {
    Scalar time;
    Scalar blue;
    Scalar red;
  };

  explicit Unfolding(const TwoBlocks& system) {
    const Rational ratio = system.blue.mass / system.red.mass;
    const Rational y1 = system.blue_gap();
    const Rational y2 = y1 + system.blocks_gap();
    const Rational& u2 = system.red.velocity;
    const Reference exact_sigma = sqrt(to_reference(ratio));
    const Reference exact_theta = atan(exact_sigma);
    const Reference exact_phase = boost::math::constants::pi<Reference>() / exact_theta;
    sigma = static_cast<Scalar>(exact_sigma);
    theta = static_cast<Scalar>(exact_theta);
    whole = static_cast<std::int64_t>(floor(exact_phase));
    fraction = static_cast<Scalar>(Reference(exact_phase - floor(exact_phase)));
    speed = to_scalar<Scalar>(abs(u2));
    impact = static_cast<Scalar>(Reference(exact_sigma * to_reference(y1)));
    turn = to_scalar<Scalar>(-y2 / u2);
    blue_corner = to_scalar<Scalar>(system.wall_face + system.blue.width / 2);
    red_corner = to_scalar<Scalar>(system.wall_face + system.blue.width + system.red.width / 2);
  }

  /// Collision k, at this distance of the line from the corner.
  Event event_at(std::int64_t k, const Scalar& time, const Scalar& distance) const {
    using std::cos;
    if (k % 2 == 0) return {time, blue_corner, red_corner + distance};
    const Scalar y = distance * cos(theta);
    return {time, blue_corner + y, red_corner + y};
  }
  /// Blue's position where the line is so far beyond its turn.
  /// @param is_odd  the ray before the phase
  Scalar blue_beyond(const Scalar& along, const Scalar& phase, const Scalar& ray,
                     bool is_odd) const {
    using std::sin;
    using std::sqrt;
    const Scalar angle = (is_odd ? ray + 1 - phase : phase - ray) * theta;
    return blue_corner + sqrt(impact * impact + along * along) * sin(angle) / sigma;
  }

  Scalar sigma;
  Scalar theta;
  Scalar speed;        // |V|
  Scalar impact;       // b
  Scalar turn;         // t_c
  std::int64_t whole;  // of pi/theta
  Scalar fraction;
  Scalar blue_corner;  // x_blue - y1
  Scalar red_corner;   // x_red - y2
};

/// As one writes it down: every angle is counted from the infinite past, k theta. Its rounding
/// error grows with k.
template <typename Number>
class OneSided : private Unfolding<Number> {
  using Base = Unfolding<Number>;

 public:
  using Base::Base;
  using typename Base::Event;
  using typename Base::Scalar;

  Event event(std::int64_t k) const {
    using std::cos;
    using std::sin;
    const Scalar angle = Scalar(k) * this->theta;
    const Scalar s = sin(angle);
    return this->event_at(k, this->turn - this->impact / this->speed * cos(angle) / s,
                          this->impact / s);
  }

  Scalar blue_at(double time) const {
    using std::atan2;
    using std::floor;
    const Scalar along = this->speed * (time - this->turn);
    const Scalar phase = atan2(this->impact, Scalar(-along)) / this->theta;
    const Scalar ray = floor(phase);
    return this->blue_beyond(along, phase, ray, static_cast<std::int64_t>(ray) % 2 != 0);
  }

  std::int64_t count() const {
    using std::ceil;
    const auto pi = boost::math::constants::pi<Scalar>();
    return static_cast<std::int64_t>(ceil(Scalar(pi / this->theta))) - 1;
  }
};

/// The program's formula, bare: angles are counted from the nearer end of time, and pi/theta has
/// been split in multiple precision.
template <typename Number>
class TwoSided : private Unfolding<Number> {
  using Base = Unfolding<Number>;

 public:
  using Base::Base;
  using typename Base::Event;
  using typename Base::Scalar;

  Event event(std::int64_t k) const {
    using std::cos;
    using std::sin;
    const bool late = k > this->whole - k;
    const Scalar to_go = late ? Scalar(this->whole - k) + this->fraction : Scalar(k);
    const Scalar angle = to_go * this->theta;
    const Scalar s = sin(angle);
    const Scalar tau = this->impact / this->speed * cos(angle) / s;
    const Scalar time = late ? this->turn + tau : this->turn - tau;
    return this->event_at(k, time, this->impact / s);
  }

  Scalar blue_at(double time) const {
    using std::atan2;
    using std::floor;
    const Scalar along = this->speed * (time - this->turn);
    const bool late = along >= 0;
    const Scalar to_go = atan2(this->impact, late ? along : Scalar(-along)) / this->theta;
    const Scalar phase = late ? this->fraction - to_go : to_go;
    const Scalar ray = floor(phase);
    const bool odd = (static_cast<std::int64_t>(ray) + (late ? this->whole : 0)) % 2 != 0;
    return this->blue_beyond(along, phase, ray, odd);
  }

  /// A ray that is reached only at infinity does not count.
  std::int64_t count() const { return this->fraction > 0 ? this->whole : this->whole - 1; }
};

template <typename Formula>
class ClosedForm final : public Method {
 public:
  using Scalar = typename Formula::Scalar;
  using Method::Method;

  WholeLog whole_log(const TwoBlocks& system, std::span<const std::int64_t> wanted,
                     const Deadline& deadline) const override {
    const Formula formula(system);
    LogWriter<Scalar> writer(wanted, deadline);
    const std::int64_t count = formula.count();
    for (std::int64_t k = 1; k <= count; ++k) {
      const auto event = formula.event(k);
      writer.push(event.time, event.blue, event.red);
    }
    return writer.finish();
  }

  std::vector<LoggedEvent> single_events(const TwoBlocks& system,
                                         std::span<const std::int64_t> wanted) const override {
    const Formula formula(system);
    std::vector<LoggedEvent> events;
    for (const std::int64_t k : wanted) {
      const auto event = formula.event(k);
      events.push_back({k, Reference(event.time), Reference(event.blue), Reference(event.red)});
    }
    return events;
  }

  Numbers blue_at(const TwoBlocks& system, const Instants& instants,
                  const Deadline&) const override {
    const Formula formula(system);
    std::vector<Scalar> blue;
    blue.reserve(instants.seconds.size());
    for (const double time : instants.seconds) blue.push_back(formula.blue_at(time));
    return blue;
  }

  Integer count(const TwoBlocks& system, const Deadline&) const override {
    return Formula(system).count();
  }
};

template <typename Formula>
MethodPtr closed_form(const std::string& method) {
  return std::make_unique<ClosedForm<Formula>>(
      Label{method, kScalarName<typename Formula::Scalar>, ""});
}

}  // namespace piblocks::benchmark
