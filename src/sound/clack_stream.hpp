// Which clacks a film has, and at which sample.
// In: a collision log and the stretches of the film. Out: clacks, ordered to an eighth of a sample.
// Where collisions are denser than samples, those of an eighth of a sample are one clack.
#pragma once

#include <piblocks/two_blocks.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "scene/schedule.hpp"

namespace piblocks {

struct Clack {
  double sample = 0;  ///< samples since the film began, with a fraction
  CollisionKind kind = CollisionKind::blocks;
  double impulse = 0;   ///< as Impact has it, in impulse_unit()
  double position = 0;  ///< as Impact has it
};

/// Takes the same memory for a film of any length. Used by one thread at a time.
class ClackStream {
 public:
  ClackStream(const Log& log, std::span<const Stretch> stretches, const Rational& duration_s,
              int rate_hz);

  /// Appends the clacks before this sample that were not read yet. None is more than an eighth of a
  /// sample earlier than the one before it. @throws SimulationError as PairLog::state_at().
  void read_until(std::int64_t sample, std::vector<Clack>& clacks);

 private:
  /// A stretch in samples.
  struct SampleStretch {
    double begin = 0;  ///< sample at which simulation time is `time`
    double end = 0;
    Time time;
    Rational begin_time;
    Rational end_time;
    double time_per_sample = 0;  ///< may be negative
    bool continues = false;      ///< begins where the one before ends

    Time time_at(double sample) const;
    double sample_at(const Time& t) const;
  };
  /// From one sample to another, with the counts of collisions at both.
  struct Piece {
    double begin;
    double end;
    Integer count_at_begin;
    Integer count_at_end;
  };

  void add_first_instant(std::span<const Stretch> stretches, int rate_hz);
  const SampleStretch& stretch() const { return stretches_[current_]; }
  void enter_stretch();
  Integer count_at(double sample) const;
  Integer count_at_end(double end, bool is_last) const;
  void add(const Piece& piece, std::vector<Clack>& clacks) const;
  void add_one_by_one(const Piece& piece, std::vector<Clack>& clacks) const;
  void add_impacts(const Integer& first, const Integer& last, const Piece& piece,
                   std::vector<Clack>& clacks) const;

  const Log& log_;
  double impulse_unit_;
  std::vector<SampleStretch> stretches_;
  std::size_t current_ = 0;
  double sample_ = 0;
  Integer count_;
};

}  // namespace piblocks
