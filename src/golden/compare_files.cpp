// The order of a comparison: two sides are lined up in steps, and every step becomes a row.
#include <fmt/format.h>
#include <piblocks/compare.hpp>
#include <piblocks/error.hpp>

#include <algorithm>
#include <filesystem>
#include <future>
#include <memory>
#include <optional>
#include <system_error>
#include <utility>
#include <variant>

#include "core/stop.hpp"
#include "core/text.hpp"
#include "core/waiting_thread.hpp"
#include "golden/frame_side.hpp"
#include "golden/hash_file.hpp"
#include "golden/picture_list.hpp"
#include "golden/rows.hpp"
#include "media/libav/av_module.hpp"
#include "media/png/png_reader.hpp"

namespace piblocks {
namespace fs = std::filesystem;
namespace {

/// "a.png", or "a.png and b.png".
std::string both_names(const std::string& reference, const std::string& actual) {
  return reference == actual ? reference : fmt::format("{} and {}", reference, actual);
}

struct SamplePair {
  AnyImage reference;
  AnyImage actual;

  template <typename Operation>
  auto apply(const Operation& operation) const {
    if (const auto* const a = std::get_if<Image>(&reference)) {
      return operation(*a, std::get<Image>(actual));
    }
    return operation(std::get<DeepImage>(reference), std::get<DeepImage>(actual));
  }
};

/// Brings both to the greater depth.
SamplePair at_one_depth(SamplePair pair) {
  const int max_level = std::max(max_level_of(pair.reference), max_level_of(pair.actual));
  if (max_level == 255) return pair;
  return {deepened(std::move(pair.reference), max_level),
          deepened(std::move(pair.actual), max_level)};
}

ImageView comparable(const Image& image) { return image.view(); }
const DeepImage& comparable(const DeepImage& image) { return image; }

struct Size {
  int width_px;
  int height_px;
};

Size size_of(const AnyImage& samples) {
  return std::visit(
      [](const auto& image) {
        return Size{image.width_px, image.height_px};
      },
      samples);
}

/// Empty if the frames can be compared.
std::string mismatch_of(Size expected, Size found, const FrameReader& reference,
                        const FrameReader& actual) {
  if (expected.width_px != found.width_px || expected.height_px != found.height_px) {
    return fmt::format("another size: {}x{} instead of {}x{}", found.width_px, found.height_px,
                       expected.width_px, expected.height_px);
  }
  const auto shown = [](const FrameReader& reader) {
    const std::string presentation = reader.presentation();
    return presentation.empty() ? "as it is stored" : presentation;
  };
  if (shown(reference) == shown(actual)) return {};
  return fmt::format("shown another way: {} instead of {}", shown(actual), shown(reference));
}

/// The masks, and which of them cover a part of a picture.
class Masks {
 public:
  explicit Masks(const std::vector<PixelRect>& masks) : masks_(masks), has_met_(masks.size()) {}

  void meet(Size size) {
    has_picture_ = true;
    for (std::size_t i = 0; i < masks_.size(); ++i) {
      const PixelRect& mask = masks_[i];
      if (mask.x_px < size.width_px && mask.y_px < size.height_px) has_met_[i] = true;
    }
  }
  /// @throws UsageError if one lies outside of every picture.
  void check() const {
    if (!has_picture_) return;
    for (std::size_t i = 0; i < masks_.size(); ++i) {
      if (has_met_[i]) continue;
      const PixelRect& mask = masks_[i];
      throw UsageError(fmt::format(
          "compare: the mask {}x{}+{}+{} lies outside of every picture that is compared",
          mask.width_px, mask.height_px, mask.x_px, mask.y_px));
    }
  }

 private:
  const std::vector<PixelRect>& masks_;
  std::vector<bool> has_met_;
  bool has_picture_ = false;
};

/// What one side has at a step: a frame, a frame that cannot be read, or none.
struct Fetched {
  bool is_there = false;
  std::string problem;

  bool is_read() const { return is_there && problem.empty(); }
};

class FrameComparer {
 public:
  FrameComparer(const ComparisonJob& job, Rows& rows, std::stop_token stop)
      : job_(job), rows_(rows), stop_(std::move(stop)), masks_(job.masks) {}

  void run(FrameSide& reference, FrameSide& actual) {
    while (true) {
      check_stop(stop_);
      const auto a = reference.next_step();
      const auto b = actual.next_step();
      if (!a && !b) break;
      const bool has_a = a && (!b || *a <= *b);
      const bool has_b = b && (!a || *b <= *a);
      std::future<Fetched> reading;
      if (has_a && has_b) reading = fetch_in_thread(reference);
      const Fetched found = has_b ? fetch(actual) : Fetched();
      const Fetched expected = reading.valid() ? reading.get()
                               : has_a         ? fetch(reference)
                                               : Fetched();
      check_stop(stop_);
      if (expected.is_there || found.is_there) add_row(reference, expected, actual, found);
      const auto is_broken = [](const FrameSide& side, const Fetched& fetched) {
        return !fetched.problem.empty() && !side.goes_on_after_failure();
      };
      if (is_broken(reference, expected) || is_broken(actual, found)) break;
    }
    masks_.check();
  }

 private:
  /// Fetches in another thread, since reading is nearly all of the work.
  /// @returns an invalid future if no thread can be started.
  std::future<Fetched> fetch_in_thread(FrameSide& side) {
    try {
      return std::async(std::launch::async, [this, &side] {
        const WaitingThread this_thread;
        return fetch(side);
      });
    } catch (const std::system_error&) {
      return {};
    }
  }
  /// Once a stop has been requested, a failed call has been broken off: the frame has no problem.
  Fetched fetch(FrameSide& side) const {
    try {
      return {side.fetch(), {}};
    } catch (const IoError& error) {
      if (stop_.stop_requested()) throw;
      return {true, error.what()};
    } catch (const MediaError& error) {
      if (stop_.stop_requested()) throw;
      return {true, error.what()};
    }
  }

  void add_row(FrameSide& reference, const Fetched& expected, FrameSide& actual,
               const Fetched& found) {
    const bool is_pair = expected.is_there && found.is_there;
    const bool is_one_broken = expected.problem.empty() != found.problem.empty();
    FrameComparison row;
    if (is_pair && !is_one_broken) {
      row.name = both_names(reference.name(), actual.name());
    } else {
      row.name =
          (is_pair ? found.problem.empty() : expected.is_there) ? reference.name() : actual.name();
    }
    row.key = expected.is_there ? reference.key() : actual.key();
    if (expected.is_read()) row.reference_path = reference.path();
    if (found.is_read()) row.actual_path = actual.path();
    if (expected.is_read() && found.is_read())
      return compare(row, reference.frame(), actual.frame());
    if (expected.is_read()) row.reference = picture_of(reference.frame());
    if (found.is_read()) row.actual = picture_of(actual.frame());
    row.outcome = expected.is_there ? Outcome::missing : Outcome::added;
    if (!expected.problem.empty()) add_unreadable(row, expected.problem);
    if (!found.problem.empty()) add_unreadable(row, found.problem);
    rows_.take(row, expected.is_there, found.is_there);
  }
  /// Converts the picture when it is first asked for.
  static std::function<Image()> picture_of(FrameReader& frame) {
    return [&frame, picture = std::optional<Image>()]() mutable {
      if (!picture) picture = shown(frame);
      return *picture;
    };
  }
  static Image shown(FrameReader& frame) {
    try {
      return flattened(frame.rgb());
    } catch (const MediaError&) {
      return {};
    }
  }

  void compare(FrameComparison& row, FrameReader& reference, FrameReader& actual) {
    const bool is_exact = reference.layout() == actual.layout();
    row.is_yuv = is_exact && reference.layout() != kRgba;
    SamplePair pair;
    try {
      pair.reference = is_exact ? reference.samples() : reference.rgb();
      pair.actual = is_exact ? actual.samples() : actual.rgb();
    } catch (const MediaError& error) {
      add_unreadable(row, error.what());
      return rows_.take(row, true, true);
    }
    const Size size = size_of(pair.reference);
    row.problem = mismatch_of(size, size_of(pair.actual), reference, actual);
    row.reference = [&] { return row.is_yuv ? shown(reference) : flattened(pair.reference); };
    row.actual = [&] { return row.is_yuv ? shown(actual) : flattened(pair.actual); };
    row.outcome = Outcome::mismatch;
    if (row.problem.empty()) {
      masks_.meet(size);
      row.width_px = size.width_px;
      pair = at_one_depth(std::move(pair));
      compare_samples(row, pair);
      row.deltas = [&] {
        return pair.apply(
            [this](const auto& a, const auto& b) { return pixel_deltas(a, b, job_.masks); });
      };
    }
    rows_.take(row, true, true);
  }

  void compare_samples(FrameComparison& row, const SamplePair& pair) const {
    row.difference = pair.apply([this](const auto& a, const auto& b) {
      return piblocks::compare(comparable(a), comparable(b), job_.tolerance, job_.masks);
    });
    const bool is_same = row.difference->is_equal() && row.difference->masked_pixels == 0;
    row.outcome = is_same                       ? Outcome::equal
                  : row.difference->is_accepted ? Outcome::accepted
                                                : Outcome::different;
  }

  const ComparisonJob& job_;
  Rows& rows_;
  std::stop_token stop_;
  Masks masks_;
};

/// Whether a name stands for a video; an animated PNG file is one. A PNG file that cannot be read
/// counts as a picture: reading that reports the reason.
bool is_video(const std::string& name) {
  std::error_code unknown;
  const fs::file_status status = fs::status(name, unknown);
  if (is_picture_pattern(name) || !fs::exists(status) || fs::is_directory(status)) return false;
  if (!has_ending(name, ".png")) return true;
  if (!fs::is_regular_file(status)) return false;
  try {
    return is_animated_png(name);
  } catch (const Error&) {
    return false;
  }
}

/// The pictures of a list, at the steps of a video beside it.
std::vector<PlacedPicture> placed_in_order(PictureList list) {
  std::vector<PlacedPicture> placed;
  const std::int64_t first = list.pictures.empty() ? 0 : list.pictures[0].number.value_or(0);
  for (ListedPicture& picture : list.pictures) {
    const auto place = static_cast<std::int64_t>(placed.size());
    const std::int64_t step = picture.number ? *picture.number - first : place;
    placed.push_back({step, std::move(picture)});
  }
  return placed;
}

std::unique_ptr<FrameSide> open_side(const std::string& name, const ComparisonJob& job, Rows& rows,
                                     const std::stop_token& stop) {
  if (is_video(name)) return video_side(name, stop);
  PictureList list = list_pictures(name, job.is_recursive);
  rows.set_problem(list.problem);
  return picture_side(placed_in_order(std::move(list)));
}

/// Lines up two lists of pictures by name or number, and compares them.
void compare_lists(const ComparisonJob& job, Rows& rows, FrameComparer& comparer) {
  const PictureList reference = list_pictures(job.reference, job.is_recursive);
  const PictureList actual = list_pictures(job.actual, job.is_recursive);
  std::vector<PlacedPicture> expected;
  std::vector<PlacedPicture> found;
  const auto is_open = [](const PictureList& list) {
    return !list.pictures.empty() &&
           std::ranges::all_of(list.pictures, &std::string::empty, &ListedPicture::problem);
  };
  bool has_pair = !is_open(reference) || !is_open(actual);
  std::int64_t step = 0;
  for (const PicturePair& pair : paired(reference, actual)) {
    if (pair.reference) expected.push_back({step, reference.pictures[*pair.reference]});
    if (pair.actual) found.push_back({step, actual.pictures[*pair.actual]});
    has_pair |= pair.reference && pair.actual;
    ++step;
  }
  rows.set_problem(reference.problem);
  rows.set_problem(actual.problem);
  if (!has_pair) {
    rows.set_problem(
        fmt::format("no picture of '{}' has the name of one of '{}'; patterns such as "
                    "FOLDER/%06d.png pair pictures by number",
                    job.actual, job.reference));
  }
  comparer.run(*picture_side(std::move(expected)), *picture_side(std::move(found)));
}

void compare_pictures(const ComparisonJob& job, Rows& rows, const std::stop_token& stop) {
  FrameComparer comparer(job, rows, stop);
  if (!is_video(job.reference) && !is_video(job.actual)) return compare_lists(job, rows, comparer);
  const auto reference = open_side(job.reference, job, rows, stop);
  const auto actual = open_side(job.actual, job, rows, stop);
  comparer.run(*reference, *actual);
}

}  // namespace

ComparisonResult compare_files(const ComparisonJob& job, const OnFrame& on_frame,
                               const std::stop_token& stop) {
  Rows rows(on_frame);
  if (is_framehash(job.reference) || is_framehash(job.actual)) {
    compare_hashes(job, rows);
  } else {
    compare_pictures(job, rows, stop);
  }
  return rows.finish(job);
}

}  // namespace piblocks
