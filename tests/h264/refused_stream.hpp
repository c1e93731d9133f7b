// The error for a stream that our slices do not fit.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "h264/bit_stream.hpp"
#include "h264/parameter_sets.hpp"

namespace piblocks::h264 {

/// "accepted" if there is none.
inline std::string problem_of(std::span<const std::uint8_t> stream) {
  try {
    read_parameter_sets(stream);
  } catch (const HeaderError& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace piblocks::h264
