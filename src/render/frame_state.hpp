// What a frame is drawn from, as numbers.
// In: a log, and what a frame shows of time. Out: the FrameState of that frame.
#pragma once

#include <optional>

#include "draw/composition.hpp"
#include "scene/schedule.hpp"

namespace piblocks {

/// When a picture is shown.
struct VideoTime {
  const Schedule& schedule;
  Rational video_s;  ///< >= 0
};

/// State, time, exposure, and what else is needed. A hit is a change of the counter: forwards at
/// the collision's time, backwards just after it. The state at the scene's first instant includes
/// collisions that are no hits.
/// @param speed       of the video where nothing slows it down, in simulation time per second
/// @param video_time  of a picture in a video; without it there are no hits
/// @throws SimulationError as the log's collision().
FrameState frame_state(const Log& log, const FrameTime& shown, const FrameNeeds& needs,
                       const Rational& speed, const std::optional<VideoTime>& video_time = {});

}  // namespace piblocks
