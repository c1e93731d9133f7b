// A video as a page, to be stepped through by time and by collision.
// In: a job whose output is a page. Out: one HTML file that asks for nothing else, or no trace of
// it.
#pragma once

#include <piblocks/render.hpp>

#include <functional>
#include <stop_token>
#include <string>

namespace piblocks {

/// Whether an output of this name is a page: `*.html`.
bool is_page(const std::string& output);

/// Renders the job's video as MP4, to the bytes that an output `*.mp4` would have, and the page
/// that holds it.
/// @throws UsageError if a part is asked for or nothing is behind the blocks; as render()
Rendered render_page(const RenderJob& job, const std::function<void(const Progress&)>& on_progress,
                     const std::stop_token& stop);

}  // namespace piblocks
