#include "golden/diff_pictures.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <array>
#include <optional>
#include <system_error>
#include <utility>

#include "core/input_file.hpp"
#include "core/text.hpp"
#include "golden/difference.hpp"
#include "media/png/png_chunk.hpp"

namespace piblocks {
namespace fs = std::filesystem;
namespace {

constexpr const char* kLabel = "differences";
constexpr const char* kUnfinished = "differences.unfinished-";  // as Unfinished names its folder

bool is_picture_name(const std::string& name) {
  constexpr std::array kKinds = {kExpected, kActual, kDiff};
  return std::ranges::any_of(
      kKinds, [&](const char* kind) { return name.ends_with(fmt::format("-{}.png", kind)); });
}

/// Pictures that comparisons have left in a folder and below, without those that are being written.
std::vector<fs::path> marked_pictures(const fs::path& folder) {
  std::vector<fs::path> paths;
  std::error_code error;
  constexpr auto kOptions = fs::directory_options::skip_permission_denied;
  for (fs::recursive_directory_iterator at(folder, kOptions, error), end; !error && at != end;
       at.increment(error)) {
    const std::string name = at->path().filename();
    if (name.starts_with(kUnfinished)) at.disable_recursion_pending();
    if (is_picture_name(name) && has_png_mark(*at, PngMark::difference)) paths.push_back(*at);
  }
  return paths;
}

/// Of a file, its bytes.
std::optional<FramePicture> side_of(const char* kind, const std::string& path,
                                    const std::function<Image()>& picture) {
  if (!picture) return std::nullopt;
  std::error_code unknown;
  const std::uintmax_t size_bytes = path.empty() ? 0 : fs::file_size(path, unknown);
  const auto file = unknown ? std::nullopt : beginning_of(path, size_bytes);
  constexpr std::size_t kHeader_bytes = 33;
  if (file && file->size() >= kHeader_bytes && file->starts_with(kPngSignature)) {
    Bytes png(file->begin(), file->end());
    const auto size = from_big_endian(ByteSpan(png).subspan(16, 8));
    return FramePicture{kind, int(size >> 32), int(size & 0xffffffff), std::move(png)};
  }
  const Image image = picture();
  if (image.words.empty()) return std::nullopt;
  return FramePicture{kind, image.width_px, image.height_px, encode_png_samples(image)};
}

}  // namespace

std::vector<FramePicture> pictures_of(const FrameComparison& frame) {
  std::vector<FramePicture> pictures;
  const auto add = [&](std::optional<FramePicture> picture) {
    if (picture) pictures.push_back(*std::move(picture));
  };
  add(side_of(kExpected, frame.reference_path, frame.reference));
  add(side_of(kActual, frame.actual_path, frame.actual));
  if (!frame.difference) return pictures;
  const Image reference = frame.reference();
  if (pictures.size() < 2 || reference.words.empty()) return {};
  add(FramePicture{kDiff, reference.width_px, reference.height_px,
                   difference_picture(reference, frame.deltas())});
  return pictures;
}

std::string picture_name(const std::string& key, std::string_view kind) {
  constexpr std::string_view kEnding = ".png";
  const std::size_t ending_bytes = key.ends_with(kEnding) ? kEnding.size() : 0;
  return fmt::format("{}-{}.png", key.substr(0, key.size() - ending_bytes), kind);
}

DiffPictures::DiffPictures(fs::path folder, Making making)
    : folder_(std::move(folder)), making_(making) {
  if (making == Making::at_once) files_of("");
}

FileSet& DiffPictures::files_of(const fs::path& name) {
  const fs::path subfolder = name.parent_path();
  return files_.try_emplace(subfolder, folder_ / subfolder, kLabel, Unfinished::Sharing::shared)
      .first->second;
}

bool DiffPictures::is_new(const fs::path& name) const {
  return std::ranges::any_of(names_, [&](const auto& frame) {
    return std::ranges::count(frame.second, name.string()) > 0;
  });
}

void DiffPictures::add(const std::string& key, std::string_view kind, ByteSpan png) {
  if (failure_) return;
  const fs::path name = picture_name(key, kind);
  names_[key].push_back(name);
  try {
    files_of(name).add(name.filename(), with_png_mark(png, PngMark::difference));
  } catch (const Error&) {
    failure_ = std::current_exception();
  }
}

void DiffPictures::drop(const std::string& key) {
  if (failure_) return;
  for (const fs::path name : names_[key]) files_of(name).drop(name.filename());
  names_.erase(key);
}

void DiffPictures::finish() {
  if (failure_) std::rethrow_exception(failure_);
  if (files_.empty() && marked_pictures(folder_).empty()) return;
  files_of("");  // makes the folder
  const FolderLock lock(folder_);
  for (const auto& [key, names] : names_) {
    for (const std::string& name : names) {
      const fs::path path = folder_ / name;
      std::error_code none;
      if (!fs::exists(fs::symlink_status(path, none)) || has_png_mark(path, PngMark::difference)) {
        continue;
      }
      throw UsageError(fmt::format(
          "diff: '{}' is not from an earlier comparison; use another folder", path.string()));
    }
  }
  for (const fs::path& path : marked_pictures(folder_)) {
    const fs::path name = path.lexically_relative(folder_);
    if (!is_new(name)) files_of(name).remove(name.filename());
  }
  for (auto files = files_.rbegin(); files != files_.rend(); ++files) {  // subfolders come first
    files->second.commit();
    std::error_code not_empty;
    const bool stays = files->first.empty() && making_ == Making::at_once;
    if (!stays) fs::remove(folder_ / files->first, not_empty);
  }
}

void claim_diff_folder(OverwriteCheck& check, const std::string& option, const std::string& folder,
                       DiffPictures::Making making) {
  const FileNames names = making == DiffPictures::Making::at_once ? is_picture_name : FileNames();
  check.writes_some_of(option, folder, folder, names, marked_pictures(folder));
}

}  // namespace piblocks
