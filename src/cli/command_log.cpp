#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <map>
#include <memory>
#include <optional>

#include "cli/commands.hpp"
#include "cli/scene_options.hpp"
#include "cli/text_output.hpp"

namespace piblocks::cli {
namespace {

/// Most rows that are written unless --limit asks for more.
constexpr long kMaxRows = 100'000'000;

enum class Format { csv, jsonl };

struct LogOptions {
  SceneOptions scene;
  Engine engine = Engine::unfolded;
  std::string from;
  std::string to;
  std::string first;
  std::string limit;
  Format format = Format::csv;
  std::string output = "-";
};

/// Rows first … last, by index; none if last < first.
struct Rows {
  Integer first;
  Integer last;
};

Integer parse_positive(const std::string& text) {
  const Rational value = parse_rational(text);
  if (value.get_den() != 1 || value < 1) throw UsageError("must be a whole number from 1 on");
  return value.get_num();
}

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

Rows select_rows(const LogOptions& options, const CollisionLog& log) {
  Rows rows{1, log.size()};
  if (!options.from.empty()) {
    const Rational from = parse_option("--from", options.from, parse_rational);
    rows.first = count_until(log, from, false) + 1;
  }
  if (!options.to.empty()) {
    const Rational to = parse_option("--to", options.to, parse_rational);
    if (!options.from.empty() && to < parse_rational(options.from)) {
      throw UsageError(fmt::format("--to {}: is before --from {}", options.to, options.from));
    }
    rows.last = count_until(log, to, true);
  }
  if (!options.first.empty()) {
    const Integer first = parse_option("--first", options.first, parse_positive);
    if (first > log.size()) {
      throw UsageError(fmt::format("--first {}: the scene has {} collisions", options.first,
                                   log.size().get_str()));
    }
    rows.first = std::max(rows.first, first);
  }
  if (!options.limit.empty()) {
    const Integer limit = parse_option("--limit", options.limit, parse_positive);
    rows.last = std::min<Integer>(rows.last, rows.first + limit - 1);
  } else if (rows.last - rows.first >= kMaxRows) {
    throw UsageError(fmt::format(
        "log: {} rows are more than the limit of {}; narrow them with --from, --to, --first, or "
        "give --limit",
        with_thousands_separators(rows.last - rows.first + 1),
        with_thousands_separators(kMaxRows)));
  }
  return rows;
}

const char* name_of(CollisionKind kind) { return kind == CollisionKind::wall ? "wall" : "blocks"; }

void write_csv(const Collision& c, TextOutput& out) {
  out.format_line("{},{},{},{},{},{},{}", c.index.get_str(), c.time.hi, name_of(c.kind),
                  c.blue.position, c.red.position, c.blue.velocity, c.red.velocity);
}

void write_jsonl(const Collision& c, TextOutput& out) {
  out.format_line(
      R"({{"index":"{}","time":{},"kind":"{}","x_blue":{},"x_red":{},"v_blue":{},"v_red":{}}})",
      c.index.get_str(), c.time.hi, name_of(c.kind), c.blue.position, c.red.position,
      c.blue.velocity, c.red.velocity);
}

void run(const LogOptions& options, const std::stop_token& stop) {
  const auto log = make_collision_log(options.scene.scene().system, options.engine);
  const Rows rows = select_rows(options, *log);
  const auto write = options.format == Format::csv ? write_csv : write_jsonl;
  TextOutput out(options.output);
  if (options.format == Format::csv) out.line("index,time,kind,x_blue,x_red,v_blue,v_red");
  for (Integer index = rows.first; index <= rows.last; ++index) {
    if (stop.stop_requested()) throw Interrupted("log: interrupted");
    write(log->at(index), out);
  }
  out.finish();
}

}  // namespace

void add_log(CLI::App& app, const std::stop_token& stop) {
  CLI::App* command = app.add_subcommand("log", "Print every collision, a row each");
  auto options = std::make_shared<LogOptions>();
  options->scene.add_system(*command);
  add_engine(*command, options->engine);
  command->add_option("--from", options->from, "Leave out collisions before this time")
      ->type_name("S");
  command->add_option("--to", options->to, "Leave out collisions after this time")->type_name("S");
  command->add_option("--first", options->first, "Start with this collision, from 1")
      ->type_name("K");
  command->add_option("--limit", options->limit, "Print at most so many rows")->type_name("N");
  static const std::map<std::string, Format> kFormats{{"csv", Format::csv},
                                                      {"jsonl", Format::jsonl}};
  command->add_option("--format", options->format, "csv (default) or jsonl")
      ->transform(CLI::CheckedTransformer(kFormats).description(""))
      ->type_name("NAME");
  command->add_option("-o,--output", options->output, "File to write (default: standard output)")
      ->type_name("FILE");
  command->callback([options, stop] { run(*options, stop); });
}

}  // namespace piblocks::cli
