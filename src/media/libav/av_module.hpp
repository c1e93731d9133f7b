// Everything that needs libav or giflib, loaded when it is asked for.
// libavcodec and libavformat bring some 130 libraries with them, which take 30 ms to load: a still,
// a count or a PNG sequence can do without.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "media/output/frame_reader.hpp"
#include "media/output/frame_sink.hpp"
#include "media/output/output_request.hpp"

namespace piblocks {

/// What the module offers: the functions of these names in output_kinds.hpp, video_reader.hpp,
/// byte_hash.hpp and find_encoder.hpp.
struct AvModule {
  const char* version;  ///< kVersion of the build; of another, nothing else here may be touched
  std::unique_ptr<Output> (*mp4_output)(const OutputRequest& request);
  std::unique_ptr<Output> (*mov_output)(const OutputRequest& request);
  std::unique_ptr<Output> (*webm_output)(const OutputRequest& request);
  std::unique_ptr<Output> (*gif_output)(const OutputRequest& request);
  std::unique_ptr<Output> (*framehash_output)(const OutputRequest& request);
  std::unique_ptr<FrameReader> (*decode_video_file)(const std::string& path,
                                                    const std::stop_token& stop);
  std::string (*compute_hash)(std::span<const std::uint8_t> bytes);
  std::vector<std::string> (*usable_h264_encoders)();
  std::vector<std::string> (*usable_webm_encoders)();
  std::vector<std::string> (*usable_prores_encoders)();
  std::vector<std::string> (*usable_sound_encoders)();
  std::vector<std::string> (*av_library_versions)();
};

/// The name of the module's one symbol, a function that returns const AvModule*.
inline constexpr const char* kAvModuleEntry = "piblocks_av_module";

/// Loads the module; once for the process. Thread-safe.
/// It may be where the binary's own search path says, where it is installed beside the binary that
/// this code is part of, or where the build was configured to install it.
/// @throws MediaError if it is in none of these places, or of another version.
const AvModule& av_module();

}  // namespace piblocks
