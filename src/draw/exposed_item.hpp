// The blocks of a frame that is exposed for a while, as plain data.
// In: where the blocks are in the meantime. Out: a draw item.
// Shares are of the exposure's time.
#pragma once

#include <vector>

#include "draw/item_id.hpp"
#include "draw/shapes.hpp"

namespace piblocks {

/// Where the left edge of a block is for a share of an exposure.
struct Dwell {
  double x = 0;
  double share = 0;

  friend bool operator==(const Dwell&, const Dwell&) = default;
};

/// Rows across a block.
struct Bar {
  double y = 0;
  double height = 0;

  friend bool operator==(const Bar&, const Bar&) = default;
};

/// A filled rectangle that moves sideways while the picture is exposed.
struct ExposedBlock {
  Rectangle bounds;  ///< at the picture's instant
  Color fill;
  Stroke stroke;          ///< solid
  std::vector<Bar> bars;  ///< in the stroke's colour, inside the bounds
  /// From left to right; none if the block stays. The shares add up to 1, less what is outside of
  /// the frame.
  std::vector<Dwell> dwells;

  friend bool operator==(const ExposedBlock&, const ExposedBlock&) = default;
};

/// A share of an exposure in which the left edge of the block behind and the right edge of the one
/// in front are less than a pixel apart: left edges of both.
struct Contact {
  double behind_x = 0;
  double front_x = 0;
  double share = 0;

  friend bool operator==(const Contact&, const Contact&) = default;
};

/// Two blocks, exposed: the mean, in linear light, of the pictures that rectangles would make at
/// each instant. In a vector file this is a picture; what stays is not.
struct ExposedItem {
  ItemId id = ItemId::red_block;
  ExposedBlock behind;  ///< on the right
  ExposedBlock front;
  std::vector<Contact> contacts;  ///< from left to right

  friend bool operator==(const ExposedItem&, const ExposedItem&) = default;
};

}  // namespace piblocks
