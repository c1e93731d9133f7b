#include <piblocks/compare.hpp>

#include <array>
#include <memory>
#include <vector>

#include "cli/command.hpp"
#include "cli/options.hpp"
#include "cli/stop_on_signals.hpp"
#include "cli/text_output.hpp"
#include "core/overwrite_check.hpp"
#include "golden/frame_source.hpp"
#include "golden/reports.hpp"

namespace piblocks::cli {
namespace {

constexpr int kMaxLines = 20;

/// By Verdict.
constexpr std::array kVerdicts = {"equal", "equal within tolerance", "different", "not comparable"};

Rational parse_delta(const std::string& text) {
  Rational delta = parse_rational(text);
  if (delta < 0 || delta > 255) throw UsageError("must be a number from 0 to 255");
  return delta;
}

std::int64_t parse_pixels(const std::string& text) {
  return parse_whole_number(text, 0, Integer(kMaxFrame_px)).get_si();
}

/// "16:40", at most 40 pixels in any square of 16x16.
Window parse_window(const std::string& text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos) throw UsageError("must be N:K, such as 16:40");
  return {parse_int(text.substr(0, colon), 1, kMaxSide_px), parse_pixels(text.substr(colon + 1))};
}

/// "640x80+100+20", from the left and the top.
PixelRect parse_mask(const std::string& text) {
  const std::size_t x = text.find('x');
  const std::size_t left = text.find('+');
  const std::size_t top = text.find('+', left + 1);
  if (x == std::string::npos || left == std::string::npos || top == std::string::npos || x > left) {
    throw UsageError("must be WxH+X+Y, such as 640x80+100+20");
  }
  const auto number = [&](std::size_t begin, std::size_t end, int low) {
    return parse_int(text.substr(begin, end - begin), low, kMaxSide_px);
  };
  return {number(left + 1, top, 0), number(top + 1, std::string::npos, 0), number(0, x, 1),
          number(x + 1, left, 1)};
}

Tolerance tolerance_of(const Command& options) {
  Tolerance tolerance;
  tolerance.max_delta = options.value("--max-delta", parse_delta).value_or(0);
  tolerance.hard_delta = options.value("--hard-delta", parse_delta).value_or(255);
  tolerance.window = options.value("--max-window", parse_window);
  // A bound on any window replaces the default bound on the whole frame.
  const std::int64_t otherwise = tolerance.window ? kMaxFrame_px : 0;
  tolerance.max_pixels = options.value("--max-pixels", parse_pixels).value_or(otherwise);
  return tolerance;
}

ComparisonJob job_of(const Command& options) {
  ComparisonJob job{*options.text("REFERENCE"), *options.text("ACTUAL"), tolerance_of(options), {}};
  for (const std::string& mask : options.texts("--mask")) {
    try {
      job.masks.push_back(parse_mask(mask));
    } catch (const UsageError& error) {
      throw UsageError(fmt::format("--mask {}: {}", mask, error.what()));
    }
  }
  return job;
}

std::vector<std::unique_ptr<Report>> reports_of(const Command& options) {
  std::vector<std::unique_ptr<Report>> reports;
  if (const auto name = options.text("--diff")) reports.push_back(diff_folder(*name));
  if (const auto name = options.text("--report")) reports.push_back(html_report(*name));
  if (const auto name = options.text("--junit")) reports.push_back(junit_report(*name));
  return reports;
}

/// Prints a line for every frame that differs, and what all of it comes to.
class Printer {
 public:
  explicit Printer(bool quiet) : quiet_(quiet) {}

  void add(const FrameComparison& frame) {
    if (quiet_ || frame.is_equal() || ++lines_ > kMaxLines) return;
    out_.format_line("{}: {}", frame.name, difference_text(frame));
    out_.flush();
  }

  void finish(const ComparisonResult& result) {
    if (!quiet_) print(result);
    out_.finish();
  }

 private:
  void print(const ComparisonResult& result) {
    if (lines_ > kMaxLines) out_.format_line("… and {} more", lines_ - kMaxLines);
    if (!result.mismatch.empty()) out_.format_line("mismatch: {}", result.mismatch);
    const std::string beyond = result.different_frames == result.refused_frames
                                   ? ""
                                   : fmt::format(", {} beyond tolerance", result.refused_frames);
    out_.format_line("{}: {} of {} frames differ{}",
                     kVerdicts.at(static_cast<std::size_t>(result.verdict)),
                     result.different_frames, result.frames, beyond);
  }

  bool quiet_;
  int lines_ = 0;
  TextOutput out_{"-"};
};

/// @throws UsageError if a report would replace what is compared.
void check_reports(const Command& options, const ComparisonJob& job) {
  OverwriteCheck check;
  claim_frames(check, "the reference", job.reference);
  claim_frames(check, "the actual pictures", job.actual);
  if (const auto name = options.text("--diff")) claim_diff_folder(check, *name);
  if (const auto name = options.text("--report")) check.writes("--report", *name);
  if (const auto name = options.text("--junit")) check.writes("--junit", *name);
  if (!options.is_given("--quiet")) check.writes_standard_output();
  check.check();
}

/// Runs `work`; gives its failures this exit code.
template <typename Work>
auto with_exit_code(int code, const Work& work) {
  try {
    return work();
  } catch (const IoError& error) {
    throw ExitError(code, error.what());
  } catch (const MediaError& error) {
    throw ExitError(code, error.what());
  }
}

ComparisonResult run_comparison(const Command& options, const ComparisonJob& job) {
  const StopOnSignals signals;
  const auto reports = reports_of(options);
  Printer printer(options.is_given("--quiet"));
  const auto on_frame = [&](const FrameComparison& frame) {
    with_exit_code(kFailed, [&] {
      printer.add(frame);
      for (const auto& report : reports) report->add(frame);
    });
  };
  ComparisonResult result =
      with_exit_code(kUnreadable, [&] { return compare_files(job, on_frame, signals.token()); });
  for (const auto& report : reports) report->finish(job, result);
  printer.finish(result);
  return result;
}

void run_compare(const Command& options) {
  const ComparisonJob job = job_of(options);
  if (!frames_exist(job.reference)) {
    throw ExitError(kMissingReference,
                    fmt::format("compare: there is no reference '{}'", job.reference));
  }
  check_reports(options, job);
  const Verdict verdict = run_comparison(options, job).verdict;
  if (verdict == Verdict::different) throw ExitError(kDifferent);
  if (verdict == Verdict::mismatch) throw ExitError(kMismatch);
}

}  // namespace

void add_compare(Command& app) {
  Command command = app.add_command("compare", "Compare pictures, sequences or videos");
  command.add_argument("REFERENCE",
                       "What is expected: a PNG file, a folder of them, FRAMES/%06d.png,\n"
                       "a video, or hashes (*.framehash)");
  command.add_argument("ACTUAL",
                       "What is to be judged: the same; a video may be compared with pictures");
  command.add_value("--max-delta", "D",
                    "Accept samples that differ by up to D, where 255 is the full\n"
                    "range at any depth: 0.25 is one level of 10 bits");
  command.add_value("--max-pixels", "N", "Accept up to N pixels of a frame that differ by more");
  command.add_value("--hard-delta", "D", "Accept no sample at all that differs by more than D");
  command.add_value("--max-window", "N:K", "Accept up to K such pixels in any square of NxN");
  command.add_values("--mask", "WxH+X+Y", "Leave this rectangle out; may be given again");
  command.add_value("--diff", "DIR",
                    "Write expected, difference and actual, side by side, of each\n"
                    "frame that is not accepted (the first hundred)");
  command.add_value("--report", "FILE.html", "Write a page to look at the differences");
  command.add_value("--junit", "FILE.xml", "Write a list of tests, one a frame");
  command.add_flag("--quiet", "Print nothing but errors");
  command.set_footer(
      "Every sample has to be equal unless a tolerance is given; of several, all have to hold.\n"
      "Samples are compared as they are stored, alpha too, at up to 16 bits.\n"
      "Exit codes: 0 equal or accepted, 1 different, 2 wrong usage, 3 no reference, 4 sizes,\n"
      "numbers of frames or the way they are shown differ, 5 cannot be read.\n\n"
      "Examples:\n"
      "  piblocks compare expected.png actual.png --diff differences\n"
      "  piblocks compare golden/%06d.png frames/%06d.png --report report.html\n"
      "  piblocks compare pi.mp4 frames --max-delta 96");
  command.on_run([command] { run_compare(command); });
}

}  // namespace piblocks::cli
