// Bytes as text that a page can hold.
// In: bytes. Out: base64 (RFC 4648, section 4), in one line.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace piblocks {

/// The texts of consecutive pieces, all but the last a multiple of three bytes long, make up the
/// text of the whole.
std::string base64(std::span<const std::uint8_t> bytes);

}  // namespace piblocks
