#include <fmt/compile.h>
#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/instant.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>

#include "cli/command.hpp"
#include "cli/options.hpp"
#include "cli/scene_options.hpp"
#include "cli/stop_on_signals.hpp"
#include "cli/text_output.hpp"
#include "core/output_file.hpp"
#include "physics/exact_motion.hpp"

namespace piblocks::cli {
namespace {

using Contents = OutputFile::Contents;

/// Rows first … last, by index; none if last < first.
struct Rows {
  Integer first;
  Integer last;

  Integer count() const { return last < first ? Integer(0) : Integer(last - first + 1); }
};

/// How a log is written.
struct LogFormat {
  Contents contents;
  std::string (*header)(const Rows& rows);  ///< bytes before the rows
  void (*append)(const CollisionBatch& batch, fmt::memory_buffer& out);
};

static_assert(std::endian::native == std::endian::little && sizeof(long) == 8,
              "rows are written as they are in memory");

constexpr std::string_view kRowType =
    "[('index', '<i8'), ('time', '<f8'), ('time_low', '<f8'), ('kind', '|S6'), "
    "('x_blue', '<f8'), ('x_red', '<f8'), ('v_blue', '<f8'), ('v_red', '<f8')]";
using Kind = std::array<char, 6>;
constexpr std::size_t kRow_bytes = 7 * 8 + sizeof(Kind);  // without gaps

constexpr Kind kWall{'w', 'a', 'l', 'l'};
constexpr Kind kBlocks{'b', 'l', 'o', 'c', 'k', 's'};

template <typename Value>
char* put(char* at, const Value& value) {
  std::memcpy(at, &value, sizeof value);
  return at + sizeof value;
}

/// https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html, version 1.0
/// @throws UsageError if an index does not fit.
std::string npy_header(const Rows& rows) {
  for (const Integer& index : {rows.first, rows.last}) {
    if (rows.count() == 0 || abs(index) <= std::numeric_limits<std::int64_t>::max()) continue;
    throw UsageError(fmt::format("--format npy: index {} does not fit in 64 bits; use csv or jsonl",
                                 readable(index)));
  }
  constexpr std::size_t kAlignment_bytes = 64;  // of the first row
  std::string text = fmt::format("{{'descr': {}, 'fortran_order': False, 'shape': ({},), }}",
                                 kRowType, rows.count().get_str());
  std::string header("\x93NUMPY\x01\x00", 8);
  const std::size_t length = header.size() + 2 + text.size() + 1;  // with its own length, and '\n'
  text.append((kAlignment_bytes - length % kAlignment_bytes) % kAlignment_bytes, ' ');
  text += '\n';
  header += static_cast<char>(text.size() % 256);
  header += static_cast<char>(text.size() / 256);
  return header + text;
}

void append_npy(const CollisionBatch& batch, fmt::memory_buffer& out) {
  const std::size_t begin = out.size();
  out.resize(begin + batch.size * kRow_bytes);
  char* at = out.data() + begin;
  const std::int64_t first = batch.first.get_si();
  for (std::size_t i = 0; i < batch.size; ++i) {
    at = put(at, first + static_cast<std::int64_t>(i));
    at = put(at, batch.time_hi[i]);
    at = put(at, batch.time_lo[i]);
    at = put(at, batch.kind[i] == CollisionKind::wall ? kWall : kBlocks);
    at = put(at, batch.blue_position[i]);
    at = put(at, batch.red_position[i]);
    at = put(at, batch.blue_velocity[i]);
    at = put(at, batch.red_velocity[i]);
  }
}

/// Appends a row each, its text as `format` says: index, time, kind, positions, velocities.
template <typename CompiledFormat>
void append_rows(const CollisionBatch& batch, const CompiledFormat& format,
                 fmt::memory_buffer& out) {
  DecimalCounter index(batch.first);
  constexpr std::size_t kMaxRest_bytes = 256;  // five numbers of at most 24 bytes, and names
  const std::size_t begin = out.size();
  out.resize(begin + batch.size * (index.text().size() + 1 + kMaxRest_bytes));
  char* end = out.data() + begin;  // fmt writes to a plain pointer a fifth faster
  for (std::size_t i = 0; i < batch.size; ++i, index.increment()) {
    end = fmt::format_to(end, format, index.text(), shown(batch.time_hi[i]),
                         batch.kind[i] == CollisionKind::wall ? "wall" : "blocks",
                         shown(batch.blue_position[i]), shown(batch.red_position[i]),
                         shown(batch.blue_velocity[i]), shown(batch.red_velocity[i]));
  }
  out.resize(static_cast<std::size_t>(end - out.data()));
}

void append_csv(const CollisionBatch& batch, fmt::memory_buffer& out) {
  append_rows(batch, FMT_COMPILE("{},{},{},{},{},{},{}\n"), out);
}

void append_jsonl(const CollisionBatch& batch, fmt::memory_buffer& out) {
  append_rows(batch,
              FMT_COMPILE("{{\"index\":\"{}\",\"time\":{},\"kind\":\"{}\",\"x_blue\":{},"
                          "\"x_red\":{},\"v_blue\":{},\"v_red\":{}}}\n"),
              out);
}

LogFormat parse_log_format(const std::string& text) {
  constexpr auto csv_header = [](const Rows&) {
    return std::string("index,time,kind,x_blue,x_red,v_blue,v_red\n");
  };
  constexpr auto no_header = [](const Rows&) { return std::string(); };
  return parse_choice<LogFormat>(text, {{"csv", {Contents::text, csv_header, append_csv}},
                                        {"jsonl", {Contents::text, no_header, append_jsonl}},
                                        {"npy", {Contents::bytes, npy_header, append_npy}}});
}

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
  const auto parse_limit = [](const std::string& text) { return parse_whole_number(text, 1); };
  if (const auto limit = options.value("--limit", parse_limit)) {
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
  if (format.contents == Contents::bytes) refuse_terminal(options);
  scene_options.check_output();
  const Scene scene = scene_options.scene();
  const auto log = make_log(scene.system, options);
  const Rows rows = select_rows(options, *log);
  const std::string header = format.header(rows);
  const StopOnSignals signals;
  OutputFile file(output_of(options), format.contents);
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
