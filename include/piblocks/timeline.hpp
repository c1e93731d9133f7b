// The collisions of a run by index and by time, whatever collides.
// In: the logs of run.hpp and bodies.hpp. Out: how many collisions there are until a time, and when
// each happens.
#pragma once

#include <piblocks/exact.hpp>

#include <optional>
#include <utility>

namespace piblocks {

/// Collisions from time 0 on have the indices 1, 2, …, size(), those before time 0 the indices 0,
/// -1, … down to first_index(). Const members are thread-safe.
class Timeline {
 public:
  Timeline() = default;
  virtual ~Timeline() = default;
  Timeline(const Timeline&) = delete;
  Timeline& operator=(const Timeline&) = delete;

  /// Number of collisions from time 0 on, and the index of the last of all time.
  const Integer& size() const noexcept { return size_; }
  /// Index of the first collision of all time; 1 if there are none before time 0.
  const Integer& first_index() const noexcept { return first_index_; }
  /// Index of the last collision until then. A collision exactly at `time` has happened. The logs
  /// of bodies, which begin at time 0, say 0 for earlier times.
  virtual Integer count_at(const Rational& time) const = 0;
  /// When the collision happens, first_index() <= index <= size(), to two doubles.
  /// @throws SimulationError if that is beyond the range of a double.
  virtual Time collision_time(const Integer& index) const = 0;
  /// Whether collisions may go on for ever, size() being those until some time.
  virtual bool may_go_on() const { return false; }
  /// A time at which exactly the collisions up to this one have happened: that of the collision if
  /// its exact value is short, otherwise one so little later that no picture can show the
  /// difference. first_index() <= index <= size().
  /// @throws UsageError if the next collision happens at the same time.
  /// @throws SimulationError if a stepping engine cannot tell the two times apart.
  virtual Rational time_after(const Integer& index) const = 0;
  /// When collisions are densest, if the run has such an instant: as turn_of().
  virtual std::optional<Rational> turn() const = 0;

 protected:
  void set_range(Integer first_index, Integer size) {
    first_index_ = std::move(first_index);
    size_ = std::move(size);
  }

 private:
  Integer first_index_ = 1;
  Integer size_ = 0;
};

}  // namespace piblocks
