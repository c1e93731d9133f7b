// The module's side of av_module.hpp.
#include <piblocks/version.hpp>

#include "media/libav/av.hpp"
#include "media/libav/av_module.hpp"
#include "media/output/output_kinds.hpp"

extern "C" const piblocks::AvModule* piblocks_av_module() {
  using namespace piblocks;
  static constexpr AvModule kModule = {.version = kVersion,
                                       .mp4_output = mp4_output_by_libav,
                                       .mov_output = mov_output,
                                       .webm_output = webm_output,
                                       .webp_output = webp_output,
                                       .framehash_output = framehash_output,
                                       .aac_sound = aac_sound,
                                       .h264_successor = h264_successor,
                                       .read_video = decode_video_file,
                                       .hash_of_bytes = compute_hash,
                                       .encoder_names = usable_encoders,
                                       .library_versions = av_library_versions};
  silence_av();
  return &kModule;
}
