// The digits of pi that a film counts.
// In: a scene and its log. Out: text for the counter.
#pragma once

#include <piblocks/run.hpp>
#include <piblocks/scene.hpp>

#include <string>

namespace piblocks {

/// The digits of pi, "3.14159…", and how many of them the film counts; none if it counts others.
struct PiDigits {
  std::string text;
  std::size_t counted = 0;
};

}  // namespace piblocks
