// The run of a scene. In: a scene without problems. Out: its log; notes and errors about it.
#pragma once

#include <piblocks/run.hpp>
#include <piblocks/scene.hpp>

#include <memory>
#include <optional>
#include <string>

namespace piblocks {

/// Nothing is computed yet. Where collisions may never end, those until scene.time.to count, if
/// that is a time.
/// @throws as make_log()
std::unique_ptr<Log> log_of(const Scene& scene);

/// @throws UsageError if bodies are not certain at this time, unless the scene allows that.
void require_certain(const Scene& scene, const Log& log, const Rational& time);

/// The same of all collisions up to this one.
void require_certain_until(const Scene& scene, const Log& log, const Integer& last);

/// What to tell the user if the order of ties decides what happens up to this collision; nothing of
/// two blocks and a wall.
std::optional<std::string> tie_note(const Log& log, const Integer& last);

/// @param what  in the message: an option
/// @throws UsageError if the scene has bodies: only two blocks and a wall can be shown that way.
void require_blocks(const Scene& scene, const char* what);

}  // namespace piblocks
