// Whether draw items can be drawn at all.
// In: items. Out: whether every place and length in them is a number.
#pragma once

#include <span>

#include "draw/draw_list.hpp"

namespace piblocks {

/// Whether no place or length is infinite or not a number. What is inside plates and groups has
/// been looked at when these were made.
bool is_finite(const DrawItem& item);
bool are_finite(std::span<const DrawItem> items);

}  // namespace piblocks
