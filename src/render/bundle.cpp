#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <array>
#include <filesystem>
#include <iterator>
#include <optional>
#include <set>
#include <span>
#include <string_view>
#include <system_error>
#include <variant>
#include <vector>

#include "core/file_set.hpp"
#include "core/input_file.hpp"
#include "core/stop.hpp"
#include "core/text.hpp"
#include "render/renderings.hpp"
#include "render/step_clock.hpp"
#include "render/video_text.hpp"

namespace piblocks {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPoster = "poster.png";
constexpr const char* kAltText = "alt.txt";
constexpr const char* kCaptions = "captions.vtt";
constexpr const char* kSubtitles = "captions.srt";
constexpr const char* kLatex = "latex.tex";
constexpr const char* kReveal = "reveal.html";
constexpr std::array kFiles{kPoster, kAltText, kCaptions, kSubtitles, kLatex, kReveal};
constexpr const char* kChapters = "chapters.vtt";
constexpr const char* kImpress = "impress.fodp";

/// How the text for beamer begins.
constexpr std::string_view kPreamble =
    R"(% In the preamble: \usepackage{graphicx} \usepackage{multimedia}
% A viewer that plays no videos shows the )";

/// As large as fits below a title, at any shape of slide and film. Without a width of its own,
/// \movie is as large as the poster.
constexpr std::string_view kMovie = R"(\centering
\movie[{options}]{{%
  \includegraphics[width=\textwidth,height={height}\textheight,keepaspectratio]{{{poster}}}}}{{{name}}}
)";

/// reveal.js sizes the video by r-stretch, and plays it when the slide is shown. Controls would
/// stay over the last picture of a shot.
constexpr std::string_view kSection = R"(<section{transition}>
  <video class="r-stretch" data-autoplay {controls}{loop}playsinline preload="metadata"{poster}
         aria-label="{alt}">
    <source src="{name}" type="video/mp4">
    <track kind="captions" srclang="en" label="English" src="{captions}">
  </video>
</section>
)";

/// Slides of the film's shape, in centimetres. Without office:styles, LibreOffice would give all
/// slides its own size.
constexpr std::string_view kImpressHead = R"(<?xml version="1.0" encoding="UTF-8"?>
<office:document xmlns:office="urn:oasis:names:tc:opendocument:xmlns:office:1.0"
  xmlns:style="urn:oasis:names:tc:opendocument:xmlns:style:1.0"
  xmlns:draw="urn:oasis:names:tc:opendocument:xmlns:drawing:1.0"
  xmlns:svg="urn:oasis:names:tc:opendocument:xmlns:svg-compatible:1.0"
  xmlns:fo="urn:oasis:names:tc:opendocument:xmlns:xsl-fo-compatible:1.0"
  xmlns:xlink="http://www.w3.org/1999/xlink"
  office:version="1.3" office:mimetype="application/vnd.oasis.opendocument.presentation">
<office:styles/>
<office:automatic-styles><style:page-layout style:name="slide">
<style:page-layout-properties fo:page-width="{width}" fo:page-height="{height}" fo:margin="0cm"/>
</style:page-layout></office:automatic-styles>
<office:master-styles><style:master-page style:name="shots" style:page-layout-name="slide"/></office:master-styles>
<office:body><office:presentation>
)";

/// The last picture lies behind the video, for programs that cannot play it.
constexpr std::string_view kImpressSlide =
    R"(<draw:page draw:name="{number}" draw:master-page-name="shots">
<draw:frame svg:width="{width}" svg:height="{height}"><draw:image xlink:href="{picture}"/></draw:frame>
<draw:frame svg:width="{width}" svg:height="{height}">
<draw:plugin xlink:href="{name}" xlink:type="simple" draw:mime-type="application/vnd.sun.star.media"/>
<svg:desc>{alt}</svg:desc></draw:frame>
</draw:page>
)";

/// The name of a shot's file: "why-pi-01.mp4" for "why-pi.mp4".
/// @param number  from 1 on
std::string shot_name(const std::string& video, std::size_t number, std::string_view ending) {
  return fmt::format("{}-{:02}{}", video.substr(0, video.rfind('.')), number, ending);
}

constexpr std::string_view kPlain =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._";

/// A name that means the same in a file system, in LaTeX and in an address.
bool is_plain(const std::string& name) {
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

void add_text(FileSet& files, const std::string& name, std::string_view text) {
  files.add(name, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

/// Shots of the film; none if it has one segment.
std::size_t shots_of(const Script& script) {
  const auto* story = std::get_if<Storyboard>(&script);
  return story == nullptr || story->segments.size() == 1 ? 0 : story->segments.size();
}

/// What a storyboard has beyond the files of a scene.
std::vector<std::string> files_of_shots(const std::string& video, std::size_t shots) {
  if (shots == 0) return {};
  std::vector<std::string> names{kChapters, kImpress};
  for (std::size_t i = 1; i <= shots; ++i) {
    for (const char* ending : {".mp4", ".png"}) names.push_back(shot_name(video, i, ending));
  }
  return names;
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
  add_text(files, kAltText, describe_film(film) + "\n");
  add_text(files, kCaptions, captions(film));
  add_text(files, kSubtitles, captions(film, CaptionFormat::subrip));
  add_text(files, kLatex, latex_slides(film, job.output));
  add_text(files, kReveal, reveal_slides(film, job.output));
  if (shots_of(job.script) == 0) return;
  add_text(files, kChapters, chapters(film));
  add_text(files, kImpress, impress_slides(film, job.output));
}

/// The names of an earlier bundle's files in the folder; empty if there is none. They come from its
/// LaTeX text, which names the files of all shots; other words of that text are among them.
std::set<std::string> earlier_files(const fs::path& folder) {
  constexpr std::size_t kMost_bytes = std::size_t{1} << 20;
  const std::vector<std::uint8_t> bytes = bytes_of_file(folder / kLatex, kMost_bytes);
  const std::string text(bytes.begin(), bytes.end());
  if (!text.starts_with(kPreamble)) return {};
  std::set<std::string> names(kFiles.begin(), kFiles.end());
  for (auto at = text.find_first_of(kPlain); at < text.size();) {
    const std::size_t end = text.find_first_not_of(kPlain, at);
    names.insert(text.substr(at, end - at));
    at = text.find_first_of(kPlain, end);
  }
  return names;
}

/// Checks all but the video, whose name the user has chosen.
/// @throws UsageError if one of them would replace a file that is not from an earlier bundle.
void check_names(const RenderJob& job, const std::set<std::string>& earlier) {
  std::error_code unknown;
  const std::vector<std::string> names = bundle_files(job);
  for (const std::string& name : std::span(names).subspan(1)) {
    const fs::path path = fs::path(job.bundle->folder) / name;
    if (earlier.contains(name) || !fs::exists(path, unknown)) continue;
    throw UsageError(fmt::format(
        "bundle: '{}' is there, but not from an earlier bundle; use another folder, or --overwrite "
        "to replace it",
        path.string()));
  }
}

/// Files of shots that the earlier bundle of this video has, and the new one has not.
void remove_rest(const RenderJob& job, const std::set<std::string>& earlier, FileSet& files) {
  const std::vector<std::string> names = bundle_files(job);
  for (const std::string& name : files_of_shots(job.output, kMaxSegments)) {
    if (earlier.contains(name) && std::ranges::find(names, name) == names.end()) files.remove(name);
  }
}

/// The video of each shot, and its last picture.
Profile render_shots(RenderJob job, const Film& film, FileSet& files, const OnProgress& on_progress,
                     const std::stop_token& stop) {
  Profile profile;
  std::optional<FilmSound> sound;
  if (sound_of(job.script).on) sound.emplace(film, film.frames(), stop, [](std::int64_t) {});
  job.max_flashes.reset();  // the whole film has been checked
  const std::string video = job.output;
  for (std::size_t i = 0; i < film.segments().size(); ++i) {
    const FrameRange frames = film.shot(i);
    files.add(shot_name(video, i + 1, ".png"), draw_png(film.frame(frames.last), stop));
    job.frames = frames;
    job.output = files.add(shot_name(video, i + 1, ".mp4"));
    const auto report = [&](const Progress& shot) {
      on_progress({frames.first + shot.frames_done, film.frame_count()});
    };
    add(profile, render_film(job, film, report, stop, sound ? &*sound : nullptr).profile);
  }
  return profile;
}

}  // namespace

std::string latex_slides(const Film& film, const std::string& video) {
  const std::size_t count = film.segments().size();
  std::string text(kPreamble);
  if (count == 1) {
    return text + "poster.\n" +
           fmt::format(kMovie, fmt::arg("options", "showcontrols"), fmt::arg("height", "0.8"),
                       fmt::arg("poster", "poster.png"), fmt::arg("name", video));
  }
  text +=
      "last picture of a shot. impress.fodp has the same slides,\n% chapters.vtt is for the whole "
      "video.\n";
  for (std::size_t i = 1; i <= count; ++i) {
    text += "\\begin{frame}[plain]\n" +
            fmt::format(kMovie, fmt::arg("options", "autostart,showcontrols"),
                        fmt::arg("height", ""), fmt::arg("poster", shot_name(video, i, ".png")),
                        fmt::arg("name", shot_name(video, i, ".mp4"))) +
            "\\end{frame}\n";
  }
  return text;
}

std::string reveal_slides(const Film& film, const std::string& video) {
  const std::size_t count = film.segments().size();
  const auto section = [&](const std::string& name, const std::string& poster,
                           const std::string& alt, const std::string& captions) {
    return fmt::format(
        kSection, fmt::arg("name", name),
        fmt::arg("poster", poster.empty() ? "" : fmt::format(" poster=\"{}\"", poster)),
        fmt::arg("alt", escaped(alt)), fmt::arg("captions", data_address("text/vtt", captions)),
        fmt::arg("controls", count == 1 ? "controls " : ""), fmt::arg("loop", loop_attribute(film)),
        fmt::arg("transition", count == 1 ? "" : " data-transition=\"none\""));
  };
  if (count == 1) return section(video, "poster.png", describe_film(film), captions(film));
  const std::vector<std::string> alts = describe_segments(film);
  const std::vector<std::string> said = shot_captions(film);
  std::string text;
  for (std::size_t i = 1; i <= count; ++i) {
    const std::string poster = i == 1 ? "" : shot_name(video, i - 1, ".png");
    text += section(shot_name(video, i, ".mp4"), poster, alts[i - 1], said[i - 1]);
  }
  return text;
}

std::string impress_slides(const Film& film, const std::string& video) {
  const std::string width = "28cm";
  const std::string height =
      fmt::format("{:.3f}cm", 28.0 * film.view().height_px / film.view().width_px);
  const std::vector<std::string> alts = describe_segments(film);
  std::string text =
      fmt::format(kImpressHead, fmt::arg("width", width), fmt::arg("height", height));
  for (std::size_t i = 1; i <= film.segments().size(); ++i) {
    text += fmt::format(
        kImpressSlide, fmt::arg("number", i), fmt::arg("width", width), fmt::arg("height", height),
        fmt::arg("picture", shot_name(video, i, ".png")),
        fmt::arg("name", shot_name(video, i, ".mp4")), fmt::arg("alt", escaped(alts[i - 1])));
  }
  return text + "</office:presentation></office:body></office:document>\n";
}

std::vector<std::string> bundle_files(const RenderJob& job) {
  std::vector<std::string> names{job.output};
  names.insert(names.end(), kFiles.begin(), kFiles.end());
  std::ranges::move(files_of_shots(job.output, shots_of(job.script)), std::back_inserter(names));
  return names;
}

Rendered render_bundle(const RenderJob& job, const OnProgress& on_progress,
                       const std::stop_token& stop) {
  check_bundle(job);
  const std::set<std::string> earlier = earlier_files(job.bundle->folder);
  if (!job.overwrite) check_names(job, earlier);
  const Film film = film_of(job, stop);
  FileSet files(job.bundle->folder, "bundle");
  write_poster(job, film, files, stop);
  write_texts(job, film, files);
  remove_rest(job, earlier, files);
  const bool has_shots = shots_of(job.script) > 0;
  // With shots, a frame is done when it is in the film and in a shot.
  const auto half = [&](std::int64_t done) { on_progress({done / 2, film.frame_count()}); };
  const auto report = [&](const Progress& progress) {
    if (has_shots) return half(progress.frames_done);
    on_progress(progress);
  };
  RenderJob video = job;
  video.bundle.reset();
  video.output = files.add(job.output);
  Rendered rendered = render_film(video, film, report, stop);
  if (has_shots) {
    video.output = job.output;
    const auto report_shots = [&](const Progress& shots) {
      half(shots.frame_count + shots.frames_done);
    };
    add(rendered.profile, render_shots(video, film, files, report_shots, stop));
  }
  check_stop(stop);
  files.commit();
  return rendered;
}

}  // namespace piblocks
