// The page of a comparison: its style and its script are in report/.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "core/output_file.hpp"
#include "core/text.hpp"
#include "golden/diff_pictures.hpp"
#include "golden/report_source.hpp"
#include "golden/reports.hpp"
#include "golden/shown_frames.hpp"

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

std::string folder_of_report(const std::string& path) {
  return fs::path(path).replace_extension().string() + "-files";
}

std::unique_ptr<Report> html_report(const std::string& path, ReportForm form) {
  return std::make_unique<HtmlReport>(path, form);
}

}  // namespace piblocks
