#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/instant.hpp>
#include <piblocks/two_blocks.hpp>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/command.hpp"
#include "cli/progress.hpp"
#include "cli/scene_options.hpp"
#include "cli/script_facts.hpp"
#include "cli/stop_on_signals.hpp"
#include "cli/text_output.hpp"
#include "core/output_file.hpp"
#include "core/stop.hpp"
#include "core/text.hpp"
#include "draw/number_text.hpp"
#include "scene/run_log.hpp"
#include "scene/run_tables.hpp"

namespace piblocks::cli {
namespace {

/// All collisions, or those until --to; of two blocks and a wall all are counted without a log.
void run_count(const Command& options, const SceneOptions& scene_options) {
  TextOutput out;
  const Scene scene = scene_options.scene();
  const std::optional<Instant> to = options.value("--to", parse_instant);
  std::unique_ptr<Log> log;
  std::optional<Rational> until;
  Integer count;
  if (to || !two_blocks_of(scene.system)) {
    log = log_of(scene);
    until = to ? std::optional(time_of(*to, *log)) : log->horizon();
    count = until ? log->count_at(*until) : log->last();
  }
  if (log) {
    require_finite_count(*log, until);
    require_certain(scene, *log, until);
  } else {
    count = count_collisions(scene.system);
  }
  out.line(count.get_str(scene.show.base));
  out.finish();
  if (log) note_ties(*log, count);
  if (log && log->never_ends() && !to) {
    say("piblocks: note: collisions may go on for ever; these are the ones until time.to = {}\n",
        exact_text(scene.time.to));
  }
  note_convention(scene);
}

void run_state(const Command& options, const SceneOptions& scene_options) {
  const std::vector<Instant> instants = *options.value("--at", parse_instants);
  const Scene scene = scene_options.scene();
  const bool has_bounds = options.is_given("--bounds");
  const Table states = state_table(scene.system, has_bounds);
  const std::unique_ptr<Log> log = make_log(scene, options);
  TextOutput out;
  Integer last = 0;
  for (const Instant& instant : instants) {
    const Rational time = time_of(instant, *log);
    require_certain(scene, *log, time);
    const StateRow state = state_row(*log, time, has_bounds);
    last = std::max(last, state.count);
    out.line(state_text(states, state));
  }
  out.finish();
  note_ties(*log, last);
  note_convention(scene);
}

/// What --format says, or the ending of the file; CSV of a file without an ending.
/// @throws UsageError if they disagree, or for another ending.
TableFormat format_of(const Command& options) {
  const std::vector<std::pair<std::string, TableFormat>> formats = {
      {"csv", TableFormat::csv}, {"jsonl", TableFormat::jsonl}, {"npy", TableFormat::npy}};
  const std::string file = output_of(options);
  const auto ending = std::ranges::find_if(
      formats, [&](const auto& format) { return has_ending(file, '.' + format.first); });
  const auto named = options.value(
      "--format", [&](const std::string& text) { return parse_choice(text, formats); });
  if (named) {
    if (ending == formats.end() || ending->second == *named) return *named;
    throw UsageError(
        fmt::format("--format {}: '{}' is a name of {}; leave out --format, or use another name",
                    *options.text("--format"), file, ending->first));
  }
  if (std::filesystem::path(file).extension().empty()) return TableFormat::csv;
  if (ending != formats.end()) return ending->second;
  throw UsageError(fmt::format(
      "log: '{}' has no known ending; use .csv, .jsonl or .npy, or say the format by --format",
      file));
}

void run_log(const Command& options, const SceneOptions& scene_options) {
  scene_options.check_output();
  const Scene scene = scene_options.scene();
  const TableFormat format = format_of(options);
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
    // Rows on the terminal show the progress themselves.
    const bool is_quiet = output_of(options) == "-" && isatty(STDOUT_FILENO) == 1;
    ProgressReport report(output_of(options), is_quiet,
                          {.unit = "rows", .delay = std::chrono::seconds(1)});
    std::int64_t done = 0;
    fmt::memory_buffer bytes;
    read_collisions(*log, rows.first, rows.last, [&](const TableRows& some) {
      check_stop(signals.token());
      bytes.clear();
      table.append(format, some, bytes);
      file.write(std::string_view(bytes.data(), bytes.size()));
      done += std::int64_t(some.size);
      const Integer count = rows.count();
      if (count.fits_slong_p()) report.update({done, count.get_si()});
    });
  }
  file.finish();
  if (const auto collapse = log->collapse(rows.until)) {
    say("piblocks: note: {}\n", endless_note(scene.system, *collapse));
  }
  note_convention(scene);
  note_ties(*log, rows.last);
}

/// Significant digits of what is lost.
constexpr int kLossDigits = 12;

/// As "{:g}" writes it, also if no double is so small.
std::string loss_text(const Rational& loss) {
  const auto [mantissa, exponent] = written_with(kLossDigits - 1, magnitude_of(loss));
  constexpr long kLeastPlainExponent = -4;
  if (exponent >= kLeastPlainExponent) return fmt::format("{:.{}g}", to_double(loss), kLossDigits);
  return fmt::format("{:.{}g}e-{:02}", mantissa, kLossDigits, -exponent);
}

Integer count_with(const Rational& restitution, int digits, int base) {
  System system = article_system(digits, base);
  system.restitution = system.wall_restitution = restitution;
  return count_collisions(system);
}

/// Decimal places that tell a restitution that is enough from one that is not.
int places_of(const LeastRestitution& need) {
  constexpr int kPlaces = 20;  // where any loss is too much
  const Rational loss = 1 - need.above;
  return loss == 0 ? kPlaces : static_cast<int>(kLossDigits - 1 - magnitude_of(loss).exponent);
}

void print_min_restitution(int digits, int base, TextOutput& out) {
  const LeastRestitution need = least_restitution(digits, base);
  const int places = places_of(need);
  const Rational unit = power_of_ten(-places);
  // Rounded up: the decimal itself is enough, and the one before it is not.
  const Rational enough = 1 - floor(Rational((1 - need.above) / unit)) * unit;
  const Rational too_little = enough - unit;
  const auto text = [&](const Rational& restitution) {
    return restitution == 1 ? "1" : fixed_text(restitution, places);
  };
  const auto count = [&](const Rational& restitution) {
    return count_with(restitution, digits, base).get_str(base);
  };
  const std::string in_base = base == kUsualBase ? "" : fmt::format(" (counts in base {})", base);
  out.format_line("Elastic blocks collide {} times{}.", need.count_above.get_str(base), in_base);
  if (enough == 1) {
    out.line("Only restitution 1 gives this count: any loss adds a collision.");
  } else {
    out.format_line("They collide as often with restitution {} or more, of blocks and wall,",
                    text(enough));
    out.format_line("which is 1 - {}.", loss_text(1 - enough));
  }
  out.format_line("Exact counts prove it: {} collisions with {}, {} with {}.", count(too_little),
                  text(too_little), count(enough), text(enough));
  out.line("Blocks that lose energy stay closer together, so they meet more often, not less.");
}

}  // namespace

void define_count(Command& command) {
  SceneOptions options(command);
  command.add_value("--to", "T",
                    "Count collisions until then (default: all; needed where they\nnever end)");
  command.set_footer(
      "Examples:\n"
      "  piblocks count --digits 12\n"
      "  piblocks count --digits 12 --base 2\n"
      "  piblocks count --mass-ratio 1/3");
  command.on_run([=] { run_count(command, options); });
}

void define_state(Command& command) {
  const SceneOptions scene(command);
  command.add_required_value("--at", "T[,T...]", "Instants: 3.5, turn-0.3, last+1, '#314'");
  command.add_flag("--bounds",
                   "Add position_bound: how far a position may be from the truth at most");
  add_engine(command);
  command.set_footer(
      "Examples:\n"
      "  piblocks state --at 0,3.5,last\n"
      "  piblocks state --digits 20 --at '#15707963267948966192' --bounds");
  command.on_run([=] { run_state(command, scene); });
}

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

void define_min_restitution(Command& command) {
  command.add_required_value("--digits", "D", "Of the article's scene with D digits, 1 to 1000");
  command.add_value("--base", "B", "In this base, 2 to 36 (default 10)");
  command.set_footer(
      "Examples:\n"
      "  piblocks min-restitution --digits 3\n"
      "  piblocks min-restitution --digits 15");
  command.on_run([command] {
    constexpr int kMostDigits = 1000;
    TextOutput out;
    print_min_restitution(*command.whole("--digits", 1, kMostDigits),
                          command.whole("--base", kMinBase, kMaxBase).value_or(kUsualBase), out);
    out.finish();
  });
}

}  // namespace piblocks::cli
