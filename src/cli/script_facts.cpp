#include "cli/script_facts.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/render.hpp>

#include "cli/values.hpp"
#include "scene/run_log.hpp"

namespace piblocks::cli {

std::unique_ptr<Log> make_log(Scene scene, const OptionTexts& options) {
  const auto parse_engine = [](const std::string& text) {
    return parse_choice<Engine>(text, {{"unfolded", Engine::unfolded}, {"events", Engine::events}});
  };
  if (options.is_given("--to")) {
    const Instant to = *options.value("--to", parse_instant);
    if (to.is_time()) scene.time.to = to;
  }
  return log_of(scene, {}, options.value("--engine", parse_engine).value_or(Engine::unfolded));
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

}  // namespace piblocks::cli
