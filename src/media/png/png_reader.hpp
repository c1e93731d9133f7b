// PNG files as they are stored: no colour profile and no gamma is applied, sRGB is assumed.
// In: files. Out: their samples.
#pragma once

#include <piblocks/image.hpp>

#include <filesystem>
#include <memory>
#include <vector>

#include "media/pixels/frame_reader.hpp"

namespace piblocks {

/// Samples of 16 bits are rounded to 8.
/// @throws IoError if the file cannot be read, MediaError if it is no PNG or above kMaxFrame_px.
Image read_png(const std::filesystem::path& path);

/// Keeps samples of 16 bits. @throws as read_png(), and MediaError if the file is animated.
AnyImage read_png_samples(const std::filesystem::path& path);

/// Whether the file is a PNG with more than one frame, all of which only read_video() reads.
/// @throws as read_png().
bool is_animated_png(const std::filesystem::path& path);

/// PNG files, one frame each, in this order.
std::unique_ptr<FrameReader> read_png_files(std::vector<std::filesystem::path> paths);

}  // namespace piblocks
