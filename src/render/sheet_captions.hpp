// What is written below the pictures of a sheet.
// In: a scene, instants and their times. Out: a line for each, which the picture does not have.
#pragma once

#include <piblocks/instant.hpp>
#include <piblocks/scene.hpp>

#include <string>
#include <vector>

namespace piblocks {

/// The time of each picture, as short as can be where different times are still written
/// differently: "t = 3.5", or "t = turn − 2.1×10⁻⁷" if the instant is named so, if times near the
/// turn look alike otherwise, or if the picture itself has the time. Empty where the picture has it
/// and there is no turn. @param times  of the instants, in their order.
std::vector<std::string> sheet_captions(const Scene& scene, const Log& log,
                                        const std::vector<Instant>& instants,
                                        const std::vector<Rational>& times);

}  // namespace piblocks
