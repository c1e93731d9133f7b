#include "media/pixels/frame_reader.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace piblocks {
namespace {

template <typename From, typename To>
void scale(const std::vector<From>& from, int from_max, std::vector<To>& to, int to_max) {
  constexpr int kFromBits = sizeof(From) * 2;
  constexpr int kToBits = sizeof(To) * 2;
  constexpr From kMask = (From{1} << kFromBits) - 1;
  std::vector<To> table;  // of every level
  for (int level = 0; level <= from_max; ++level) {
    table.push_back(static_cast<To>(scaled_level(level, from_max, to_max)));
  }
  to.resize(from.size());
  std::ranges::transform(from, to.begin(), [&](From word) {
    To scaled = 0;
    for (int place = 0; place < 4; ++place) {
      scaled |= table[std::size_t((word >> (kFromBits * place)) & kMask)] << (kToBits * place);
    }
    return scaled;
  });
}

}  // namespace

int max_level_of(const AnyImage& image) {
  const auto* const deep = std::get_if<DeepImage>(&image);
  return deep == nullptr ? 255 : deep->max_level;
}

DeepImage deepened(AnyImage image, int max_level) {
  auto* const deep = std::get_if<DeepImage>(&image);
  if (deep != nullptr && deep->max_level == max_level) return std::move(*deep);
  const auto scaled = [&](const auto& from) {
    DeepImage result{from.width_px, from.height_px, max_level, {}};
    scale(from.words, max_level_of(image), result.words, max_level);
    return result;
  };
  return deep != nullptr ? scaled(*deep) : scaled(flattened(std::move(image)));
}

Image flattened(AnyImage image) {
  if (auto* const flat = std::get_if<Image>(&image)) return std::move(*flat);
  if constexpr (kReadsPackedPng) {
    if (const auto* const packed = std::get_if<PackedImage>(&image)) return unpacked(*packed);
  }
  const DeepImage& deep = std::get<DeepImage>(image);
  Image result{deep.width_px, deep.height_px, {}};
  scale(deep.words, deep.max_level, result.words, 255);
  return result;
}

}  // namespace piblocks
