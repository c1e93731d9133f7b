// One thing in the picture: an overlay or a diagram, in a file of its own.
// In: a setting, once; what is shown, for every frame. Out: items, in the order of their ids.
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "draw/composition.hpp"
#include "draw/font.hpp"
#include "draw/stage.hpp"
#include "draw/theme.hpp"

namespace piblocks {

/// Appends the items that show it at one instant. Thread-safe.
using Drawable = std::function<void(const FrameState& shown, std::vector<DrawItem>& items)>;

/// What is the same in every frame.
inline Drawable unchanging(std::vector<DrawItem> same) {
  return [same = std::move(same)](const FrameState& /*shown*/, std::vector<DrawItem>& items) {
    items.insert(items.end(), same.begin(), same.end());
  };
}

}  // namespace piblocks
