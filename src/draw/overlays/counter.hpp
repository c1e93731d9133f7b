// The count, and the digits of pi that a film counts.
// In: a scene and its log. Out: texts, and a drawable.
#pragma once

#include <piblocks/scene.hpp>
#include <piblocks/two_blocks.hpp>

#include <string>
#include <string_view>

#include "draw/layout.hpp"

namespace piblocks {

/// The count as the picture of its last collision shows it, if these are the digits of pi; else
/// empty.
/// @throws UsageError if they are not, and the scene asks for them.
std::string pi_count(const LayoutContext& context);

/// Length of the expected beginning of the count, with separators; 0 while it has fewer digits.
std::size_t lit_length(std::string_view count, std::string_view expected);

/// The longest count that the film shows. Counts before time 0 are negative and may be longer.
Integer longest_count(const Scene& scene, const Log& log);

/// What a plan must know of the counter.
CounterRoom counter_room(const LayoutContext& context, const std::string& pi_count);

/// The count, and the digits of pi that it has reached, each at the right end of its line.
/// @param pi_count  as above
Drawable counter(const LayoutContext& context, const CounterPlace& place,
                 const std::string& pi_count);

}  // namespace piblocks
