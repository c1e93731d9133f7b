// Texts of messages.
#pragma once

#include <sstream>
#include <string>

namespace piblocks::h264 {

/// Texts and numbers, one after another.
template <typename... Parts>
std::string text(const Parts&... parts) {
  std::ostringstream stream;
  (stream << ... << parts);
  return stream.str();
}

}  // namespace piblocks::h264
