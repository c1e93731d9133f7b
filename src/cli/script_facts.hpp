// What commands ask of a scene or a storyboard, apart from its film.
// In: a script, and options as texts. Out: its log, the files that it reads, what a user should
// know.
#pragma once

#include <piblocks/instant.hpp>
#include <piblocks/render.hpp>
#include <piblocks/run.hpp>
#include <piblocks/script.hpp>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/option_texts.hpp"
#include "core/overwrite_check.hpp"

namespace piblocks::cli {

/// The system's log, made by the engine that --engine names.
/// @throws UsageError if that engine would have to store too many collisions.
std::unique_ptr<CollisionLog> make_log(const BodySystem& system, const OptionTexts& options);

/// The scene as a log of it is asked for: bodies that collide for ever are computed up to --to, if
/// that is a time, and have to be certain up to then.
Scene scene_for_log(Scene scene, const OptionTexts& options);

/// How exact the state at a time is. @throws UsageError if the engine cannot say.
PositionBounds bounds_at(const CollisionLog& log, const Rational& time);

/// The index in this log that stands for infinitely many collisions, if one does.
std::optional<Integer> infinite_count(const Log& log);

/// How far the log of a run of infinitely many collisions goes; nothing for other scenes.
/// @throws SceneError if problems_of() of the system is not empty.
std::optional<std::string> endless_note(const Scene& scene);

/// What --at, or --frames and --by, say that a sheet shows.
/// @throws UsageError
SheetInstants sheet_instants(const OptionTexts& options);

/// Enters the logos of a scene or storyboard as files that are read.
void claim_logos(OverwriteCheck& check, const Script& script);

/// Which of two equally good counts is shown, if all collisions of a run happen at once: their
/// number then depends on a convention. A line for each such run.
/// @throws SceneError if problems_of() of the system is not empty.
std::vector<std::string> convention_notes(const Script& script);

}  // namespace piblocks::cli
