// A film, from its frames to one output.
// In: a job whose output is a video, an animation, a sequence, hashes or sound. Out: that file.
#pragma once

#include <piblocks/render.hpp>

namespace piblocks {

/// render() of a job that is neither a bundle nor a page.
Rendered render_film(const RenderJob& job, const std::function<void(const Progress&)>& on_progress,
                     const std::stop_token& stop);

}  // namespace piblocks
