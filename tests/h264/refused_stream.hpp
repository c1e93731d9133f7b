// What is said of a stream into which slices of ours would not fit.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "h264/error.hpp"
#include "h264/parameter_sets.hpp"

namespace piblocks::h264 {

/// "accepted" if nothing is.
inline std::string problem_of(std::span<const std::uint8_t> stream) {
  try {
    read_parameter_sets(stream);
  } catch (const HeaderError& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace piblocks::h264
