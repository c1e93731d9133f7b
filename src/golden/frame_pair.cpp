#include "golden/frame_pair.hpp"

#include <fmt/format.h>
#include <fnmatch.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <functional>
#include <system_error>
#include <tuple>
#include <type_traits>
#include <variant>

#include "core/input_file.hpp"
#include "core/threads.hpp"
#include "golden/packed_rows.hpp"
#include "media/png/png_reader.hpp"

namespace piblocks {
namespace fs = std::filesystem;
namespace {

/// "a.png", or "a.png and b.png".
std::string both_names(const std::string& reference, const std::string& actual) {
  return reference == actual ? reference : fmt::format("{} and {}", reference, actual);
}

std::string name_of(const ListedPicture& picture) {
  return picture.name.empty() ? picture.path.string() : picture.name;
}

/// A pair has the names of both sides, unless it has only one that can be read.
std::string row_name(const Fetched& reference, const Fetched& actual) {
  if (!reference.is_there || !actual.is_there) {
    return reference.is_there ? reference.name : actual.name;
  }
  if (reference.is_read() == actual.is_read()) return both_names(reference.name, actual.name);
  return actual.is_read() ? reference.name : actual.name;
}

Fetched decoded(const ListedPicture& picture, Bytes file) {
  Fetched fetched{
      .is_there = true, .name = name_of(picture), .key = name_of(picture), .path = picture.path};
  try {
    if (!picture.problem.empty()) throw IoError(picture.problem);
    refuse_pipe(picture.path, "compare");
    fetched.frame = read_png_frame(picture.path, std::move(file));
    fetched.frame->next();
  } catch (const IoError& error) {
    fetched.problem = error.what();
  } catch (const MediaError& error) {
    fetched.problem = error.what();
  }
  return fetched;
}

/// The file; nothing if it cannot be read, or is larger than a picture with plain chunks can be.
Bytes file_of(const ListedPicture& picture) {
  constexpr std::size_t kMost = std::size_t{5} * kMaxFrame_px;
  return picture.problem.empty() ? bytes_of_file(picture.path, kMost) : Bytes();
}

/// A picture as it is shown; without pixels if its colours are not known.
Image shown_picture(FrameReader& frame) {
  try {
    return flattened(frame.rgb());
  } catch (const MediaError&) {
    return {};
  }
}

/// Makes it when it is first asked for, since several reports may want it.
template <typename Make>
auto made_once(Make make) {
  return [make, made = std::optional<std::invoke_result_t<Make&>>()]() mutable {
    if (!made) made = make();
    return *made;
  };
}

std::function<Image()> picture_of(const std::shared_ptr<FrameReader>& frame) {
  return made_once([frame] { return shown_picture(*frame); });
}

/// Starting one takes as long as reading a small file.
bool is_worth_a_thread(const fs::path& path) {
  constexpr std::uintmax_t kLeast_bytes = std::uintmax_t{32} << 10;
  std::error_code error;
  const std::uintmax_t size = fs::file_size(path, error);
  return !error && size >= kLeast_bytes;
}

ComparedPair equal_pair(const ListedPicture& reference, const ListedPicture& actual) {
  ComparedPair result{.row = {}, .has_reference = true, .has_actual = true};
  result.row.name = both_names(name_of(reference), name_of(actual));
  result.row.reference_path = reference.path;
  result.row.actual_path = actual.path;
  result.row.difference = Difference();
  result.row.reference = [path = reference.path] { return read_png(path); };
  result.row.actual = result.row.reference;
  result.row.deltas = [path = reference.path] {
    return std::vector<std::uint8_t>(read_png(path).words.size());
  };
  return result;
}

/// The samples of two frames at one step, as they are compared.
class SamplePair {
 public:
  /// @param as_rgb  whether videos are converted to RGB in any case
  SamplePair(Fetched reference, Fetched actual, bool as_rgb)
      : reference_(std::move(reference)), actual_(std::move(actual)) {
    const std::string layout = reference_.frame->layout();
    const bool is_exact = layout == actual_.frame->layout() && (layout == kRgba || !as_rgb);
    is_yuv_ = is_exact && layout != kRgba;
    const auto samples_of = [&](FrameReader& frame) {
      return std::make_shared<AnyImage>(is_exact ? frame.samples() : frame.rgb());
    };
    expected_ = samples_of(*reference_.frame);
    found_ = samples_of(*actual_.frame);
  }

  bool is_yuv() const noexcept { return is_yuv_; }
  PictureSize size() const { return size_of(*expected_); }
  std::size_t held_bytes() const {
    const auto bytes = [](const AnyImage& image) {
      const PictureSize size = size_of(image);
      return 4 * std::size_t(size.width_px) * std::size_t(size.height_px);
    };
    return bytes(*expected_) + bytes(*found_);
  }
  Image reference_picture() const { return shown(*reference_.frame, *expected_); }
  Image actual_picture() const { return shown(*actual_.frame, *found_); }

  /// Empty if they can be compared.
  std::string mismatch() const {
    const PictureSize expected = size();
    const PictureSize found = size_of(*found_);
    if (expected != found) {
      return fmt::format("another size: {}x{} instead of {}x{}", found.width_px, found.height_px,
                         expected.width_px, expected.height_px);
    }
    const auto presentation = [](const FrameReader& frame) {
      const std::string text = frame.presentation();
      return text.empty() ? "as it is stored" : text;
    };
    const std::string expected_way = presentation(*reference_.frame);
    const std::string found_way = presentation(*actual_.frame);
    if (expected_way == found_way) return {};
    return fmt::format("shown another way: {} instead of {}", found_way, expected_way);
  }
  /// Brings both to one form: packed if both are, else the greater depth.
  void unify() {
    if (expected_->index() == found_->index() && max_level() == max_level_of(*found_)) return;
    for (auto* const image : {&expected_, &found_})
      *image = std::make_shared<AnyImage>(at_depth(**image));
  }
  /// What operation(reference, actual) returns; both are of one type.
  template <typename Operation>
  auto apply(const Operation& operation) const {
    return std::visit(
        [&](const auto& a) { return operation(a, std::get<std::decay_t<decltype(a)>>(*found_)); },
        *expected_);
  }

 private:
  using Samples = std::shared_ptr<const AnyImage>;

  static PictureSize size_of(const AnyImage& samples) {
    return std::visit(
        [](const auto& image) {
          return PictureSize{image.width_px, image.height_px};
        },
        samples);
  }
  int max_level() const { return max_level_of(*expected_); }
  AnyImage at_depth(const AnyImage& image) const {
    const int level = std::max(max_level(), max_level_of(*found_));
    if (level == 255) return flattened(image);
    return deepened(image, level);
  }
  Image shown(FrameReader& frame, const AnyImage& samples) const {
    return is_yuv_ ? shown_picture(frame) : flattened(samples);
  }

  Fetched reference_;
  Fetched actual_;
  bool is_yuv_ = false;
  Samples expected_;
  Samples found_;
};

ImageView comparable(const Image& image) { return image.view(); }
template <typename Picture>
const Picture& comparable(const Picture& image) {
  return image;
}

/// Whether a mask is about one of these pictures.
bool concerns(const Mask& mask, const Fetched& reference, const Fetched& actual) {
  const std::string& pattern = mask.name_pattern;
  const auto fits = [&](const std::string& name) {
    return pattern == name || ::fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
  };
  return pattern.empty() || fits(reference.name) || fits(actual.name);
}

/// @returns false if a mask that is a picture is of another size, and need not hide anything.
/// @throws UsageError if it has to
bool fits_size(const Mask& mask, const PictureSize& size, const std::string& name) {
  if (!mask.whole || PictureSize{mask.whole->width_px, mask.whole->height_px} == size) return true;
  if (!mask.must_hide) return false;
  throw UsageError(fmt::format("compare: the mask {} is {}x{}, and '{}' is {}x{}", mask.text,
                               mask.whole->width_px, mask.whole->height_px, name, size.width_px,
                               size.height_px));
}

/// The masks that concern a pair. Leaves in the result those that hide a part of it.
std::vector<PixelRect> masks_of(const ComparisonJob& job, const PictureSize& size,
                                ComparedPair& result) {
  std::vector<PixelRect> rects;
  std::erase_if(result.mask_indices, [&](std::size_t index) {
    const Mask& mask = job.masks[index];
    if (!fits_size(mask, size, result.row.name)) return true;
    rects.insert(rects.end(), mask.rects.begin(), mask.rects.end());
    return std::ranges::none_of(mask.rects, [&](const PixelRect& r) {
      return r.x_px < size.width_px && r.y_px < size.height_px;
    });
  });
  return rects;
}

void compare_samples(const Fetched& reference, const Fetched& actual, const ComparisonJob& job,
                     ComparedPair& result) {
  const bool as_rgb = job.tolerance.threshold.has_value();
  const auto pair = std::make_shared<SamplePair>(reference, actual, as_rgb);
  FrameComparison& row = result.row;
  row.is_yuv = pair->is_yuv();
  row.reference = [pair] { return pair->reference_picture(); };
  row.actual = [pair] { return pair->actual_picture(); };
  row.problem = pair->mismatch();
  row.outcome = Outcome::mismatch;
  result.held_bytes = pair->held_bytes();
  if (!row.problem.empty()) return;
  result.is_compared = true;
  row.width_px = pair->size().width_px;
  row.masks = masks_of(job, pair->size(), result);
  pair->unify();
  row.difference = pair->apply([&](const auto& a, const auto& b) {
    return compare(comparable(a), comparable(b), job.tolerance, row.masks);
  });
  const bool is_same = row.difference->is_equal() && row.difference->masked_pixels == 0;
  row.outcome = is_same                       ? Outcome::equal
                : row.difference->is_accepted ? Outcome::accepted
                                              : Outcome::different;
  row.deltas =
      made_once([pair, masks = row.masks, ignores_transparent = job.tolerance.ignores_transparent] {
        return pair->apply([&](const auto& a, const auto& b) {
          return pixel_deltas(a, b, masks, ignores_transparent);
        });
      });
}

}  // namespace

void add_unreadable(FrameComparison& row, const std::string& problem) {
  row.outcome = Outcome::unreadable;
  if (problem == row.problem) return;
  row.problem += (row.problem.empty() ? "" : "; ") + problem;
}

Fetched fetch_picture(const ListedPicture& picture) { return decoded(picture, file_of(picture)); }

ComparedPair compare_pictures(const ListedPicture& reference, const ListedPicture& actual,
                              bool in_threads, const ComparisonJob& job) {
  using Side = std::pair<const ListedPicture*, Bytes>;
  Side a(&reference, {});
  Side b(&actual, {});
  in_threads = in_threads && is_worth_a_thread(reference.path);
  std::tie(a.second, b.second) =
      on_two_threads(in_threads, a, b, [](const Side& side) { return file_of(*side.first); });
  if constexpr (kReadsPackedPng) {
    const bool may_be_equal = job.masks.empty() && a.second == b.second;
    if (may_be_equal && is_whole_png(std::move(b.second))) return equal_pair(reference, actual);
  }
  const auto [expected, found] = on_two_threads(
      in_threads, a, b, [](Side& side) { return decoded(*side.first, std::move(side.second)); });
  return compare_frames(expected, found, job);
}

ComparedPair compare_frames(const Fetched& reference, const Fetched& actual,
                            const ComparisonJob& job) {
  ComparedPair result{
      .row = {}, .has_reference = reference.is_there, .has_actual = actual.is_there};
  for (std::size_t i = 0; i < job.masks.size(); ++i) {
    if (concerns(job.masks[i], reference, actual)) result.mask_indices.push_back(i);
  }
  FrameComparison& row = result.row;
  row.name = row_name(reference, actual);
  row.key = reference.is_there ? reference.key : actual.key;
  if (reference.is_read()) row.reference_path = reference.path;
  if (actual.is_read()) row.actual_path = actual.path;
  if (reference.is_read() && actual.is_read()) {
    try {
      compare_samples(reference, actual, job, result);
    } catch (const MediaError& error) {
      add_unreadable(row, error.what());
    }
    return result;
  }
  if (reference.is_read()) row.reference = picture_of(reference.frame);
  if (actual.is_read()) row.actual = picture_of(actual.frame);
  row.outcome = reference.is_there ? Outcome::missing : Outcome::added;
  for (const std::string& problem : {reference.problem, actual.problem}) {
    if (!problem.empty()) add_unreadable(row, problem);
  }
  return result;
}

}  // namespace piblocks
