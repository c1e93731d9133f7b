#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>

#include "cli/commands.hpp"
#include "cli/options.hpp"
#include "cli/scene_options.hpp"
#include "cli/stop_on_signals.hpp"
#include "cli/text_output.hpp"

namespace piblocks::cli {
namespace {

/// Most rows that are written unless --limit asks for more.
constexpr long kMaxRows = 100'000'000;

struct LogOptions {
  SceneOptions scene;
  const CLI::Option* engine;
  const CLI::Option* from;
  const CLI::Option* to;
  const CLI::Option* first;
  const CLI::Option* limit;
  const CLI::Option* format;
  const CLI::Option* output;
};

/// Rows first … last, by index; none if last < first.
struct Rows {
  Integer first;
  Integer last;
};

Integer parse_positive(const std::string& text) { return parse_whole_number(text, 1); }

/// Number of collisions before `time`, or also at it.
Integer count_until(const CollisionLog& log, const Rational& time, bool inclusive) {
  const Time t = to_time(time);
  const auto has_happened = [&](const Integer& index) {
    const Time event = log.at(index).time;
    if (event.hi != t.hi) return event.hi < t.hi;
    return inclusive ? event.lo <= t.lo : event.lo < t.lo;
  };
  Integer happened = 0;  // invariant: happened <= answer < open
  Integer open = log.size() + 1;
  while (happened + 1 < open) {
    const Integer middle = (happened + open) / 2;
    (has_happened(middle) ? happened : open) = middle;
  }
  return happened;
}

Rows rows_within_times(const LogOptions& options, const CollisionLog& log) {
  const auto from = value_of(*options.from, parse_rational);
  const auto to = value_of(*options.to, parse_rational);
  if (from && to && *to < *from) {
    throw UsageError(fmt::format("--to {}: is before --from {}", to_text(*to), to_text(*from)));
  }
  Rows rows{1, log.size()};
  if (from) rows.first = count_until(log, *from, false) + 1;
  if (to) rows.last = count_until(log, *to, true);
  return rows;
}

Rows select_rows(const LogOptions& options, const CollisionLog& log) {
  Rows rows = rows_within_times(options, log);
  if (const auto first = value_of(*options.first, parse_positive)) {
    if (*first > log.size()) {
      throw UsageError(fmt::format("--first {}: the scene has {} collisions", readable(*first),
                                   readable(log.size())));
    }
    rows.first = std::max(rows.first, *first);
  }
  if (const auto limit = value_of(*options.limit, parse_positive)) {
    rows.last = std::min<Integer>(rows.last, rows.first + *limit - 1);
  }
  const Integer count = rows.last - rows.first + 1;
  if (count > kMaxRows && options.limit->count() == 0) {
    throw UsageError(fmt::format(
        "log: {} rows are more than {}; narrow them with --from, --to or --first, or allow them "
        "with --limit",
        readable(count), readable(kMaxRows)));
  }
  return rows;
}

const char* name_of(CollisionKind kind) { return kind == CollisionKind::wall ? "wall" : "blocks"; }

void write_csv(const Collision& c, TextOutput& out) {
  out.format_line("{},{},{},{},{},{},{}", c.index.get_str(), shown(c.time.hi), name_of(c.kind),
                  shown(c.blue.position), shown(c.red.position), shown(c.blue.velocity),
                  shown(c.red.velocity));
}

void write_jsonl(const Collision& c, TextOutput& out) {
  out.format_line(
      R"({{"index":"{}","time":{},"kind":"{}","x_blue":{},"x_red":{},"v_blue":{},"v_red":{}}})",
      c.index.get_str(), shown(c.time.hi), name_of(c.kind), shown(c.blue.position),
      shown(c.red.position), shown(c.blue.velocity), shown(c.red.velocity));
}

/// How a log is written.
struct Format {
  const char* header;  // a line before the rows, if any
  void (*write)(const Collision& collision, TextOutput& out);
};

Format parse_format(const std::string& text) {
  return parse_choice<Format>(text,
                              {{"csv", {"index,time,kind,x_blue,x_red,v_blue,v_red", write_csv}},
                               {"jsonl", {nullptr, write_jsonl}}});
}

void run(const LogOptions& options) {
  const Format format = value_of(*options.format, parse_format).value_or(parse_format("csv"));
  const auto log = make_log(options.scene.scene().system, *options.engine);
  const Rows rows = select_rows(options, *log);
  const StopOnSignals signals;
  const std::stop_token stop = signals.token();
  TextOutput out(text_of(*options.output).value_or("-"));
  if (format.header != nullptr) out.line(format.header);
  for (Integer index = rows.first; index <= rows.last; ++index) {
    if (stop.stop_requested()) throw Interrupted("log: interrupted");
    format.write(log->at(index), out);
  }
  out.finish();
}

LogOptions add_options(CLI::App& command) {
  const SceneOptions scene(command);
  return {scene,
          &add_engine(command),
          &add_value_option(command, "--from", "S", "Leave out collisions before this time"),
          &add_value_option(command, "--to", "S", "Leave out collisions after this time"),
          &add_value_option(command, "--first", "K", "Start with this collision, from 1"),
          &add_value_option(command, "--limit", "N", "Print at most so many rows"),
          &add_value_option(command, "--format", "NAME", "csv (default) or jsonl"),
          &add_value_option(command, "-o,--output", "FILE",
                            "File to write (default: standard output)")};
}

}  // namespace

void add_log(CLI::App& app) {
  CLI::App* command = app.add_subcommand("log", "Print every collision, a row each");
  const LogOptions options = add_options(*command);
  command->footer(
      "Examples:\n"
      "  piblocks log --from 3 --to 4 --format jsonl\n"
      "  piblocks log --digits 20 --first 15707963267948966190 --limit 5 -o turn.csv");
  command->callback([options] { run(options); });
}

}  // namespace piblocks::cli
