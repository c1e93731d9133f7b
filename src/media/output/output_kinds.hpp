// The function that sets up each kind of output; outputs.cpp has the table of kinds.
// In: a request whose name the kind matches. Out: the output, set up but not opened.
#pragma once

#include <memory>

#include "media/output/output_request.hpp"

namespace piblocks {

// All throw UsageError if the kind cannot hold the format or does not take a setting.

/// H.264 in MP4: BT.709 in limited range, converted and tagged.
std::unique_ptr<Output> mp4_output(const OutputRequest& request);
/// The same in MOV; or ProRes 4444 with 10 bits and alpha, colours not multiplied by alpha.
std::unique_ptr<Output> mov_output(const OutputRequest& request);
/// VP9 or AV1 in WebM; VP9 with alpha if the frames have it.
std::unique_ptr<Output> webm_output(const OutputRequest& request);
/// GIF, at most 50 frames/s: only what changes, with colours of its own for every frame.
std::unique_ptr<Output> gif_output(const OutputRequest& request);
/// Animated PNG: only what changes, exact, with alpha if the frames have it.
std::unique_ptr<Output> apng_output(const OutputRequest& request);
/// One PNG file a frame, numbered from 1. The files take their names together, in finish().
std::unique_ptr<Output> png_output(const OutputRequest& request);
/// Uncompressed 4:2:0 video for other programs (YUV4MPEG2): BT.709 in limited range.
std::unique_ptr<Output> y4m_output(const OutputRequest& request);
/// A line of text a frame with the hash of its RGB bytes, as FFmpeg's framehash muxer writes it for
/// rawvideo rgb24 (rgba, if the frames have alpha), but without its #software line.
std::unique_ptr<Output> framehash_output(const OutputRequest& request);
/// Sound alone, uncompressed: 24 bits.
std::unique_ptr<Output> wav_output(const OutputRequest& request);
/// Takes frames and keeps nothing: what rendering costs without an output.
std::unique_ptr<Output> null_output(const OutputRequest& request);

}  // namespace piblocks
