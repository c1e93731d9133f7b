#include "golden/frame_side.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <filesystem>
#include <utility>

#include "media/libav/av_module.hpp"

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
  Fetched fetch() override { return fetch_picture(pictures_[fetched_++].picture); }
  bool goes_on_after_failure() const override { return true; }

 private:
  std::vector<PlacedPicture> pictures_;
  std::size_t fetched_ = 0;
};

class VideoSide final : public FrameSide {
 public:
  VideoSide(std::string path, std::stop_token stop)
      : path_(std::move(path)), stop_(std::move(stop)) {}

  std::optional<std::int64_t> next_step() const override {
    return is_over_ ? std::nullopt : std::optional(fetched_);
  }
  Fetched fetch() override {
    Fetched fetched{.is_there = true};
    try {
      fetched.is_there = read();
    } catch (const IoError& error) {
      if (stop_.stop_requested()) throw;
      fetched.problem = error.what();
    } catch (const MediaError& error) {
      if (stop_.stop_requested()) throw;
      fetched.problem = error.what();
    }
    const std::int64_t number = is_over_ ? fetched_ : fetched_ - 1;
    fetched.name = reader_ ? fmt::format("frame {}", number) : fs::path(path_).filename().string();
    fetched.key = reader_ ? frame_key(number) : fetched.name;
    fetched.frame = reader_;
    return fetched;
  }
  bool goes_on_after_failure() const override { return false; }

 private:
  bool read() {
    is_over_ = true;  // if this throws
    if (!reader_) reader_ = read_video(path_, stop_);
    is_over_ = !reader_->next();
    if (!is_over_) ++fetched_;
    return !is_over_;
  }

  std::string path_;
  std::stop_token stop_;
  std::shared_ptr<FrameReader> reader_;
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
