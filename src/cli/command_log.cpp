#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <unistd.h>

#include <array>
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "cli/command.hpp"
#include "cli/log_rows.hpp"
#include "cli/options.hpp"
#include "cli/progress.hpp"
#include "cli/scene_options.hpp"
#include "cli/stop_on_signals.hpp"
#include "cli/text_output.hpp"
#include "core/output_file.hpp"
#include "core/stop.hpp"
#include "core/text.hpp"
#include "scene/run_log.hpp"
#include "scene/run_tables.hpp"

namespace piblocks::cli {
namespace {

constexpr std::array kFormats = {"csv", "jsonl", "npy"};

TableFormat parse_format(const std::string& text) {
  return parse_choice<TableFormat>(text, {{kFormats[0], TableFormat::csv},
                                          {kFormats[1], TableFormat::jsonl},
                                          {kFormats[2], TableFormat::npy}});
}

/// The format that the ending of a file names; nothing if it names none.
std::optional<std::string> format_by_ending(const std::string& file) {
  for (const char* format : kFormats) {
    if (has_ending(file, std::string(".") + format)) return format;
  }
  return std::nullopt;
}

/// The same, and CSV of a file without an ending. @throws UsageError for another ending.
std::string format_of_file(const std::string& file) {
  if (std::filesystem::path(file).extension().empty()) return kFormats[0];
  if (auto format = format_by_ending(file)) return *format;
  throw UsageError(fmt::format(
      "log: '{}' has no known ending; use .csv, .jsonl or .npy, or say the format by --format",
      file));
}

/// What --format says, or the ending of the file.
/// @throws UsageError if they disagree.
std::string format_name(const Command& options) {
  const std::string file = output_of(options);
  const auto named = options.value("--format", [](const std::string& text) {
    parse_format(text);
    return text;
  });
  if (!named) return format_of_file(file);
  const std::optional<std::string> ending = format_by_ending(file);
  if (!ending || *ending == *named) return *named;
  throw UsageError(
      fmt::format("--format {}: '{}' is a name of {}; leave out --format, or use another name",
                  *named, file, *ending));
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

void run_log(const Command& options, const SceneOptions& scene_options) {
  scene_options.check_output();
  const Scene scene = scene_options.scene();
  const TableFormat format = parse_format(format_name(options));
  const bool is_text = format != TableFormat::npy;
  if (!is_text) refuse_terminal(options);
  const std::unique_ptr<Log> log = make_log(scene, options);
  const Rows rows = select_rows(options, *log);
  require_certain(scene, *log, rows.until);
  const Table table = collision_table(scene.system);
  const std::string header = table.header(format, rows.first, rows.count());
  const StopOnSignals signals;
  OutputFile file(output_of(options),
                  is_text ? OutputFile::Contents::text : OutputFile::Contents::bytes);
  file.write(header);
  {
    RowProgress progress(output_of(options), rows);
    fmt::memory_buffer bytes;
    read_collisions(*log, rows.first, rows.last, [&](const TableRows& some) {
      check_stop(signals.token());
      bytes.clear();
      table.append(format, some, bytes);
      file.write(std::string_view(bytes.data(), bytes.size()));
      progress.add(std::int64_t(some.size));
    });
  }
  file.finish();
  if (const auto collapse = log->collapse(rows.until)) {
    say("piblocks: note: {}\n", endless_note(scene.system, *collapse));
  }
  note_convention(scene);
  note_ties(*log, rows.last);
}

}  // namespace

void define_log(Command& command) {
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
