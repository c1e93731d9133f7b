// How a scene is paced: slow motion, eases and freezes as plain intervals of simulation time.
// In: a scene, its log, the span that is shown. Out: moves in order, without gaps.
#pragma once

#include <piblocks/scene.hpp>
#include <piblocks/two_blocks.hpp>

#include <vector>

#include "scene/schedule.hpp"

namespace piblocks {

/// Even motion from one time to another, or a freeze, before its speed is known.
struct Move {
  Rational from;
  Rational to;  ///< the same as `from` for a freeze
  Rational slowdown = 1;
  Rational frozen_s = 0;
};

/// time_of(instant, log) for the value of a key, which messages name.
/// @param item  that it is of, as in Problem
Rational time_of(const Instant& instant, const char* key, const Log& log,
                 const std::string& item = {});

/// The speed that windows and eases are measured by. A duration sets the speed once they are known,
/// and scales them.
Rational nominal_speed(const Scene& scene);

/// The length rounded up to whole frames.
Rational whole_frames(const Rational& length_s, const Rational& frame_rate);

/// The moves that fill the span.
/// @throws UsageError as time_of(); if windows of slow motion overlap, or do not end after they
///         begin; if a window or a freeze that the scene names is outside of the span.
std::vector<Move> moves_of(const Scene& scene, const Log& log, const Span& span);

}  // namespace piblocks
