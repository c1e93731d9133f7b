// What the readers of video files share.
#pragma once

#include <memory>
#include <stop_token>
#include <string>
#include <utility>

#include "media/libav/av.hpp"
#include "media/pixels/frame_reader.hpp"

namespace piblocks {

/// An opened file. Reading it fails soon after a stop has been requested.
struct VideoInput {
  VideoInput(const std::string& path, std::stop_token token)
      : stop(std::move(token)), file(open_av_input(path, &stop)) {}
  ~VideoInput() = default;
  VideoInput(const VideoInput&) = delete;
  VideoInput& operator=(const VideoInput&) = delete;

  std::stop_token stop;  // libavformat has its address
  AvInputPtr file;
};

/// The frames of a GIF, each a whole picture.
std::unique_ptr<FrameReader> read_gif(const std::string& path, std::unique_ptr<VideoInput> input);

}  // namespace piblocks
