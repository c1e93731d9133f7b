#include <fmt/format.h>
#include <piblocks/png.hpp>

#include <filesystem>

#include "core/output_file.hpp"
#include "golden/diff_picture.hpp"
#include "golden/reports.hpp"

namespace piblocks {
namespace {

constexpr int kMaxPictures = 100;

class DiffFolder final : public Report {
 public:
  explicit DiffFolder(std::string folder) : folder_(std::move(folder)), made_(folder_) {}

  void add(const FrameComparison& frame) override {
    if (frame.is_accepted || !frame.difference || ++pictures_ > kMaxPictures) return;
    const Image strip = difference_strip(frame.reference(), frame.deltas(), frame.actual(),
                                         frame.difference->densest);
    OutputFile file(folder_ / fmt::format("{:06}.png", frame.number));
    file.write(encode_png(strip.view()));
    file.finish();
  }
  void finish(const ComparisonJob& /*job*/, const ComparisonResult& /*result*/) override {
    made_.keep();
  }

 private:
  std::filesystem::path folder_;
  MadeFolders made_;
  int pictures_ = 0;
};

}  // namespace

std::unique_ptr<Report> diff_folder(const std::string& folder) {
  return std::make_unique<DiffFolder>(folder);
}

}  // namespace piblocks
