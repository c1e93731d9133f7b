// Which rows of a log are asked for, and how a row lies in memory.
// In: a log, options as texts, batches of collisions. Out: a range of indices, and rows as NumPy
// has them.
#pragma once

#include <piblocks/bodies.hpp>
#include <piblocks/exact.hpp>
#include <piblocks/run.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "cli/option_texts.hpp"

namespace piblocks::cli {

/// Rows first … last, by index; none if last < first.
struct Rows {
  Integer first;
  Integer last;
  /// They are all collisions from `first` on until this time; nothing for the whole run.
  std::optional<Rational> until = {};

  Integer count() const { return last < first ? Integer(0) : Integer(last - first + 1); }
};

/// What --from, --to, --first and --limit select.
/// @throws UsageError if they make no sense, or select more than kMaxRows without --limit.
Rows select_rows(const OptionTexts& options, const Log& log);

/// What a file of NumPy begins with
/// (https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html, version 1.0).
/// @throws UsageError if an index does not fit into a row.
std::string npy_header(std::string_view row_type, const Rows& rows);

/// A row as NumPy describes it: no gaps, numbers in little-endian order.
inline constexpr std::string_view kRowType =
    "[('index', '<i8'), ('time', '<f8'), ('time_low', '<f8'), ('kind', '|S6'), "
    "('x_blue', '<f8'), ('x_red', '<f8'), ('v_blue', '<f8'), ('v_red', '<f8')]";
inline constexpr std::size_t kRow_bytes = 7 * 8 + 6;

/// Writes the rows of a batch, kRow_bytes each. @param first  index of the first one, as written
void write_rows(const CollisionBatch& batch, std::int64_t first, char* at);

}  // namespace piblocks::cli
