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
#include "render/captions.hpp"
#include "render/renderings.hpp"
#include "render/slides.hpp"
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

void add(FileSet& files, const std::string& name, std::string_view text) {
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
  add(files, kAltText, describe_film(film) + "\n");
  add(files, kCaptions, captions(film));
  add(files, kSubtitles, captions(film, CaptionFormat::subrip));
  add(files, kLatex, latex_slides(film, job.output));
  add(files, kReveal, reveal_slides(film, job.output));
  if (shots_of(job.script) == 0) return;
  add(files, kChapters, chapters(film));
  add(files, kImpress, impress_slides(film, job.output));
}

/// The bundle that an earlier run has left in the folder.
class EarlierBundle {
 public:
  explicit EarlierBundle(const fs::path& folder) {
    constexpr std::size_t kMost_bytes = std::size_t{1} << 20;
    const std::vector<std::uint8_t> bytes = bytes_of_file(folder / kLatex, kMost_bytes);
    const std::string text(bytes.begin(), bytes.end());
    is_there_ = text.starts_with(beginning_of_latex());
    for (auto at = text.find_first_of(kPlain); is_there_ && at < text.size();) {
      const std::size_t end = text.find_first_not_of(kPlain, at);
      words_.insert(text.substr(at, end - at));
      at = text.find_first_of(kPlain, end);
    }
  }

  /// Whether it has a file of this name, which is one of bundle_files().
  bool has(const std::string& name) const {
    return is_there_ && (std::ranges::find(kFiles, name) != kFiles.end() || words_.contains(name));
  }

 private:
  bool is_there_ = false;
  std::set<std::string> words_;  // of the text for beamer, which names the files of all shots
};

/// Checks all but the video, whose name the user has chosen.
/// @throws UsageError if one of them would replace a file that is not from an earlier bundle.
void check_names(const RenderJob& job, const EarlierBundle& earlier) {
  std::error_code unknown;
  const std::vector<std::string> names = bundle_files(job);
  for (const std::string& name : std::span(names).subspan(1)) {
    const fs::path path = fs::path(job.bundle->folder) / name;
    if (earlier.has(name) || !fs::exists(path, unknown)) continue;
    throw UsageError(fmt::format(
        "bundle: '{}' is there, but not from an earlier bundle; use another folder, or --overwrite "
        "to replace it",
        path.string()));
  }
}

/// Files of shots that the earlier bundle of this video has, and the new one has not.
void remove_rest(const RenderJob& job, const EarlierBundle& earlier, FileSet& files) {
  const std::vector<std::string> names = bundle_files(job);
  for (const std::string& name : files_of_shots(job.output, kMaxSegments)) {
    if (earlier.has(name) && std::ranges::find(names, name) == names.end()) files.remove(name);
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

std::vector<std::string> bundle_files(const RenderJob& job) {
  std::vector<std::string> names{job.output};
  names.insert(names.end(), kFiles.begin(), kFiles.end());
  std::ranges::move(files_of_shots(job.output, shots_of(job.script)), std::back_inserter(names));
  return names;
}

Rendered render_bundle(const RenderJob& job, const OnProgress& on_progress,
                       const std::stop_token& stop) {
  check_bundle(job);
  const EarlierBundle earlier(job.bundle->folder);
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
