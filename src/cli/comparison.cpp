#include "cli/comparison.hpp"

#include <fmt/format.h>

#include <exception>
#include <memory>
#include <vector>

#include "cli/exit_code.hpp"
#include "cli/stop_on_signals.hpp"
#include "cli/text_output.hpp"
#include "cli/tolerance_options.hpp"
#include "core/overwrite_check.hpp"
#include "golden/difference.hpp"
#include "golden/picture_list.hpp"
#include "golden/reports.hpp"
#include "golden/shown_frames.hpp"

namespace piblocks::cli {
namespace {

ReportForm form_of_report(const Command& options) {
  return options.is_given("--report-in-one-file") ? ReportForm::one_file : ReportForm::with_folder;
}

/// The reports that were asked for. A report that fails does not stop the others.
class Reports {
 public:
  explicit Reports(const Command& options) {
    if (const auto name = options.text("--diff")) reports_.push_back(diff_folder(*name));
    if (const auto name = options.text("--report")) {
      reports_.push_back(html_report(*name, form_of_report(options)));
    }
    if (const auto name = options.text("--junit")) reports_.push_back(junit_report(*name));
    if (const auto name = options.text("--json")) reports_.push_back(json_report(*name));
  }

  void add(const FrameComparison& frame) {
    for (auto& report : reports_) attempt(report, [&] { report->add(frame); });
  }
  void finish(const ComparisonJob& job, const ComparisonResult& result) {
    for (auto& report : reports_) attempt(report, [&] { report->finish(job, result); });
  }
  /// @throws the error of the first report that failed. A failed write is only printed if the
  ///         comparison already ends with a more severe exit code.
  void check(int exit_code) const {
    try {
      if (failure_) std::rethrow_exception(failure_);
    } catch (const IoError& error) {
      if (exit_code <= kFailed) throw;
      say("piblocks: {}\n", error.what());
    }
  }

 private:
  template <typename Work>
  void attempt(std::unique_ptr<Report>& report, const Work& work) {
    if (!report) return;
    try {
      work();
    } catch (const Error&) {
      if (!failure_) failure_ = std::current_exception();
      report.reset();
    }
  }

  std::vector<std::unique_ptr<Report>> reports_;  // null where one has failed
  std::exception_ptr failure_;
};

/// Prints a line for every frame that is shown, and a summary. What cannot be read is an error, and
/// goes to standard error.
class Printer {
 public:
  explicit Printer(bool quiet) : quiet_(quiet) {}

  void add(const FrameComparison& frame) { shown_.add(frame); }

  void finish(const ComparisonJob& job, const ComparisonResult& result,
              const std::vector<std::string>& notes) {
    shown_.for_each([this](Outcome outcome, const std::string& line) {
      if (outcome == Outcome::unreadable) {
        say("piblocks: {}\n", line);
      } else if (!quiet_) {
        out_.line(line);
      }
    });
    if (!quiet_) {
      if (const std::string rest = shown_.rest(); !rest.empty()) out_.line(rest);
      out_.line(printable(summary_text(job, result)));
      for (const std::string& note : notes) out_.line(printable(note));
    }
    out_.finish();
  }

 private:
  bool quiet_;
  ShownLines shown_;
  TextOutput out_;
};

/// @throws UsageError if a report would replace what is compared.
void check_reports(const Command& options, const ComparisonJob& job) {
  OverwriteCheck check;
  claim_pictures(check, "the reference", job.reference, job.is_recursive);
  claim_pictures(check, "the actual pictures", job.actual, job.is_recursive);
  if (const auto name = options.text("--diff"))
    claim_diff_folder(check, "--diff", *name, DiffPictures::Making::at_once);
  for (const char* const option : {"--report", "--junit", "--json"}) {
    const auto name = options.text(option);
    if (name == "-") {
      throw UsageError(fmt::format(
          "{} -: standard output has the lines of the comparison; name a file", option));
    }
    if (name) check.writes(option, *name);
  }
  const auto page = options.text("--report");
  if (form_of_report(options) == ReportForm::with_folder && page) {
    claim_diff_folder(check, "--report", folder_of_report(*page),
                      DiffPictures::Making::when_needed);
  } else if (!page && options.is_given("--report-in-one-file")) {
    throw UsageError("--report-in-one-file needs --report FILE.html");
  }
  if (!options.is_given("--quiet")) check.writes_standard_output();
  check.check();
}

void run_compare(const Command& options) {
  ComparisonJob job{*options.text("REFERENCE"), *options.text("ACTUAL")};
  job.is_recursive = !options.is_given("--no-recursive");
  read_tolerance(options, job);
  run_comparison(options, job);
}

}  // namespace

void define_tolerance(Command& command) {
  command.add_value("--max-delta", "D",
                    "Accept samples that differ by up to D, where 255 is the full\n"
                    "range at any depth: 0.25 is one level of 10 bits");
  command.add_value("--threshold", "T",
                    "Instead of --max-delta: accept pixels that look alike, and smoothed\n"
                    "edges. T is from 0 (equal) to 1; odiff and pixelmatch 7 take 0.1");
  command.add_flag("--count-antialiasing", "With --threshold, do not accept smoothed edges");
  command.add_flag("--ignore-transparent",
                   "Accept any colour of pixels that are fully transparent");
  command.add_value("--max-pixels", "N",
                    "Accept up to N pixels of a frame that differ by more, or N%");
  command.add_value("--hard-delta", "D", "Reject a frame if any sample differs by more than D");
  command.add_value("--max-window", "N:K",
                    "Accept up to K pixels that differ by more than --max-delta or\n"
                    "--threshold in any square of NxN");
  command.add_values("--mask", "MASK",
                     "Leave out a part: WxH+X+Y, or what is not black in a PNG file; of\n"
                     "some pictures by NAME:MASK. May be given again, but something must\n"
                     "be left of every picture");
}

void define_reports(Command& command) {
  command.add_value("--diff", "DIR",
                    "Write NAME-expected.png, NAME-actual.png and NAME-diff.png of\n"
                    "frames that are different, at most 40");
  command.add_value("--report", "FILE.html",
                    "Write a page to look at the differences, with its pictures in\n"
                    "the folder FILE-files");
  command.add_flag("--report-in-one-file", "Keep the pictures in the page itself");
  command.add_value("--junit", "FILE.xml", "Write a list of tests, one a row");
  command.add_value("--json", "FILE.json", "Write numbers and changed places of every row");
  command.add_flag("--quiet", "Print only what cannot be read, and other errors");
}

/// Writes the reports before it prints anything, since printing may fail.
void run_comparison(const Command& options, const ComparisonJob& job, const MakeNotes& make_notes) {
  check_reports(options, job);
  const StopOnSignals signals;
  Reports reports(options);
  Printer printer(options.is_given("--quiet"));
  const ComparisonResult result = compare_files(
      job,
      [&](const FrameComparison& frame) {
        reports.add(frame);
        printer.add(frame);
      },
      signals.token());
  reports.finish(job, result);
  printer.finish(job, result, make_notes ? make_notes(result) : std::vector<std::string>());
  const int code = exit_code_of(result);
  reports.check(code);
  if (code != 0) {
    // Set only if a side has no frame, or if no picture has a partner.
    throw ExitError(code, result.problem.empty() ? "" : "compare: " + result.problem);
  }
}

void define_compare(Command& command) {
  command.add_argument("REFERENCE",
                       "What is expected: a PNG file, a folder of them, FRAMES/%06d.png,\n"
                       "a video, or hashes (*.framehash)");
  command.add_argument("ACTUAL",
                       "What is to be judged: the same; a video may be compared with pictures");
  define_tolerance(command);
  command.add_flag("--no-recursive", "Leave out the folders in a folder");
  define_reports(command);
  command.set_footer(
      "Pictures are paired by name: those of folders by their paths in these, those of a pattern\n"
      "by their numbers. Beside a video they are paired by their order.\n"
      "Every sample has to be equal unless a tolerance is given; of several, all have to hold.\n"
      "Samples are compared as they are stored, alpha too, at up to 16 bits.\n"
      "The comparison goes on after whatever it finds, and reports are written. The first line "
      "that\n"
      "holds is the exit code:\n"
      "  2  wrong usage\n"
      "  5  something cannot be read, or all of ACTUAL is missing\n"
      "  3  all of REFERENCE is missing\n"
      "  4  a picture is missing, new, of another size, or shown another way\n"
      "  1  a picture is different, or a report could not be written\n"
      "  0  all is equal or accepted\n\n"
      "Examples:\n"
      "  piblocks compare expected.png actual.png --diff differences\n"
      "  piblocks compare golden/%06d.png frames/%06d.png --report report.html\n"
      "  piblocks compare pi.mp4 frames --max-delta 96");
  command.on_run([command] { run_compare(command); });
}

}  // namespace piblocks::cli
