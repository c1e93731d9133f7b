// What a decoded picture holds.
// In: a frame of libavcodec's. Out: what its pixel format and tags say; its samples or colours.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "media/libav/av.hpp"
#include "media/pixels/frame_reader.hpp"

extern "C" {
#include <libavutil/pixdesc.h>
#include <libswscale/swscale.h>
}

namespace piblocks {

/// Frames can be compared if their samples are integers of up to 16 bits in regular rows.
/// @throws MediaError that names the pixel format, if they are not.
void check_pixel_format(const AVFrame& frame, const std::string& path);

/// FrameReader::layout(), in which the arrangement in memory has no part.
std::string layout_of(const AVFrame& frame);

AVPixelFormat pixel_format_of(const AVFrame& frame);
const AVPixFmtDescriptor& descriptor_of(const AVFrame& frame);
bool has_flag(const AVPixFmtDescriptor& format, std::uint64_t flag);
int greatest_depth(const AVPixFmtDescriptor& format);

/// If the file does not say, players assume limited range for YUV and full range for grey.
bool is_full_range(const AVFrame& frame);
/// If the file does not say, players assume a matrix by the height.
int matrix_of(const AVFrame& frame);
/// Whether the samples are red, green and blue, or grey that stands for all three.
bool is_rgb(const AVFrame& frame);

/// The channel behind red, green and blue, or Y, Cb and Cr.
inline constexpr int kAlpha = 3;
/// The component that a channel shows; -1 if the format has no alpha. Three channels show grey.
int component_of(const AVPixFmtDescriptor& format, int channel);
// log2 of the pixels that share a sample of a component, and its samples in a row.
int x_shift_of(const AVPixFmtDescriptor& format, int component);
int y_shift_of(const AVPixFmtDescriptor& format, int component);
int samples_in_row(const AVFrame& frame, int component);

struct SwsDeleter {
  void operator()(SwsContext* context) const noexcept { sws_freeContext(context); }
};
using SwsPtr = std::unique_ptr<SwsContext, SwsDeleter>;

AnyImage samples_of(const AVFrame& frame);

/// @param sws  of the last picture, reused if it suits this one.
/// @throws MediaError if libswscale does not know the pixel format.
AnyImage rgb_of(const AVFrame& frame, SwsPtr& sws);

}  // namespace piblocks
