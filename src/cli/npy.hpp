// Collisions as a NumPy file, format version 1.0: numpy.load() gives a structured array.
// In: the number of rows, then batches of collisions. Out: the bytes of the file, in order.
// https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html
#pragma once

#include <fmt/format.h>
#include <piblocks/run.hpp>

#include <cstdint>
#include <limits>
#include <string>

namespace piblocks::cli {

/// The largest index that a row can hold.
inline constexpr std::int64_t kMaxNpyIndex = std::numeric_limits<std::int64_t>::max();

/// What stands before so many rows.
std::string npy_header(const Integer& rows);

/// Appends a row for each collision; no index may be above kMaxNpyIndex.
void append_npy(const CollisionBatch& batch, fmt::memory_buffer& out);

}  // namespace piblocks::cli
