// Whether a film may be shown to everybody.
// In: a film. Out: nothing, or an error that says when it flashes too much.
#pragma once

#include <stop_token>

#include "render/film.hpp"

namespace piblocks {

/// Paints every frame once, without encoding any.
/// @param most  flashes within a second that are allowed (WCAG 2.3.1: 3), >= 1.
/// @throws UsageError as FlashMeter finds; SimulationError, DrawError, Interrupted
void check_flashes(const Film& film, int most, const std::stop_token& stop);

}  // namespace piblocks
