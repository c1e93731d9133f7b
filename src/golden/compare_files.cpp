// The order of a comparison: two sides are lined up in steps, and every step becomes a row.
#include <fmt/format.h>
#include <piblocks/compare.hpp>
#include <piblocks/error.hpp>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>
#include <system_error>
#include <utility>

#include "core/ordered_pool.hpp"
#include "core/processors.hpp"
#include "core/stop.hpp"
#include "core/text.hpp"
#include "core/threads.hpp"
#include "core/waiting_thread.hpp"
#include "golden/frame_pair.hpp"
#include "golden/picture_list.hpp"
#include "golden/rows.hpp"
#include "media/libav/av_module.hpp"
#include "media/png/png_reader.hpp"

namespace piblocks {
namespace fs = std::filesystem;
namespace {

/// One side of a comparison: its frames, one step after the other.
class FrameSide {
 public:
  virtual ~FrameSide() = default;
  /// The step at which the next frame stands; nothing after the last. A video may turn out to have
  /// none there.
  virtual std::optional<std::int64_t> next_step() const = 0;
  /// Goes to that step and reads its frame, which stays until the next call.
  /// @throws IoError, MediaError once a stop has been requested: then the frame has no problem.
  virtual Fetched fetch() = 0;
  /// Whether frames after one that cannot be read can be fetched.
  virtual bool goes_on_after_failure() const = 0;
};

/// PNG files: those of a pattern by their numbers, counted from the first; others in their order.
class PictureSide final : public FrameSide {
 public:
  explicit PictureSide(std::vector<ListedPicture> pictures) : pictures_(std::move(pictures)) {}

  std::optional<std::int64_t> next_step() const override {
    if (fetched_ == pictures_.size()) return std::nullopt;
    const std::optional<std::int64_t>& number = pictures_[fetched_].number;
    return number ? *number - pictures_.front().number.value_or(0) : std::int64_t(fetched_);
  }
  Fetched fetch() override { return fetch_picture(pictures_[fetched_++]); }
  bool goes_on_after_failure() const override { return true; }

 private:
  std::vector<ListedPicture> pictures_;
  std::size_t fetched_ = 0;
};

/// Any file that libavformat reads, opened when the first frame is fetched. It has a frame at every
/// step.
class VideoSide final : public FrameSide {
 public:
  VideoSide(std::string path, std::stop_token stop)
      : path_(std::move(path)), stop_(std::move(stop)) {}

  std::optional<std::int64_t> next_step() const override {
    return is_over_ ? std::nullopt : std::optional(fetched_);
  }
  Fetched fetch() override {
    Fetched fetched{.is_there = true};
    try {
      fetched.is_there = read();
    } catch (const IoError& error) {
      if (stop_.stop_requested()) throw;
      fetched.problem = error.what();
    } catch (const MediaError& error) {
      if (stop_.stop_requested()) throw;
      fetched.problem = error.what();
    }
    const std::int64_t number = is_over_ ? fetched_ : fetched_ - 1;
    fetched.name = reader_ ? fmt::format("frame {}", number) : fs::path(path_).filename().string();
    fetched.key = reader_ ? frame_key(number) : fetched.name;
    fetched.frame = reader_;
    return fetched;
  }
  bool goes_on_after_failure() const override { return false; }

 private:
  bool read() {
    is_over_ = true;  // if this throws
    if (!reader_) reader_ = read_video(path_, stop_);
    is_over_ = !reader_->next();
    if (!is_over_) ++fetched_;
    return !is_over_;
  }

  std::string path_;
  std::stop_token stop_;
  std::shared_ptr<FrameReader> reader_;
  bool is_over_ = false;
  std::int64_t fetched_ = 0;
};

// How a shift of frames between two videos is found.
constexpr int kColumns = 640;            // of pixels that are read, at least
constexpr std::size_t kMostFrames = 64;  // that are looked at
constexpr int kMostShift = 24;           // so that most of them are compared
constexpr double kAlike = 2;  // square levels: more than a lossy encoder leaves of equal frames
constexpr double kTimesCloser = 4;  // than by any other shift, or the speed is another one

constexpr int kAcross = 32;
constexpr int kDown = 18;
/// The mean red, green and blue of the parts of a picture.
using Thumbnail = std::array<float, std::size_t{3} * kAcross * kDown>;

Thumbnail thumbnail_of(const Image& image) {
  Thumbnail sums = {};
  std::array<float, std::size_t{kAcross}* kDown> counts = {};
  const int step = std::max(1, image.width_px / kColumns);
  for (int y = 0; y < image.height_px; y += step) {
    const std::uint32_t* const row = image.words.data() + std::ptrdiff_t{y} * image.width_px;
    const int first = y * kDown / image.height_px * kAcross;
    for (int x = 0; x < image.width_px; x += step) {
      const auto part = static_cast<unsigned>(first + x * kAcross / image.width_px);
      for (unsigned c = 0; c < 3; ++c) {
        sums.at(3 * part + c) += float((row[x] >> (8 * c)) & 0xff);
      }
      ++counts.at(part);
    }
  }
  for (std::size_t i = 0; i < sums.size(); ++i) sums[i] /= std::max(1.0F, counts[i / 3]);
  return sums;
}

/// Whether one side shows what the other one shows, some frames earlier or later. Looks at the
/// frames from the first that is different, since those before are equal.
class FrameShift {
 public:
  void add(std::int64_t number, const FrameComparison& frame) {
    if (reference_.empty() && actual_.empty()) {
      if (frame.outcome != Outcome::different) return;
      first_ = number;
    }
    const auto take = [](const std::function<Image()>& picture, std::vector<Thumbnail>& to) {
      if (!picture || to.size() == kMostFrames) return;
      if (const Image image = picture(); !image.words.empty()) to.push_back(thumbnail_of(image));
    };
    take(frame.reference, reference_);
    take(frame.actual, actual_);
  }
  /// "from frame 12 on, frames look like those of the reference 2 frames before them"; empty if
  /// they do not.
  std::string text() const;

 private:
  /// The mean square difference of the frames that both sides have if the actual ones come later.
  double distance(int frames_later) const {
    const auto a = reference_.begin() + std::max(0, -frames_later);
    const auto b = actual_.begin() + std::max(0, frames_later);
    const auto frames = std::min(reference_.end() - a, actual_.end() - b);
    double sum = 0;
    for (std::ptrdiff_t i = 0; i < frames; ++i) {
      sum += std::transform_reduce(a[i].begin(), a[i].end(), b[i].begin(), 0.0, std::plus<>(),
                                   [](float x, float y) { return double((x - y) * (x - y)); });
    }
    return sum / static_cast<double>(frames) / static_cast<double>(Thumbnail().size());
  }

  std::int64_t first_ = 0;
  std::vector<Thumbnail> reference_;
  std::vector<Thumbnail> actual_;
};

std::string FrameShift::text() const {
  const int frames = static_cast<int>(std::min(reference_.size(), actual_.size()));
  const int most = std::min(kMostShift, frames / 2);
  int best = 0;
  double least = std::numeric_limits<double>::infinity();
  double second = least;
  for (int shift = -most; shift <= most; ++shift) {
    const double found = distance(shift);
    second = std::min(second, std::max(found, least));
    if (found >= least) continue;
    best = shift;
    least = found;
  }
  if (best == 0 || least > kAlike || least * kTimesCloser > second || second == 0) return {};
  return fmt::format("from frame {} on, frames look like those of the reference {} {} them", first_,
                     counted(std::abs(best), "frame"), best > 0 ? "before" : "after");
}

/// Compares frame by frame. Both sides are read at once, since reading is nearly all of the work.
/// @returns how the frames of one side are shifted, if they are
std::string compare_sides(FrameSide& reference, FrameSide& actual, const ComparisonJob& job,
                          Rows& rows, const std::stop_token& stop) {
  FrameShift shift;
  while (true) {
    check_stop(stop);
    const auto a = reference.next_step();
    const auto b = actual.next_step();
    if (!a && !b) return shift.text();
    std::pair<FrameSide*, bool> first(&reference, a && (!b || *a <= *b));
    std::pair<FrameSide*, bool> second(&actual, b && (!a || *b <= *a));
    auto [expected, found] =
        on_two_threads(first.second && second.second, first, second, [](const auto& side) {
          const WaitingThread this_thread;
          return side.second ? side.first->fetch() : Fetched();
        });
    check_stop(stop);
    const auto is_broken = [](const FrameSide& side, const Fetched& fetched) {
      return !fetched.problem.empty() && !side.goes_on_after_failure();
    };
    const bool ends = is_broken(reference, expected) || is_broken(actual, found);
    if (expected.is_there || found.is_there) {
      ComparedPair pair = compare_frames(expected, found, job);
      shift.add(first.second ? *a : *b, pair.row);
      rows.take(std::move(pair));
    }
    if (ends) return shift.text();
  }
}

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

std::unique_ptr<FrameSide> open_side(const std::string& name, const ComparisonJob& job, Rows& rows,
                                     const std::stop_token& stop) {
  if (is_video(name)) return std::make_unique<VideoSide>(name, stop);
  PictureList list = list_pictures(name, job.is_recursive);
  rows.set_problem(list.problem);
  return std::make_unique<PictureSide>(std::move(list.pictures));
}

/// A pair for each processor; a lone pair has two.
void compare_pairs(const PictureList& reference, const PictureList& actual,
                   const std::vector<PicturePair>& pairs, const ComparisonJob& job, Rows& rows,
                   const std::stop_token& stop) {
  const auto compare_pair = [&](std::int64_t index, const std::stop_token&) {
    const PicturePair& pair = pairs[std::size_t(index)];
    if (pair.reference && pair.actual) {
      return compare_pictures(reference.pictures[*pair.reference], actual.pictures[*pair.actual],
                              pairs.size() == 1 && processor_count() > 1, job);
    }
    const auto fetched = [](const PictureList& list, std::optional<std::size_t> place) {
      return place ? fetch_picture(list.pictures[*place]) : Fetched();
    };
    return compare_frames(fetched(reference, pair.reference), fetched(actual, pair.actual), job);
  };
  if (pairs.size() == 1) return rows.take(compare_pair(0, stop));
  using Pool = OrderedPool<ComparedPair>;
  Pool pool(
      std::ssize(pairs), processor_count(), [&] { return Pool::Task(compare_pair); },
      [](const ComparedPair& pair) { return pair.held_bytes; });
  while (auto pair = pool.take(stop)) rows.take(*std::move(pair));
  check_stop(stop);
}

/// Lines up two lists of pictures by name or number, and compares them.
void compare_lists(const ComparisonJob& job, Rows& rows, const std::stop_token& stop) {
  const PictureList reference = list_pictures(job.reference, job.is_recursive);
  const PictureList actual = list_pictures(job.actual, job.is_recursive);
  const std::vector<PicturePair> pairs = paired(reference, actual);
  const auto is_open = [](const PictureList& list) {
    return !list.pictures.empty() &&
           std::ranges::all_of(list.pictures, &std::string::empty, &ListedPicture::problem);
  };
  const bool has_pair =
      !is_open(reference) || !is_open(actual) ||
      std::ranges::any_of(pairs, [](const PicturePair& p) { return p.reference && p.actual; });
  rows.set_problem(reference.problem);
  rows.set_problem(actual.problem);
  if (!has_pair) {
    rows.set_problem(
        fmt::format("no picture of '{}' has the name of one of '{}'; patterns such as "
                    "FOLDER/%06d.png pair pictures by number",
                    job.actual, job.reference));
  }
  compare_pairs(reference, actual, pairs, job, rows, stop);
}

}  // namespace

ComparisonResult compare_pair(const Fetched& reference, const Fetched& actual,
                              const ComparisonJob& job, const OnFrame& on_frame) {
  Rows rows(job, on_frame);
  rows.take(compare_frames(reference, actual, job));
  return rows.finish();
}

ComparisonResult compare_files(const ComparisonJob& job, const OnFrame& on_frame,
                               const std::stop_token& stop) {
  Rows rows(job, on_frame);
  if (is_framehash(job.reference) || is_framehash(job.actual)) {
    compare_hashes(job, rows);
  } else if (is_video(job.reference) || is_video(job.actual)) {
    const auto reference = open_side(job.reference, job, rows, stop);
    const auto actual = open_side(job.actual, job, rows, stop);
    rows.set_note(compare_sides(*reference, *actual, job, rows, stop));
  } else {
    compare_lists(job, rows, stop);
  }
  return rows.finish();
}

}  // namespace piblocks
