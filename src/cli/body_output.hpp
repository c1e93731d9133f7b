// Collisions of bodies, as commands print them.
// In: a log of bodies. Out: rows of CSV, JSON or NumPy. Bodies are numbered from
// 1, as their tables stand in the scene file; walls have their names.
#pragma once

#include <fmt/format.h>
#include <piblocks/bodies.hpp>

#include <string>
#include <string_view>

#include "cli/log_rows.hpp"

namespace piblocks::cli {

/// How a log of bodies is written.
struct BodyLogFormat {
  bool is_binary;
  std::string (*header)(const BodySystem& system, const Rows& rows);
  void (*append)(const BodySystem& system, const BodyCollision& collision, fmt::memory_buffer& out);
};

/// @throws UsageError unless the name is csv, jsonl or npy.
BodyLogFormat parse_body_log_format(const std::string& name);

/// A row as NumPy describes it: no gaps, numbers in little-endian order. A wall is -1, -2, … in the
/// order of BodySystem::walls.
std::string_view body_row_type(const BodySystem& system);
/// Appends such a row.
void append_body_row(const BodySystem& system, const BodyCollision& collision,
                     fmt::memory_buffer& out);

}  // namespace piblocks::cli
