#include "golden/reports.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <utility>

#include "core/output_file.hpp"
#include "core/text.hpp"
#include "golden/diff_pictures.hpp"
#include "golden/report_source.hpp"
#include "golden/shown_frames.hpp"
#include "media/output/frame_pattern.hpp"
#include "media/png/png_chunk.hpp"

namespace piblocks {
namespace fs = std::filesystem;
namespace {

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
                     base64(encode_png_samples(image)));
}

/// One picture by itself, with its size.
std::string single_picture(const std::function<Image()>& picture_of, std::string_view kind) {
  if (!picture_of) return {};
  const Image image = picture_of();
  if (image.words.empty()) return {};
  return fmt::format(
      "<div class=\"frame single\" style=\"--shape: {0} / {1}\"><div class=\"sides\">"
      "<span>{2}, {0}x{1}</span></div><div class=\"pictures\">{3}</div></div>\n",
      image.width_px, image.height_px, kind, picture(image, kind));
}

/// The expected picture is left of the slider, the actual one right of it. Frames that were not
/// compared have no slider: each picture that there is stands by itself.
std::string pictures_of(const FrameComparison& frame) {
  if (!frame.difference) {
    return single_picture(frame.reference, "expected") + single_picture(frame.actual, "actual");
  }
  const Image reference = frame.reference();
  const Image actual = frame.actual();
  if (reference.words.empty() || actual.words.empty()) {
    return "<p>There are no pictures: piblocks does not know what these colours look like.</p>\n";
  }
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

/// What browsers open without trouble, and what fits into memory.
constexpr std::size_t kMostPictures_bytes = 100'000'000;

const char* class_of(Outcome outcome) {
  return outcome <= Outcome::accepted ? "accepted" : "refused";
}

/// A comparison that is broken off leaves no report, rather than that of an earlier one.
void remove_old_report(const std::string& path) {
  std::error_code error;
  if (fs::is_regular_file(path, error)) fs::remove(fs::canonical(path, error), error);
}

class HtmlReport final : public Report {
 public:
  explicit HtmlReport(const std::string& path) : file_(path) { remove_old_report(path); }

  void add(const FrameComparison& frame) override {
    if (frame.outcome == Outcome::equal) return;
    Section section{escaped(frame.name), escaped(difference_text(frame)), {}};
    if (shown_.takes(frame.outcome)) section.pictures = pictures_of(frame);
    if (bytes_ + section.pictures.size() > kMostPictures_bytes) {
      section.pictures = "<p>Its pictures would make this page too large; --diff has them.</p>\n";
    }
    bytes_ += section.pictures.size();
    const auto left = shown_.add(frame.outcome, std::move(section));
    if (!left) return;
    bytes_ -= left->item.pictures.size();
    ++left_;
    const std::string line = fmt::format("<li class=\"{}\"><b>{}</b>: {}</li>\n",
                                         class_of(left->outcome), left->item.name, left->item.text);
    std::string& lines = left_lines_.at(static_cast<std::size_t>(left->outcome));
    // A frame that another one has displaced comes before those that were never shown.
    lines.insert(left->outcome == frame.outcome ? lines.size() : 0, line);
  }

  void finish(const ComparisonJob& job, const ComparisonResult& result) override {
    file_.write(kHead);
    file_.write(fmt::format("<style>\n{}</style>\n", kReportStyle));
    file_.write(fmt::format(
        "<title>{1} against {0}</title>\n<h1>{1} against {0}</h1>\n<p>{2}</p>\n",
        escaped(job.reference), escaped(job.actual), escaped(summary_text(job, result))));
    if (!result.problem.empty()) file_.write(fmt::format("<p>{}</p>\n", escaped(result.problem)));
    if (result.rows[0] < result.total()) write_sections();
    file_.finish();
  }

 private:
  struct Section {
    std::string name;
    std::string text;
    std::string pictures;
  };

  void write_sections() {
    file_.write(kControls);
    shown_.for_each([this](Outcome outcome, const Section& section) {
      file_.write(fmt::format("<section class=\"{}\">\n<h2>{}</h2>\n<p>{}</p>\n{}</section>\n",
                              class_of(outcome), section.name, section.text, section.pictures));
    });
    if (left_ > 0) {
      file_.write(fmt::format("<p>{} more, without pictures:</p>\n<ul>\n", left_));
      for (std::size_t i = kOutcomes; i-- > 0;) file_.write(left_lines_.at(i));
      file_.write(std::string_view("</ul>\n"));
    }
    file_.write(fmt::format("<script>\n{}</script>\n", kReportScript));
  }

  OutputFile file_;
  ShownFrames<Section> shown_;
  std::array<std::string, kOutcomes> left_lines_;  // of what is not shown
  std::int64_t left_ = 0;
  std::size_t bytes_ = 0;  // of pictures
};

class JunitReport final : public Report {
 public:
  explicit JunitReport(const std::string& path) : file_(path) { remove_old_report(path); }

  void add(const FrameComparison& frame) override {
    cases_ += fmt::format(R"(    <testcase classname="frames" name="{}")", escaped(frame.name));
    if (frame.is_accepted()) {
      cases_ += "/>\n";
      return;
    }
    const bool is_error = frame.outcome == Outcome::unreadable;
    cases_ += fmt::format(">\n      <{} type=\"{}\" message=\"{}\"/>\n    </testcase>\n",
                          is_error ? "error" : "failure", name_of(frame.outcome),
                          escaped(difference_text(frame)));
  }

  void finish(const ComparisonJob& job, const ComparisonResult& result) override {
    const std::int64_t errors = result.count(Outcome::unreadable);
    const std::int64_t passes = result.count(Outcome::equal) + result.count(Outcome::accepted);
    file_.write(fmt::format(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n"
        "  <testsuite name=\"{} against {}\" tests=\"{}\" failures=\"{}\" errors=\"{}\" "
        "skipped=\"0\">\n",
        escaped(job.actual), escaped(job.reference), result.total(),
        result.total() - passes - errors, errors));
    file_.write(cases_);
    file_.write(std::string_view("  </testsuite>\n</testsuites>\n"));
    file_.finish();
  }

 private:
  OutputFile file_;
  std::string cases_;
};

PixelRect place_of_largest(const std::vector<std::uint8_t>& deltas, const Image& image) {
  const auto at = int(std::ranges::max_element(deltas) - deltas.begin());
  return {at % image.width_px, at / image.width_px, 1, 1};
}

class DiffFolder final : public Report {
 public:
  explicit DiffFolder(const std::string& folder)
      : pictures_(folder, DiffPictures::Making::at_once), pattern_(DiffPictures::kPattern) {}

  void add(const FrameComparison& frame) override {
    if (frame.is_accepted() || !frame.difference || !shown_.takes(frame.outcome)) return;
    const Image reference = frame.reference();
    const Image actual = frame.actual();
    if (reference.words.empty() || actual.words.empty()) return;
    const Difference& d = *frame.difference;
    const std::vector<std::uint8_t> deltas = frame.deltas();
    // Without a pixel off, the hard limit refuses the largest delta.
    const PixelRect focus = d.off_pixels > 0 ? d.densest : place_of_largest(deltas, reference);
    const Image strip = difference_strip(reference, deltas, actual, focus);
    shown_.add(frame.outcome, {pattern_.name(frame.number), encode_png_samples(strip)});
  }
  void finish(const ComparisonJob& /*job*/, const ComparisonResult& /*result*/) override {
    shown_.for_each([&](Outcome /*outcome*/, const auto& picture) {
      pictures_.add(picture.first, picture.second);
    });
    pictures_.finish([this](const std::string& name) { return bool(pattern_.number_of(name)); });
  }

 private:
  DiffPictures pictures_;
  FramePattern pattern_;
  ShownFrames<std::pair<std::string, Bytes>> shown_;  // names and files
};

}  // namespace

std::unique_ptr<Report> diff_folder(const std::string& folder) {
  return std::make_unique<DiffFolder>(folder);
}

void claim_diff_folder(OverwriteCheck& check, const std::string& folder) {
  check.writes_some_of("--diff", folder, folder, names_of_pattern(DiffPictures::kPattern));
}

std::unique_ptr<Report> html_report(const std::string& path) {
  return std::make_unique<HtmlReport>(path);
}

std::unique_ptr<Report> junit_report(const std::string& path) {
  return std::make_unique<JunitReport>(path);
}

}  // namespace piblocks
