// In: a token that may ask to stop. Out: Interrupted, if it does.
#pragma once

#include <piblocks/error.hpp>

#include <stop_token>

namespace piblocks {

/// @throws Interrupted if the token asks to stop.
inline void check_stop(const std::stop_token& stop) {
  if (stop.stop_requested()) throw Interrupted();
}

}  // namespace piblocks
