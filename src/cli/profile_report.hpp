// What each stage of a rendering cost, as a table for people and programs.
// In: a profile. Out: lines on standard error.
#pragma once

#include <piblocks/render.hpp>

namespace piblocks::cli {

void print_profile(const Rendered& rendered);

}  // namespace piblocks::cli
