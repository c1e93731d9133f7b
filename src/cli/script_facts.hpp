// What commands ask of a scene or a storyboard, apart from its film.
// In: a script, and options as texts. Out: its log, which rows of it, and the files that it reads.
#pragma once

#include <piblocks/exact.hpp>
#include <piblocks/instant.hpp>
#include <piblocks/log.hpp>
#include <piblocks/render.hpp>
#include <piblocks/script.hpp>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/option_texts.hpp"
#include "core/overwrite_check.hpp"

namespace piblocks::cli {

/// The log of a scene, by the engine that --engine names. Where collisions may never end, those
/// until --to count, if that is a time.
/// @throws UsageError if the scene cannot have that engine, or that would have to store too many
///         collisions.
std::unique_ptr<Log> make_log(Scene scene, const OptionTexts& options);

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

/// "0,3.5,#10,last"
std::vector<Instant> parse_instants(const std::string& text);

/// What --at, or --frames and --by, say that a sheet shows.
/// @throws UsageError
SheetInstants sheet_instants(const OptionTexts& options);

/// Enters the logos of a scene or storyboard as files that are read.
void claim_logos(OverwriteCheck& check, const Script& script);

}  // namespace piblocks::cli
