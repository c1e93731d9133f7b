// What differs between the versions of libav that the program is built with: FFmpeg 5.1 to 7.1.
// In: libav's objects. Out: what they hold, in whichever field this version keeps it.
#pragma once

#include <cstdint>
#include <span>

#include "media/libav/av.hpp"

namespace piblocks {

bool is_key_frame(const AVFrame& frame) noexcept;

/// Those that an encoder takes; empty if it does not say.
std::span<const AVPixelFormat> pixel_formats_of(const AVCodec& encoder) noexcept;

/// The matrix of 9 numbers that a file asks players to turn its pictures by; null if it has none.
const std::uint8_t* display_matrix_of(const AVStream& stream) noexcept;

}  // namespace piblocks
