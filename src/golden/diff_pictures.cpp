#include "golden/diff_pictures.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <fstream>
#include <string_view>
#include <system_error>
#include <utility>

namespace piblocks {
namespace fs = std::filesystem;
namespace {

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

}  // namespace

DiffPictures::DiffPictures(fs::path folder, Making making) : folder_(std::move(folder)) {
  if (making == Making::at_once) make_folder();
}

void DiffPictures::make_folder() {
  files_.emplace(folder_, "differences", Unfinished::Sharing::shared);
}

void DiffPictures::add(const std::string& name, Bytes png) {
  const Bytes chunk = mark();
  png.insert(png.begin() + kMark_at, chunk.begin(), chunk.end());
  pictures_.push_back({name, std::move(png)});
}

std::vector<std::string> DiffPictures::old_pictures(const FileNames& may_be_old) const {
  std::vector<std::string> names;
  std::error_code error;
  for (const fs::path& path : entries_of(folder_, error)) {
    const std::string name = path.filename();
    const bool is_new = std::ranges::count(pictures_, name, &Picture::name) > 0;
    if (!is_new && may_be_old(name) && has_mark(path)) names.push_back(name);
  }
  return names;
}

void DiffPictures::finish(const FileNames& may_be_old) {
  if (!files_ && pictures_.empty() && old_pictures(may_be_old).empty()) return;
  if (!files_) make_folder();
  const FolderLock lock(folder_);
  for (const auto& [name, bytes] : pictures_) {
    const fs::path path = folder_ / name;
    std::error_code none;
    if (fs::exists(fs::symlink_status(path, none)) && !has_mark(path)) {
      throw UsageError(fmt::format(
          "diff: '{}' is not from an earlier comparison; use another folder", path.string()));
    }
    files_->add(name, bytes);
  }
  for (const std::string& name : old_pictures(may_be_old)) files_->remove(name);
  files_->commit();
}

}  // namespace piblocks
