// PNG files as they are stored: no colour profile and no gamma is applied, sRGB is assumed.
// In: files. Out: their samples.
#pragma once

#include <piblocks/image.hpp>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "media/output/bytes.hpp"
#include "media/pixels/frame_reader.hpp"

namespace piblocks {

/// Samples of 16 bits are rounded to 8.
/// Ignores damage in chunks that no pixel depends on, and whatever follows the end.
/// @throws IoError if the file cannot be read, MediaError if it is no PNG, is damaged, or is above
///         kMaxFrame_px.
Image read_png(const std::filesystem::path& path);

/// A PNG file in memory, animated or not, with samples of 16 bits. @param path  for messages
/// @throws as read_png()
AnyImage read_png_samples(const std::filesystem::path& path, std::span<const std::uint8_t> bytes);

/// Whether this is a regular file that begins as a PNG does.
bool is_png_file(const std::filesystem::path& path);

/// Whether the file is a PNG with more than one frame. @throws as read_png().
bool is_animated_png(const std::filesystem::path& path);

/// The frames of an animated PNG, each as it is shown: a whole picture.
/// Reading throws MediaError if a frame is damaged, or if there are fewer or more frames than the
/// file announces.
/// @throws as read_png().
std::unique_ptr<FrameReader> read_apng(const std::filesystem::path& path);

/// FrameReader::presentation() of a picture with these Exif data: what its tag Orientation says
/// (Exif 2.32, 4.6.4). Players obey an eXIf chunk (PNG specification, third edition, 11.3.4.5).
/// Empty if it says nothing that can be understood.
std::string presentation_by_exif(ByteSpan exif);

/// A PNG file as the only frame. Reading throws as read_png(), and MediaError if it is animated.
/// @param file  what is in it; it is opened only if libpng has to read it, or if this is empty.
std::unique_ptr<FrameReader> read_png_frame(std::filesystem::path path, Bytes file = {});

/// A PNG file in memory as the only frame. @param name  for messages
std::unique_ptr<FrameReader> read_png_bytes(std::string name, Bytes file);

}  // namespace piblocks
