// What a decoded picture holds.
// In: a frame of libavcodec's. Out: what its pixel format and tags say; its samples or colours.
#pragma once

#include <cstdint>
#include <string>

#include "media/libav/av.hpp"
#include "media/pixels/frame_reader.hpp"

extern "C" {
#include <libavutil/pixdesc.h>
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

/// If the file does not say, players assume limited range for YUV and full range for others.
bool is_full_range(const AVFrame& frame);
/// If the file does not say, players choose a matrix by the height. AVCOL_SPC_RGB for grey too.
AVColorSpace matrix_of(const AVFrame& frame);
/// Whether the samples are red, green and blue of full range, or grey that stands for all three.
bool is_rgb(const AVFrame& frame);
bool is_grey(const AVPixFmtDescriptor& format);
bool is_xyz(const AVPixFmtDescriptor& format);

/// Where chroma samples lie among the pixels that share them.
struct Siting {
  /// From the first pixel to the middle of the sample, in halves of a pixel.
  int right = 0;
  int down = 0;
};
/// If the file does not say, players assume the left side.
Siting siting_of(const AVFrame& frame);

/// The channel behind red, green and blue, or Y, Cb and Cr.
inline constexpr int kAlpha = 3;
/// The component that a channel shows; -1 if the format has no alpha. Three channels show grey.
int component_of(const AVPixFmtDescriptor& format, int channel);
// log2 of the pixels that share a sample of a component, and its samples in a row.
int x_shift_of(const AVPixFmtDescriptor& format, int component);
int y_shift_of(const AVPixFmtDescriptor& format, int component);
int samples_in_row(const AVFrame& frame, int component);
int samples_in_column(const AVFrame& frame, int component);

/// One row of a component's samples, as they are stored.
/// @param row  of the component: two rows of 4:2:0 share one of chroma.
/// @param levels  takes samples_in_row() of them.
void read_levels(const AVFrame& frame, int component, int row, std::uint16_t* levels);

AnyImage samples_of(const AVFrame& frame);

/// The colours, of 8 bits if the samples have no more, else of 16. Chroma is interpolated linearly
/// between the places where its samples lie. The rows of interlaced pictures are taken as those of
/// any other, as by players without a deinterlacer.
/// @throws MediaError if no conversion to RGB is known for the matrix or the pixel format.
AnyImage rgb_of(const AVFrame& frame, const std::string& path);

}  // namespace piblocks
