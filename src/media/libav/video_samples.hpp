// The samples of a decoded picture, whatever its pixel format.
// In: a frame of libavcodec's. Out: what is stored in it, or the colours that it shows.
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

/// Samples of whole numbers, up to 16 bits each, every one at its place, are what can be compared.
/// @throws MediaError that names the pixel format, if it is another.
void check_pixel_format(const AVFrame& frame, const std::string& path);

/// What FrameReader::layout() says of the frame: the arrangement in memory is no part of it.
std::string layout_of(const AVFrame& frame);

Samples samples_of(const AVFrame& frame);

/// @param sws  of the last picture, used again if it suits this one.
/// @throws MediaError if libswscale does not know the pixel format.
Samples rgb_of(const AVFrame& frame, SwsPtr& sws);

}  // namespace piblocks
