#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <filesystem>
#include <span>
#include <string_view>
#include <system_error>
#include <vector>

#include "core/file_set.hpp"
#include "core/input_file.hpp"
#include "core/stop.hpp"
#include "core/text.hpp"
#include "render/captions.hpp"
#include "render/renderings.hpp"
#include "render/video_text.hpp"

namespace piblocks {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPoster = "poster.png";
constexpr const char* kAltText = "alt.txt";
constexpr const char* kCaptions = "captions.vtt";
constexpr const char* kSubtitles = "captions.srt";
constexpr const char* kLatexFile = "latex.tex";
constexpr const char* kRevealFile = "reveal.html";

/// As large as fits below a title, at any shape of slide and film. Without a width of its own,
/// \movie is as large as the poster.
constexpr std::string_view kLatex =
    R"(% In the preamble: \usepackage{{graphicx}} \usepackage{{multimedia}}
% A viewer that plays no videos shows the poster.
\centering
\movie[showcontrols]{{%
  \includegraphics[width=\textwidth,height=0.8\textheight,keepaspectratio]{{poster.png}}}}{{{name}}}
)";

/// reveal.js sizes the video by r-stretch, and plays it when the slide is shown.
constexpr std::string_view kReveal = R"(<section>
  <video class="r-stretch" data-autoplay controls {loop}playsinline preload="metadata" poster="poster.png"
         aria-label="{alt}">
    <source src="{name}" type="video/mp4">
    <track kind="captions" srclang="en" label="English" src="{captions}">
  </video>
</section>
)";

/// A name that means the same in a file system, in LaTeX and in an address.
bool is_plain(const std::string& name) {
  constexpr std::string_view kPlain =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._";
  return name.find_first_not_of(kPlain) == std::string::npos && !name.starts_with('.') &&
         !name.starts_with('-');
}

void check_bundle(const RenderJob& job) {
  std::vector<std::string> problems;
  if (job.shard) {
    problems.emplace_back("bundle: a bundle has no parts; leave --bundle or --part out");
  }
  if (!has_ending(job.output, ".mp4") || !is_plain(job.output)) {
    problems.push_back(fmt::format(
        "bundle: '{}' is no name for the video in it; use one such as pi-3.mp4, without a folder, "
        "of letters, digits, '-', '_' and '.'",
        job.output));
  }
  if (view_of(job.script).background == Background::transparent) {
    problems.push_back(
        fmt::format("bundle: '{}' cannot be transparent; use an opaque background, or write a "
                    "*.mov or *.webm without a bundle",
                    job.output));
  }
  if (job.bundle->folder.empty()) problems.emplace_back("bundle: the name of the folder is empty");
  if (!problems.empty()) throw UsageError(std::move(problems));
}

void add(FileSet& files, const char* name, std::string_view text) {
  files.add(name, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

/// How much a segment proves: with a diagram more than without, with a run more than a card.
int proof_of(const PlacedSegment& placed) {
  const std::span<const FilmRun> runs = placed.segment.runs();
  const auto has_diagram = [](const FilmRun& run) { return !run.scene().show.panels.empty(); };
  return int(!runs.empty()) + int(std::ranges::any_of(runs, has_diagram));
}

/// The last picture of the last segment that proves most.
DrawList poster_of(const Film& film) {
  const auto segments = film.segments();
  const auto proves_less = [](const auto& a, const auto& b) { return proof_of(a) < proof_of(b); };
  const FilmSegment& best =
      std::max_element(segments.rbegin(), segments.rend(), proves_less)->segment;
  return best.frame(best.furthest_frame());
}

void write_poster(const RenderJob& job, const Film& film, FileSet& files,
                  const std::stop_token& stop) {
  const auto& poster = job.bundle->poster;
  files.add(kPoster, draw_png(poster ? still_picture(film, *poster) : poster_of(film), stop));
}

void write_texts(const RenderJob& job, const Film& film, FileSet& files) {
  const std::string alt = describe_film(film);
  add(files, kAltText, alt + "\n");
  add(files, kCaptions, captions(film));
  add(files, kSubtitles, captions(film, CaptionFormat::subrip));
  add(files, kLatexFile, fmt::format(kLatex, fmt::arg("name", job.output)));
  add(files, kRevealFile,
      fmt::format(kReveal, fmt::arg("name", job.output), fmt::arg("alt", escaped(alt)),
                  fmt::arg("loop", loop_attribute(film)),
                  fmt::arg("captions", captions_address(film))));
}

/// Whether the folder has the bundle of an earlier run.
bool has_bundle(const fs::path& folder) {
  const std::string_view expected = kLatex.substr(0, kLatex.find('{'));
  return beginning_of(folder / kLatexFile, expected.size()) == expected;
}

/// Checks all but the video, whose name the user has chosen.
/// @throws UsageError if one of them would replace a file that is not from an earlier bundle.
void check_names(const Bundle& bundle) {
  if (has_bundle(bundle.folder)) return;
  std::error_code unknown;
  for (const char* name : {kPoster, kAltText, kCaptions, kSubtitles, kLatexFile, kRevealFile}) {
    const fs::path path = fs::path(bundle.folder) / name;
    if (!fs::exists(path, unknown)) continue;
    throw UsageError(fmt::format(
        "bundle: '{}' is there, but not from an earlier bundle; use another folder, or --overwrite "
        "to replace it",
        path.string()));
  }
}

}  // namespace

std::vector<std::string> bundle_files(const RenderJob& job) {
  return {job.output, kPoster, kAltText, kCaptions, kSubtitles, kLatexFile, kRevealFile};
}

Rendered render_bundle(const RenderJob& job, const OnProgress& on_progress,
                       const std::stop_token& stop) {
  check_bundle(job);
  if (!job.overwrite) check_names(*job.bundle);
  const Film film = film_of(job, stop);
  FileSet files(job.bundle->folder, "bundle");
  write_poster(job, film, files, stop);
  write_texts(job, film, files);
  RenderJob video = job;
  video.bundle.reset();
  video.output = files.add(job.output);
  Rendered rendered = render_film(video, film, on_progress, stop);
  check_stop(stop);
  files.commit();
  return rendered;
}

}  // namespace piblocks
