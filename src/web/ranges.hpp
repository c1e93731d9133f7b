// Where a slider may go.
// In: a builder of the scene that is shown. Out: for keys the values that it accepts, all else
// unchanged.
#pragma once

#include <piblocks/script.hpp>

#include <string>

#include "web/live.hpp"

namespace piblocks::web {

/// {"blue.position":[low,high],…}: positions between the wall, the other block and the edge of the
/// view, widths up to the gap, and the usual range of other keys; less where the scene refuses
/// parts of it. Empty for a storyboard.
std::string ranges_json(const ScriptBuilder& builder, const LiveScript& live);

}  // namespace piblocks::web
