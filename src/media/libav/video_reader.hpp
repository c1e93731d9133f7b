// The module's side of read_video().
// In: a file. Out: its frames, decoded by libavcodec.
#pragma once

#include <memory>
#include <stop_token>
#include <string>

#include "media/pixels/frame_reader.hpp"

namespace piblocks {

/// @throws IoError, MediaError
std::unique_ptr<FrameReader> decode_video_file(const std::string& path,
                                               const std::stop_token& stop = {});

}  // namespace piblocks
