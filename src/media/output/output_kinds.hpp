// The kinds of output there are, one function each; set_up_output.cpp holds the table of them.
// In: a request whose name the kind matches. Out: the output, set up but not opened.
#pragma once

#include <memory>

#include "media/output/output_request.hpp"

namespace piblocks {

/// H.264 in MP4: BT.709 in limited range, converted and tagged.
/// @throws UsageError if the size is odd, no level of H.264 allows size and frame rate, a frame
///         lasts too long, or a setting or the encoder is no good.
std::unique_ptr<Output> mp4_output(const OutputRequest& request);

/// The same in MOV; or, with alpha, ProRes 4444 of 10 bits, colours as they were before they were
/// multiplied by alpha.
/// @throws UsageError as mp4_output(), but ProRes takes odd sizes.
std::unique_ptr<Output> mov_output(const OutputRequest& request);

/// VP9 or AV1 in WebM; VP9 with alpha if the frames have it.
/// @throws UsageError if the size is odd, or a setting or the encoder is no good.
std::unique_ptr<Output> webm_output(const OutputRequest& request);

/// GIF, at most 50 frames/s: only what changes, in colours of its own for every frame.
/// @throws UsageError if the frame rate is out of range.
std::unique_ptr<Output> gif_output(const OutputRequest& request);

/// Animated PNG: only what changes, exact, perhaps with alpha.
/// @throws UsageError if the frame rate has too large terms.
std::unique_ptr<Output> apng_output(const OutputRequest& request);

/// One PNG file a frame, numbered from 1. The files take their names together, in finish().
/// @throws UsageError if the pattern is no good.
std::unique_ptr<Output> png_output(const OutputRequest& request);

/// Uncompressed 4:2:0 video for other programs (YUV4MPEG2): BT.709 in limited range.
/// @throws UsageError if a side is odd.
std::unique_ptr<Output> y4m_output(const OutputRequest& request);

/// A line of text a frame with the hash of its RGB bytes, exactly as FFmpeg's framehash muxer
/// writes it for rawvideo rgb24 (rgba, if the frames have alpha) without its #software line.
std::unique_ptr<Output> framehash_output(const OutputRequest& request);

/// Sound alone, uncompressed: 24 bits.
/// @throws UsageError if it is longer than such a file can be.
std::unique_ptr<Output> wav_output(const OutputRequest& request);

/// Takes frames and keeps nothing: what rendering costs without any output.
std::unique_ptr<Output> null_output(const OutputRequest& request);

}  // namespace piblocks
