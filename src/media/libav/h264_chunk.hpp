// The chunks of an H.264 video, coded from what changes in them.
// In: frames, and which rectangles of them have changed. Out: packets that fit the headers of the
// stream, made by src/h264 or, if too much changes, by libavcodec's encoder.
#pragma once

#include <memory>

#include "h264/picture.hpp"
#include "h264/picture_encoder.hpp"
#include "media/libav/video_encoder.hpp"
#include "media/pixels/yuv.hpp"

namespace piblocks {

YuvView<std::uint8_t> view_of(h264::Picture& picture);

/// @param encoder        of the stream; must outlive the result, as `sets`.
/// @param may_hand_over  whether it may take the rest of a chunk in which much changes.
std::unique_ptr<ChunkEncoder> h264_chunk_encoder(const VideoEncoder& encoder,
                                                 const h264::ParameterSets& sets, int qp,
                                                 bool may_hand_over);

}  // namespace piblocks
