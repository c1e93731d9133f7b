#include "media/pixels/samples.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace piblocks {
namespace {

/// Every level of one range as a level of another.
std::vector<std::uint64_t> level_table(int from_max, int to_max) {
  std::vector<std::uint64_t> table(static_cast<std::size_t>(from_max) + 1);
  for (int level = 0; level <= from_max; ++level) {
    table[static_cast<std::size_t>(level)] =
        static_cast<std::uint64_t>(scaled_level(level, from_max, to_max));
  }
  return table;
}

template <typename From, typename To>
void scale(const std::vector<From>& from, int from_max, std::vector<To>& to, int to_max) {
  constexpr int kFromBits = sizeof(From) * 2;
  constexpr int kToBits = sizeof(To) * 2;
  constexpr From kMask = (From{1} << kFromBits) - 1;
  const std::vector<std::uint64_t> table = level_table(from_max, to_max);
  to.resize(from.size());
  std::ranges::transform(from, to.begin(), [&](From word) {
    To scaled = 0;
    for (int place = 0; place < 4; ++place) {
      const From level = (word >> (kFromBits * place)) & kMask;
      scaled |= static_cast<To>(table[static_cast<std::size_t>(level)]) << (kToBits * place);
    }
    return scaled;
  });
}

}  // namespace

int max_level_of(const Samples& samples) {
  const auto* const deep = std::get_if<DeepImage>(&samples);
  return deep == nullptr ? 255 : deep->max_level;
}

DeepImage deepened(Samples samples, int max_level) {
  if (auto* const deep = std::get_if<DeepImage>(&samples)) {
    if (deep->max_level == max_level) return std::move(*deep);
    DeepImage image{deep->width_px, deep->height_px, max_level, {}};
    scale(deep->words, deep->max_level, image.words, max_level);
    return image;
  }
  const Image& flat = std::get<Image>(samples);
  DeepImage image{flat.width_px, flat.height_px, max_level, {}};
  scale(flat.words, 255, image.words, max_level);
  return image;
}

Image flattened(Samples samples) {
  if (auto* const flat = std::get_if<Image>(&samples)) return std::move(*flat);
  const DeepImage& deep = std::get<DeepImage>(samples);
  Image image{deep.width_px, deep.height_px, {}};
  scale(deep.words, deep.max_level, image.words, 255);
  return image;
}

}  // namespace piblocks
