// Comparison: two images, or two pictures, sequences or videos frame by frame.
// In: images or file names, and what may differ. Out: how many pixels differ, by how much and
// where.
#pragma once

#include <piblocks/exact.hpp>
#include <piblocks/image.hpp>

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
};

/// What is accepted: all of it has to hold. The default accepts nothing but equality. A delta of
/// 255 is the full range of a sample at any depth.
struct Tolerance {
  Rational max_delta = 0;       ///< a pixel is off if one of its samples differs by more, 0 … 255
  std::int64_t max_pixels = 0;  ///< that are off in the whole image
  Rational hard_delta = 255;    ///< no sample of any pixel may differ by more, 0 … 255
  std::optional<Window> window = {};  ///< bounds the pixels that are off in one place

  bool is_exact() const { return max_delta == 0 && max_pixels == 0; }
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
  bool is_accepted = true;

  bool is_equal() const noexcept { return different_pixels == 0; }
};

/// Compares all four samples of every pixel outside of the masks. Without a window in the
/// tolerance, the densest 16x16 pixels are searched.
/// @throws UsageError if the images are not of one size, or the tolerance is out of range.
Difference compare(const ImageView& reference, const ImageView& actual,
                   const Tolerance& tolerance = {}, std::span<const PixelRect> masks = {});

/// The same for deeper samples. @throws UsageError also if the images differ in max_level.
Difference compare(const DeepImage& reference, const DeepImage& actual,
                   const Tolerance& tolerance = {}, std::span<const PixelRect> masks = {});

/// The largest delta of each pixel, row by row: 255 for the full range, rounded up, so that 0 means
/// that the pixel is equal or in one of the masks.
/// @throws UsageError if the images are not of one size.
std::vector<std::uint8_t> pixel_deltas(const Image& reference, const Image& actual,
                                       std::span<const PixelRect> masks = {});
/// The same for deeper samples. @throws UsageError also if the images differ in max_level.
std::vector<std::uint8_t> pixel_deltas(const DeepImage& reference, const DeepImage& actual,
                                       std::span<const PixelRect> masks = {});

/// Longest file of hashes that is read, in lines.
inline constexpr std::size_t kMaxHashes = 2'000'000;

struct ComparisonJob {
  std::string reference;  ///< a PNG file, a folder of them, a pattern, a video, or a framehash file
  std::string actual;     ///< the same; a video may be compared with pictures
  Tolerance tolerance = {};
  std::vector<PixelRect> masks = {};  ///< not compared
};

/// One frame of both, valid during the call.
struct FrameComparison {
  std::int64_t number = 0;  ///< from 0
  std::string name;         ///< of the reference's frame, for people
  bool is_yuv = false;      ///< whether the samples are Y, Cb and Cr
  /// Nothing where only hashes are known: is_accepted then says whether these are equal.
  std::optional<Difference> difference;
  bool is_accepted = true;
  /// The pictures as they are shown; empty functions where only hashes are known.
  std::function<Image()> reference;
  std::function<Image()> actual;
  /// What pixel_deltas() returns for the samples that were compared.
  std::function<std::vector<std::uint8_t>()> deltas;

  bool is_equal() const noexcept { return difference ? difference->is_equal() : is_accepted; }
};

enum class Verdict { equal, accepted, different, mismatch };

struct ComparisonResult {
  Verdict verdict = Verdict::equal;
  std::string mismatch;               ///< what does not fit: sizes, numbers of frames, rotation
  std::int64_t frames = 0;            ///< that were compared
  std::int64_t different_frames = 0;  ///< that are not equal, accepted or not
  std::int64_t refused_frames = 0;    ///< that are not accepted
};

/// Compares what both have stored wherever their formats are equal, and else the RGB pictures they
/// show. Ends early where sizes do not fit.
/// @param on_frame  called for every frame, in order.
/// @throws UsageError if the job makes no sense; IoError, MediaError if an input cannot be read;
///         Interrupted
ComparisonResult compare_files(const ComparisonJob& job,
                               const std::function<void(const FrameComparison&)>& on_frame,
                               const std::stop_token& stop = {});

/// Whether there is anything of that name to compare with.
bool frames_exist(const std::string& name);

}  // namespace piblocks
