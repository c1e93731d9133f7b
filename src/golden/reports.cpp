#include "golden/reports.hpp"

#include <fmt/format.h>
#include <piblocks/encode.hpp>
#include <piblocks/error.hpp>

#include <algorithm>
#include <filesystem>
#include <set>
#include <string_view>
#include <system_error>

#include "core/output_file.hpp"
#include "core/text.hpp"
#include "golden/report_source.hpp"
#include "media/output/frame_pattern.hpp"
#include "media/png/png_mark.hpp"

namespace piblocks {
namespace fs = std::filesystem;
namespace {

constexpr int kMaxDiffPictures = 100;
constexpr const char* kPattern = "%06d.png";

class DiffFolder final : public Report {
 public:
  explicit DiffFolder(const std::string& folder)
      : folder_(folder), files_(folder_, "differences"), pattern_(kPattern) {}

  void add(const FrameComparison& frame) override;
  void finish(const ComparisonJob& job, const ComparisonResult& result) override;

 private:
  fs::path folder_;
  FileSet files_;
  FramePattern pattern_;
  std::set<std::string> names_;  // of the pictures
};

void DiffFolder::add(const FrameComparison& frame) {
  if (frame.is_accepted || !frame.difference || names_.size() == kMaxDiffPictures) return;
  const std::string name = pattern_.name(frame.number);
  const fs::path path = folder_ / name;
  std::error_code none;
  if (fs::exists(fs::symlink_status(path, none)) && !has_png_mark(path, PngMark::difference)) {
    throw UsageError(fmt::format("diff: '{}' is not from an earlier comparison; use another folder",
                                 path.string()));
  }
  const Image strip = difference_strip(frame.reference(), frame.deltas(), frame.actual(),
                                       frame.difference->densest);
  files_.add(name, with_png_mark(encode_png(strip.view()), PngMark::difference));
  names_.insert(name);
}

void DiffFolder::finish(const ComparisonJob& /*job*/, const ComparisonResult& /*result*/) {
  std::error_code error;
  for (const fs::path& path : entries_of(folder_, error)) {
    const std::string name = path.filename();
    const bool is_old = pattern_.number_of(name) && !names_.contains(name) &&
                        has_png_mark(path, PngMark::difference);
    if (is_old) files_.remove(name);
  }
  files_.commit();
}

constexpr int kMaxPictures = 40;

constexpr std::string_view kHead = R"(<!DOCTYPE html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width">
)";

constexpr std::string_view kControls = R"(<div class="controls">
<label>Show frames named <input id="filter" type="search" autocomplete="off"></label>
<label><input id="refused" type="checkbox" autocomplete="off"> only what is not accepted</label>
<label><input id="difference" type="checkbox" autocomplete="off"> differences in red</label>
</div>
)";

std::string picture(const Image& image, std::string_view kind) {
  return fmt::format(R"(<img class="{0}" alt="{0}" src="data:image/png;base64,{1}">)", kind,
                     base64(encode_png(image.view())));
}

/// The expected picture is left of the slider, the actual one right of it.
std::string pictures_of(const FrameComparison& frame) {
  const Image reference = frame.reference();
  const Image actual = frame.actual();
  return fmt::format(
      "<div class=\"frame\" style=\"--shape: {} / {}\">"
      "<div class=\"sides\"><span>expected</span><span>actual</span></div>"
      "<div class=\"pictures\">{}{}{}</div>"
      "<input type=\"range\" value=\"50\" autocomplete=\"off\" "
      "aria-label=\"expected on the left, actual on the right\"></div>\n",
      reference.width_px, reference.height_px, picture(reference, "expected"),
      picture(actual, "actual"),
      picture(difference_picture(reference, frame.deltas()), "difference"));
}

std::string summary_of(const ComparisonResult& result) {
  if (!result.mismatch.empty()) return "Not comparable: " + result.mismatch + ".";
  return fmt::format("{} of {} frames differ, {} beyond what is accepted.", result.different_frames,
                     result.frames, result.refused_frames);
}

class HtmlReport final : public Report {
 public:
  explicit HtmlReport(const std::string& path) : file_(path) {}

  void add(const FrameComparison& frame) override {
    if (frame.is_equal()) return;
    sections_ += fmt::format("<section class=\"{}\">\n<h2>{}</h2>\n<p>{}</p>\n",
                             frame.is_accepted ? "accepted" : "refused", escaped(frame.name),
                             escaped(difference_text(frame)));
    if (frame.difference && pictures_ < kMaxPictures) {
      ++pictures_;
      sections_ += pictures_of(frame);
    }
    sections_ += "</section>\n";
  }

  void finish(const ComparisonJob& job, const ComparisonResult& result) override {
    file_.write(kHead);
    file_.write(fmt::format("<style>\n{}</style>\n", kReportStyle));
    file_.write(
        fmt::format("<title>{1} against {0}</title>\n<h1>{1} against {0}</h1>\n<p>{2}</p>\n",
                    escaped(job.reference), escaped(job.actual), escaped(summary_of(result))));
    if (!sections_.empty()) write_sections();
    file_.finish();
  }

 private:
  void write_sections() {
    file_.write(kControls);
    file_.write(sections_);
    if (pictures_ == kMaxPictures) {
      file_.write(fmt::format("<p>Pictures are shown of the first {} frames.</p>\n", pictures_));
    }
    file_.write(fmt::format("<script>\n{}</script>\n", kReportScript));
  }

  OutputFile file_;
  std::string sections_;
  int pictures_ = 0;
};

class JunitReport final : public Report {
 public:
  explicit JunitReport(const std::string& path) : file_(path) {}

  void add(const FrameComparison& frame) override {
    const std::string name = escaped(frame.name);
    if (frame.is_accepted) {
      cases_ += fmt::format("    <testcase classname=\"frames\" name=\"{}\"/>\n", name);
    } else {
      add_failure(name, difference_text(frame));
    }
  }

  void finish(const ComparisonJob& job, const ComparisonResult& result) override {
    if (!result.mismatch.empty()) add_failure("sizes and number of frames", result.mismatch);
    const std::int64_t mismatches = result.mismatch.empty() ? 0 : 1;
    file_.write(
        fmt::format("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n"
                    "  <testsuite name=\"{} against {}\" tests=\"{}\" failures=\"{}\" errors=\"0\" "
                    "skipped=\"0\">\n{}  </testsuite>\n</testsuites>\n",
                    escaped(job.actual), escaped(job.reference), result.frames + mismatches,
                    result.refused_frames + mismatches, cases_));
    file_.finish();
  }

 private:
  void add_failure(const std::string& name, const std::string& reason) {
    cases_ += fmt::format(
        "    <testcase classname=\"frames\" name=\"{}\">\n"
        "      <failure message=\"{}\"/>\n    </testcase>\n",
        name, escaped(reason));
  }

  OutputFile file_;
  std::string cases_;
};

}  // namespace

std::unique_ptr<Report> diff_folder(const std::string& folder) {
  return std::make_unique<DiffFolder>(folder);
}

void claim_diff_folder(OverwriteCheck& check, const std::string& folder) {
  check.writes_some_of("--diff", folder, folder, names_of_pattern(kPattern));
}

std::unique_ptr<Report> html_report(const std::string& path) {
  return std::make_unique<HtmlReport>(path);
}

std::unique_ptr<Report> junit_report(const std::string& path) {
  return std::make_unique<JunitReport>(path);
}

}  // namespace piblocks
