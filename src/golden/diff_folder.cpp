// The pictures of differences, one PNG file each.
#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <string_view>
#include <system_error>

#include "core/output_file.hpp"
#include "golden/reports.hpp"
#include "golden/shown_frames.hpp"
#include "media/output/frame_pattern.hpp"
#include "media/png/png_chunk.hpp"

namespace piblocks {
namespace fs = std::filesystem;
namespace {

constexpr const char* kPattern = "%06d.png";

/// The offset of the first chunk after IHDR.
constexpr std::size_t kMark_at = 33;

/// The chunk that tells pictures of this kind from other PNG files.
Bytes mark() {
  constexpr std::string_view kText("Software\0piblocks compare --diff", 32);
  Bytes chunk;
  const std::size_t start = begin_png_chunk(chunk, "tEXt");
  chunk.insert(chunk.end(), kText.begin(), kText.end());
  end_png_chunk(chunk, start);
  return chunk;
}

Bytes encode_with_mark(const Image& picture) {
  Bytes bytes = encode_png_samples(picture);
  const Bytes chunk = mark();
  bytes.insert(bytes.begin() + kMark_at, chunk.begin(), chunk.end());
  return bytes;
}

/// Whether a comparison has written this file.
bool has_mark(const fs::path& path) {
  std::error_code none;
  if (!fs::is_regular_file(fs::symlink_status(path, none))) return false;
  const Bytes expected = mark();
  std::string found(expected.size(), '\0');
  std::ifstream file(path, std::ios::binary);
  file.seekg(kMark_at);
  file.read(found.data(), static_cast<std::streamsize>(found.size()));
  return file && std::ranges::equal(found, expected, [](char a, std::uint8_t b) {
           return static_cast<std::uint8_t>(a) == b;
         });
}

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
    shown_.add(frame.outcome, {pattern_.name(frame.number), encode_with_mark(strip)});
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
    if (fs::exists(fs::symlink_status(path, none)) && !has_mark(path)) {
      throw UsageError(fmt::format(
          "diff: '{}' is not from an earlier comparison; use another folder", path.string()));
    }
    files_.add(picture.name, picture.bytes);
    names.insert(picture.name);
  });
  std::error_code error;
  for (const fs::path& path : entries_of(folder_, error)) {
    const std::string name = path.filename();
    const bool is_old = pattern_.number_of(name) && !names.contains(name) && has_mark(path);
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
