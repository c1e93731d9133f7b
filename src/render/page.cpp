#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/run.hpp>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <memory>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "core/descriptor.hpp"
#include "core/output_file.hpp"
#include "core/text.hpp"
#include "render/page_source.hpp"
#include "render/renderings.hpp"
#include "render/step_clock.hpp"
#include "render/video_facts.hpp"
#include "scene/run_log.hpp"
#include "scene/schedule.hpp"

namespace piblocks {
namespace {

namespace fs = std::filesystem;

/// Read and written at once. Three bytes are four letters of base64.
constexpr std::size_t kPiece_bytes = std::size_t{3} << 14;

/// Nothing is fetched, nothing is sent, no other script runs.
constexpr std::string_view kHead = R"(<!DOCTYPE html>
<html lang="en">
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; media-src data:; script-src 'sha256-{script_hash}'; style-src 'sha256-{style_hash}'; base-uri 'none'; form-action 'none'">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{title}</title>
<style>{style}</style>
<main>
<h1>{title}</h1>
<video id="video" width="{width}" height="{height}" controls playsinline preload="auto" aria-label="{title}" aria-describedby="description" src="data:video/mp4;base64,)";

constexpr std::string_view kControls = R"("></video>
<p id="problem" role="alert"></p>
<div id="controls" hidden>
<input id="time-slider" type="range" min="0" step="any" autocomplete="off" aria-label="Simulation time">
<dl class="read-outs">
<div><dt>Collisions</dt><dd><span id="count" aria-live="polite"></span> <span id="picture"></span></dd></div>
<div><dt>Time</dt><dd id="time" aria-live="polite"></dd></div>
<div><dt>Frame</dt><dd id="frame"></dd></div>
</dl>
<div class="buttons" role="group" aria-label="Playback">
<button id="play" type="button" aria-keyshortcuts="Space">Play</button>
<button id="previous-collision" type="button" aria-keyshortcuts="," aria-label="Previous collision">&minus; collision</button>
<button id="next-collision" type="button" aria-keyshortcuts="." aria-label="Next collision">+ collision</button>
<button id="previous-frame" type="button" aria-keyshortcuts="ArrowLeft" aria-label="Previous frame">&minus; frame</button>
<button id="next-frame" type="button" aria-keyshortcuts="ArrowRight" aria-label="Next frame">+ frame</button>
<button id="start" type="button" aria-keyshortcuts="Home">Start</button>
<button id="end" type="button" aria-keyshortcuts="End">End</button>
<button id="sound" type="button" aria-keyshortcuts="m">Sound off</button>
</div>
<p><kbd>Space</kbd> plays and pauses, <kbd>&larr;</kbd> <kbd>&rarr;</kbd> go from frame to frame,
<kbd>,</kbd> <kbd>.</kbd> from collision to collision, <kbd>Home</kbd> <kbd>End</kbd> to the ends.</p>
</div>
)";

void check_page(const RenderJob& job) {
  if (job.shard) {
    throw UsageError(fmt::format(
        "part: there are no parts of page '{}'; render it whole, or the parts of an MP4",
        job.output));
  }
  const auto* const scene = std::get_if<Scene>(&job.script);
  if (scene == nullptr) {
    throw UsageError(fmt::format(
        "page: '{}' steps through one run, and a storyboard has several; write an MP4, or a page "
        "of a scene without [[part]]",
        job.output));
  }
  if (scene->view.background == Background::transparent) {
    throw UsageError(fmt::format(
        "output: '{}' cannot be transparent: a page shows an MP4; use an opaque background",
        job.output));
  }
  const std::string problem = problem_of_replacing(follow_links(job.output));
  if (!problem.empty()) {
    throw UsageError(fmt::format("output: cannot open '{}': {}", job.output, problem));
  }
}

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

void write_page(const Scene& scene, const PageFacts& facts, const fs::path& video,
                OutputFile& page) {
  page.write(fmt::format(
      kHead, fmt::arg("script_hash", kPageScriptHash), fmt::arg("style_hash", kPageStyleHash),
      fmt::arg("style", kPageStyle), fmt::arg("title", escaped(title_of(scene, facts.count()))),
      fmt::arg("width", scene.view.width_px), fmt::arg("height", scene.view.height_px)));
  add_video(video, page);
  page.write(kControls);
  page.write(fmt::format("<p id=\"description\">{}</p>\n</main>\n",
                         escaped(describe_video(scene, facts.count()))));
  page.write(R"(<script id="facts" type="application/json">)");
  std::string pieces;  // collected, since they are small
  facts.write([&](std::string_view text) {
    pieces += text;
    if (pieces.size() >= kPiece_bytes) page.write(std::exchange(pieces, {}));
  });
  page.write(pieces);
  page.write(fmt::format("</script>\n<script>{}</script>\n", kPageScript));
}

}  // namespace

bool is_page(const std::string& output) { return has_ending(output, ".html"); }

Rendered render_page(const RenderJob& job, const OnProgress& on_progress,
                     const std::stop_token& stop) {
  check_page(job);
  const auto& scene = std::get<Scene>(job.script);
  const RunLog run(scene);
  const Schedule schedule = make_schedule(scene, run.timeline());
  const PageFacts facts(scene, run, schedule);
  facts.check_range();
  const fs::path path = follow_links(job.output);
  FileSet files(path.parent_path(), path.filename(), Unfinished::Sharing::shared);
  OutputFile page(files.add(path.filename()));
  RenderJob video = job;
  video.output = files.temporary_folder() / "video.mp4";
  Rendered rendered = render_film(video, on_progress, stop);
  StepClock clock(job.profile, Step::write);
  write_page(scene, facts, video.output, page);
  if (stop.stop_requested()) throw Interrupted("render: interrupted");
  page.finish();
  files.commit();
  if (job.profile) {
    const auto write = static_cast<std::size_t>(Step::write);
    rendered.profile.steps[write] += clock.spent()[write];
    rendered.profile.total_s = processor_seconds(CLOCK_PROCESS_CPUTIME_ID);
  }
  return rendered;
}

}  // namespace piblocks
