#include "draw/blocks_together.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace piblocks {

std::span<const TogetherMoment> BlocksTogether::find(int column,
                                                     std::span<const std::size_t> some) {
  // Covers of a column that are computed at most, where very many thin blocks pass.
  constexpr double kMostCovers = 1 << 15;
  stays_.clear();
  covered_.clear();
  ends_.clear();
  moments_.clear();
  if (some.size() < 2) return moments_;
  for (const std::size_t block : some) add_stays(column, block);
  sort_changes();
  double covers = 0;
  each_time([&](double begin, double end) {
    covers += samples_between(begin, end) * double(present_.size());
  });
  if (covers == 0) return moments_;
  // If there are too many, a moment stands for those since the one before.
  const double part = std::min(1.0, kMostCovers / covers);
  double due = 0;
  double pending = 0;
  each_time([&](double begin, double end) {
    due += part < 1 ? part * samples_between(begin, end) : samples_between(begin, end);
    pending += end - begin;
    const double count = std::floor(due);
    for (double i = 0; i < count; ++i) {
      add_moment(column, begin + (end - begin) * ((i + 0.5) / count), pending / count);
    }
    if (count < 1) return;
    due -= count;
    pending = 0;
  });
  if (!moments_.empty()) moments_.back().share += pending;
  std::size_t begin = 0;
  for (std::size_t i = 0; i < moments_.size(); ++i) {
    moments_[i].blocks = std::span(covered_).subspan(begin, ends_[i] - begin);
    begin = ends_[i];
  }
  return moments_;
}

void BlocksTogether::add_stays(int column, std::size_t block) {
  const ExposedBlock& exposed = blocks_[block];
  const double first = column - exposed.bounds.width;  // left edges between these cover a part
  const double last = column + 1;
  if (exposed.is_still()) {
    const double x = exposed.bounds.x;
    if (x > first && x < last) stays_.push_back({0, 1, block, x, x});
    return;
  }
  double begin = 0;
  for (const BlockPath& path : exposed.paths) {
    const double step = path.to - path.from;
    double enters = 0;
    double leaves = 1;
    if (step != 0) {
      const double low = (first - path.from) / step;
      const double high = (last - path.from) / step;
      enters = std::clamp(std::min(low, high), 0.0, 1.0);
      leaves = std::clamp(std::max(low, high), 0.0, 1.0);
    } else if (path.from <= first || path.from >= last) {
      leaves = 0;
    }
    if (enters < leaves) {
      stays_.push_back({begin + enters * path.share, begin + leaves * path.share, block,
                        path.from + enters * step, path.from + leaves * step});
    }
    begin += path.share;
  }
}

void BlocksTogether::sort_changes() {
  changes_.clear();
  for (std::size_t i = 0; i < stays_.size(); ++i) {
    const auto stay = static_cast<std::uint32_t>(i);
    changes_.push_back({stays_[i].begin, stay, false});
    changes_.push_back({stays_[i].end, stay, true});
  }
  std::ranges::sort(changes_, [](const Change& a, const Change& b) {
    return std::tie(a.time, a.stay, a.is_end) < std::tie(b.time, b.stay, b.is_end);
  });
}

template <typename Visit>
void BlocksTogether::each_time(const Visit& visit) {
  present_.clear();
  for (std::size_t i = 0; i + 1 < changes_.size(); ++i) {
    apply(changes_[i]);
    if (present_.size() < 2 || changes_[i].time == changes_[i + 1].time) continue;
    visit(changes_[i].time, changes_[i + 1].time);
  }
}

void BlocksTogether::apply(const Change& change) {
  const auto block = [this](std::uint32_t stay) { return stays_[stay].block; };
  if (change.is_end) {
    std::erase(present_, change.stay);
  } else {
    const auto place = std::ranges::upper_bound(present_, block(change.stay), {}, block);
    present_.insert(place, change.stay);
  }
}

double BlocksTogether::samples_between(double begin, double end) const {
  double most = 1;
  for (const std::uint32_t i : present_) {
    const Stay& stay = stays_[i];
    const double way_px = std::fabs(stay.at(end) - stay.at(begin));
    most = std::max(most, std::ceil(16 * way_px));
  }
  return most;
}

void BlocksTogether::add_moment(int column, double time, double share) {
  const std::size_t begin = covered_.size();
  for (const std::uint32_t i : present_) {
    const Stay& stay = stays_[i];
    const Cover cover = covers_[stay.block].of_column(column, stay.at(time));
    if (cover.outer > 0) covered_.push_back({stay.block, cover});
  }
  if (covered_.size() < begin + 2) return covered_.resize(begin);
  ends_.push_back(covered_.size());
  moments_.push_back({share, {}});
}

}  // namespace piblocks
