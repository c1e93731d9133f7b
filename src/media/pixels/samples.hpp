// The samples of a frame, of 8 bits or more.
// In: frames as files hold them. Out: the same at another depth, to compare any two.
#pragma once

#include <piblocks/image.hpp>

#include <variant>

namespace piblocks {

using Samples = std::variant<Image, DeepImage>;

/// The largest possible sample: 255, or more.
int max_level_of(const Samples& samples);

/// A level of one range as a level of another, rounded to the nearest. Exact if one range is a
/// multiple of the other, as 65535 is of 255.
constexpr int scaled_level(int level, int from_max, int to_max) {
  return static_cast<int>((2LL * level * to_max + from_max) / (2LL * from_max));
}

/// Brings samples to a depth at least as great; different levels stay different.
/// @param max_level  above 255, and not below the samples' own.
DeepImage deepened(Samples samples, int max_level);

/// Brings samples to 8 bits, to show them.
Image flattened(Samples samples);

}  // namespace piblocks
