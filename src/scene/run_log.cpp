#include "scene/run_log.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>

#include "scene/schedule.hpp"

namespace piblocks {
namespace {

std::unique_ptr<BodyLog> body_log_of(const Scene& scene) {
  const BodySystem& system = scene.bodies->system;
  std::optional<Rational> until;
  if (may_never_end(system) && scene.time.to.is_time()) {
    until = std::max(scene.time.to.offset, Rational(0));
  }
  std::unique_ptr<BodyLog> log = make_body_log(system, until);
  if (has_span(scene, *log)) require_certain(scene, *log, span_of(scene, *log).to);
  return log;
}

}  // namespace

RunLog::RunLog(const Scene& scene) {
  if (scene.bodies) {
    bodies_ = body_log_of(scene);
  } else {
    blocks_ = make_collision_log(scene.system);
  }
}

void require_certain(const Scene& scene, const BodyLog& log, const Rational& time) {
  if (scene.time.allow_uncertain) return;
  log.count_at(time);  // computes it, and with it what is certain
  const std::optional<double> until = log.certain_until();
  if (!until || *until > to_double(time)) return;
  throw UsageError(fmt::format(
      "bodies: the result is certain only until time {:.6g}; after that, rounding may change which "
      "bodies collide; end earlier, as with time.to = {:.4g}, or accept this by --allow-uncertain",
      *until, *until * 0.999));
}

std::optional<std::string> tie_note(const RunLog& log, const Integer& last) {
  const std::optional<Integer> tie = log.bodies() ? log.bodies()->first_tie() : std::nullopt;
  if (!tie || *tie > last) return std::nullopt;
  return fmt::format(
      "at t = {} a body has several collisions at once: those of movable bodies come first, in the "
      "order of the file; another order may end otherwise",
      log.bodies()->collision_time(*tie).hi);
}

void require_blocks(const Scene& scene, const char* what) {
  if (!scene.bodies) return;
  throw UsageError(fmt::format(
      "{}: needs two blocks and a fixed wall; leave it out, or leave out [[body]] and wall.mass",
      what));
}

}  // namespace piblocks
