// The hash by which frames and pictures are told apart; framehash.cpp sets up its output too.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace piblocks {

/// The module's side of hash_of_bytes().
std::string compute_hash(std::span<const std::uint8_t> bytes);

}  // namespace piblocks
