// What changes from one picture to the next.
// In: two draw lists. Out: the region outside of which their pixels are equal.
#pragma once

#include "draw/extent.hpp"
#include "draw/region.hpp"

namespace piblocks {

/// Adds every pixel in which the pictures may differ. These are all pixels if the lists have
/// neither the same ids nor rising ones.
void add_changes(const DrawList& before, const DrawList& after, const MeasureText& width_em,
                 Region& region);

}  // namespace piblocks
