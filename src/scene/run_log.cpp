#include "scene/run_log.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/restitution.hpp>

#include <algorithm>

#include "scene/schedule.hpp"

namespace piblocks {

std::unique_ptr<Log> log_of(const Scene& scene, const std::stop_token& stop) {
  if (!scene.bodies) return make_collision_log(scene.system);
  const bool is_time = scene.time.to.is_time();
  return make_log(
      scene.bodies->system,
      is_time ? std::optional(std::max(scene.time.to.offset, Rational(0))) : std::nullopt, stop);
}

std::unique_ptr<Log> log_by(const std::optional<Engine>& engine, const Scene& scene) {
  std::unique_ptr<Log> log = log_of(scene);
  if (!engine) return log;
  require_pair(*log, "--engine");
  return make_collision_log(log->pair()->two_blocks(), *engine);
}

Integer count_of(const Scene& scene) {
  if (has_short_names(scene)) return count_collisions(scene.system);
  const std::unique_ptr<Log> log = log_of(scene);
  const Integer count = log->last();
  require_certain(scene, *log, log->horizon());
  return count;
}

std::optional<Integer> infinite_count(const Log& log) {
  return is_endless(log) ? std::optional(log.last()) : std::nullopt;
}

void require_certain(const Scene& scene, const Log& log, const std::optional<Rational>& time) {
  if (scene.time.allow_uncertain) return;
  const std::optional<double> until = log.certain_until(time);
  if (!until) return;
  throw UsageError(fmt::format(
      "bodies: the result is certain only until time {:.6g}; after that, rounding may change which "
      "bodies collide; end earlier, as with time.to = {:.4g}, or accept this by --allow-uncertain",
      *until, *until * 0.999));
}

std::optional<std::string> tie_note(const Scene& scene, const Log& log, const Integer& last) {
  const std::optional<Integer> tie = log.first_tie(last);
  if (has_short_names(scene) || !tie) return std::nullopt;
  return fmt::format(
      "at t = {} a body has several collisions at once: those of movable bodies come first, in the "
      "order of the file; another order may end otherwise",
      log.collision_time(*tie).hi);
}

std::string listed_collisions(const Log& log, const char* mark) {
  const std::string first = mark + readable(log.first_index());
  if (!log.has(log.first_index())) return "no collisions";
  if (!log.has_last()) return fmt::format("collisions from {} on", first);
  return fmt::format(
      "{} {} to {}{}",
      is_endless(log) ? "infinitely many collisions, of which the log lists" : "collisions", first,
      mark, readable(log.last()));
}

void require_pair(const Log& log, const char* what) {
  if (log.pair() != nullptr) return;
  throw UsageError(fmt::format(
      "{}: needs two blocks beside one wall or fixed block, and no more; leave it out", what));
}

std::vector<std::string> convention_notes(const Script& script) {
  std::vector<std::string> notes;
  for (const Scene* scene : scenes_of(script)) {
    if (!has_short_names(*scene)) continue;
    const std::optional<Corner> corner = corner_of(scene->system);
    if (!corner) continue;
    notes.push_back(fmt::format(
        "all collisions happen at once, at t = {}, when blue touches both wall and red: by "
        "convention {}, which makes {} ({} first: {})",
        to_text(corner->time),
        corner->blocks_first ? "the blocks meet first" : "blue meets the wall first",
        readable(corner->count), corner->blocks_first ? "wall" : "blocks",
        readable(corner->other_count)));
  }
  return notes;
}

std::optional<std::string> endless_note(const Scene& scene) {
  if (!has_short_names(scene)) return std::nullopt;
  const std::optional<Collapse> collapse = collapse_of(scene.system);
  if (!collapse) return std::nullopt;
  const std::string end = collapse->time
                              ? fmt::format(" until the blocks rest at t = {}", collapse->time->hi)
                              : std::string(", which never end");
  return fmt::format(
      "there are infinitely many collisions{}; the log lists the first {}, and the blocks rest "
      "from the last of these on",
      end, readable(collapse->listed));
}

}  // namespace piblocks
