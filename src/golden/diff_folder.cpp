// The pictures of differences, one PNG file each.
#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <filesystem>
#include <set>
#include <system_error>

#include "core/output_file.hpp"
#include "golden/reports.hpp"
#include "golden/shown_frames.hpp"
#include "media/output/frame_pattern.hpp"
#include "media/png/png_chunk.hpp"
#include "media/png/png_mark.hpp"

namespace piblocks {
namespace fs = std::filesystem;
namespace {

constexpr const char* kPattern = "%06d.png";

class DiffFolder final : public Report {
 public:
  explicit DiffFolder(const std::string& folder)
      : folder_(folder), files_(folder_, "differences"), pattern_(kPattern) {}

  void add(const FrameComparison& frame) override {
    if (frame.is_accepted() || !frame.difference || !shown_.takes(frame.outcome)) return;
    const Image reference = frame.reference();
    const Image actual = frame.actual();
    if (reference.words.empty() || actual.words.empty()) return;
    const Image strip =
        difference_strip(reference, frame.deltas(), actual, frame.difference->densest);
    shown_.add(frame.outcome, {pattern_.name(frame.number),
                               with_png_mark(encode_png_samples(strip), PngMark::difference)});
  }
  void finish(const ComparisonJob& job, const ComparisonResult& result) override;

 private:
  struct Picture {
    std::string name;
    Bytes bytes;
  };

  fs::path folder_;
  FileSet files_;
  FramePattern pattern_;
  ShownFrames<Picture> shown_;
};

void DiffFolder::finish(const ComparisonJob& /*job*/, const ComparisonResult& /*result*/) {
  std::set<std::string> names;
  shown_.for_each([&](Outcome /*outcome*/, const Picture& picture) {
    const fs::path path = folder_ / picture.name;
    std::error_code none;
    if (fs::exists(fs::symlink_status(path, none)) && !has_png_mark(path, PngMark::difference)) {
      throw UsageError(fmt::format(
          "diff: '{}' is not from an earlier comparison; use another folder", path.string()));
    }
    files_.add(picture.name, picture.bytes);
    names.insert(picture.name);
  });
  std::error_code error;
  for (const fs::path& path : entries_of(folder_, error)) {
    const std::string name = path.filename();
    const bool is_old = pattern_.number_of(name) && !names.contains(name) &&
                        has_png_mark(path, PngMark::difference);
    if (is_old) files_.remove(name);
  }
  files_.commit();
}

}  // namespace

std::unique_ptr<Report> diff_folder(const std::string& folder) {
  return std::make_unique<DiffFolder>(folder);
}

void claim_diff_folder(OverwriteCheck& check, const std::string& folder) {
  check.writes_some_of("--diff", folder, folder, names_of_pattern(kPattern));
}

}  // namespace piblocks
