// Random pictures of many kinds that change in some places.
// In: a source of numbers: integer(first, last). Out: a picture, and the rectangles that differ
// from the one before.
#pragma once

#include <algorithm>
#include <cstdint>

#include "h264/callers_picture.hpp"

namespace piblocks::h264 {

inline std::uint8_t clamped(std::int64_t value) {
  return static_cast<std::uint8_t>(std::clamp<std::int64_t>(value, 0, 255));
}

template <typename Numbers>
class RandomPictures {
 public:
  RandomPictures(int width_mb, int height_mb, Numbers& numbers)
      : numbers_(numbers), picture_(width_mb, height_mb), changed_(width_mb, height_mb) {
    fill({0, 0, 16 * width_mb, 16 * height_mb});
  }

  const Picture& picture() const { return picture_; }
  const MacroblockSet& changed() const { return changed_; }

  void advance() {
    changed_.clear();
    for (int count = pick(0, 4); count > 0; --count) change_something();
  }

 private:
  enum class Kind : std::uint8_t {
    flat,
    noise,
    little_noise,
    ramp,
    extremes,      // black and white, in blocks
    copy,          // of what is elsewhere
    slide,         // of what is near, by any number of samples
    small_change,  // of what was there
    no_change
  };
  static constexpr int kKinds = 9;
  struct Rect {
    int x, y, width, height;
  };

  int pick(int first, int last) { return static_cast<int>(numbers_.integer(first, last)); }

  void change_something() {
    const int width = 16 * picture_.width_mb();
    const int height = 16 * picture_.height_mb();
    const int x = 2 * pick(0, width / 2 - 1);
    const int y = 2 * pick(0, height / 2 - 1);
    const int w = 2 * pick(1, std::min(40, (width - x) / 2));
    const int h = 2 * pick(1, std::min(40, (height - y) / 2));
    fill({x, y, w, h});
    add(changed_, x, y, w, h);
  }

  void fill(const Rect& rect) {
    const auto kind = static_cast<Kind>(pick(0, kKinds - 1));
    noise_ = static_cast<std::uint32_t>(pick(0, 255));
    if (kind == Kind::no_change) return;
    if (kind == Kind::copy) {
      return copy(rect, 2 * pick(0, (16 * picture_.width_mb() - rect.width) / 2),
                  2 * pick(0, (16 * picture_.height_mb() - rect.height) / 2));
    }
    if (kind == Kind::slide)
      return copy(rect, near(rect.x, rect.width, picture_.width_mb()),
                  near(rect.y, rect.height, picture_.height_mb()));
    for (int plane = 0; plane < 3; ++plane) fill(plane, kind, rect);
  }

  /// A place of a side that has this length, not far from `at`.
  int near(int at, int length, int size_mb) {
    const int distance = pick(0, 2) == 0 ? pick(-60, 60) : pick(-3, 3);
    return std::clamp(at + distance, 0, 16 * size_mb - length);
  }

  void copy(const Rect& rect, int from_x, int from_y) {
    const Picture before = picture_;
    for (int plane = 0; plane < 3; ++plane) {
      const int step = plane == 0 ? 1 : 2;
      const std::uint8_t* const from =
          before.plane(plane) + from_y / step * before.stride_bytes(plane) + from_x / step;
      set_samples(plane, rect, [&](int column, int row, int) {
        return from[row * before.stride_bytes(plane) + column];
      });
    }
  }

  void fill(int plane, Kind kind, const Rect& rect) {
    const int base = pick(0, 255);
    const int slope_x = kind == Kind::ramp ? pick(-8, 8) : 0;
    const int slope_y = kind == Kind::ramp ? pick(-8, 8) : 0;
    const int side = kind == Kind::extremes ? pick(1, 5) : 1;
    const auto seed = static_cast<std::uint32_t>(base);
    set_samples(plane, rect, [&](int column, int row, int before) {
      if (kind == Kind::noise) return base + noise(255);
      if (kind == Kind::little_noise) return base + noise(3);
      if (kind == Kind::small_change) return before + base % 8 - 4 + noise(base / 64);
      if (kind == Kind::extremes) return is_white(seed, column / side, row / side) ? 255 : 0;
      return base + slope_x * column + slope_y * row;
    });
  }

  /// @param value_at  of column and row in the rectangle, and the sample that was there.
  template <typename ValueAt>
  void set_samples(int plane, const Rect& rect, ValueAt value_at) {
    const int step = plane == 0 ? 1 : 2;
    for (int row = 0; row < rect.height / step; ++row) {
      std::uint8_t* const at = picture_.plane(plane) +
                               (rect.y / step + row) * picture_.stride_bytes(plane) + rect.x / step;
      for (int column = 0; column < rect.width / step; ++column) {
        const int value = value_at(column, row, at[column]);
        at[column] = static_cast<std::uint8_t>(std::clamp(value, 0, 255));
      }
    }
  }

  /// From -most to most: a number for every sample would leave little of a short input.
  int noise(int most) {
    noise_ = noise_ * 1'664'525 + 1'013'904'223;
    return static_cast<int>((noise_ >> 8) % static_cast<std::uint32_t>(2 * most + 1)) - most;
  }

  static bool is_white(std::uint32_t seed, int column, int row) {
    std::uint32_t hash = seed + 7919 * static_cast<std::uint32_t>(column);
    hash = (hash + 104'729 * static_cast<std::uint32_t>(row)) * 2'654'435'761;
    return (hash >> 31) != 0;
  }

  Numbers& numbers_;
  Picture picture_;
  MacroblockSet changed_;
  std::uint32_t noise_ = 0;
};

}  // namespace piblocks::h264
