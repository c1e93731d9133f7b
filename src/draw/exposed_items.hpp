// What moves while a picture is exposed.
// In: composition. Out: draw items that say for how long each thing is where.
#pragma once

#include <vector>

#include "draw/item_parts.hpp"

namespace piblocks {

/// What moves less is taken to stay. Far below what a pixel shows, far above roundings.
inline constexpr double kStill_px = 1e-6;

/// A place of a block's left edge, and for which share of the exposure it is there.
struct Dwell {
  double x = 0;
  double share = 0;
  bool operator==(const Dwell&) const = default;
};

/// A path of a block's left edge, at constant speed.
struct BlockPath {
  double from = 0;
  double to = 0;
  double share = 0;  ///< of the exposure
  bool operator==(const BlockPath&) const = default;
};

/// Rows across a block.
struct Bar {
  double y = 0;
  double height = 0;
  bool operator==(const Bar&) const = default;
};

/// A filled rectangle that moves sideways while the picture is exposed.
struct ExposedBlock {
  Rectangle bounds;  ///< at the picture's instant
  Color fill;
  Stroke stroke;          ///< solid
  std::vector<Bar> bars;  ///< in the stroke's colour, inside the bounds
  /// From left to right. Shares add up to 1 less those outside the frame.
  std::vector<Dwell> dwells;
  /// In the order of time; shares add up to 1. They say when the block is where: all blocks begin
  /// at the same time. If there are dwells, these say more exactly for how long.
  std::vector<BlockPath> paths = {};

  bool is_still() const { return dwells.empty() && paths.empty(); }
  bool operator==(const ExposedBlock&) const = default;
};

/// A share of an exposure during which two blocks, the right and the left one, are less than a
/// pixel apart. Both places are left edges.
struct TouchingBlocks {
  double right_x = 0;
  double left_x = 0;
  double share = 0;
  bool operator==(const TouchingBlocks&) const = default;
};

/// Blocks, exposed: the mean, in linear light, of the pictures that rectangles would make at each
/// instant. A vector file has moving blocks as pixels, and others as rectangles.
struct ExposedBlocksItem {
  ItemId id = ItemId::red_block;
  std::vector<ExposedBlock> blocks;      ///< from back to front; they never overlap
  std::vector<TouchingBlocks> contacts;  ///< of two blocks without paths, in the order of right_x
  bool operator==(const ExposedBlocksItem&) const = default;
};

/// A straight path of the centre of a disc, at constant speed.
struct DiscPath {
  Point from;
  Point to;
  double share = 0;  ///< of the exposure
  bool operator==(const DiscPath&) const = default;
};

/// A disc that moves while the picture is exposed.
struct ExposedDisc {
  double radius = 0;  ///< of its outside
  double rim_px = 0;  ///< width of the line, which is inside; 0 if there is none
  Color fill;
  Color rim;
  std::vector<DiscPath> paths;  ///< in the order of time; shares add up to 1
  bool operator==(const ExposedDisc&) const = default;
};

/// Discs, exposed: the mean, in linear light, of the pictures that they would make at each instant.
/// All paths begin at the same time, so that it is known which discs are in a pixel together.
/// A vector file has them as pixels.
struct ExposedDiscsItem {
  ItemId id = ItemId::red_block;
  std::vector<ExposedDisc> discs;  ///< they never overlap
  bool operator==(const ExposedDiscsItem&) const = default;
};

}  // namespace piblocks
