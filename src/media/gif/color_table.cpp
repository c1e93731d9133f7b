#include "media/gif/color_table.hpp"

#include <algorithm>
#include <utility>

namespace piblocks {
namespace {

/// Squared distance of red, green and blue.
int distance_of(std::uint32_t a, std::uint32_t b) {
  int sum = 0;
  for (const int shift : {0, 8, 16}) {
    const int difference = int(a >> shift & 0xff) - int(b >> shift & 0xff);
    sum += difference * difference;
  }
  return sum;
}

}  // namespace

void ColorTable::clear() {
  counts_.clear();
  colors_.clear();
  last_ = nullptr;
}

std::int64_t& ColorTable::entry(std::uint32_t color) {
  if (last_ == nullptr || color != last_color_) {
    last_ = &counts_[color];
    last_color_ = color;
  }
  return *last_;
}

void ColorTable::choose(std::size_t room) {
  std::vector<Candidate> candidates;
  candidates.reserve(counts_.size());
  for (const auto& [color, count] : counts_) candidates.push_back({color, count});
  if (candidates.size() <= room) {
    std::ranges::sort(candidates, {}, &Candidate::color);
    for (Candidate& candidate : candidates) {
      candidate.place = std::int64_t(colors_.size());
      colors_.push_back(candidate.color);
    }
  } else {
    choose_some(room, candidates);
  }
  for (const Candidate& candidate : candidates) counts_[candidate.color] = candidate.place;
}

void ColorTable::choose_some(std::size_t room, std::vector<Candidate>& candidates) {
  std::ranges::sort(candidates, {},
                    [](const Candidate& c) { return std::pair(-c.count, c.color); });
  for (std::size_t i = 0; i < room; ++i) {
    // Of equally far ones the most frequent, which come first.
    const auto next = i < room / 8 ? candidates.begin() + std::ptrdiff_t(i)
                                   : std::ranges::max_element(candidates, {}, &Candidate::distance);
    keep(next->color, candidates);
  }
}

void ColorTable::keep(std::uint32_t color, std::vector<Candidate>& candidates) {
  for (Candidate& candidate : candidates) {
    const int distance = distance_of(candidate.color, color);
    if (distance >= candidate.distance) continue;
    candidate.distance = distance;
    candidate.place = std::int64_t(colors_.size());
  }
  colors_.push_back(color);
}

}  // namespace piblocks
