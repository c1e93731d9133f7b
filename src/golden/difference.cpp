#include "golden/difference.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/exact.hpp>

#include <algorithm>
#include <array>
#include <optional>
#include <system_error>
#include <utility>

#include "core/input_file.hpp"
#include "core/text.hpp"
#include "media/png/png_chunk.hpp"

namespace piblocks {
namespace fs = std::filesystem;
namespace {

const char* channel_name(const FrameComparison& frame, int channel) {
  constexpr std::array kRgb = {"red", "green", "blue", "alpha"};
  constexpr std::array kYuv = {"Y", "Cb", "Cr", "alpha"};
  return (frame.is_yuv ? kYuv : kRgb).at(static_cast<std::size_t>(channel));
}

std::string differing(std::int64_t pixels) {
  return fmt::format("{} {}", pixels, pixels == 1 ? "pixel differs" : "pixels differ");
}

/// So many decimals that three digits are written, but at most five decimals.
int decimals_of(const Rational& value) {
  int decimals = 0;
  for (Rational scaled = value; scaled < 100 && decimals < 5; scaled *= 10) ++decimals;
  return decimals;
}

/// "3 of 255", and for deeper samples "0.250 of 255 (1 of 1023)". It is rounded up, so that the
/// printed number, as a tolerance, accepts the delta.
std::string largest_delta(const Difference& d) {
  if (d.max_level == 255) return fmt::format("{} of 255", d.largest_delta);
  const Rational delta = Rational(d.largest_delta) * 255 / d.max_level;
  const int decimals = decimals_of(delta);
  const Rational unit = power(Rational(10), static_cast<unsigned long>(decimals));
  return fmt::format("{:.{}f} of 255 ({} of {})", to_double(Rational(ceil(delta * unit)) / unit),
                     decimals, d.largest_delta, d.max_level);
}

std::string differing_pixels(const FrameComparison& frame, const Difference& d) {
  std::string text = fmt::format("{}, largest delta {}, first at x={} y={} ({})",
                                 differing(d.different_pixels), largest_delta(d), d.first.x_px,
                                 d.first.y_px, channel_name(frame, d.first.channel));
  if (d.off_pixels != d.different_pixels) {
    text += fmt::format(", {} beyond the accepted delta", d.off_pixels);
    if (d.off_pixels == 0 && !d.is_accepted) text += ", the largest beyond the hard limit";
  }
  if (d.off_pixels > 0) {
    text += fmt::format(", densest {}x{} window at x={} y={}: {}", d.densest.width_px,
                        d.densest.height_px, d.densest.x_px, d.densest.y_px, d.densest_off);
  }
  return text;
}

PixelRect around(const PixelRect& one, const PixelRect& other) {
  const int x = std::min(one.x_px, other.x_px);
  const int y = std::min(one.y_px, other.y_px);
  return {x, y, std::max(one.right_px(), other.right_px()) - x,
          std::max(one.bottom_px(), other.bottom_px()) - y};
}

/// Rectangles that are farther apart than a distance, which grows with their number.
class Regions {
 public:
  void add(PixelRect rect) {
    const auto is_near = [&](const PixelRect& other) {
      const PixelRect both = around(rect, other);
      return both.width_px < rect.width_px + other.width_px + distance_px_ &&
             both.height_px < rect.height_px + other.height_px + distance_px_;
    };
    for (auto at = rects_.begin(); (at = std::ranges::find_if(rects_, is_near)) != rects_.end();) {
      rect = around(rect, *at);
      rects_.erase(at);
    }
    rects_.push_back(rect);
    if (rects_.size() <= kMaxRegions) return;
    distance_px_ *= 2;
    for (const PixelRect& old : std::exchange(rects_, {})) add(old);
  }
  std::vector<PixelRect> take() { return std::move(rects_); }

 private:
  int distance_px_ = 16;
  std::vector<PixelRect> rects_;
};

constexpr int kGreys = 64;
constexpr int kReds = 161;

int level(std::uint32_t pixel, int shift) { return static_cast<int>((pixel >> shift) & 0xff); }

/// How far a pixel is from white in the picture of differences, 0 … kGreys - 1.
int pale(std::uint32_t pixel) {
  const int mean = (level(pixel, 16) + 2 * level(pixel, 8) + level(pixel, 0)) / 4;
  return (255 - mean) * level(pixel, 24) / 255 / 4;
}

std::vector<std::uint32_t> palette_of_differences() {
  std::vector<std::uint32_t> palette;
  for (std::uint32_t i = 0; i < kGreys; ++i) palette.push_back((255 - i) * 0x010101);
  // Even the least delta can be seen.
  for (std::uint32_t i = 0; i < kReds; ++i) palette.push_back(0xff0000 | (kReds - 1 - i) * 0x0101);
  return palette;
}

constexpr const char* kLabel = "differences";
constexpr const char* kUnfinished = "differences.unfinished-";  // as Unfinished names its folder

bool is_picture_name(const std::string& name) {
  constexpr std::array kKinds = {kExpected, kActual, kDiff};
  return std::ranges::any_of(
      kKinds, [&](const char* kind) { return name.ends_with(fmt::format("-{}.png", kind)); });
}

/// Pictures that comparisons have left in a folder and below, without those that are being written.
std::vector<fs::path> marked_pictures(const fs::path& folder) {
  std::vector<fs::path> paths;
  std::error_code error;
  constexpr auto kOptions = fs::directory_options::skip_permission_denied;
  for (fs::recursive_directory_iterator at(folder, kOptions, error), end; !error && at != end;
       at.increment(error)) {
    const std::string name = at->path().filename();
    if (name.starts_with(kUnfinished)) at.disable_recursion_pending();
    if (is_picture_name(name) && has_png_mark(*at, PngMark::difference)) paths.push_back(*at);
  }
  return paths;
}

/// Of a file, its bytes.
std::optional<FramePicture> side_of(const char* kind, const std::string& path,
                                    const std::function<Image()>& picture) {
  if (!picture) return std::nullopt;
  std::error_code unknown;
  const std::uintmax_t size_bytes = path.empty() ? 0 : fs::file_size(path, unknown);
  const auto file = unknown ? std::nullopt : beginning_of(path, size_bytes);
  constexpr std::size_t kHeader_bytes = 33;
  if (file && file->size() >= kHeader_bytes && file->starts_with(kPngSignature)) {
    Bytes png(file->begin(), file->end());
    const auto size = from_big_endian(ByteSpan(png).subspan(16, 8));
    return FramePicture{kind, int(size >> 32), int(size & 0xffffffff), std::move(png)};
  }
  const Image image = picture();
  if (image.words.empty()) return std::nullopt;
  return FramePicture{kind, image.width_px, image.height_px, encode_png_samples(image)};
}

}  // namespace

std::string difference_text(const FrameComparison& frame) {
  if (!frame.problem.empty()) return frame.problem;
  if (!frame.difference) {
    const bool is_compared = frame.outcome <= Outcome::different;
    return std::string(name_of(frame.outcome)) + (is_compared ? " hashes" : "");
  }
  const Difference& d = *frame.difference;
  std::string text = "equal";
  if (!d.is_equal()) text = differing_pixels(frame, d);
  if (d.masked_pixels > 0) text += fmt::format(", {} in the masks", differing(d.masked_pixels));
  if (d.is_accepted && !d.is_equal()) text += ", within tolerance";
  return text;
}

std::string row_text(const FrameComparison& frame) {
  const std::string text = difference_text(frame);
  const bool has_name =
      frame.outcome == Outcome::unreadable && text.find(frame.name) != std::string::npos;
  return has_name ? text : fmt::format("{}: {}", frame.name, text);
}

std::string summary_text(const ComparisonJob& job, const ComparisonResult& result) {
  const Outcome worst = result.worst();
  std::string text = name_of(worst);
  if (worst > Outcome::different && worst < Outcome::unreadable) text = name_of(Outcome::different);
  if (result.reference_frames == 0 && worst < Outcome::unreadable) {
    if (result.actual_frames == 0) return "nothing to compare";
    text = "no reference";
  }
  const char* separator = ": ";
  const auto add = [&](const std::string& part) {
    text += separator + part;
    separator = ", ";
  };
  if (const std::int64_t compared = result.compared_frames(); compared > 0) {
    add(fmt::format("{} of {} frames differ{}", result.different_frames, compared,
                    job.masks.empty() ? "" : " outside of the masks"));
    if (result.masked_frames > 0) add(fmt::format("{} in them", result.masked_frames));
    const std::int64_t beyond = result.count(Outcome::different);
    if (beyond != result.different_frames) add(fmt::format("{} beyond tolerance", beyond));
  }
  for (const Outcome outcome :
       {Outcome::unreadable, Outcome::mismatch, Outcome::missing, Outcome::added}) {
    const std::int64_t count = result.count(outcome);
    if (count > 0) add(fmt::format("{} {}", count, name_of(outcome)));
  }
  if (!result.note.empty()) text += "; " + result.note;
  return text;
}

std::string tolerance_text(const ComparisonJob& job) {
  const Tolerance& tolerance = job.tolerance;
  std::string text = "Every sample must be equal";
  if (tolerance.threshold) {
    text = fmt::format("Pixels must look alike, by a threshold of {}{}", *tolerance.threshold,
                       tolerance.counts_antialiasing ? "" : ", or be those of smoothed edges");
  } else if (tolerance.max_delta > 0) {
    text = fmt::format("Samples may differ by up to {} of 255", to_double(tolerance.max_delta));
  }
  if (tolerance.max_share < 1) {
    text +=
        fmt::format(", except in up to {}% of the pixels", to_double(tolerance.max_share * 100));
  } else if (tolerance.max_pixels >= kMaxFrame_px) {
    text += ", except in any number of pixels";
  } else if (tolerance.max_pixels > 0) {
    text += ", except in up to " + counted(tolerance.max_pixels, "pixel");
  }
  if (tolerance.window) {
    text += fmt::format(", up to {0} of any square of {1}x{1}",
                        counted(tolerance.window->max_pixels, "pixel"), tolerance.window->side_px);
  }
  if (tolerance.hard_delta < 255) {
    text += fmt::format(", and none by more than {}", to_double(tolerance.hard_delta));
  }
  if (tolerance.ignores_transparent) text += ". Transparent pixels are equal";
  const char* separator = ". Masked: ";
  for (const Mask& mask : job.masks) text += std::exchange(separator, ", ") + mask.text;
  return text + '.';
}

std::vector<PixelRect> changed_regions(std::span<const std::uint8_t> deltas, int width_px) {
  constexpr std::ptrdiff_t kPiece_px = 16;
  const auto differs = [](std::uint8_t delta) { return delta != 0; };
  Regions regions;
  for (auto row = deltas.begin(); row != deltas.end(); row += width_px) {
    const int y = static_cast<int>((row - deltas.begin()) / width_px);
    const auto end = row + width_px;
    for (auto at = row; (at = std::find_if(at, end, differs)) != end;) {
      const auto piece_end = at + std::min(kPiece_px, end - at);
      auto last = piece_end - 1;
      while (*last == 0) --last;
      regions.add({static_cast<int>(at - row), y, static_cast<int>(last - at) + 1, 1});
      at = piece_end;
    }
  }
  return regions.take();
}

Bytes difference_picture(const Image& reference, const std::vector<std::uint8_t>& deltas) {
  const auto pack_row = [&](int row, std::uint8_t* to) {
    const std::ptrdiff_t at = std::ptrdiff_t{row} * reference.width_px;
    const std::uint32_t* const words = reference.words.data() + at;
    std::transform(words, words + reference.width_px, deltas.data() + at, to,
                   [](std::uint32_t word, std::uint8_t delta) {
                     const int red = kGreys + (kReds - 1) * delta / 255;
                     return static_cast<std::uint8_t>(delta == 0 ? pale(word) : red);
                   });
  };
  return encode_png_palette(reference.width_px, reference.height_px, palette_of_differences(),
                            pack_row);
}

std::vector<FramePicture> pictures_of(const FrameComparison& frame) {
  std::vector<FramePicture> pictures;
  const auto add = [&](std::optional<FramePicture> picture) {
    if (picture) pictures.push_back(*std::move(picture));
  };
  add(side_of(kExpected, frame.reference_path, frame.reference));
  add(side_of(kActual, frame.actual_path, frame.actual));
  if (!frame.difference) return pictures;
  const Image reference = frame.reference();
  if (pictures.size() < 2 || reference.words.empty()) return {};
  add(FramePicture{kDiff, reference.width_px, reference.height_px,
                   difference_picture(reference, frame.deltas())});
  return pictures;
}

std::string picture_name(const std::string& key, std::string_view kind) {
  constexpr std::string_view kEnding = ".png";
  const std::size_t ending_bytes = key.ends_with(kEnding) ? kEnding.size() : 0;
  return fmt::format("{}-{}.png", key.substr(0, key.size() - ending_bytes), kind);
}

DiffPictures::DiffPictures(fs::path folder, Making making)
    : folder_(std::move(folder)), making_(making) {
  if (making == Making::at_once) files_of("");
}

FileSet& DiffPictures::files_of(const fs::path& name) {
  const fs::path subfolder = name.parent_path();
  return files_.try_emplace(subfolder, folder_ / subfolder, kLabel, Unfinished::Sharing::shared)
      .first->second;
}

bool DiffPictures::is_new(const fs::path& name) const {
  return std::ranges::any_of(names_, [&](const auto& frame) {
    return std::ranges::count(frame.second, name.string()) > 0;
  });
}

void DiffPictures::add(const std::string& key, std::string_view kind, ByteSpan png) {
  if (failure_) return;
  const fs::path name = picture_name(key, kind);
  names_[key].push_back(name);
  try {
    files_of(name).add(name.filename(), with_png_mark(png, PngMark::difference));
  } catch (const Error&) {
    failure_ = std::current_exception();
  }
}

void DiffPictures::drop(const std::string& key) {
  if (failure_) return;
  for (const fs::path name : names_[key]) files_of(name).drop(name.filename());
  names_.erase(key);
}

void DiffPictures::finish() {
  if (failure_) std::rethrow_exception(failure_);
  if (files_.empty() && marked_pictures(folder_).empty()) return;
  files_of("");  // makes the folder
  const FolderLock lock(folder_);
  for (const auto& [key, names] : names_) {
    for (const std::string& name : names) {
      const fs::path path = folder_ / name;
      std::error_code none;
      if (!fs::exists(fs::symlink_status(path, none)) || has_png_mark(path, PngMark::difference)) {
        continue;
      }
      throw UsageError(fmt::format(
          "diff: '{}' is not from an earlier comparison; use another folder", path.string()));
    }
  }
  for (const fs::path& path : marked_pictures(folder_)) {
    const fs::path name = path.lexically_relative(folder_);
    if (!is_new(name)) files_of(name).remove(name.filename());
  }
  for (auto files = files_.rbegin(); files != files_.rend(); ++files) {  // subfolders come first
    files->second.commit();
    std::error_code not_empty;
    const bool stays = files->first.empty() && making_ == Making::at_once;
    if (!stays) fs::remove(folder_ / files->first, not_empty);
  }
}

void claim_diff_folder(OverwriteCheck& check, const std::string& option, const std::string& folder,
                       DiffPictures::Making making) {
  const FileNames names = making == DiffPictures::Making::at_once ? is_picture_name : FileNames();
  check.writes_some_of(option, folder, folder, names, marked_pictures(folder));
}

}  // namespace piblocks
