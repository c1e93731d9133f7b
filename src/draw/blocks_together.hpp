// Blocks that are in one column of pixels at the same time.
// In: exposed blocks and a column. Out: moments, with what each of the blocks covers then.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "draw/block_cover.hpp"
#include "draw/exposed_items.hpp"

namespace piblocks {

/// What a block covers of the column.
struct PresentBlock {
  std::size_t block = 0;  ///< its place in ExposedBlocksItem::blocks
  Cover column;
};

/// A share of the exposure's time.
struct TogetherMoment {
  double share = 0;
  std::span<const PresentBlock> blocks;  ///< at least two, from back to front
};

/// Keeps its memory from column to column.
class BlocksTogether {
 public:
  /// @param blocks   of the item; they outlive this
  BlocksTogether(std::span<const ExposedBlock> blocks, std::span<const BlockCover> covers)
      : blocks_(blocks), covers_(covers) {}

  /// All moments at which two or more of some blocks cover a part of the column. Valid until the
  /// next call. @param some  from back to front
  std::span<const TogetherMoment> find(int column, std::span<const std::size_t> some);

 private:
  /// While a block covers a part of the column, and moves evenly.
  struct Stay {
    double begin = 0;  ///< share of the exposure's time that has passed
    double end = 0;
    std::size_t block = 0;
    double from = 0;  ///< its left edge
    double to = 0;

    double at(double time) const {
      return end > begin ? from + (to - from) * ((time - begin) / (end - begin)) : from;
    }
  };
  /// The begin or the end of a stay.
  struct Change {
    double time = 0;
    std::uint32_t stay = 0;
    bool is_end = false;
  };

  void add_stays(int column, std::size_t block);
  void sort_changes();
  /// Calls visit(begin, end) for each time in which the same two or more blocks are present.
  template <typename Visit>
  void each_time(const Visit& visit);
  void apply(const Change& change);
  double samples_between(double begin, double end) const;
  void add_moment(int column, double time, double share);

  std::span<const ExposedBlock> blocks_;
  std::span<const BlockCover> covers_;
  std::vector<Stay> stays_;
  std::vector<Change> changes_;
  std::vector<std::uint32_t> present_;  // stays, in the order of their blocks
  std::vector<PresentBlock> covered_;   // of all moments
  std::vector<std::size_t> ends_;       // of each moment's blocks among them
  std::vector<TogetherMoment> moments_;
};

}  // namespace piblocks
