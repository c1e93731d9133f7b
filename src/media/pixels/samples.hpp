// The samples of a frame, of 8 bits or of more.
// In: frames as files hold them. Out: the same at another depth, so that any two can be compared.
#pragma once

#include <piblocks/image.hpp>

#include <variant>

namespace piblocks {

using Samples = std::variant<Image, DeepImage>;

/// What the largest sample is: 255, or more.
int max_level_of(const Samples& samples);

/// A level of one range as a level of another, rounded to the nearest. Exact where the one range is
/// a multiple of the other, as 65535 is of 255.
constexpr int scaled_level(int level, int from_max, int to_max) {
  return static_cast<int>((2LL * level * to_max + from_max) / (2LL * from_max));
}

/// Brings samples to a depth at least as great, by which different levels stay different.
/// @param max_level  more than 255, and not less than the samples' own.
DeepImage deepened(Samples samples, int max_level);

/// Brings samples to 8 bits, to be looked at.
Image flattened(Samples samples);

}  // namespace piblocks
