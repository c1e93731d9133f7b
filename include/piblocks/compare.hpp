// Comparison: two images, or two pictures, sequences or videos frame by frame.
// In: images or file names, and what may differ. Out: how many pixels differ, by how much and
// where; for files, also a row for every frame of either side.
#pragma once

#include <piblocks/exact.hpp>
#include <piblocks/image.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

namespace piblocks {

/// A square that is moved over the whole image.
struct Window {
  int side_px = 16;             ///< >= 1
  std::int64_t max_pixels = 0;  ///< that may be off, wherever the window is

  friend bool operator==(const Window&, const Window&) = default;
};

/// What is accepted: all of it has to hold. The default accepts nothing but equality. A delta of
/// 255 is the full range of a sample at any depth.
struct Tolerance {
  Rational max_delta = 0;       ///< a pixel is off if one of its samples differs by more, 0 … 255
  std::int64_t max_pixels = 0;  ///< that are off in the whole image
  Rational hard_delta = 255;    ///< no sample of any pixel may differ by more, 0 … 255
  std::optional<Window> window = {};  ///< bounds the pixels that are off in one place
  /// If given, a pixel is off if it looks different, 0 … 1, whatever max_delta says: as odiff and
  /// pixelmatch 7 measure it, in YIQ and on white. Samples of RGB only.
  std::optional<double> threshold = {};
  bool counts_antialiasing = false;  ///< whether pixels of smoothed edges are off by the threshold
  bool ignores_transparent = false;  ///< whether fully transparent pixels are equal
  Rational max_share = 1;            ///< the part of the image's pixels that may be off, 0 … 1

  friend bool operator==(const Tolerance&, const Tolerance&) = default;
};

/// A sample. Channels 0 to 3 are red, green, blue and alpha, or Y, Cb and Cr.
struct SamplePlace {
  int x_px = 0;
  int y_px = 0;
  int channel = 0;

  friend bool operator==(const SamplePlace&, const SamplePlace&) = default;
};

struct Difference {
  std::int64_t different_pixels = 0;  ///< in which any sample differs
  std::int64_t off_pixels = 0;        ///< of these, by more than the tolerance's max_delta
  int largest_delta = 0;              ///< in levels of the samples
  int max_level = 255;                ///< of the samples: a delta of 255 is so many levels
  SamplePlace first = {};             ///< the first that differs, row by row, if one does
  PixelRect densest = {};             ///< where the window has the most pixels off, first such
  std::int64_t densest_off = 0;       ///< pixels that are off there
  std::int64_t masked_pixels = 0;     ///< that differ inside a mask; the counts above omit them
  bool is_accepted = true;

  bool is_equal() const noexcept { return different_pixels == 0; }
};

/// Compares all four samples of every pixel outside of the masks. A mask may extend beyond the
/// image. Without a window in the tolerance, `densest` is a window of 16x16 pixels.
/// @throws UsageError if the images are not of one size, the tolerance is out of range, or the
///         masks together cover the whole image.
Difference compare(const ImageView& reference, const ImageView& actual,
                   const Tolerance& tolerance = {}, std::span<const PixelRect> masks = {});

/// The same for deeper samples. @throws UsageError also if the images differ in max_level.
Difference compare(const DeepImage& reference, const DeepImage& actual,
                   const Tolerance& tolerance = {}, std::span<const PixelRect> masks = {});

/// The largest delta of each pixel, row by row: 255 for the full range, rounded up, so that 0 means
/// that the pixel is equal or in one of the masks.
/// @throws UsageError if the images are not of one size.
std::vector<std::uint8_t> pixel_deltas(const Image& reference, const Image& actual,
                                       std::span<const PixelRect> masks = {},
                                       bool ignores_transparent = false);
/// The same for deeper samples. @throws UsageError also if the images differ in max_level.
std::vector<std::uint8_t> pixel_deltas(const DeepImage& reference, const DeepImage& actual,
                                       std::span<const PixelRect> masks = {},
                                       bool ignores_transparent = false);

/// Longest file of hashes that is read, in lines.
inline constexpr std::size_t kMaxHashes = 2'000'000;

/// A part of pictures that is not compared.
struct Mask {
  std::string text;               ///< as it was given, for messages
  std::string name_pattern = {};  ///< of pictures: a name, or a pattern of the shell; empty for all
  std::vector<PixelRect> rects = {};
  std::optional<PixelRect> whole = {};  ///< the size that a picture must have, from 0, 0
  bool must_hide = true;  ///< whether it is wrong usage if the mask hides a part of no picture
};

/// The reference and the actual side may each be a PNG file, a folder of them, a numbered pattern
/// such as frames/%06d.png, a video, or a file of frame hashes.
///
/// Pictures are paired by name: those of two folders by their paths in the folders, those of a
/// pattern by their numbers. Two single files are always a pair. Beside a video, pictures are
/// paired by their order; those of a pattern by their numbers, counted from the first.
struct ComparisonJob {
  std::string reference;
  std::string actual;
  Tolerance tolerance = {};
  std::vector<Mask> masks = {};
  bool is_recursive = true;  ///< whether subfolders are searched too
};

/// What is found about a frame, from the least severe to the most severe.
enum class Outcome : std::uint8_t {
  equal,
  accepted,    ///< differs within the tolerance, or only inside a mask
  different,   ///< beyond the tolerance
  added,       ///< only the actual side has it
  missing,     ///< only the reference has it
  mismatch,    ///< of another size, or shown another way (rotation, shape of pixels)
  unreadable,  ///< on either side
};
inline constexpr std::size_t kOutcomes = 7;

/// "equal", "new", … for people.
const char* name_of(Outcome outcome);

/// One frame, valid during the call.
struct FrameComparison {
  std::int64_t number = 0;  ///< of the row, from 0
  std::string name;         ///< for people: of the reference's frame and, if other, of the actual
  /// The reference's frame, or the actual one if it is the only one: "sub/7.png", "frame-000012".
  std::string key;
  Outcome outcome = Outcome::equal;
  std::string problem;           ///< why the frame is a mismatch or unreadable; else empty
  int width_px = 0;              ///< of the pictures, if they were compared
  std::vector<PixelRect> masks;  ///< that concern them
  bool is_yuv = false;           ///< whether the samples are Y, Cb and Cr
  /// Nothing where only hashes are known, and where there is nothing to compare.
  std::optional<Difference> difference;
  std::string reference_path;  ///< of the PNG file that is the frame; else empty
  std::string actual_path;     ///< the same
  /// The pictures as they are shown, with alpha; empty functions where there is none. A picture
  /// whose colours are not known has no pixels.
  std::function<Image()> reference;
  std::function<Image()> actual;
  /// What pixel_deltas() returns for the samples that were compared; empty without a difference.
  std::function<std::vector<std::uint8_t>()> deltas;

  bool is_accepted() const noexcept { return outcome <= Outcome::accepted; }
};

struct ComparisonResult {
  std::array<std::int64_t, kOutcomes> rows = {};  ///< by outcome
  std::int64_t different_frames = 0;  ///< that differ outside of the masks, accepted or not
  std::int64_t masked_frames = 0;     ///< that differ inside a mask
  std::int64_t reference_frames = 0;  ///< that the reference has, read or not
  std::int64_t actual_frames = 0;     ///< that the actual side has, read or not
  /// Why a side has no frame, or why no picture of one side is paired with one of the other.
  std::string problem;
  std::string note;  ///< that one video shows the other one some frames earlier or later

  std::int64_t count(Outcome outcome) const { return rows[static_cast<std::size_t>(outcome)]; }
  std::int64_t total() const;  ///< number of rows
  /// Number of rows of which both frames could be compared.
  std::int64_t compared_frames() const {
    return count(Outcome::equal) + count(Outcome::accepted) + count(Outcome::different);
  }
  /// The most severe one of the rows.
  Outcome worst() const;
};

/// Compares what both have stored wherever their formats are equal, and else the RGB pictures they
/// show. No finding ends the comparison, except that a video is not compared beyond a frame that
/// cannot be read.
/// @param on_frame  called for every row, in the order of names, numbers or time.
/// @throws UsageError if the job makes no sense, also if masks cover all of a picture or one lies
///         outside of all pictures; Interrupted
ComparisonResult compare_files(const ComparisonJob& job,
                               const std::function<void(const FrameComparison&)>& on_frame,
                               const std::stop_token& stop = {});

}  // namespace piblocks
