// What commands ask of a scene or a storyboard, apart from its film.
// In: a script, and options as texts. Out: its log, the files that it reads.
#pragma once

#include <piblocks/instant.hpp>
#include <piblocks/render.hpp>
#include <piblocks/script.hpp>
#include <piblocks/two_blocks.hpp>

#include <memory>

#include "cli/option_texts.hpp"
#include "core/overwrite_check.hpp"

namespace piblocks::cli {

/// The log of a scene, by the engine that --engine names. Where collisions may never end, those
/// until --to count, if that is a time.
/// @throws UsageError if the scene cannot have that engine, or that would have to store too many
///         collisions.
std::unique_ptr<Log> make_log(Scene scene, const OptionTexts& options);

/// What --at, or --frames and --by, say that a sheet shows.
/// @throws UsageError
SheetInstants sheet_instants(const OptionTexts& options);

/// Enters the logos of a scene or storyboard as files that are read.
void claim_logos(OverwriteCheck& check, const Script& script);

}  // namespace piblocks::cli
