// The groups of measurements.
// In: a workbench. Out: rows of the results.
#pragma once

#include "speed/workbench.hpp"

namespace piblocks::benchmark {

/// The whole video, by the program and by what else a lecturer would use.
void measure_job(const Workbench& bench);
/// Both of the program's ways to an MP4, and ffmpeg's, at several sizes.
void measure_encoders(const Workbench& bench);
/// Numbered pictures, by the program and by the usual ways to write PNG.
void measure_png(const Workbench& bench);
/// Where the program's processor time goes.
void measure_stages(const Workbench& bench);
/// What digits, frame size, threads and duration do to time and memory.
void measure_scaling(const Workbench& bench);
/// What everything that a scene can ask for beside the blocks costs, and every format.
void measure_features(const Workbench& bench);

}  // namespace piblocks::benchmark
