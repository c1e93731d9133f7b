// Rules that several kinds of values share.
// In: a line of text, or a segment of a storyboard. Out: its problems.
#pragma once

#include <piblocks/script.hpp>

#include <string_view>
#include <vector>

#include "physics/blocks.hpp"

namespace piblocks {

/// A title, a caption or a line of a card.
void check_line(const char* key, std::string_view text, SceneProblems& problems);

/// Problems with "fade", "card", "seconds" and "compare" of a segment; its scenes have their own
/// problems_of().
std::vector<Problem> problems_of(const Segment& segment, bool is_first);

}  // namespace piblocks
