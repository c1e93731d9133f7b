#include <fmt/format.h>
#include <piblocks/compare.hpp>
#include <piblocks/error.hpp>

#include <algorithm>
#include <future>
#include <memory>
#include <tuple>
#include <utility>
#include <variant>

#include "core/text.hpp"
#include "core/waiting_thread.hpp"
#include "golden/frame_source.hpp"

namespace piblocks {
namespace {

using OnFrame = std::function<void(const FrameComparison&)>;

bool is_framehash(const std::string& name) {
  return has_ending(name, ".framehash") || has_ending(name, ".framemd5");
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
SamplePair at_one_depth(AnyImage reference, AnyImage actual) {
  const int max_level = std::max(max_level_of(reference), max_level_of(actual));
  if (max_level == 255) return {std::move(reference), std::move(actual)};
  return {deepened(std::move(reference), max_level), deepened(std::move(actual), max_level)};
}

ImageView comparable(const Image& image) { return image.view(); }
const DeepImage& comparable(const DeepImage& image) { return image; }

std::string size_of(const AnyImage& samples) {
  return std::visit(
      [](const auto& image) { return fmt::format("{}x{}", image.width_px, image.height_px); },
      samples);
}

void take(const FrameComparison& frame, ComparisonResult& result) {
  ++result.frames;
  result.different_frames += frame.is_equal() ? 0 : 1;
  result.refused_frames += frame.is_accepted ? 0 : 1;
}

Verdict verdict_of(const ComparisonResult& result) {
  if (!result.mismatch.empty()) return Verdict::mismatch;
  if (result.refused_frames > 0) return Verdict::different;
  return result.different_frames > 0 ? Verdict::accepted : Verdict::equal;
}

std::string count_mismatch(std::int64_t reference, std::int64_t actual) {
  return fmt::format("the reference has {} frames, the other {}", reference, actual);
}

class PictureComparison {
 public:
  PictureComparison(const ComparisonJob& job, std::stop_token stop)
      : job_(job),
        stop_(std::move(stop)),
        reference_(open_frames(job.reference, stop_)),
        actual_(open_frames(job.actual, stop_)) {}

  ComparisonResult run(const OnFrame& on_frame) {
    while (true) {
      if (stop_.stop_requested()) throw Interrupted("compare: interrupted");
      // Reading is nearly all of the work.
      auto reading = std::async(std::launch::async, [this] {
        const WaitingThread this_thread;
        return reference_->next();
      });
      const bool has_actual = actual_->next();
      const bool has_reference = reading.get();
      if (has_reference != has_actual) {
        result_.mismatch = count_mismatch(result_.frames + frames_left(*reference_, has_reference),
                                          result_.frames + frames_left(*actual_, has_actual));
      }
      if (!has_reference || !has_actual || !compare_frame(on_frame)) break;
    }
    result_.verdict = verdict_of(result_);
    return result_;
  }

 private:
  static std::int64_t frames_left(FrameReader& reader, bool has_frame) {
    std::int64_t count = has_frame ? 1 : 0;
    while (has_frame && reader.next()) ++count;
    return count;
  }

  /// False if the frames do not fit.
  bool compare_frame(const OnFrame& on_frame) {
    const bool is_exact = reference_->layout() == actual_->layout();
    AnyImage reference = is_exact ? reference_->samples() : reference_->rgb();
    AnyImage actual = is_exact ? actual_->samples() : actual_->rgb();
    result_.mismatch = mismatch_of(reference, actual);
    if (!result_.mismatch.empty()) return false;
    const SamplePair pair = at_one_depth(std::move(reference), std::move(actual));
    FrameComparison frame;
    frame.number = result_.frames;
    frame.name = reference_->name();
    frame.is_yuv = is_exact && reference_->layout() != kRgba;
    frame.difference = pair.apply([this](const auto& a, const auto& b) {
      return compare(comparable(a), comparable(b), job_.tolerance, job_.masks);
    });
    frame.is_accepted = frame.difference->is_accepted;
    frame.reference = [&] { return flattened(frame.is_yuv ? reference_->rgb() : pair.reference); };
    frame.actual = [&] { return flattened(frame.is_yuv ? actual_->rgb() : pair.actual); };
    frame.deltas = [&] {
      return pair.apply(
          [this](const auto& a, const auto& b) { return pixel_deltas(a, b, job_.masks); });
    };
    take(frame, result_);
    on_frame(frame);
    return true;
  }

  std::string mismatch_of(const AnyImage& reference, const AnyImage& actual) const {
    const auto shown = [](const FrameReader& reader) {
      const std::string presentation = reader.presentation();
      return presentation.empty() ? "as it is stored" : presentation;
    };
    for (const auto& [is, expected, found] :
         {std::tuple{"is", size_of(reference), size_of(actual)},
          std::tuple{"is shown", shown(*reference_), shown(*actual_)}}) {
      if (expected == found) continue;
      return fmt::format("{} {} {} in the reference, {} in the other", reference_->name(), is,
                         expected, found);
    }
    return {};
  }

  const ComparisonJob& job_;
  std::stop_token stop_;
  std::unique_ptr<FrameReader> reference_;
  std::unique_ptr<FrameReader> actual_;
  ComparisonResult result_;
};

ComparisonResult compare_hashes(const ComparisonJob& job, const OnFrame& on_frame) {
  if (!is_framehash(job.reference) || !is_framehash(job.actual)) {
    throw UsageError("compare: hashes of frames can be compared with hashes only");
  }
  if (!job.tolerance.is_exact() || !job.masks.empty()) {
    throw UsageError("compare: hashes of frames know no tolerance and no masks");
  }
  const FramehashFile reference = read_framehash(job.reference);
  const FramehashFile actual = read_framehash(job.actual);
  ComparisonResult result;
  const auto differs = std::ranges::mismatch(reference.header, actual.header);
  if (differs.in1 != reference.header.end() || differs.in2 != actual.header.end()) {
    const auto line = [](auto at, const auto& header) {
      return at == header.end() ? std::string("nothing") : "'" + *at + "'";
    };
    result.mismatch =
        fmt::format("the headers differ: {} and {}", line(differs.in1, reference.header),
                    line(differs.in2, actual.header));
  } else if (reference.frames.size() != actual.frames.size()) {
    result.mismatch = count_mismatch(static_cast<std::int64_t>(reference.frames.size()),
                                     static_cast<std::int64_t>(actual.frames.size()));
  }
  const std::size_t common = std::min(reference.frames.size(), actual.frames.size());
  for (std::size_t i = 0; i < common; ++i) {
    FrameComparison frame;
    frame.number = static_cast<std::int64_t>(i);
    frame.name = fmt::format("frame {}", i);
    frame.is_accepted = reference.frames[i] == actual.frames[i];
    take(frame, result);
    on_frame(frame);
  }
  result.verdict = verdict_of(result);
  return result;
}

}  // namespace

ComparisonResult compare_files(const ComparisonJob& job, const OnFrame& on_frame,
                               const std::stop_token& stop) {
  const bool has_hashes = is_framehash(job.reference) || is_framehash(job.actual);
  ComparisonResult result =
      has_hashes ? compare_hashes(job, on_frame) : PictureComparison(job, stop).run(on_frame);
  if (result.frames == 0 && result.mismatch.empty()) {
    throw IoError(fmt::format("compare: there is no frame in '{}' and none in '{}'", job.reference,
                              job.actual));
  }
  return result;
}

}  // namespace piblocks
