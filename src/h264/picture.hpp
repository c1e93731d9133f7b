// Pictures in 4:2:0, cut into macroblocks of 16x16 pixels.
// In: samples, written into the planes. Out: the samples of a macroblock, and those beside it.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <new>
#include <vector>

#include "h264/encoder.hpp"

namespace piblocks::h264 {

/// A block of 4x4 samples, row by row.
using Block4x4 = std::array<std::uint8_t, 16>;

/// @param stride  from row to row where the samples lie.
inline Block4x4 load_block(const std::uint8_t* from, int stride) {
  Block4x4 block;
  for (int y = 0; y < 4; ++y) std::memcpy(block.data() + 4 * y, from + y * stride, 4);
  return block;
}

inline void store_block(const Block4x4& block, std::uint8_t* to, int stride) {
  for (int y = 0; y < 4; ++y) std::memcpy(to + y * stride, block.data() + 4 * y, 4);
}

inline int sum_of_differences(const Block4x4& a, const Block4x4& b) {
  int sum = 0;
  for (std::size_t i = 0; i < 16; ++i) sum += std::abs(a[i] - b[i]);
  return sum;
}

/// Of `count` samples. Differences of bytes and 16 bits in the product: what processors square and
/// add up at once.
inline int squared_error(const std::uint8_t* a, const std::uint8_t* b, int count) {
  int sum = 0;
  for (int i = 0; i < count; ++i) {
    const auto difference = static_cast<std::int16_t>(a[i] - b[i]);
    sum += difference * difference;
  }
  return sum;
}

inline constexpr int kLumaSide = 16;
/// Those of a side of this length, of which the last may stick out.
constexpr int macroblocks_along(int side_px) { return (side_px + kLumaSide - 1) / kLumaSide; }
inline constexpr int kChromaSide = 8;

/// Y, Cb, Cr of a macroblock, row by row, one plane after the other.
struct Samples {
  static constexpr int kCount = kLumaSide * kLumaSide + 2 * kChromaSide * kChromaSide;
  /// Where a plane begins: 0 Y, 1 Cb, 2 Cr.
  static constexpr int start(int plane) { return plane == 0 ? 0 : 192 + 64 * plane; }

  std::uint8_t* plane(int number) { return values.data() + start(number); }
  const std::uint8_t* plane(int number) const { return values.data() + start(number); }

  alignas(16) std::array<std::uint8_t, kCount> values;
};

/// Length of a row of a macroblock's plane.
constexpr int side_of(int plane) { return plane == 0 ? kLumaSide : kChromaSide; }

/// Sums of squared differences.
inline int luma_error(const Samples& a, const Samples& b) {
  return squared_error(a.plane(0), b.plane(0), 256);
}
inline int chroma_error(const Samples& a, const Samples& b) {
  return squared_error(a.plane(1), b.plane(1), 128);
}
/// Of all samples.
int largest_difference(const Samples& a, const Samples& b);

/// The row above a macroblock and the column left of it.
struct Border {
  alignas(16) std::array<std::uint8_t, kLumaSide> above;
  alignas(16) std::array<std::uint8_t, kLumaSide> left;
};

struct Borders {
  bool has_above;  ///< false at the edge of the picture, where `above` is undefined
  bool has_left;
  std::array<Border, 3> planes;
};

/// Memory of zeros, which the system gives page by page when it is first used.
// NOLINTBEGIN(cppcoreguidelines-no-malloc,cppcoreguidelines-owning-memory): an allocator
template <typename Element>
struct ZeroedMemory {
  using value_type = Element;  // NOLINT(readability-identifier-naming): of the standard

  Element* allocate(std::size_t count) {
    void* const memory = std::calloc(count, sizeof(Element));
    if (memory == nullptr) throw std::bad_alloc();
    return static_cast<Element*>(memory);
  }
  void deallocate(Element* memory, std::size_t /*count*/) noexcept { std::free(memory); }
  /// The elements of a new vector are zeros already.
  void construct(Element* /*element*/) noexcept {}
  void construct(Element* element, Element value) noexcept { *element = value; }
  bool operator==(const ZeroedMemory&) const = default;
};
// NOLINTEND(cppcoreguidelines-no-malloc,cppcoreguidelines-owning-memory)

/// Planes of whole macroblocks.
class Picture {
 public:
  Picture(int width_mb, int height_mb);

  int width_mb() const noexcept { return width_mb_; }
  int height_mb() const noexcept { return height_mb_; }
  std::uint8_t* plane(int number) noexcept { return planes_[std::size_t(number)].data(); }
  const std::uint8_t* plane(int number) const noexcept {
    return planes_[std::size_t(number)].data();
  }
  std::ptrdiff_t stride_bytes(int plane) const noexcept {
    return std::ptrdiff_t{width_mb_} * side_of(plane);
  }
  Planes planes() const noexcept {
    return {{plane(0), stride_bytes(0)}, {plane(1), stride_bytes(1)}, {plane(2), stride_bytes(2)}};
  }

  void load(int x_mb, int y_mb, Samples& samples) const;
  void store(int x_mb, int y_mb, const Samples& samples);
  /// Takes the samples of a macroblock that lie in a rectangle of even numbers, which shares some
  /// with it. @param part  the rectangle's samples alone. @returns whether that changes anything
  bool update(int x_mb, int y_mb, const Planes& part, const Rect& rect);
  /// Where a macroblock reaches out of a picture of width_px x height_px pixels, repeats the last
  /// column and row: that costs the fewest bits.
  void extend(int x_mb, int y_mb, int width_px, int height_px);
  /// Takes a macroblock of another picture of this size.
  void copy(int x_mb, int y_mb, const Picture& from);
  void load_borders(int x_mb, int y_mb, Borders& borders) const;

 private:
  template <int side>
  bool update_plane(int number, int x_mb, int y_mb, const Plane& part, const Rect& rect);
  std::ptrdiff_t offset(int plane, int x_mb, int y_mb) const noexcept {
    return side_of(plane) * (y_mb * stride_bytes(plane) + x_mb);
  }

  int width_mb_;
  int height_mb_;
  std::array<std::vector<std::uint8_t, ZeroedMemory<std::uint8_t>>, 3> planes_;
};

/// The macroblocks of a picture that may have changed, by their addresses in raster order.
class MacroblockSet {
 public:
  MacroblockSet(int width_mb, int height_mb)
      : width_mb_(width_mb),
        count_(width_mb * height_mb),
        words_((static_cast<std::size_t>(count_) + 63) / 64) {}

  /// Adds a macroblock, if it is in the picture.
  void add_one(int x_mb, int y_mb) {
    const int address = y_mb * width_mb_ + x_mb;
    if (x_mb >= 0 && x_mb < width_mb_ && address < count_) add_one(address);
  }
  void add_one(int address) {
    words_[static_cast<std::size_t>(address / 64)] |= std::uint64_t{1} << address % 64;
  }
  void clear() { words_.assign(words_.size(), 0); }
  bool contains(int address) const {
    return (words_[static_cast<std::size_t>(address / 64)] >> address % 64 & 1) != 0;
  }
  int count() const {
    int sum = 0;
    for (const std::uint64_t word : words_) sum += std::popcount(word);
    return sum;
  }
  /// The first address in the set that is no less; -1 if there is none.
  int next(int address) const {
    if (address >= count_) return -1;
    auto i = static_cast<std::size_t>(address / 64);
    std::uint64_t word = words_[i] >> address % 64 << address % 64;
    while (word == 0 && ++i < words_.size()) word = words_[i];
    return word == 0 ? -1 : static_cast<int>(64 * i) + std::countr_zero(word);
  }

 private:
  int width_mb_;
  int count_;
  std::vector<std::uint64_t> words_;
};

}  // namespace piblocks::h264
