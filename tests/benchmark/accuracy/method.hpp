// A method of finding collisions and positions, as the benchmark sees it.
// In: the article's system and a question. Out: the answer, in the method's own number type.
// To add a method, derive from Method (or write a stepper, see event_loop.hpp) and name it in
// methods.cpp.
#pragma once

#include <piblocks/exact.hpp>
#include <piblocks/two_blocks.hpp>

#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "accuracy/deadline.hpp"
#include "accuracy/instants.hpp"
#include "accuracy/number.hpp"

namespace piblocks::benchmark {

enum class Question {
  whole_log,  ///< time and both positions of every collision
  instants,   ///< blue's position at given times
  count       ///< the number of collisions
};

/// What a row of the results is called.
struct Label {
  std::string method;
  std::string scalar;
  std::string parameter;  ///< step or tolerance, with its name; empty if there is none
};

/// One collision that was looked at.
struct LoggedEvent {
  std::int64_t index;  ///< from 1
  Reference time;
  Reference blue;  ///< position of the centre
  Reference red;
};

struct WholeLog {
  std::int64_t count = 0;  ///< of all collisions met
  std::vector<LoggedEvent> kept;
};

/// Const members are called again and again and timed, set-up included.
class Method {
 public:
  explicit Method(Label label) : label_(std::move(label)) {}
  virtual ~Method() = default;

  const Label& label() const noexcept { return label_; }
  virtual bool answers(Question) const { return true; }

  /// Computes every event, in order, and keeps those with an index in `wanted`, ascending.
  /// @throws NotRun
  virtual WholeLog whole_log(const TwoBlocks&, std::span<const std::int64_t> /*wanted*/,
                             const Deadline&) const {
    throw NotRun("not run: has no whole log");
  }
  /// Computes the events of `wanted` alone. Not timed: it shows the errors of logs too long for
  /// the budget. @throws NotRun by default: there is no way but through all events.
  virtual std::vector<LoggedEvent> single_events(const TwoBlocks&,
                                                 std::span<const std::int64_t> /*wanted*/) const {
    throw NotRun("not run: has no random access");
  }
  /// Blue's position at each of the instants, ascending. @throws NotRun
  virtual Numbers blue_at(const TwoBlocks& system, const Instants& instants,
                          const Deadline& deadline) const = 0;
  /// @throws NotRun
  virtual Integer count(const TwoBlocks& system, const Deadline& deadline) const = 0;

 private:
  Label label_;
};

using MethodPtr = std::unique_ptr<Method>;

}  // namespace piblocks::benchmark
