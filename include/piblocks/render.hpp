// Rendering: a scene or a storyboard becomes a video, a sequence, a still, a sheet or pixels.
// In: a script and the name of an output, or shards of one. Out: the complete output, or an
// exception and no trace of it.
#pragma once

#include <piblocks/encode.hpp>
#include <piblocks/image.hpp>
#include <piblocks/instant.hpp>
#include <piblocks/script.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <variant>
#include <vector>

namespace piblocks {

/// One of several equal shares of a rendering, for the option --part.
struct Shard {
  int number = 1;  ///< 1 … count
  int count = 1;

  friend bool operator==(const Shard&, const Shard&) = default;
};

/// Consecutive frames of a film, by their numbers. The first frame of a film is number 0.
struct FrameRange {
  std::int64_t first = 0;
  std::int64_t last = 0;  ///< included

  std::int64_t count() const { return last - first + 1; }
};

/// A folder for a video under the name of the job's output, and for what a lecture needs beside it:
/// poster, captions, a text for those who cannot see it, ways to show it. Of a storyboard also a
/// video of each part, so that a lecture can stop after it, in about twice the processor time.
struct Bundle {
  std::string folder;
  /// What the poster shows; without it, the frame that comes furthest in time. Of a storyboard it
  /// is that of the last part with a diagram, else of the last run.
  std::optional<Instant> poster = {};
};

struct RenderJob {
  Script script;
  /// A name whose ending selects the format: `*.mp4`, `*.mov`, `*.webm`, `*.gif`, `*.apng`,
  /// `*.webp`, `*.png` or `*.svg` with one number such as `%06d`, `*.pdf` with a page for each
  /// frame,
  /// `*.y4m`, `-` (y4m on standard output), `*.framehash`, `*.wav`, `null`, or `*.html`, a page
  /// that holds the MP4 and steps through it.
  std::string output;
  EncoderSettings encoder = {};
  int jobs = 1;  ///< most frames painted and encoded at the same time, >= 1; changes no byte
  /// Renders this share only, to the file shard_name().
  std::optional<Shard> shard = {};
  bool profile = false;  ///< whether to measure what each step costs
  /// Renders a `*.mp4` into a folder, together with the rest, or nothing of it.
  std::optional<Bundle> bundle = {};
  /// Whether the MP4 has a track of captions: those of Bundle.
  bool captions_inside = false;
  /// Renders nothing if more flashes than this would be seen within a second
  /// (WCAG 2.3.1: 3), >= 1.
  std::optional<int> max_flashes = {};
  /// Whether files whose names piblocks makes (pictures of a sequence, files of a bundle, a shard)
  /// may replace files that no earlier run has made.
  bool overwrite = false;
  /// Of numbered pictures: keeps those that an unfinished run of the same job has left, and leaves
  /// its own for the next one if it does not finish. A shard that is there already is kept. No
  /// other output can be resumed.
  bool resume = false;
  /// Renders these frames only: a film of its own or, of numbered pictures, those that a rendering
  /// of the whole film would number alike; its other pictures stay. No part, page or bundle has it.
  std::optional<FrameRange> frames = {};
};

/// What the work on a frame consists of, in this order; sound is both made and encoded in one.
enum class Step { compose, paint, convert, encode, sound, mux, write };
inline constexpr std::array<const char*, 7> kStepNames = {"compose", "paint", "convert", "encode",
                                                          "sound",   "mux",   "write"};

/// Seconds of processor time by step.
using StepSeconds = std::array<double, kStepNames.size()>;

struct Profile {
  StepSeconds steps{};  ///< of all threads together
  double total_s = 0;   ///< of the process since its start; more than the steps
  /// How each chunk was encoded, where an encoder has several ways.
  std::vector<std::string> chunk_methods = {};
};

struct Rendered {
  std::int64_t frame_count = 0;
  Profile profile;  ///< zero unless asked for
  /// What a user should know of the output, one line each: players that may not show it.
  std::vector<std::string> notes = {};
  /// What became of the files of an earlier run, such as "removed 12 pictures of an earlier
  /// run"; usually empty.
  std::string aftermath = {};
};

struct Progress {
  std::int64_t frames_done = 0;
  std::int64_t frame_count = 0;
};

using OnProgress = std::function<void(const Progress&)>;

/// Renders every frame of the film, or of a range or shard of it.
/// @param on_progress  called by the calling thread: at the start, now and then, at the end.
/// @param stop         asks to give up: Interrupted is thrown soon after.
/// @throws UsageError, DrawError, MediaError, IoError, SimulationError, Interrupted
Rendered render(const RenderJob& job, const OnProgress& on_progress,
                const std::stop_token& stop = {});

/// The file for a shard: "OUTPUT.part-2-of-3".
std::string shard_name(const std::string& output, const Shard& shard);

/// Joins the files of all shards, in any order, to the output that one rendering would have made,
/// byte for byte.
/// @param output  of the same kind as the shards were rendered for; none of their files.
/// @param overwrite  as RenderJob::overwrite.
/// @return the number of frames, and the aftermath; nothing else.
/// @throws UsageError if a part is missing, given twice or of another job; MediaError, IoError,
///         Interrupted
Rendered join(const std::vector<std::string>& parts, const std::string& output,
              const std::stop_token& stop = {}, bool overwrite = false);

/// Renders one instant to a `.png`, `.svg` or `.pdf` file, or to standard output as PNG for "-".
/// The picture is that of the film's first frame that shows the instant. In a storyboard an instant
/// is a second of its video, and "last" is the last frame.
/// @param stop  asks to give up: Interrupted is thrown when the picture is drawn.
/// @return  of a scene: whether the order of collisions at one instant mattered until then
/// @throws SceneError if problems_of() the scene or storyboard is not empty; UsageError, DrawError,
///         MediaError, IoError, SimulationError, Interrupted
std::vector<std::string> render_still(const Script& script, const Instant& instant,
                                      const std::string& output, const std::stop_token& stop = {});

/// Most pictures of a sheet.
inline constexpr int kMaxSheetPictures = 200;

/// The quantity in which the instants of a sheet are evenly spaced.
enum class Spacing : std::uint8_t {
  count,  ///< of collisions, to the nearest one
  time
};

/// So many instants of the scene's span of time. The first is its beginning. By time, the last is
/// its end. By count, the others are collisions: picture i of N, from 0 on, is just after the
/// i / (N - 1) part of the span's collisions, the last one just after the last of them.
/// @param by  without it by count, if the span contains the turn and enough collisions for
///            pictures with different counts; otherwise by time.
/// @throws UsageError unless 1 <= pictures <= kMaxSheetPictures, or as span_of(); if pictures by
///         count would not differ; SceneError if problems_of(scene) is not empty; SimulationError
std::vector<Instant> spread_instants(const Scene& scene, int pictures,
                                     std::optional<Spacing> by = std::nullopt);

/// The instants of spread_instants().
struct Spread {
  int pictures = 12;
  std::optional<Spacing> by = {};
};
using SheetInstants = std::variant<std::vector<Instant>, Spread>;

/// Renders these instants side by side on one page, the time below each: a `.pdf`, `.svg` or
/// `.png` file of the shape of A4 in landscape, or PNG on standard output for "-". Times are left
/// out where they would make the pictures less than half as wide.
/// @param on_progress  called after each picture.
/// @param stop         asks to give up: Interrupted is thrown after a picture, or when the page is
///                     drawn.
/// @return  as render_still(), until the latest instant
/// @throws SceneError if problems_of(scene) is not empty; UsageError, DrawError, MediaError,
///         IoError, SimulationError, Interrupted
std::vector<std::string> render_sheet(const Scene& scene, const SheetInstants& instants,
                                      const std::string& output, const OnProgress& on_progress = {},
                                      const std::stop_token& stop = {});

/// The frames of a film as pixels, in any order. Only what differs from the frame painted before
/// is painted; the pixels are those that render() encodes. Used by one thread at a time; different
/// renderers are independent. A renderer that was moved from can only be assigned to or destroyed.
class FrameRenderer {
 public:
  /// @throws SceneError if problems_of() the scene or storyboard is not empty.
  /// @throws UsageError if the span, the pacing or the length of the film is impossible, as
  ///         make_log(), or if a fade is not shorter than its segments; SimulationError,
  ///         DrawError
  explicit FrameRenderer(const Script& script);
  ~FrameRenderer();
  FrameRenderer(FrameRenderer&& other) noexcept;
  FrameRenderer& operator=(FrameRenderer&& other) noexcept;
  FrameRenderer(const FrameRenderer&) = delete;
  FrameRenderer& operator=(const FrameRenderer&) = delete;

  /// Frames of the whole film.
  std::int64_t frame_count() const noexcept;
  /// The frame with this number.
  /// @returns a picture of the size of the film's view; valid until the next call.
  /// @throws UsageError unless 0 <= number < frame_count(); SimulationError, DrawError
  ImageView frame(std::int64_t number);
  /// The same, into memory of the caller's: pixels as ImageView has them, rows from the top.
  /// Bytes between a row's end and the next row stay as they are.
  /// @param stride_bytes  from a row to the next, at least four times the width in pixels.
  /// @throws UsageError as frame(), or if the buffer or the stride is too small; nothing is written
  ///         then. SimulationError, DrawError
  void copy_frame(std::int64_t number, std::span<std::uint8_t> buffer, std::ptrdiff_t stride_bytes);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace piblocks
