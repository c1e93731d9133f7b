#include "golden/diff_pictures.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <system_error>
#include <utility>

#include "media/png/png_mark.hpp"

namespace piblocks {
namespace fs = std::filesystem;
DiffPictures::DiffPictures(fs::path folder, Making making) : folder_(std::move(folder)) {
  if (making == Making::at_once) make_folder();
}

void DiffPictures::make_folder() {
  files_.emplace(folder_, "differences", Unfinished::Sharing::shared);
}

void DiffPictures::add(const std::string& name, ByteSpan png) {
  pictures_.push_back({name, with_png_mark(png, PngMark::difference)});
}

std::vector<std::string> DiffPictures::old_pictures(const FileNames& may_be_old) const {
  std::vector<std::string> names;
  std::error_code error;
  for (const fs::path& path : entries_of(folder_, error)) {
    const std::string name = path.filename();
    const bool is_new = std::ranges::count(pictures_, name, &Picture::name) > 0;
    if (!is_new && may_be_old(name) && has_png_mark(path, PngMark::difference))
      names.push_back(name);
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
    if (fs::exists(fs::symlink_status(path, none)) && !has_png_mark(path, PngMark::difference)) {
      throw UsageError(fmt::format(
          "diff: '{}' is not from an earlier comparison; use another folder", path.string()));
    }
    files_->add(name, bytes);
  }
  for (const std::string& name : old_pictures(may_be_old)) files_->remove(name);
  files_->commit();
}

}  // namespace piblocks
