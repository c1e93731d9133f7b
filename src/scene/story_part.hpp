// Rules for one part of a storyboard.
// In: a part. Out: what is wrong with it.
#pragma once

#include <piblocks/script.hpp>

#include <vector>

namespace piblocks {

/// What is wrong with "fade", "card", "seconds" and "compare"; the scenes in it have their own
/// problems_of().
std::vector<Problem> problems_of(const StoryPart& part, bool is_first);

}  // namespace piblocks
