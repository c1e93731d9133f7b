// One column of pixels of two blocks while the picture is exposed.
// In: where the blocks are, for which share of the time, and what is behind. Out: the mean of the
// column's pixels in linear light.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "draw/draw_list.hpp"
#include "draw/light.hpp"

namespace piblocks {

/// How much of a row or a column of pixels is covered by a block, by what is inside its line, and,
/// of a row, by its bars.
struct Cover {
  double outer = 0;
  double inner = 0;
  double bars = 0;

  friend bool operator==(const Cover&, const Cover&) = default;
};

/// What of a block covers the pixels of a row.
Cover row_cover_of(int row, const ExposedBlock& block, double line_px);

/// What covers the pixels from `pixel` to `pixel` + 1 of a block from `begin` on.
Cover cover_of(double pixel, double begin, double length, double line_px);

/// What both blocks cover of a row.
struct RowCover {
  Cover behind;
  Cover front;

  friend bool operator==(const RowCover&, const RowCover&) = default;
};

/// The dwells of a block, with the sums of their shares.
class BlockTimes {
 public:
  explicit BlockTimes(const ExposedBlock& block);

  const ExposedBlock& block() const noexcept { return block_; }
  bool moves() const noexcept { return !block_.dwells.empty(); }
  double line_px() const noexcept { return line_px_; }
  Cover cover(double pixel, double x) const {
    return cover_of(pixel, x, block_.bounds.width, line_px_);
  }

  struct Covered {
    Cover cover;
    double share = 0;
  };
  /// Replaces `covered` by all ways in which the block covers some of a column of pixels.
  void cover_column(double pixel, std::vector<Covered>& covered) const;

 private:
  void add_alike(double pixel, double from, double to, std::vector<Covered>& covered) const;
  void add_each(double pixel, double from, double to, std::vector<Covered>& covered) const;
  std::size_t first_at(double x) const;

  const ExposedBlock& block_;
  double line_px_;
  double first_x_;
  std::vector<double> sums_;  // of the shares before each stop
};

/// Used for one column after another.
class ExposedColumn {
 public:
  ExposedColumn(const ExposedItem& item, const Light& light);

  const BlockTimes& behind() const noexcept { return behind_; }
  const BlockTimes& front() const noexcept { return front_; }
  /// Turns to the column from `pixel` to `pixel` + 1.
  void enter(int pixel);
  /// The pixel of a row, in front of this one: words 0x00RRGGBB.
  std::uint32_t pixel(const RowCover& row, std::uint32_t background);

 private:
  struct Known {
    RowCover row;
    std::uint32_t background = 0;
    std::uint32_t result = 0;
  };
  std::uint32_t compute(const RowCover& row, std::uint32_t background) const;
  double light_of(const RowCover& row, double background, std::uint8_t Color::*channel) const;

  const ExposedItem& item_;
  const Light& light_;
  BlockTimes behind_;
  BlockTimes front_;
  std::vector<BlockTimes::Covered> behind_covers_;
  std::vector<BlockTimes::Covered> front_covers_;
  std::span<const Contact> contacts_;
  int pixel_ = 0;
  std::vector<Known> known_;
};

}  // namespace piblocks
