// The run of a scene. In: a scene without problems. Out: its log; notes and errors about it.
#pragma once

#include <piblocks/scene.hpp>
#include <piblocks/script.hpp>
#include <piblocks/two_blocks.hpp>

#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

namespace piblocks {

/// Nothing is computed yet. Where collisions may never end, those until scene.time.to count, if
/// that is a time.
/// @param stop, engine  as make_log(). @throws as make_log()
std::unique_ptr<Log> log_of(const Scene& scene, const std::stop_token& stop = {},
                            Engine engine = Engine::unfolded);

/// `time.to`, but not before time 0; nothing if it is no time.
std::optional<Rational> end_of(const Scene& scene);

/// @param until  nothing for the whole run
/// @throws UsageError if there are infinitely many collisions until then.
void require_finite_count(const Log& log, const std::optional<Rational>& until);

/// @param time  nothing for the whole run
/// @throws UsageError if bodies are not certain until this time, unless the scene allows that.
void require_certain(const Scene& scene, const Log& log, const std::optional<Rational>& time);

/// What to tell the user if the order of ties decides what happens up to this collision; nothing of
/// two blocks beside something immovable, which have a convention.
std::optional<std::string> tie_note(const Log& log, const Integer& last);

/// Which of two equally good counts is shown, if all collisions of a run happen at once: their
/// number then depends on a convention. A line for each such run.
std::vector<std::string> convention_notes(const Script& script);

/// How far the log of a run of infinitely many collisions goes.
std::string endless_note(const System& system, const Collapse& collapse);

/// Which collisions the log lists: "no collisions", "collisions #1 to #31".
/// @param mark  before each number
std::string listed_collisions(const Log& log, const char* mark);

}  // namespace piblocks
