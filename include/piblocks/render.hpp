// The whole program: a scene becomes a video, a sequence or a still.
// In: a scene and the name of an output. Out: the output, complete, or an exception and no
// trace of it.
#pragma once

#include <piblocks/frame_sink.hpp>
#include <piblocks/instant.hpp>
#include <piblocks/scene.hpp>

#include <cstdint>
#include <functional>
#include <stop_token>
#include <string>

namespace piblocks {

struct RenderJob {
  Scene scene;
  std::string output;  ///< as open_sink() takes it
  EncoderSettings encoder;
  int jobs = 1;  ///< frames painted and encoded at the same time, >= 1; does not change a byte
};

struct Progress {
  std::int64_t frames_done = 0;
  std::int64_t frame_count = 0;
};

/// Renders every frame of the scene's span of time.
/// @param on_progress  called by the calling thread: at the start, now and then, at the end.
/// @param stop         asks to give up: Interrupted is thrown soon after.
/// @return the number of frames.
/// @throws UsageError, DrawError, MediaError, IoError, SimulationError, Interrupted
std::int64_t render(const RenderJob& job, const std::function<void(const Progress&)>& on_progress,
                    const std::stop_token& stop = {});

/// Renders one instant to a `.png`, `.svg` or `.pdf` file, or to standard output as PNG for "-".
/// @param stop  asks to give up: Interrupted is thrown when the picture is drawn.
/// @throws UsageError, DrawError, MediaError, IoError, SimulationError, Interrupted
void render_still(const Scene& scene, const Instant& instant, const std::string& output,
                  const std::stop_token& stop = {});

}  // namespace piblocks
