// The module's sides of functions that av_module.hpp and encode.hpp declare.
#pragma once

#include <piblocks/encode.hpp>

#include <cstdint>
#include <memory>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "media/pixels/frame_reader.hpp"

namespace piblocks {

/// read_video()
std::unique_ptr<FrameReader> decode_video_file(const std::string& path,
                                               const std::stop_token& stop = {});
/// hash_of_bytes()
std::string compute_hash(std::span<const std::uint8_t> bytes);
/// encoder_names()
std::vector<std::string> usable_encoders(EncoderKind kind);
/// Name and version of each library that the module needs.
std::vector<std::string> av_library_versions();

}  // namespace piblocks
