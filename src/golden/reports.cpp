#include "golden/reports.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <string_view>
#include <system_error>
#include <utility>

#include "core/output_file.hpp"
#include "core/text.hpp"
#include "golden/diff_pictures.hpp"
#include "golden/shown_frames.hpp"

namespace piblocks {
namespace fs = std::filesystem;

void remove_old_report(const std::string& path) {
  std::error_code error;
  if (fs::is_regular_file(path, error)) fs::remove(fs::canonical(path, error), error);
}

namespace {

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

}  // namespace

std::unique_ptr<Report> diff_folder(const std::string& folder) {
  return std::make_unique<DiffFolder>(folder);
}

std::unique_ptr<Report> junit_report(const std::string& path) {
  return std::make_unique<JunitReport>(path);
}

std::unique_ptr<Report> json_report(const std::string& path) {
  return std::make_unique<JsonReport>(path);
}

}  // namespace piblocks
