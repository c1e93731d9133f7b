// Every way of going from collision to collision is a stepper; this makes a Method of it.
// In: a stepper. Out: its whole log, its positions at given times, its count.
//
// A stepper has a number type Stepper::Scalar, is made from a TwoBlocks in which red comes to
// meet a resting blue, and has
//   Flight<Scalar> start()                the motion before the first collision
//   bool next(Flight<Scalar>& flight)     the motion after the next collision; false at the end
#pragma once

#include <functional>

#include "accuracy/log_writer.hpp"
#include "accuracy/method.hpp"

namespace piblocks::benchmark {

/// Uniform motion from `time` on: positions of the centres then, and velocities.
template <typename Scalar>
struct Flight {
  Scalar time;
  Scalar blue;
  Scalar red;
  Scalar blue_velocity;
  Scalar red_velocity;
};

template <typename Scalar>
Flight<Scalar> start_of(const TwoBlocks& system) {
  return {Scalar(0), to_scalar<Scalar>(system.blue.position),
          to_scalar<Scalar>(system.red.position), to_scalar<Scalar>(system.blue.velocity),
          to_scalar<Scalar>(system.red.velocity)};
}

template <typename Stepper>
class EventLoop final : public Method {
 public:
  using Scalar = typename Stepper::Scalar;
  using MakeStepper = std::function<Stepper(const TwoBlocks&)>;

  EventLoop(Label label, MakeStepper make) : Method(std::move(label)), make_(std::move(make)) {}

  WholeLog whole_log(const TwoBlocks& system, std::span<const std::int64_t> wanted,
                     const Deadline& deadline) const override {
    Stepper stepper = make_(system);
    LogWriter<Scalar> writer(wanted, deadline);
    Flight<Scalar> flight = stepper.start();
    while (stepper.next(flight)) writer.push(flight.time, flight.blue, flight.red);
    return writer.finish();
  }

  Numbers blue_at(const TwoBlocks& system, const Instants& instants,
                  const Deadline& deadline) const override {
    Stepper stepper = make_(system);
    Flight<Scalar> flight = stepper.start();
    Flight<Scalar> next = flight;
    bool more = stepper.next(next);
    std::vector<Scalar> blue;
    blue.reserve(instants.seconds.size());
    for (std::uint32_t steps = 0; const double time : instants.seconds) {
      while (more && next.time <= time) {
        flight = next;
        more = stepper.next(next);
        if (++steps % kStepsPerCheck == 0) deadline.check();
      }
      blue.push_back(flight.blue + flight.blue_velocity * (time - flight.time));
    }
    return blue;
  }

  Integer count(const TwoBlocks& system, const Deadline& deadline) const override {
    Stepper stepper = make_(system);
    Flight<Scalar> flight = stepper.start();
    std::int64_t events = 0;
    while (stepper.next(flight)) {
      if (++events % kStepsPerCheck == 0) deadline.check();
    }
    return events;
  }

 private:
  static constexpr std::uint32_t kStepsPerCheck = 1 << 14;

  MakeStepper make_;
};

template <typename Stepper>
MethodPtr event_loop(const std::string& method, const std::string& parameter = "") {
  return std::make_unique<EventLoop<Stepper>>(
      Label{method, kScalarName<typename Stepper::Scalar>, parameter},
      [](const TwoBlocks& system) { return Stepper(system); });
}

}  // namespace piblocks::benchmark
