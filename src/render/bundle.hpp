// A video with what a lecture needs beside it: poster, captions, words, and how to show them.
// In: a job with a bundle. Out: the files, all of them, or no trace of them.
#pragma once

#include <piblocks/render.hpp>

#include <functional>
#include <stop_token>
#include <string>
#include <vector>

namespace piblocks {

/// Renders the job's video into the bundle's folder, with poster.png, captions.vtt, alt.txt,
/// latex.tex and reveal.html beside it.
/// @throws UsageError if the output is no MP4 by a plain name, or a part is asked for; as render()
Rendered render_bundle(const RenderJob& job,
                       const std::function<void(const Progress&)>& on_progress,
                       const std::stop_token& stop);

/// The names of all these files, in the bundle's folder.
std::vector<std::string> bundle_files(const RenderJob& job);

}  // namespace piblocks
