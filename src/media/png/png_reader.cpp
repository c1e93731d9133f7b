#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <utility>

#include "media/output/frame_reader.hpp"
#include "media/png/png_file.hpp"

namespace piblocks {
namespace fs = std::filesystem;
namespace {

class PngReader final : public FrameReader {
 public:
  explicit PngReader(std::vector<fs::path> paths) : paths_(std::move(paths)) {}

  bool next() override {
    if (read_ == paths_.size()) return false;
    samples_ = read_png_samples(paths_[read_++]);
    return true;
  }
  std::string layout() const override { return std::string(kRgba); }
  Samples samples() override { return std::move(samples_); }
  Samples rgb() override { return std::move(samples_); }
  std::string name() const override { return paths_[read_ - 1].filename(); }

 private:
  std::vector<fs::path> paths_;
  std::size_t read_ = 0;
  Samples samples_;
};

}  // namespace

Image read_png(const fs::path& path) { return PngFile(path).read_flat(); }

Samples read_png_samples(const fs::path& path) {
  PngFile file(path);
  if (file.is_animated()) {
    throw MediaError(fmt::format(
        "png: cannot read '{}' as one picture: it is animated; compare it by itself, as a video",
        path.string()));
  }
  if (file.is_deep()) return file.read_deep();
  return file.read_flat();
}

bool is_animated_png(const fs::path& path) { return PngFile(path).is_animated(); }

std::unique_ptr<FrameReader> read_png_files(std::vector<fs::path> paths) {
  return std::make_unique<PngReader>(std::move(paths));
}

}  // namespace piblocks
