// What render(), render_still() and render_sheet() are made of.
// In: a job or a scene. Out: files, or the draw lists that go into them.
#pragma once

#include <piblocks/instant.hpp>
#include <piblocks/render.hpp>
#include <piblocks/scene.hpp>
#include <piblocks/script.hpp>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <stop_token>
#include <string>
#include <vector>

#include "draw/draw_list.hpp"
#include "draw/montage.hpp"
#include "media/output/shard_file.hpp"
#include "render/film.hpp"

namespace piblocks {

/// The film of a job, which is made once: its runs are simulated then.
/// @throws UsageError if the job asks for a part and has none; as Film()
Film film_of(const RenderJob& job, const std::stop_token& stop);

/// render() of a job that is neither a bundle nor a page. @param film  of the job
/// @param sound  the film's, if several renderings read on in it; null for one of its own
/// @throws UsageError if a frame is not certain, before the first one; as render()
Rendered render_film(const RenderJob& job, const Film& film, const OnProgress& on_progress,
                     const std::stop_token& stop, FilmSound* sound = nullptr);

/// Renders frames of the job's film as the pages of a PDF file.
/// @throws UsageError if they are too many; as render()
Rendered render_pdf(const RenderJob& job, const Film& film, const FrameRange& frames,
                    const OnProgress& on_progress, const std::stop_token& stop);

/// What the bytes of a rendering depend on: the header of all its shards, without their number.
ShardHeader describe(const RenderJob& job, const Output& output, std::int64_t frame_count);

/// Whether this part has been rendered already, whole, with this header. A damaged one has not.
/// @throws UsageError naming what differs if the file is of another job.
bool has_shard(const std::string& path, const ShardHeader& header, const std::stop_token& stop);

/// Renders the job's video into the bundle's folder, with poster.png, captions.vtt, alt.txt,
/// latex.tex and reveal.html beside it; of a storyboard the video and the last picture of each
/// shot, chapters.vtt and impress.fodp, too.
/// @throws UsageError if the output is no MP4 by a plain name, or a part is asked for; as render()
Rendered render_bundle(const RenderJob& job, const OnProgress& on_progress,
                       const std::stop_token& stop);

/// The names of all these files, in the bundle's folder.
std::vector<std::string> bundle_files(const RenderJob& job);

/// For LaTeX beamer: a frame's content for a film of one segment, else a frame for each shot. Names
/// all files of the shots.
std::string latex_slides(const Film& film, const std::string& video);

/// A <section> of reveal.js for the film, or for each shot. The poster of a shot is the last
/// picture of the shot before, so that nothing flashes.
std::string reveal_slides(const Film& film, const std::string& video);

/// A flat OpenDocument presentation with a slide for each shot.
std::string impress_slides(const Film& film, const std::string& video);

/// join() of the shards of a silent MP4, to one with sound that was encoded elsewhere.
/// @param sound  of the whole film; null: it stays silent
Rendered join_with_sound(const std::vector<std::string>& parts, const std::string& output,
                         const std::shared_ptr<const CodedSound>& sound,
                         const std::stop_token& stop = {}, bool overwrite = false);

/// Whether an output of this name is a page: `*.html`.
bool is_page(const std::string& output);

/// Nobody knows how large a video becomes before it is written: call this now and then.
/// @param folder  with the video, whatever its name is while it is written
/// @throws UsageError if a page with this video is larger than browsers load.
void check_page_size(const std::string& page, const std::filesystem::path& folder,
                     const Progress& progress);

/// Renders the job's video as MP4, to the bytes that an output `*.mp4` would have, and the page
/// that holds it.
/// @throws UsageError if a part is asked for, or the background is transparent; as
///         check_page_size() and render()
Rendered render_page(const RenderJob& job, const OnProgress& on_progress,
                     const std::stop_token& stop);

/// What render_still() draws: for a scene what FilmRun::stills() draws, for a storyboard the frame
/// that frame_at() finds.
/// @throws SceneError if problems_of() the script is not empty; UsageError, DrawError, MediaError,
///         SimulationError, Interrupted
DrawList still_picture(const Script& script, const Instant& instant,
                       const std::stop_token& stop = {});

/// The same of a film that is there.
DrawList still_picture(const Film& film, const Instant& instant);

/// The bytes of a PNG file with the pixels of a frame. @throws DrawError, MediaError, Interrupted
std::vector<std::uint8_t> draw_png(const DrawList& list, const std::stop_token& stop);

/// Each picture is the still_picture() of its instant, with its time. @throws as still_picture();
/// Interrupted
std::vector<CaptionedPicture> sheet_pictures(const FilmRun& run,
                                             const std::vector<Instant>& instants,
                                             const OnProgress& on_progress = {},
                                             const std::stop_token& stop = {});

}  // namespace piblocks
