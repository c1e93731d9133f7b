#include "golden/frame_pair.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <functional>
#include <type_traits>
#include <variant>

#include "core/input_file.hpp"
#include "core/threads.hpp"
#include "golden/packed_rows.hpp"
#include "golden/rows.hpp"
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
  Fetched fetched{.is_there = true, .name = name_of(picture)};
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

/// Converts the picture when it is first asked for.
std::function<Image()> picture_of(const std::shared_ptr<FrameReader>& frame) {
  return [frame, picture = std::optional<Image>()]() mutable {
    if (!picture) picture = shown_picture(*frame);
    return *picture;
  };
}

ComparedPair equal_pair(const ListedPicture& reference, const ListedPicture& actual) {
  ComparedPair result{.row = {}, .has_reference = true, .has_actual = true};
  result.row.name = both_names(name_of(reference), name_of(actual));
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
  SamplePair(Fetched reference, Fetched actual)
      : reference_(std::move(reference)), actual_(std::move(actual)) {
    is_yuv_ = is_exact() && reference_.frame->layout() != kRgba;
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
  bool is_exact() const { return reference_.frame->layout() == actual_.frame->layout(); }
  int max_level() const { return max_level_of(*expected_); }
  Samples samples_of(FrameReader& frame) const {
    return std::make_shared<AnyImage>(is_exact() ? frame.samples() : frame.rgb());
  }
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

void compare_samples(const std::shared_ptr<SamplePair>& pair, const ComparisonJob& job,
                     ComparedPair& result) {
  FrameComparison& row = result.row;
  row.is_yuv = pair->is_yuv();
  row.reference = [pair] { return pair->reference_picture(); };
  row.actual = [pair] { return pair->actual_picture(); };
  row.problem = pair->mismatch();
  row.outcome = Outcome::mismatch;
  result.held_bytes = pair->held_bytes();
  if (!row.problem.empty()) return;
  result.size = pair->size();
  pair->unify();
  row.difference = pair->apply([&](const auto& a, const auto& b) {
    return compare(comparable(a), comparable(b), job.tolerance, job.masks);
  });
  const bool is_same = row.difference->is_equal() && row.difference->masked_pixels == 0;
  row.outcome = is_same                       ? Outcome::equal
                : row.difference->is_accepted ? Outcome::accepted
                                              : Outcome::different;
  row.deltas = [pair, masks = job.masks] {
    return pair->apply([&](const auto& a, const auto& b) { return pixel_deltas(a, b, masks); });
  };
}

}  // namespace

Fetched fetch_picture(const ListedPicture& picture) { return decoded(picture, file_of(picture)); }

ComparedPair compare_pictures(const ListedPicture& reference, const ListedPicture& actual,
                              bool in_threads, const ComparisonJob& job) {
  using Side = std::pair<const ListedPicture*, Bytes>;
  Side a(&reference, file_of(reference));
  Side b(&actual, file_of(actual));
  if constexpr (kReadsPackedPng) {
    const bool may_be_equal = job.masks.empty() && a.second == b.second;
    if (may_be_equal && is_whole_png(std::move(b.second))) return equal_pair(reference, actual);
  }
  auto [expected, found] = on_two_threads(
      in_threads, a, b, [](Side& side) { return decoded(*side.first, std::move(side.second)); });
  return compare_frames(std::move(expected), std::move(found), job);
}

ComparedPair compare_frames(Fetched reference, Fetched actual, const ComparisonJob& job) {
  ComparedPair result{
      .row = {}, .has_reference = reference.is_there, .has_actual = actual.is_there};
  FrameComparison& row = result.row;
  row.name = row_name(reference, actual);
  if (reference.is_read() && actual.is_read()) {
    try {
      compare_samples(std::make_shared<SamplePair>(std::move(reference), std::move(actual)), job,
                      result);
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
