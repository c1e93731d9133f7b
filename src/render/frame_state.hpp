// What a frame is drawn from, as numbers.
// In: a log, and what a frame shows of time. Out: the FrameState of that frame.
#pragma once

#include "draw/composition.hpp"
#include "scene/schedule.hpp"

namespace piblocks {

/// When a picture is shown.
struct VideoTime {
  const Schedule& schedule;
  Rational video_s;  ///< >= 0
};

/// State, time, exposure, and what else is needed; no hits.
/// @param speed  of the video where nothing slows it down, in simulation time per second
FrameState frame_state(const Log& log, const FrameTime& shown, const FrameNeeds& needs,
                       const Rational& speed);

/// The same of a picture that is shown at this time of a video, with its hits if they are needed.
/// @throws SimulationError as the log's collision().
FrameState frame_state(const Log& log, const FrameTime& shown, const FrameNeeds& needs,
                       const Rational& speed, const VideoTime& video_time);

/// Adds the hits and their rate to what is shown at that time. A hit is a
/// change of the counter: forwards at the collision's time, backwards just after it. The state at
/// the scene's first instant includes collisions that are no hits.
/// @throws SimulationError as the log's collision().
void add_hits(FrameState& state, const Log& log, const VideoTime& video_time);

}  // namespace piblocks
