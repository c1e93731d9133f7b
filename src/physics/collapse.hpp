// Bodies that lose all speed relative to each other in infinitely many collisions.
// In: a System, and which bodies have lately met so often in no time. Out: whether they collapse.
#pragma once

#include <piblocks/system.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace piblocks {

/// A body may be part of a collapse if it has so many collisions within this share of the time,
/// and no more than this share of the speed is left with which it parted at first.
inline constexpr std::size_t kCollapseSteps = 32;
inline constexpr double kCollapseWindow = 0x1p-48;
inline constexpr double kCollapseSpeed = 0x1p-16;

/// Whether three neighbours on a line that meet so often do so infinitely often: README.md,
/// "Collapse". Nothing for other bodies.
/// @param bodies      as Collapse::bodies
/// @param speed_left  what share of its parting speed a pair keeps from one round to the next
std::optional<bool> do_three_collapse(const System& system,
                                      const std::vector<std::uint32_t>& bodies, double speed_left);

}  // namespace piblocks
