// The samples of a decoded picture, whatever its pixel format.
// In: a frame of libavcodec's. Out: what it stores, or the colours that it shows.
#pragma once

#include <memory>
#include <string>

#include "media/libav/av.hpp"
#include "media/pixels/samples.hpp"

extern "C" {
#include <libswscale/swscale.h>
}

namespace piblocks {

struct SwsDeleter {
  void operator()(SwsContext* context) const noexcept { sws_freeContext(context); }
};
using SwsPtr = std::unique_ptr<SwsContext, SwsDeleter>;

/// Frames can be compared if their samples are integers of up to 16 bits in regular rows.
/// @throws MediaError that names the pixel format, if they are not.
void check_pixel_format(const AVFrame& frame, const std::string& path);

/// FrameReader::layout(), in which the arrangement in memory has no part.
std::string layout_of(const AVFrame& frame);

Samples samples_of(const AVFrame& frame);

/// @param sws  of the last picture, reused if it suits this one.
/// @throws MediaError if libswscale does not know the pixel format.
Samples rgb_of(const AVFrame& frame, SwsPtr& sws);

}  // namespace piblocks
