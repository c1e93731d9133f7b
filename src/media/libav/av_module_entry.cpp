// The module's side of av_module.hpp.
#include <piblocks/version.hpp>

#include "media/libav/av.hpp"
#include "media/libav/av_module.hpp"
#include "media/libav/byte_hash.hpp"
#include "media/libav/find_encoder.hpp"
#include "media/libav/video_reader.hpp"
#include "media/output/output_kinds.hpp"

extern "C" const piblocks::AvModule* piblocks_av_module() {
  using namespace piblocks;
  static constexpr AvModule kModule = {.version = kVersion,
                                       .mp4_output = mp4_output,
                                       .mov_output = mov_output,
                                       .webm_output = webm_output,
                                       .gif_output = gif_output,
                                       .framehash_output = framehash_output,
                                       .decode_video_file = decode_video_file,
                                       .compute_hash = compute_hash,
                                       .usable_h264_encoders = usable_h264_encoders,
                                       .usable_webm_encoders = usable_webm_encoders,
                                       .usable_prores_encoders = usable_prores_encoders,
                                       .usable_sound_encoders = usable_sound_encoders,
                                       .av_library_versions = av_library_versions};
  silence_av();
  return &kModule;
}
