// The hash by which frames and pictures are told apart.
// In: bytes. Out: its digits. It is no protection against a forger.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace piblocks {

/// 32 hexadecimal digits of 128 bits, the same on every machine. Loads libav.
/// @throws MediaError if that cannot be loaded.
std::string hash_of_bytes(std::span<const std::uint8_t> bytes);

/// The same where libav is loaded.
std::string compute_hash(std::span<const std::uint8_t> bytes);

}  // namespace piblocks
