// Which rows of a log are asked for.
// In: a log, options as texts. Out: a range of indices.
#pragma once

#include <piblocks/exact.hpp>
#include <piblocks/log.hpp>

#include <optional>

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

/// What --from, --to, --first and --limit select, and --last, which Python has.
/// @throws UsageError if they make no sense, or select more than kMaxRows without --limit.
Rows select_rows(const OptionTexts& options, const Log& log);

}  // namespace piblocks::cli
