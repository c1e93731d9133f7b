#include <fmt/format.h>

#include "core/output_file.hpp"
#include "core/text.hpp"
#include "golden/reports.hpp"

namespace piblocks {
namespace {

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

std::unique_ptr<Report> junit_report(const std::string& path) {
  return std::make_unique<JunitReport>(path);
}

}  // namespace piblocks
