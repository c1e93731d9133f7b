// The order of a comparison: two sides are lined up in steps, and every step becomes a row.
#include <fmt/format.h>
#include <piblocks/compare.hpp>
#include <piblocks/error.hpp>

#include <algorithm>
#include <filesystem>
#include <memory>
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
#include "golden/frame_shift.hpp"
#include "golden/frame_side.hpp"
#include "golden/hash_file.hpp"
#include "golden/picture_list.hpp"
#include "golden/rows.hpp"
#include "media/libav/av_module.hpp"
#include "media/png/png_reader.hpp"

namespace piblocks {
namespace fs = std::filesystem;
namespace {

/// Takes compared pairs in their order.
class PairTaker {
 public:
  PairTaker(const ComparisonJob& job, Rows& rows)
      : job_(job), rows_(rows), hides_(job.masks.size()) {}

  void take(ComparedPair pair) {
    is_compared_ |= pair.is_compared;
    for (const std::size_t mask : pair.mask_indices) hides_[mask] = true;
    rows_.take(std::move(pair.row), pair.has_reference, pair.has_actual);
  }
  /// @throws UsageError if a mask lies outside of every picture.
  void finish() const {
    if (!is_compared_) return;
    for (std::size_t i = 0; i < hides_.size(); ++i) {
      const Mask& mask = job_.masks[i];
      if (hides_[i] || !mask.must_hide) continue;
      throw UsageError(
          mask.name_pattern.empty()
              ? fmt::format("compare: the mask {} lies outside of every picture that is compared",
                            mask.text)
              : fmt::format("compare: the mask {} hides nothing: no picture that is compared has "
                            "this name, or the mask lies outside of it",
                            mask.text));
    }
  }

 private:
  const ComparisonJob& job_;
  Rows& rows_;
  std::vector<bool> hides_;  // of each mask: a part of some picture
  bool is_compared_ = false;
};

/// Compares frame by frame. Both sides are read at once, since reading is nearly all of the work.
/// @returns how the frames of one side are shifted, if they are
std::string compare_sides(FrameSide& reference, FrameSide& actual, const ComparisonJob& job,
                          PairTaker& taker, const std::stop_token& stop) {
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
      taker.take(std::move(pair));
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

/// A pair for each processor; a lone pair has two.
void compare_pairs(const PictureList& reference, const PictureList& actual,
                   const std::vector<PicturePair>& pairs, const ComparisonJob& job,
                   PairTaker& taker, const std::stop_token& stop) {
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
  if (pairs.size() == 1) return taker.take(compare_pair(0, stop));
  using Pool = OrderedPool<ComparedPair>;
  Pool pool(
      std::ssize(pairs), processor_count(), [&] { return Pool::Task(compare_pair); },
      [](const ComparedPair& pair) { return pair.held_bytes; });
  while (auto pair = pool.take(stop)) taker.take(*std::move(pair));
  check_stop(stop);
}

/// Lines up two lists of pictures by name or number, and compares them.
void compare_lists(const ComparisonJob& job, Rows& rows, PairTaker& taker,
                   const std::stop_token& stop) {
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
  compare_pairs(reference, actual, pairs, job, taker, stop);
}

void compare_frames_of(const ComparisonJob& job, Rows& rows, const std::stop_token& stop) {
  PairTaker taker(job, rows);
  if (!is_video(job.reference) && !is_video(job.actual)) {
    compare_lists(job, rows, taker, stop);
  } else {
    const auto reference = open_side(job.reference, job, rows, stop);
    const auto actual = open_side(job.actual, job, rows, stop);
    rows.set_note(compare_sides(*reference, *actual, job, taker, stop));
  }
  taker.finish();
}

}  // namespace

ComparisonResult compare_pair(const Fetched& reference, const Fetched& actual,
                              const ComparisonJob& job, const OnFrame& on_frame) {
  Rows rows(on_frame);
  PairTaker taker(job, rows);
  taker.take(compare_frames(reference, actual, job));
  taker.finish();
  return rows.finish(job);
}

ComparisonResult compare_files(const ComparisonJob& job, const OnFrame& on_frame,
                               const std::stop_token& stop) {
  Rows rows(on_frame);
  if (is_framehash(job.reference) || is_framehash(job.actual)) {
    compare_hashes(job, rows);
  } else {
    compare_frames_of(job, rows, stop);
  }
  return rows.finish(job);
}

}  // namespace piblocks
