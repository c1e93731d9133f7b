// Errors of the encoder.
#pragma once

#include <sstream>
#include <stdexcept>
#include <string>

namespace piblocks::h264 {

/// A header of a stream is broken, or the slices of this encoder do not fit it.
class HeaderError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Texts and numbers, one after another.
template <typename... Parts>
std::string message(const Parts&... parts) {
  std::ostringstream text;
  (text << ... << parts);
  return text.str();
}

}  // namespace piblocks::h264
