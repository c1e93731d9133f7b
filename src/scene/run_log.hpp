// The run of a scene. In: a scene without problems. Out: its log; notes and errors about it.
#pragma once

#include <piblocks/run.hpp>
#include <piblocks/scene.hpp>

#include <memory>
#include <optional>
#include <stop_token>
#include <string>

namespace piblocks {

/// Nothing is computed yet. Where collisions may never end, those until scene.time.to count, if
/// that is a time.
/// @param stop  as make_log(). @throws as make_log()
std::unique_ptr<Log> log_of(const Scene& scene, const std::stop_token& stop = {});

/// @param time  nothing for the whole run
/// @throws UsageError if bodies are not certain until this time, unless the scene allows that.
void require_certain(const Scene& scene, const Log& log, const std::optional<Rational>& time);

/// What to tell the user if the order of ties decides what happens up to this collision; nothing of
/// two blocks beside something immovable, which have a convention.
std::optional<std::string> tie_note(const Log& log, const Integer& last);

/// Which collisions the log lists: "no collisions", "collisions #1 to #31".
/// @param mark  before each number
std::string listed_collisions(const Log& log, const char* mark);

/// @param what  in the message: an option
/// @throws UsageError if the scene has bodies: only two blocks and a wall can be shown that way.
void require_blocks(const Scene& scene, const char* what);

}  // namespace piblocks
