#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/instant.hpp>

#include <algorithm>
#include <optional>
#include <utility>

#include "cli/command.hpp"
#include "cli/log_format.hpp"
#include "cli/options.hpp"
#include "cli/scene_options.hpp"
#include "cli/stop_on_signals.hpp"
#include "cli/text_output.hpp"
#include "core/output_file.hpp"
#include "physics/exact_motion.hpp"

namespace piblocks::cli {
namespace {

Integer parse_positive(const std::string& text) { return parse_whole_number(text, 1); }

Integer parse_index(const std::string& text) {
  const Rational index = parse_rational(text);
  if (index.get_den() != 1) throw UsageError("must be a whole number");
  return index.get_num();
}

/// An end of what is printed.
struct Bound {
  Instant instant;
  Rational time;
};

/// Nothing if the option was not given.
std::optional<Bound> bound_of(const Command& options, const char* option, const CollisionLog& log) {
  return options.value(option, [&](const std::string& text) {
    Instant instant = parse_instant(text);
    Rational time = time_of(instant, log);
    return Bound{std::move(instant), std::move(time)};
  });
}

/// The first collision at this instant or after it.
Integer first_since(const CollisionLog& log, const Bound& bound) {
  const auto& [instant, time] = bound;
  if (instant.offset == 0 && instant.anchor == Instant::Anchor::collision) return instant.index;
  if (instant.offset == 0 && instant.anchor == Instant::Anchor::last) return log.size();
  const Integer last = log.state_at(time).count;
  if (last < log.first_index()) return log.first_index();
  // Collisions happen together only in the corner, and there all of them do.
  const ExactMotion motion(log.system());
  if (motion.through_corner() && motion.closest_approach == time) return log.first_index();
  return log.collision(last).time == to_time(time) ? last : Integer(last + 1);
}

Rows rows_within_times(const Command& options, const CollisionLog& log) {
  const auto from = bound_of(options, "--from", log);
  const auto to = bound_of(options, "--to", log);
  if (from && to && to->time < from->time) {
    throw UsageError(fmt::format("--to {}: is before --from {}", exact_text(to->instant),
                                 exact_text(from->instant)));
  }
  Rows rows{1, log.size()};
  if (from) rows.first = first_since(log, *from);
  if (to) rows.last = log.state_at(to->time).count;
  return rows;
}

Rows select_rows(const Command& options, const CollisionLog& log) {
  Rows rows = rows_within_times(options, log);
  if (const auto first = options.value("--first", parse_index)) {
    if (*first > log.size() || *first < log.first_index()) {
      throw UsageError(
          fmt::format("--first {}: the scene has {}", readable(*first),
                      log.size() < log.first_index()
                          ? "no collisions"
                          : fmt::format("collisions {} to {}", readable(log.first_index()),
                                        readable(log.size()))));
    }
    rows.first = options.is_given("--from") ? std::max(rows.first, *first) : *first;
  }
  if (const auto limit = options.value("--limit", parse_positive)) {
    rows.last = std::min<Integer>(rows.last, rows.first + *limit - 1);
  }
  if (rows.count() > kMaxRows && !options.is_given("--limit")) {
    throw UsageError(fmt::format(
        "log: {} rows are more than {}; narrow them with --from, --to or --first, or allow them "
        "with --limit",
        readable(rows.count()), readable(kMaxRows)));
  }
  return rows;
}

/// @throws Interrupted soon after the token asks for it.
void write(CollisionStream& collisions, const LogFormat& format, OutputFile& file,
           const std::stop_token& stop) {
  fmt::memory_buffer rows;
  for (CollisionBatch batch{}; collisions.read(batch); rows.clear()) {
    if (stop.stop_requested()) throw Interrupted("log: interrupted");
    format.append(batch, rows);
    file.write(std::string_view(rows.data(), rows.size()));
  }
}

void run_log(const Command& options, const SceneOptions& scene_options) {
  const LogFormat format =
      options.value("--format", parse_log_format).value_or(parse_log_format("csv"));
  if (!format.is_text) refuse_terminal(options);
  scene_options.check_output();
  const Scene scene = scene_options.scene();
  const auto log = make_log(scene.system, options);
  const Rows rows = select_rows(options, *log);
  const std::string header = format.header(rows);
  const StopOnSignals signals;
  using Contents = OutputFile::Contents;
  OutputFile file(output_of(options), format.is_text ? Contents::text : Contents::bytes);
  file.write(header);
  write(*log->stream(rows.first, rows.last), format, file, signals.token());
  file.finish();
  note_convention(scene);
}

}  // namespace

void add_log(Command& app) {
  Command command = app.add_command("log", "Print every collision, a row each");
  const SceneOptions scene(command);
  add_engine(command);
  command.add_value("--from", "T", "Leave out collisions before this instant (default 0)");
  command.add_value("--to", "T", "Leave out collisions after this instant");
  command.add_value("--first", "K", "Start with this collision (default 1)");
  command.add_value("--limit", "N", "Print at most so many rows");
  command.add_value("--format", "NAME", "csv (default), jsonl, or npy, which numpy.load() reads");
  command.add_value("-o,--output", "FILE", "File to write (default: standard output)");
  command.set_footer(
      "Examples:\n"
      "  piblocks log --from 3 --to 4 --format jsonl\n"
      "  piblocks log --digits 7 --format npy -o log.npy\n"
      "  piblocks log --digits 20 --first 15707963267948966190 --limit 5 -o turn.csv");
  command.on_run([=] { run_log(command, scene); });
}

}  // namespace piblocks::cli
