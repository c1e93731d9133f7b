#include <fmt/format.h>
#include <piblocks/encode.hpp>

#include <string_view>

#include "core/base64.hpp"
#include "core/output_file.hpp"
#include "core/printable.hpp"
#include "golden/describe.hpp"
#include "golden/diff_picture.hpp"
#include "golden/reports.hpp"

namespace piblocks {
namespace {

constexpr int kMaxPictures = 40;

constexpr std::string_view kHead = R"(<!DOCTYPE html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width">
<style>
:root { color-scheme: light dark; font: 16px/1.5 system-ui, sans-serif; }
body { max-width: 76rem; margin: 2rem auto; padding: 0 1rem; }
h1 { font-size: 1.4rem; }
h2 { font-size: 1.1rem; margin: 0; }
section { border-top: 1px solid #8888; padding: 1rem 0; }
section.refused h2::before { content: "\2717  "; color: #c62828; }
section.accepted h2::before { content: "\2713  "; color: #2e7d32; }
p { margin: .3rem 0; }
.controls { display: flex; gap: 0 1.5rem; flex-wrap: wrap; position: sticky; top: 0; z-index: 1;
  padding: .5rem 0; background: Canvas; }
.frame { max-width: calc(80vh * var(--shape)); margin: auto; }
.sides { display: flex; justify-content: space-between; opacity: .7; }
.pictures { position: relative; line-height: 0; border: 1px solid #8888; }
.pictures img { width: 100%; }
.pictures img + img { position: absolute; inset: 0; }
.actual { clip-path: inset(0 0 0 var(--split, 50%)); }
.difference { visibility: hidden; }
.pictures::after { content: ""; position: absolute; inset: 0 auto 0 var(--split, 50%);
  border-left: 1px solid #888; }
.show-difference .difference { visibility: visible; }
.show-difference :is(.sides, input[type=range]), .show-difference .pictures::after {
  visibility: hidden; }
body:not(:has(img)) label:has(#difference) { display: none; }
input[type=range] { width: calc(100% + 1rem); margin: .5rem -.5rem; }
</style>
)";

constexpr std::string_view kControls = R"(<div class="controls">
<label>Show frames named <input id="filter" type="search" autocomplete="off"></label>
<label><input id="refused" type="checkbox" autocomplete="off"> only what is not accepted</label>
<label><input id="difference" type="checkbox" autocomplete="off"> differences in red</label>
</div>
)";

constexpr std::string_view kScript = R"(<script>
const filter = document.getElementById("filter");
const refused = document.getElementById("refused");
const difference = document.getElementById("difference");
const sections = document.querySelectorAll("section");
function update() {
  for (const section of sections) {
    const name = section.querySelector("h2").textContent.toLowerCase();
    const matches = name.includes(filter.value.toLowerCase());
    section.hidden = !matches || (refused.checked && !section.classList.contains("refused"));
  }
  document.body.classList.toggle("show-difference", difference.checked);
}
for (const control of [filter, refused, difference]) control.addEventListener("input", update);
for (const slider of document.querySelectorAll("input[type=range]")) {
  slider.addEventListener("input", () =>
    slider.previousElementSibling.style.setProperty("--split", slider.value + "%"));
}
update();
</script>
)";

std::string picture(const Image& image, std::string_view kind) {
  return fmt::format(R"(<img class="{0}" alt="{0}" src="data:image/png;base64,{1}">)", kind,
                     base64(encode_png(image.view())));
}

/// What is left of the slider is expected, what is right of it was found.
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
                             escaped(describe(frame)));
    if (frame.difference && pictures_ < kMaxPictures) {
      ++pictures_;
      sections_ += pictures_of(frame);
    }
    sections_ += "</section>\n";
  }

  void finish(const ComparisonJob& job, const ComparisonResult& result) override {
    file_.write(kHead);
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
    file_.write(kScript);
  }

  OutputFile file_;
  std::string sections_;
  int pictures_ = 0;
};

}  // namespace

std::unique_ptr<Report> html_report(const std::string& path) {
  return std::make_unique<HtmlReport>(path);
}

}  // namespace piblocks
