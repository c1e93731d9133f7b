#include "golden/frame_shift.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <functional>
#include <limits>
#include <numeric>

#include "core/text.hpp"

namespace piblocks {
namespace {

constexpr int kColumns = 640;            // of pixels that are read, at least
constexpr std::size_t kMostFrames = 64;  // that are looked at
constexpr int kMostShift = 24;           // so that most of them are compared
constexpr double kAlike = 2;  // square levels: more than a lossy encoder leaves of equal frames
constexpr double kTimesCloser = 4;  // than by any other shift, or the speed is another one

}  // namespace

FrameShift::Thumbnail FrameShift::thumbnail_of(const Image& image) {
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

void FrameShift::add(std::int64_t number, const FrameComparison& frame) {
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

double FrameShift::distance(int frames_later) const {
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

}  // namespace piblocks
