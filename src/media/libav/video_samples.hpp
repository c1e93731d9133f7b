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

Samples samples_of(const AVFrame& frame);

/// @param sws  of the last picture, reused if it suits this one.
/// @throws MediaError if libswscale does not know the pixel format.
Samples rgb_of(const AVFrame& frame, SwsPtr& sws);

}  // namespace piblocks
