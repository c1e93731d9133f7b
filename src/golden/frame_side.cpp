#include "golden/frame_side.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <filesystem>
#include <utility>

#include "core/input_file.hpp"
#include "media/libav/av_module.hpp"
#include "media/png/png_reader.hpp"

namespace piblocks {
namespace fs = std::filesystem;
namespace {

class PictureSide final : public FrameSide {
 public:
  explicit PictureSide(std::vector<PlacedPicture> pictures) : pictures_(std::move(pictures)) {}

  std::optional<std::int64_t> next_step() const override {
    if (fetched_ == pictures_.size()) return std::nullopt;
    return pictures_[fetched_].step;
  }
  bool fetch() override {
    const ListedPicture& picture = pictures_[fetched_++].picture;
    if (!picture.problem.empty()) throw IoError(picture.problem);
    refuse_pipe(picture.path, "compare");
    reader_ = read_png_frame(picture.path);
    return reader_->next();
  }
  std::string name() const override {
    const ListedPicture& picture = pictures_[fetched_ - 1].picture;
    return picture.name.empty() ? picture.path.string() : picture.name;
  }
  std::string path() const override { return pictures_[fetched_ - 1].picture.path; }
  bool goes_on_after_failure() const override { return true; }
  FrameReader& frame() override { return *reader_; }

 private:
  std::vector<PlacedPicture> pictures_;
  std::size_t fetched_ = 0;
  std::unique_ptr<FrameReader> reader_;
};

class VideoSide final : public FrameSide {
 public:
  VideoSide(std::string path, std::stop_token stop)
      : path_(std::move(path)), stop_(std::move(stop)) {}

  std::optional<std::int64_t> next_step() const override {
    return is_over_ ? std::nullopt : std::optional(fetched_);
  }
  bool fetch() override {
    is_over_ = true;  // if this throws
    if (!reader_) reader_ = read_video(path_, stop_);
    is_over_ = !reader_->next();
    if (!is_over_) ++fetched_;
    return !is_over_;
  }
  std::string name() const override {
    if (!reader_) return fs::path(path_).filename();
    return fmt::format("frame {}", number());
  }
  std::string key() const override { return reader_ ? frame_key(number()) : name(); }
  bool goes_on_after_failure() const override { return false; }
  FrameReader& frame() override { return *reader_; }

 private:
  std::int64_t number() const { return is_over_ ? fetched_ : fetched_ - 1; }

  std::string path_;
  std::stop_token stop_;
  std::unique_ptr<FrameReader> reader_;
  bool is_over_ = false;
  std::int64_t fetched_ = 0;
};

}  // namespace

std::unique_ptr<FrameSide> picture_side(std::vector<PlacedPicture> pictures) {
  return std::make_unique<PictureSide>(std::move(pictures));
}

std::unique_ptr<FrameSide> video_side(const std::string& path, const std::stop_token& stop) {
  return std::make_unique<VideoSide>(path, stop);
}

}  // namespace piblocks
