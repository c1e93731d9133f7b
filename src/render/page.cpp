#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/descriptor.hpp"
#include "core/file_set.hpp"
#include "core/stop.hpp"
#include "core/text.hpp"
#include "render/page_source.hpp"
#include "render/renderings.hpp"
#include "render/step_clock.hpp"
#include "render/video_text.hpp"

namespace piblocks {
namespace {

namespace fs = std::filesystem;

/// Read and written at once. Three bytes are four letters of base64.
constexpr std::size_t kPiece_bytes = std::size_t{3} << 14;

/// Nothing is fetched, nothing is sent, no other script runs.
constexpr std::string_view kHead = R"(<!DOCTYPE html>
<html lang="en">
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; media-src data:; img-src data:; script-src 'sha256-{script_hash}'; style-src 'sha256-{style_hash}'; base-uri 'none'; form-action 'none'">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{title}</title>
<style>{style}</style>
<main>
<h1>{title}</h1>
<video id="video" width="{width}" height="{height}" data-rate="{rate}" data-frames="{frames}" controls {loop}playsinline preload="auto" poster="{poster}" aria-label="{title}" aria-describedby="description" src="data:video/mp4;base64,)";

constexpr std::string_view kFoot = R"(">
<track kind="captions" srclang="en" label="English" src="{captions}">
{chapters}</video>
<p id="problem" role="alert"></p>
<div id="steps" role="group" aria-label="Frames" hidden>
<button id="previous-frame" type="button" aria-keyshortcuts=",">&minus; frame</button>
<button id="next-frame" type="button" aria-keyshortcuts=".">+ frame</button>
<span id="frame"></span>
</div>
<div id="chapters" role="group" aria-label="Chapters" hidden></div>
<p id="description">{description}</p>
</main>
<script>{script}</script>
)";

void check_page(const RenderJob& job) {
  if (job.shard) {
    throw UsageError(fmt::format(
        "part: there are no parts of page '{}'; render it whole, or the parts of an MP4",
        job.output));
  }
  if (view_of(job.script).background == Background::transparent) {
    throw UsageError(fmt::format(
        "output: '{}' cannot be transparent: a page shows an MP4; use an opaque background",
        job.output));
  }
  const std::string problem = problem_of_replacing(follow_links(job.output));
  if (!problem.empty()) {
    throw UsageError(fmt::format("output: cannot open '{}': {}", job.output, problem));
  }
}

/// Chromium and Firefox take addresses of at most 2^29 characters, four for three bytes.
constexpr std::uintmax_t kMostVideo_bytes = 400'000'000;

/// Piece by piece, however long the video is.
void add_video(const fs::path& path, OutputFile& page) {
  std::ifstream video(path, std::ios::binary);
  std::vector<std::uint8_t> piece(kPiece_bytes);
  while (video) {
    video.read(reinterpret_cast<char*>(piece.data()), kPiece_bytes);
    page.write(base64(std::span(piece).first(static_cast<std::size_t>(video.gcount()))));
  }
  if (video.eof()) return;
  throw IoError(fmt::format("page: cannot read '{}': {}", path.string(), error_text(errno)));
}

void write_page(const Film& film, const fs::path& video, OutputFile& page,
                const std::stop_token& stop) {
  const View& view = film.view();
  const Rational& rate = view.frame_rate;
  page.write(fmt::format(
      kHead, fmt::arg("script_hash", kPageScriptHash), fmt::arg("style_hash", kPageStyleHash),
      fmt::arg("style", kPageStyle), fmt::arg("title", escaped(title_of(film))),
      fmt::arg("width", view.width_px), fmt::arg("height", view.height_px),
      fmt::arg("rate", rate.get_num().get_str() + "/" + rate.get_den().get_str()),
      fmt::arg("frames", film.frame_count()), fmt::arg("loop", loop_attribute(film)),
      fmt::arg("poster", data_address("image/png", draw_png(film.frame(0), stop)))));
  add_video(video, page);
  const std::string chapter_track =
      film.segments().size() == 1
          ? ""
          : fmt::format("<track kind=\"chapters\" srclang=\"en\" label=\"Chapters\" src=\"{}\">\n",
                        data_address("text/vtt", chapters(film)));
  page.write(fmt::format(kFoot, fmt::arg("chapters", chapter_track),
                         fmt::arg("captions", data_address("text/vtt", captions(film))),
                         fmt::arg("description", escaped(describe_film(film))),
                         fmt::arg("script", kPageScript)));
}

}  // namespace

void check_page_size(const std::string& page, const fs::path& folder, const Progress& progress) {
  std::uintmax_t size = 0;
  std::error_code gone;  // a file that takes its name has gone for a moment
  for (const fs::path& file : entries_of(folder, gone)) {
    std::error_code unknown;
    const bool is_file = fs::is_regular_file(file, unknown);
    const std::uintmax_t bytes = is_file ? fs::file_size(file, unknown) : 0;
    if (!unknown) size += bytes;
  }
  if (size <= kMostVideo_bytes) return;
  throw UsageError(
      fmt::format("page: '{}' is too large after {} of {} frames: browsers play at most {} MB of "
                  "video inside a "
                  "page; write an MP4, perhaps with --bundle, or choose a smaller size",
                  page, progress.frames_done, progress.frame_count, kMostVideo_bytes / 1'000'000));
}

bool is_page(const std::string& output) { return has_ending(output, ".html"); }

Rendered render_page(const RenderJob& job, const OnProgress& on_progress,
                     const std::stop_token& stop) {
  check_page(job);
  const Film film = film_of(job, stop);
  const fs::path path = follow_links(job.output);
  FileSet files(path.parent_path(), path.filename(), Unfinished::Sharing::shared);
  OutputFile page(files.add(path.filename()));
  RenderJob video = job;
  video.output = files.temporary_folder() / "video.mp4";
  const auto report = [&](const Progress& progress) {
    check_page_size(job.output, files.temporary_folder(), progress);
    on_progress(progress);
  };
  Rendered rendered = render_film(video, film, report, stop);
  check_page_size(job.output, files.temporary_folder(),
                  {rendered.frame_count, rendered.frame_count});
  StepClock clock(job.profile, Step::write);
  write_page(film, video.output, page, stop);
  check_stop(stop);
  page.finish();
  files.commit();
  if (job.profile)
    add(rendered.profile, {clock.spent(), processor_seconds(CLOCK_PROCESS_CPUTIME_ID)});
  return rendered;
}

}  // namespace piblocks
