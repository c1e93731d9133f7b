#include "media/libav/color_table.hpp"

#include <algorithm>
#include <utility>

namespace piblocks {
namespace {

/// Squared distance of red, green and blue.
int distance(std::uint32_t a, std::uint32_t b) {
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
  std::vector<std::pair<std::int64_t, std::uint32_t>> found;
  found.reserve(counts_.size());
  for (const auto& [color, count] : counts_) found.emplace_back(-count, color);
  std::ranges::sort(found);
  found.resize(std::min(room, found.size()));
  for (const auto& entry : found) colors_.push_back(entry.second);
  std::ranges::sort(colors_);
  for (auto& [color, place] : counts_) {
    const auto at = std::ranges::lower_bound(colors_, color);
    const bool is_kept = at != colors_.end() && *at == color;
    const auto nearest =
        is_kept ? at : std::ranges::min_element(colors_, {}, [wanted = color](std::uint32_t c) {
          return distance(c, wanted);
        });
    place = nearest - colors_.begin();
  }
}

}  // namespace piblocks
