#include <piblocks/compare.hpp>

#include <exception>
#include <memory>
#include <vector>

#include "cli/command.hpp"
#include "cli/exit_code.hpp"
#include "cli/options.hpp"
#include "cli/stop_on_signals.hpp"
#include "cli/text_output.hpp"
#include "core/overwrite_check.hpp"
#include "core/text.hpp"
#include "golden/diff_pictures.hpp"
#include "golden/mask_picture.hpp"
#include "golden/picture_list.hpp"
#include "golden/reports.hpp"
#include "golden/shown_frames.hpp"
#include "media/png/png_reader.hpp"

namespace piblocks::cli {
namespace {

Rational parse_delta(const std::string& text) {
  Rational delta = parse_rational(text);
  if (delta < 0 || delta > 255) throw UsageError("must be a number from 0 to 255");
  return delta;
}

std::int64_t parse_pixels(const std::string& text) {
  return parse_whole_number(text, 0, Integer(kMaxFrame_px)).get_si();
}

/// "0.1%", of the pixels of a frame.
Rational parse_share(const std::string& text) {
  const Rational share = parse_rational(text.substr(0, text.size() - 1)) / 100;
  if (share < 0 || share > 1) throw UsageError("must be a number of pixels, or from 0% to 100%");
  return share;
}

double parse_threshold(const std::string& text) {
  const Rational threshold = parse_rational(text);
  if (threshold < 0 || threshold > 1) throw UsageError("must be a number from 0 to 1");
  return to_double(threshold);
}

/// "16:40", at most 40 pixels in any square of 16x16.
Window parse_window(const std::string& text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos) throw UsageError("must be N:K, such as 16:40");
  return {parse_int(text.substr(0, colon), 1, kMaxSide_px), parse_pixels(text.substr(colon + 1))};
}

/// "640x80+100+20", from the left and the top.
PixelRect parse_rect(const std::string& text) {
  const std::size_t x = text.find('x');
  const std::size_t left = text.find('+');
  const std::size_t top = text.find('+', left + 1);
  if (x == std::string::npos || left == std::string::npos || top == std::string::npos || x > left) {
    throw UsageError(
        "must be WxH+X+Y, such as 640x80+100+20, or a PNG file, or one of these behind NAME:");
  }
  const auto number = [&](std::size_t begin, std::size_t end, int low) {
    return parse_int(text.substr(begin, end - begin), low, kMaxSide_px);
  };
  return {number(left + 1, top, 0), number(top + 1, std::string::npos, 0), number(0, x, 1),
          number(x + 1, left, 1)};
}

/// A rectangle or a picture, perhaps behind the name of the pictures that it is for.
Mask parse_mask(const std::string& text) {
  Mask mask{.text = text};
  const std::size_t colon = text.rfind(':');
  const bool is_named = colon != std::string::npos;
  if (is_named) mask.picture = text.substr(0, colon);
  const std::string place = is_named ? text.substr(colon + 1) : text;
  if (is_named && mask.picture.empty()) throw UsageError("there is no name in front of the colon");
  if (!has_ending(place, ".png")) {
    mask.rects = {parse_rect(place)};
    return mask;
  }
  try {
    const Image picture = read_png(place);
    mask.rects = rects_of_mask(picture);
    mask.whole = PixelRect{0, 0, picture.width_px, picture.height_px};
  } catch (const Error& error) {
    throw UsageError(error.what());
  }
  if (mask.rects.empty()) throw UsageError("all of it is black or transparent: it hides nothing");
  return mask;
}

Tolerance tolerance_of(const Command& options) {
  Tolerance tolerance;
  tolerance.max_delta = options.value("--max-delta", parse_delta).value_or(0);
  tolerance.hard_delta = options.value("--hard-delta", parse_delta).value_or(255);
  tolerance.window = options.value("--max-window", parse_window);
  // A bound on any window replaces the default bound on the whole frame.
  tolerance.max_pixels = tolerance.window ? kMaxFrame_px : 0;
  if (const auto most = options.text("--max-pixels"); most && most->ends_with('%')) {
    tolerance.max_share = options.value("--max-pixels", parse_share);
    tolerance.max_pixels = kMaxFrame_px;
  } else if (most) {
    tolerance.max_pixels = *options.value("--max-pixels", parse_pixels);
  }
  tolerance.threshold = options.value("--threshold", parse_threshold);
  tolerance.counts_smoothing = options.is_given("--count-antialiasing");
  tolerance.ignores_transparent = options.is_given("--ignore-transparent");
  if (tolerance.threshold && options.is_given("--max-delta")) {
    throw UsageError("--threshold and --max-delta: use one of them");
  }
  if (tolerance.counts_smoothing && !tolerance.threshold) {
    throw UsageError("--count-antialiasing belongs to --threshold, which is not given");
  }
  return tolerance;
}

ComparisonJob job_of(const Command& options) {
  ComparisonJob job{*options.text("REFERENCE"), *options.text("ACTUAL"), tolerance_of(options)};
  job.is_recursive = !options.is_given("--no-recursive");
  for (const std::string& mask : options.texts("--mask")) {
    try {
      job.masks.push_back(parse_mask(mask));
    } catch (const UsageError& error) {
      throw UsageError(fmt::format("--mask {}: {}", mask, error.what()));
    }
  }
  return job;
}

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

  void add(const FrameComparison& frame) {
    if (frame.outcome == Outcome::equal) return;
    const bool takes = shown_.takes(frame.outcome);
    const bool is_left = shown_.add(frame.outcome, takes ? row_text(frame) : "").has_value();
    left_ += is_left ? 1 : 0;
  }

  void finish(const ComparisonJob& job, const ComparisonResult& result) {
    shown_.for_each([this](Outcome outcome, const std::string& line) {
      if (outcome == Outcome::unreadable) {
        say("piblocks: {}\n", line);
      } else if (!quiet_) {
        out_.line(printable(line));
      }
    });
    if (!quiet_) {
      if (left_ > 0) out_.format_line("… and {} more", left_);
      out_.line(printable(summary_text(job, result)));
    }
    out_.finish();
  }

 private:
  bool quiet_;
  ShownFrames<std::string> shown_;
  std::int64_t left_ = 0;
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
    throw UsageError("--report-in-one-file is about the page of --report; name that");
  }
  if (!options.is_given("--quiet")) check.writes_standard_output();
  check.check();
}

/// Writes the reports before it prints anything, since printing may fail.
void run_compare(const Command& options) {
  const ComparisonJob job = job_of(options);
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
  printer.finish(job, result);
  const int code = exit_code_of(result);
  reports.check(code);
  if (code != 0) {
    // Set only if a side has no frame, or if no picture has a partner.
    throw ExitError(code, result.problem.empty() ? "" : "compare: " + result.problem);
  }
}

}  // namespace

void define_compare(Command& command) {
  command.add_argument("REFERENCE",
                       "What is expected: a PNG file, a folder of them, FRAMES/%06d.png,\n"
                       "a video, or hashes (*.framehash)");
  command.add_argument("ACTUAL",
                       "What is to be judged: the same; a video may be compared with pictures");
  command.add_value("--max-delta", "D",
                    "Accept samples that differ by up to D, where 255 is the full\n"
                    "range at any depth: 0.25 is one level of 10 bits");
  command.add_value("--threshold", "T",
                    "Accept instead what looks alike, 0 to 1, as odiff and pixelmatch 7\n"
                    "do (they take 0.1), and pixels of smoothed edges");
  command.add_flag("--count-antialiasing", "With --threshold, do not accept smoothed edges");
  command.add_flag("--ignore-transparent",
                   "Accept any colour of pixels that are fully transparent");
  command.add_value("--max-pixels", "N",
                    "Accept up to N pixels of a frame that differ by more, or N%");
  command.add_value("--hard-delta", "D", "Accept no sample at all that differs by more than D");
  command.add_value("--max-window", "N:K", "Accept up to K such pixels in any square of NxN");
  command.add_values("--mask", "MASK",
                     "Leave out a part: WxH+X+Y, or what is not black in a PNG file; of\n"
                     "some pictures by NAME:MASK. May be given again, but something must\n"
                     "be left of every picture");
  command.add_flag("--no-recursive", "Leave out the folders in a folder");
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
