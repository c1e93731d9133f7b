// The pictures of differences, one PNG file each.
#include <filesystem>
#include <utility>

#include "golden/diff_pictures.hpp"
#include "golden/reports.hpp"
#include "golden/shown_frames.hpp"
#include "media/output/frame_pattern.hpp"
#include "media/png/png_chunk.hpp"

namespace piblocks {
namespace {

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

}  // namespace piblocks
