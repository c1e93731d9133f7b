#include "cli/script_facts.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/render.hpp>
#include <piblocks/restitution.hpp>

#include "cli/values.hpp"

namespace piblocks::cli {

std::unique_ptr<CollisionLog> make_log(const BodySystem& system, const OptionTexts& options) {
  const auto parse_engine = [](const std::string& text) {
    return parse_choice<Engine>(text, {{"unfolded", Engine::unfolded}, {"events", Engine::events}});
  };
  return make_collision_log(system,
                            options.value("--engine", parse_engine).value_or(Engine::unfolded));
}

Scene scene_for_log(Scene scene, const OptionTexts& options) {
  const auto to = options.value("--to", parse_instant);
  if (to && to->is_time()) scene.time.to = *to;
  return scene;
}

PositionBounds bounds_at(const CollisionLog& log, const Rational& time) {
  if (const auto bounds = log.bounds_at(time)) return *bounds;
  throw UsageError(
      "--bounds: engines that step cannot say how exact they are; use --engine unfolded");
}

std::optional<Integer> infinite_count(const Log& log) {
  return is_endless(log) ? std::optional(log.last()) : std::nullopt;
}

std::optional<std::string> endless_note(const Scene& scene) {
  const std::optional<TwoBlocks> pair = two_blocks_of(scene.system);
  const std::optional<Collapse> collapse = pair ? collapse_of(*pair) : std::nullopt;
  if (!collapse) return std::nullopt;
  const std::string end = collapse->time
                              ? fmt::format(" until the blocks rest at t = {}", collapse->time->hi)
                              : std::string(", which never end");
  return fmt::format(
      "there are infinitely many collisions{}; the log lists the first {}, and the blocks rest "
      "from the last of these on",
      end, readable(collapse->listed));
}

SheetInstants sheet_instants(const OptionTexts& options) {
  constexpr int kUsualCount = 12;
  for (const char* option : {"--frames", "--by"}) {
    if (!options.is_given(option) || !options.is_given("--at")) continue;
    throw UsageError(
        fmt::format("{} and --at both say which instants are shown; give one of them", option));
  }
  if (const auto named = options.value("--at", parse_instants)) return *named;
  const auto parse_count = [](const std::string& text) {
    return parse_int(text, 1, kMaxSheetPictures);
  };
  const auto parse_spacing = [](const std::string& text) {
    return parse_choice<Spacing>(text, {{"count", Spacing::count}, {"time", Spacing::time}});
  };
  const int count = options.value("--frames", parse_count).value_or(kUsualCount);
  return Spread{count, options.value("--by", parse_spacing)};
}

void claim_logos(OverwriteCheck& check, const Script& script) {
  for (const Scene* scene : scenes_of(script)) {
    if (!scene->show.logo.empty()) check.reads("the logo", scene->show.logo);
  }
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

}  // namespace piblocks::cli
