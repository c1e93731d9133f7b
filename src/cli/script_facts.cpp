#include "cli/script_facts.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <utility>

#include "scene/run_log.hpp"

namespace piblocks::cli {
namespace {

Integer parse_index(const std::string& text) {
  if (std::optional<Integer> index = whole_number(text)) return *std::move(index);
  throw UsageError("must be a whole number");
}

/// An end of what is printed.
struct Bound {
  Instant instant;
  Rational time;
};

/// Nothing if the option was not given.
std::optional<Bound> bound_of(const OptionTexts& options, const char* option, const Log& log) {
  return options.value(option, [&](const std::string& text) {
    Instant instant = parse_instant(text);
    Rational time = time_of(instant, log);
    return Bound{std::move(instant), std::move(time)};
  });
}

/// The first collision at this instant or after it.
Integer first_since(const Log& log, const Bound& bound) {
  const auto& [instant, time] = bound;
  if (instant.offset == 0 && instant.anchor == Instant::Anchor::collision) return instant.index;
  if (instant.offset == 0 && instant.anchor == Instant::Anchor::last) return log.last();
  return log.first_since(time);
}

/// Nothing if the option was not given, or is none of this command.
std::optional<Integer> index_of(const OptionTexts& options, const std::string& option,
                                const Log& log) {
  if (!options.is_given(option)) return std::nullopt;
  const Integer index = *options.value(option, parse_index);
  if (log.is_listed(index)) return index;
  throw UsageError(
      fmt::format("{} {}: the scene has {}", option, readable(index), listed_collisions(log, "")));
}

Integer first_row(const OptionTexts& options, const Log& log, const std::optional<Bound>& from) {
  Integer since = from ? first_since(log, *from) : Integer(1);
  const auto first = index_of(options, "--first", log);
  if (!first) return since;
  return from ? std::max(since, *first) : *first;
}

/// Sets where the rows end. Asks for no collision beyond them.
/// @param until  the rows end before any later collision; nothing if the run ends by itself
void end_rows(const OptionTexts& options, const Log& log, const std::optional<Rational>& until,
              Rows& rows) {
  const auto parse_limit = [](const std::string& text) { return parse_whole_number(text, 1); };
  std::optional<Integer> last = index_of(options, "--last", log);
  if (const auto limit = options.value("--limit", parse_limit)) {
    const Integer end = rows.first + *limit - 1;
    last = last ? std::min(*last, end) : end;
  }
  if (last && log.has(*last)) {
    const Rational end = to_rational(log.collision_time(*last));
    if (!until || end < *until) {
      rows.last = *last;
      rows.until = end;
      return;
    }
  }
  rows.last = until ? log.count_at(*until) : log.last();
  rows.until = until;
}

}  // namespace

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

Rows select_rows(const OptionTexts& options, const Log& log) {
  const auto from = bound_of(options, "--from", log);
  const auto to = bound_of(options, "--to", log);
  if (from && to && to->time < from->time) {
    throw UsageError(fmt::format("--to {}: is before --from {}", exact_text(to->instant),
                                 exact_text(from->instant)));
  }
  Rows rows;
  rows.first = first_row(options, log, from);
  end_rows(options, log, to ? std::optional(to->time) : log.horizon(), rows);
  if (rows.count() > kMaxRows && !options.is_given("--limit")) {
    throw UsageError(fmt::format(
        "log: {} rows are more than {}; narrow them with --from, --to or --first, or allow them "
        "with --limit",
        readable(rows.count()), readable(kMaxRows)));
  }
  return rows;
}

std::vector<Instant> parse_instants(const std::string& text) {
  std::vector<Instant> instants;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string instant = text.substr(begin, end - begin);
    try {
      instants.push_back(parse_instant(instant));
    } catch (const UsageError& error) {
      if (instant == text) throw;
      throw UsageError(fmt::format("'{}': {}", instant, error.what()));
    }
    begin = end + 1;
  }
  return instants;
}

SheetInstants sheet_instants(const OptionTexts& options) {
  constexpr int kUsualCount = 12;
  for (const char* option : {"--frames", "--by"}) {
    if (!options.is_given(option) || !options.is_given("--at")) continue;
    throw UsageError(
        fmt::format("{} and --at both say which instants are shown; give one of them", option));
  }
  if (const auto named = options.value("--at", parse_instants)) return *named;
  const auto parse_spacing = [](const std::string& text) {
    return parse_choice<Spacing>(text, {{"count", Spacing::count}, {"time", Spacing::time}});
  };
  const int count = options.whole("--frames", 1, kMaxSheetPictures).value_or(kUsualCount);
  return Spread{count, options.value("--by", parse_spacing)};
}

void claim_logos(OverwriteCheck& check, const Script& script) {
  for (const Scene* scene : scenes_of(script)) {
    if (!scene->show.logo.empty()) check.reads("the logo", scene->show.logo);
  }
}

}  // namespace piblocks::cli
