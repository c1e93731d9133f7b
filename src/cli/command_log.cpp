#include <fmt/compile.h>
#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

#include "cli/body_output.hpp"
#include "cli/command.hpp"
#include "cli/log_rows.hpp"
#include "cli/options.hpp"
#include "cli/progress.hpp"
#include "cli/scene_options.hpp"
#include "cli/state_text.hpp"
#include "cli/stop_on_signals.hpp"
#include "cli/text_output.hpp"
#include "core/output_file.hpp"
#include "core/stop.hpp"
#include "core/text.hpp"
#include "scene/run_log.hpp"

namespace piblocks::cli {
namespace {

using Contents = OutputFile::Contents;

/// How a log is written.
struct LogFormat {
  Contents contents;
  std::string (*header)(const Rows& rows);  ///< bytes before the rows
  void (*append)(const CollisionBatch& batch, fmt::memory_buffer& out);
};

std::string header_of_npy(const Rows& rows) { return npy_header(kRowType, rows); }

void append_npy(const CollisionBatch& batch, fmt::memory_buffer& out) {
  const std::size_t begin = out.size();
  out.resize(begin + batch.size * kRow_bytes);
  write_rows(batch, batch.first.get_si(), out.data() + begin);
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
  const auto csv_header = [](const Rows&) {
    return std::string("index,time,kind,x_blue,x_red,v_blue,v_red\n");
  };
  const auto no_header = [](const Rows&) { return std::string(); };
  return parse_choice<LogFormat>(text, {{"csv", {Contents::text, csv_header, append_csv}},
                                        {"jsonl", {Contents::text, no_header, append_jsonl}},
                                        {"npy", {Contents::bytes, header_of_npy, append_npy}}});
}

/// The format that the ending of a file names; CSV of a file without an ending.
/// @throws UsageError for another ending.
std::string format_of_file(const std::string& file) {
  const std::string ending = std::filesystem::path(file).extension();
  if (ending.empty()) return "csv";
  for (const char* format : {"csv", "jsonl", "npy"}) {
    if (has_ending(ending, std::string(".") + format)) return format;
  }
  throw UsageError(fmt::format(
      "log: '{}' has no known ending; use .csv, .jsonl or .npy, or say the format by --format",
      file));
}

/// What --format says, or the ending of the file.
/// @throws UsageError if they disagree.
std::string format_name(const Command& options) {
  const std::string file = output_of(options);
  const auto named = options.value("--format", [](const std::string& text) {
    parse_log_format(text);
    return text;
  });
  if (!named) return format_of_file(file);
  for (const char* other : {"csv", "jsonl", "npy"}) {
    if (*named == other || !has_ending(file, std::string(".") + other)) continue;
    throw UsageError(
        fmt::format("--format {}: '{}' is a name of {}; leave out --format, or use "
                    "another name",
                    *named, file, other));
  }
  return *named;
}

/// Shows how many rows have been written, if that takes more than a second and the rows themselves
/// do not go to the terminal.
class RowProgress {
 public:
  RowProgress(const std::string& output, const Rows& rows)
      : report_(output, output == "-" && isatty(STDOUT_FILENO) == 1,
                {.unit = "rows", .delay = std::chrono::seconds(1)}),
        count_(rows.count().fits_slong_p() ? rows.count().get_si() : 0) {}

  void add(std::int64_t rows) {
    done_ += rows;
    if (count_ > 0) report_.update({done_, count_});
  }

 private:
  ProgressReport report_;
  std::int64_t count_;  // 0 if there are more than can be written
  std::int64_t done_ = 0;
};

/// @throws Interrupted soon after the token asks for it.
void write(CollisionStream& collisions, const LogFormat& format, OutputFile& file,
           RowProgress& progress, const std::stop_token& stop) {
  fmt::memory_buffer rows;
  for (CollisionBatch batch{}; collisions.read(batch); rows.clear()) {
    check_stop(stop);
    format.append(batch, rows);
    file.write(std::string_view(rows.data(), rows.size()));
    progress.add(std::int64_t(batch.size));
  }
}

void log_bodies(const Scene& scene, const Command& options) {
  if (options.is_given("--engine")) require_blocks(scene, "--engine");
  const BodyLogFormat format = parse_body_log_format(format_name(options));
  if (format.is_binary) refuse_terminal(options);
  const Scene logged = scene_for_log(scene, options);
  const std::unique_ptr<Log> log = log_of(logged);
  const Rows rows = select_rows(options, *log);
  require_certain(logged, *log, rows.until);
  const StopOnSignals signals;
  OutputFile file(output_of(options), format.is_binary ? Contents::bytes : Contents::text);
  file.write(format.header(log->system(), rows));
  RowProgress progress(output_of(options), rows);
  std::int64_t pending = 0;
  fmt::memory_buffer text;
  constexpr std::size_t kPiece_bytes = 1 << 16;
  for (Integer index = rows.first; index <= rows.last; ++index) {
    format.append(log->system(), log->collision(index), text);
    ++pending;
    if (text.size() < kPiece_bytes && index != rows.last) continue;
    progress.add(std::exchange(pending, 0));
    check_stop(signals.token());
    file.write(std::string_view(text.data(), text.size()));
    text.clear();
  }
  file.finish();
  note_ties(*log, rows.last);
}

void run_log(const Command& options, const SceneOptions& scene_options) {
  scene_options.check_output();
  const Scene scene = scene_options.scene();
  if (!has_short_names(scene.system)) return log_bodies(scene, options);
  const LogFormat format = parse_log_format(format_name(options));
  if (format.contents == Contents::bytes) refuse_terminal(options);
  const auto log = make_log(scene.system, options);
  const Rows rows = select_rows(options, *log);
  const std::string header = format.header(rows);
  const StopOnSignals signals;
  OutputFile file(output_of(options), format.contents);
  file.write(header);
  {
    RowProgress progress(output_of(options), rows);
    write(*log->stream(rows.first, rows.last), format, file, progress, signals.token());
  }
  file.finish();
  if (const auto note = endless_note(scene)) say("piblocks: note: {}\n", *note);
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
  command.add_value("--format", "NAME",
                    "csv, jsonl, or npy, which numpy.load() reads (default: by the\n"
                    "ending of FILE; csv without one)");
  command.add_value("-o,--output", "FILE",
                    "NAME.csv, NAME.jsonl, NAME.npy, or - (standard output, the\ndefault)");
  command.set_footer(
      "Examples:\n"
      "  piblocks log --from 3 --to 4 --format jsonl\n"
      "  piblocks log --digits 7 -o log.npy\n"
      "  piblocks log --digits 20 --first 15707963267948966190 --limit 5 -o turn.csv");
  command.on_run([=] { run_log(command, scene); });
}

}  // namespace piblocks::cli
