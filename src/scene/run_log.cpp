#include "scene/run_log.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/restitution.hpp>

#include <algorithm>

#include "scene/schedule.hpp"

namespace piblocks {

std::unique_ptr<Log> log_of(const Scene& scene, const std::stop_token& stop) {
  const bool is_time = scene.time.to.is_time();
  return make_log(
      scene.system,
      is_time ? std::optional(std::max(scene.time.to.offset, Rational(0))) : std::nullopt, stop);
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

std::optional<std::string> tie_note(const Log& log, const Integer& last) {
  const std::optional<Integer> tie = log.pair() ? std::nullopt : log.first_tie(last);
  if (!tie) return std::nullopt;
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

void require_blocks(const Scene& scene, const char* what) {
  if (has_short_names(scene.system)) return;
  throw UsageError(fmt::format(
      "{}: needs two blocks and a fixed wall; leave it out, or leave out [[body]] and wall.mass",
      what));
}

}  // namespace piblocks
