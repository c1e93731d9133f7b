// The forms in which a log is written: csv, jsonl, and npy, which numpy.load() reads.
// In: which rows, then batches of collisions. Out: the bytes of the file, in order.
// npy: https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html, version 1.0
#pragma once

#include <fmt/format.h>
#include <piblocks/run.hpp>

#include <string>

namespace piblocks::cli {

/// Rows first … last, by index; none if last < first.
struct Rows {
  Integer first;
  Integer last;

  Integer count() const { return last < first ? Integer(0) : Integer(last - first + 1); }
};

/// How a log is written.
struct LogFormat {
  bool is_text;
  std::string (*header)(const Rows& rows);  // bytes before the rows
  void (*append)(const CollisionBatch& batch, fmt::memory_buffer& out);
};

/// @throws UsageError if there is no format of this name.
LogFormat parse_log_format(const std::string& text);

}  // namespace piblocks::cli
