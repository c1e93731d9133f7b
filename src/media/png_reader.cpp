#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <png.h>

#include <cerrno>
#include <cstdio>
#include <system_error>
#include <utility>

#include "media/frame_reader.hpp"

namespace piblocks {
namespace fs = std::filesystem;
namespace {

struct FileCloser {
  // NOLINTNEXTLINE(cppcoreguidelines-owning-memory): this is the owner
  void operator()(std::FILE* file) const noexcept { std::fclose(file); }
};
using FilePtr = std::unique_ptr<std::FILE, FileCloser>;

FilePtr open_file(const fs::path& path) {
  std::error_code error;
  if (fs::is_directory(path, error)) error = std::make_error_code(std::errc::is_a_directory);
  FilePtr file(error ? nullptr : std::fopen(path.c_str(), "rbe"));
  if (!file && !error) error.assign(errno, std::generic_category());
  if (!file) {
    throw IoError(fmt::format("png: cannot read '{}': {}", path.string(), error.message()));
  }
  return file;
}

/// libpng's simplified interface: it reports errors instead of jumping.
class PngImage {
 public:
  explicit PngImage(const fs::path& path) : path_(path), file_(open_file(path)) {
    image_.version = PNG_IMAGE_VERSION;
    if (png_image_begin_read_from_stdio(&image_, file_.get()) == 0) fail(image_.message);
    const bool is_large = image_.width > kMaxSide_px || image_.height > kMaxSide_px ||
                          std::int64_t{image_.width} * image_.height > kMaxFrame_px;
    if (is_large) fail(fmt::format("{}x{} is too large", image_.width, image_.height));
  }
  ~PngImage() { png_image_free(&image_); }
  PngImage(const PngImage&) = delete;
  PngImage& operator=(const PngImage&) = delete;

  Image read() {
    // As words on a little-endian machine: 0xAARRGGBB.
    image_.format = PNG_FORMAT_BGRA;
    Image image{static_cast<int>(image_.width), static_cast<int>(image_.height), {}};
    image.words.resize(std::size_t{image_.width} * image_.height);
    if (png_image_finish_read(&image_, nullptr, image.words.data(), 0, nullptr) == 0) {
      fail(image_.message);
    }
    return image;
  }

 private:
  [[noreturn]] void fail(const std::string& reason) const {
    throw MediaError(fmt::format("png: cannot read '{}': {}", path_.string(), reason));
  }

  fs::path path_;
  FilePtr file_;
  png_image image_{};
};

class PngReader final : public FrameReader {
 public:
  explicit PngReader(std::vector<fs::path> paths) : paths_(std::move(paths)) {}

  bool next() override {
    if (read_ == paths_.size()) return false;
    image_ = read_png(paths_[read_++]);
    return true;
  }
  std::string layout() const override { return "rgba"; }
  Image samples() override { return std::move(image_); }
  Image rgb() override { return std::move(image_); }
  std::string name() const override { return paths_[read_ - 1].filename(); }

 private:
  std::vector<fs::path> paths_;
  std::size_t read_ = 0;
  Image image_;
};

}  // namespace

Image read_png(const fs::path& path) { return PngImage(path).read(); }

std::unique_ptr<FrameReader> read_png_files(std::vector<fs::path> paths) {
  return std::make_unique<PngReader>(std::move(paths));
}

}  // namespace piblocks
