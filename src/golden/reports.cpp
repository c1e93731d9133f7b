#include "golden/reports.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <iterator>
#include <span>
#include <string_view>
#include <system_error>
#include <utility>

#include "core/output_file.hpp"
#include "core/text.hpp"
#include "golden/difference.hpp"
#include "golden/report_source.hpp"
#include "golden/shown_frames.hpp"

namespace piblocks {
namespace fs = std::filesystem;
namespace {

/// A comparison that is broken off leaves no report, rather than that of an earlier one.
void remove_old_report(const std::string& path) {
  std::error_code error;
  if (fs::is_regular_file(path, error)) fs::remove(fs::canonical(path, error), error);
}

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

std::string counts_json(const ComparisonResult& result) {
  std::vector<std::string> counts;
  for (std::size_t i = 0; i < kOutcomes; ++i) {
    counts.push_back(fmt::format("\"{}\":{}", name_of(Outcome(i)), result.rows.at(i)));
  }
  return fmt::format("{{{}}}", fmt::join(counts, ","));
}

std::string rect_json(const PixelRect& rect) {
  return fmt::format("[{},{},{},{}]", rect.x_px, rect.y_px, rect.width_px, rect.height_px);
}

std::string rects_json(const std::vector<PixelRect>& rects) {
  std::vector<std::string> texts;
  std::ranges::transform(rects, std::back_inserter(texts), rect_json);
  return fmt::format("[{}]", fmt::join(texts, ","));
}

class JsonReport final : public Report {
 public:
  explicit JsonReport(const std::string& path) : file_(path) { remove_old_report(path); }

  void add(const FrameComparison& frame) override {
    rows_ += fmt::format(R"({}{{"name":{},"outcome":"{}","text":{})", rows_.empty() ? "" : ",\n",
                         json_text(printable(frame.name)), name_of(frame.outcome),
                         json_text(printable(difference_text(frame))));
    if (frame.difference) add_difference(frame, *frame.difference);
    rows_ += '}';
  }

  void finish(const ComparisonJob& job, const ComparisonResult& result) override {
    file_.write(
        fmt::format(R"({{"reference":{},"actual":{},"tolerance":{},"outcome":"{}","text":{},)"
                    "\"counts\":{},\"rows\":[\n",
                    json_text(printable(job.reference)), json_text(printable(job.actual)),
                    json_text(printable(tolerance_text(job))), name_of(result.worst()),
                    json_text(printable(summary_text(job, result))), counts_json(result)));
    file_.write(rows_);
    file_.write(std::string_view("\n]}\n"));
    file_.finish();
  }

 private:
  void add_difference(const FrameComparison& frame, const Difference& d) {
    rows_ += fmt::format(
        R"(,"different_pixels":{},"off_pixels":{},"masked_pixels":{},"largest_delta":{},)"
        R"("max_level":{},"densest":{{"rect":{},"off_pixels":{}}})",
        d.different_pixels, d.off_pixels, d.masked_pixels, d.largest_delta, d.max_level,
        rect_json(d.densest), d.densest_off);
    if (!frame.masks.empty()) rows_ += fmt::format(R"(,"masks":{})", rects_json(frame.masks));
    if (d.is_equal()) return;
    rows_ += fmt::format(R"(,"regions":{})",
                         rects_json(changed_regions(frame.deltas(), frame.width_px)));
  }

  OutputFile file_;
  std::string rows_;
};

/// Of each frame, its pictures are in the folder already; they are left out if it is not shown.
class DiffFolder final : public Report {
 public:
  explicit DiffFolder(const std::string& folder)
      : pictures_(folder, DiffPictures::Making::at_once) {}

  void add(const FrameComparison& frame) override {
    if (frame.is_accepted() || !frame.difference || !shown_.takes(frame.outcome)) return;
    const std::vector<FramePicture> pictures = pictures_of(frame);
    if (pictures.empty()) return;
    for (const FramePicture& picture : pictures) {
      pictures_.add(frame.key, picture.kind, picture.png);
    }
    if (const auto left = shown_.add(frame.outcome, frame.key)) pictures_.drop(left->item);
  }
  void finish(const ComparisonJob& /*job*/, const ComparisonResult& /*result*/) override {
    pictures_.finish();
  }

 private:
  DiffPictures pictures_;
  ShownFrames<std::string> shown_;  // keys
};

// The page: its style and its script are in report/.

constexpr std::string_view kHead = R"(<!DOCTYPE html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width">
)";

constexpr std::string_view kControls = R"(<div class="controls">
<label>Show frames named <input id="filter" type="search" autocomplete="off"></label>
<label><input id="refused" type="checkbox" autocomplete="off"> only what is not accepted</label>
</div>
<div class="tools">
<fieldset><legend>View</legend>
<label><input name="mode" type="radio" value="slider" autocomplete="off" checked> slider</label>
<label><input name="mode" type="radio" value="side" autocomplete="off"> side by side</label>
<label><input name="mode" type="radio" value="blink" autocomplete="off"> blink</label>
<label><input name="mode" type="radio" value="diff" autocomplete="off"> difference</label>
<label><input id="boxes" type="checkbox" autocomplete="off" checked> boxes</label>
</fieldset>
<span><button id="previous" title="Key p" aria-label="previous change">&#x25c0;</button>
<output id="place">changes</output>
<button id="next" title="Key n" aria-label="next change">&#x25b6;</button></span>
<span><button id="less" title="Key -" aria-label="zoom out">&minus;</button>
<button id="more" title="Key +, or the wheel with Ctrl" aria-label="zoom in">+</button>
<button id="whole" title="Key 0">whole</button></span>
</div>
)";

constexpr std::string_view kAccepted = R"(<section id="list">
<h2>Accepted</h2>
<p>Check "accept" at frames that are right. The names, one a line: <a id="download" download="accepted.txt">accepted.txt</a></p>
<textarea id="names" rows="4" readonly aria-label="names of accepted frames"></textarea>
</section>
)";

/// A path as a relative address (RFC 3986).
std::string address_of(std::string_view path) {
  std::string address;
  for (const char c : path) {
    const bool is_plain = ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z') ||
                          ('0' <= c && c <= '9') ||
                          std::string_view("-._~/").find(c) != std::string_view::npos;
    address += is_plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return address;
}

std::string rect_markup(const char* kind, const PixelRect& rect) {
  return fmt::format(R"(<rect class="{}" x="{}" y="{}" width="{}" height="{}"/>)", kind, rect.x_px,
                     rect.y_px, rect.width_px, rect.height_px);
}

/// Pictures over each other, the upper left corners in one place. Where only one of them is, the
/// pane behind the other one shows its hatching.
/// @param sources  addresses of the pictures
std::string frame_markup(const FrameComparison& frame, std::span<const FramePicture> pictures,
                         std::span<const std::string> sources) {
  int width = 0;
  int height = 0;
  for (const FramePicture& picture : pictures) {
    width = std::max(width, picture.width_px);
    height = std::max(height, picture.height_px);
  }
  std::string sides;
  std::string panes;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const FramePicture& picture = pictures[i];
    panes += fmt::format(
        "<div class=\"pane {0}\"><img alt=\"{0}\" loading=\"lazy\" width=\"{1}\" height=\"{2}\" "
        "style=\"width: {3:.5f}%\" src=\"{4}\"></div>",
        picture.kind, picture.width_px, picture.height_px, 100.0 * picture.width_px / width,
        sources[i]);
    if (i == 2) continue;
    const std::string size = fmt::format(", {}x{}", picture.width_px, picture.height_px);
    sides += fmt::format("<span>{}{}</span>", picture.kind, frame.difference ? "" : size);
  }
  std::string boxes;
  for (const PixelRect& mask : frame.masks) boxes += rect_markup("mask", mask);
  if (frame.difference && !frame.difference->is_equal()) {
    for (const PixelRect& region : changed_regions(frame.deltas(), width)) {
      boxes += rect_markup("change", region);
    }
  }
  const bool is_single = pictures.size() == 1;
  return fmt::format(
      "<div class=\"frame{0}\" style=\"--shape: {1} / {2}\" data-width=\"{1}\">"
      "<div class=\"sides\">{3}</div><div class=\"pictures\">{4}"
      "<svg viewBox=\"0 0 {1} {2}\" aria-hidden=\"true\">{5}</svg></div>{6}"
      "</div>\n",
      is_single ? " single" : "", width, height, sides, panes, boxes,
      is_single ? ""
                : "<input type=\"range\" value=\"50\" autocomplete=\"off\" "
                  "aria-label=\"expected on the left, actual on the right\">");
}

/// What browsers open without trouble, and what fits into memory.
constexpr std::size_t kMostPictures_bytes = 100'000'000;

constexpr const char* kTooLarge =
    "<p>Its pictures would make this page too large; without --report-in-one-file they are "
    "shown.</p>\n";
constexpr const char* kNoColors =
    "<p>There are no pictures: piblocks does not know what these colours look like.</p>\n";

/// Of a frame. All but the key is HTML.
struct Section {
  std::string key;
  std::string name;
  std::string text;
  std::string pictures;
};

const char* class_of(Outcome outcome) {
  return outcome <= Outcome::accepted ? "accepted" : "refused";
}

std::string accept_box(Outcome outcome, const Section& section) {
  if (outcome <= Outcome::accepted) return {};
  return fmt::format(
      " <label><input class=\"accept\" type=\"checkbox\" autocomplete=\"off\" value=\"{}\"> "
      "accept</label>",
      escaped(section.key));
}

class HtmlReport final : public Report {
 public:
  HtmlReport(const std::string& path, ReportForm form)
      : form_(form),
        file_(path),
        folder_(folder_of_report(path)),
        pictures_(folder_, DiffPictures::Making::when_needed) {
    remove_old_report(path);
  }

  void add(const FrameComparison& frame) override {
    if (frame.outcome == Outcome::equal) return;
    Section section{frame.key, escaped(frame.name), escaped(difference_text(frame)), {}};
    if (shown_.takes(frame.outcome)) section.pictures = shown_pictures(frame);
    bytes_ += section.pictures.size();
    const auto left = shown_.add(frame.outcome, std::move(section));
    if (!left) return;
    bytes_ -= left->item.pictures.size();
    if (left->outcome != frame.outcome) pictures_.drop(left->item.key);
    ++left_;
    const std::string line =
        fmt::format("<li class=\"{}\"><b>{}</b>: {}{}</li>\n", class_of(left->outcome),
                    left->item.name, left->item.text, accept_box(left->outcome, left->item));
    std::string& lines = left_lines_.at(static_cast<std::size_t>(left->outcome));
    // A frame that another one has displaced comes before those that were never shown.
    lines.insert(left->outcome == frame.outcome ? lines.size() : 0, line);
  }

  void finish(const ComparisonJob& job, const ComparisonResult& result) override {
    pictures_.finish();
    file_.write(kHead);
    file_.write(fmt::format("<style>\n{}</style>\n", kReportStyle));
    file_.write(fmt::format(
        "<title>{1} against {0}</title>\n<h1>{1} against {0}</h1>\n<p>{2}</p>\n<p>{3}</p>\n",
        escaped(job.reference), escaped(job.actual), escaped(summary_text(job, result)),
        escaped(tolerance_text(job))));
    if (!result.problem.empty()) file_.write(fmt::format("<p>{}</p>\n", escaped(result.problem)));
    if (result.rows[0] < result.total()) write_sections();
    file_.finish();
  }

 private:
  std::string shown_pictures(const FrameComparison& frame) {
    const std::vector<FramePicture> pictures = pictures_of(frame);
    if (pictures.empty()) return frame.difference ? kNoColors : "";
    std::vector<std::string> sources;
    for (const FramePicture& picture : pictures) {
      if (form_ == ReportForm::one_file) {
        sources.push_back("data:image/png;base64," + base64(picture.png));
        continue;
      }
      pictures_.add(frame.key, picture.kind, picture.png);
      sources.push_back(
          address_of((folder_.filename() / picture_name(frame.key, picture.kind)).string()));
    }
    std::string markup = frame_markup(frame, pictures, sources);
    return bytes_ + markup.size() > kMostPictures_bytes ? kTooLarge : markup;
  }

  void write_sections() {
    file_.write(kControls);
    shown_.for_each([this](Outcome outcome, const Section& section) {
      file_.write(fmt::format("<section class=\"{}\">\n<h2>{}</h2>\n<p>{}{}</p>\n{}</section>\n",
                              class_of(outcome), section.name, section.text,
                              accept_box(outcome, section), section.pictures));
    });
    if (left_ > 0) {
      file_.write(fmt::format("<p>{} more, without pictures:</p>\n<ul>\n", left_));
      for (std::size_t i = kOutcomes; i-- > 0;) file_.write(left_lines_.at(i));
      file_.write(std::string_view("</ul>\n"));
    }
    file_.write(fmt::format("{}<script>\n{}</script>\n", kAccepted, kReportScript));
  }

  ReportForm form_;
  OutputFile file_;
  fs::path folder_;
  DiffPictures pictures_;
  ShownFrames<Section> shown_;
  std::array<std::string, kOutcomes> left_lines_;  // of what is not shown
  std::int64_t left_ = 0;
  std::size_t bytes_ = 0;  // of sections
};

}  // namespace

std::unique_ptr<Report> diff_folder(const std::string& folder) {
  return std::make_unique<DiffFolder>(folder);
}

std::string folder_of_report(const std::string& path) {
  return fs::path(path).replace_extension().string() + "-files";
}

std::unique_ptr<Report> html_report(const std::string& path, ReportForm form) {
  return std::make_unique<HtmlReport>(path, form);
}

std::unique_ptr<Report> junit_report(const std::string& path) {
  return std::make_unique<JunitReport>(path);
}

std::unique_ptr<Report> json_report(const std::string& path) {
  return std::make_unique<JsonReport>(path);
}

}  // namespace piblocks
