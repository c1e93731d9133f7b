#include "scene/run_log.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/two_blocks.hpp>

#include <algorithm>

#include "core/text.hpp"
#include "physics/logs.hpp"
#include "scene/schedule.hpp"

namespace piblocks {

std::unique_ptr<Log> log_of(const Scene& scene, const std::stop_token& stop, Engine engine) {
  return make_log(scene.system, end_of(scene), stop, engine);
}

std::optional<Rational> end_of(const Scene& scene) {
  if (!scene.time.to.is_time()) return std::nullopt;
  return std::max(scene.time.to.offset, Rational(0));
}

void require_finite_count(const Log& log, const std::optional<Rational>& until) {
  if (const auto collapse = log.collapse(until)) refuse_count(log.system(), *collapse);
}

void require_certain(const Scene& scene, const Log& log, const std::optional<Rational>& time) {
  if (scene.time.allow_uncertain) return;
  const std::optional<double> until = log.certain_until(time);
  if (!until) return;
  if (const auto collapse = collapse_at(log, *until, time)) {
    throw UsageError(
        fmt::format("bodies: there are {}; what follows is not computed; end earlier, as with "
                    "time.to = {:.4g}, "
                    "or accept this by --allow-uncertain",
                    text_of(log.system(), *collapse), *until * 0.999));
  }
  throw UsageError(fmt::format(
      "bodies: the result is certain only until time {}; after that, rounding may change which "
      "bodies collide; end earlier, as with time.to = {:.4g}, or accept this by --allow-uncertain",
      rounded_down(*until), *until * 0.999));
}

std::optional<std::string> tie_note(const Log& log, const Integer& last) {
  const std::optional<Integer> tie = log.pair() ? std::nullopt : log.first_tie(last);
  if (!tie) return std::nullopt;
  const double time = log.collision_time(*tie).hi;
  if (are_at_once(log.system())) {
    return fmt::format(
        "at t = {} bodies that touch collide at once; one after the other, as by contacts = "
        "\"in-order\", they may part otherwise",
        time);
  }
  return fmt::format(
      "at t = {} a body has several collisions at once: those of movable bodies come first, in the "
      "order of the file; another order may end otherwise",
      time);
}

std::vector<std::string> convention_notes(const Script& script) {
  std::vector<std::string> notes;
  for (const Scene* scene : scenes_of(script)) {
    const std::optional<TwoBlocks> pair = two_blocks_of(scene->system);
    const auto corner = pair ? corner_of(*pair) : std::nullopt;
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

std::string endless_note(const System& system, const Collapse& collapse) {
  const bool is_pair = two_blocks_of(system).has_value();
  return fmt::format("there are {}; the log lists the first {}{}", text_of(system, collapse),
                     readable(collapse.listed),
                     is_pair ? ", and shows the blocks at rest after them" : "");
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

}  // namespace piblocks
