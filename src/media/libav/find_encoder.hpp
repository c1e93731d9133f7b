// The encoders that the linked libavcodec offers.
// In: a name, or none. Out: an encoder of H.264 that takes yuv420p.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "media/libav/av.hpp"

namespace piblocks {

/// The encoder that is taken if there is a choice.
inline constexpr std::string_view kX264 = "libx264";
/// Our own, which codes what changes; its stream has the headers of libx264.
inline constexpr std::string_view kDamage = "damage";

/// What h264_encoders() gives.
std::vector<std::string> usable_h264_encoders();
/// Those of H.264 and those of ProRes.
std::vector<std::string> usable_mov_encoders();
/// What webm_encoders() gives.
std::vector<std::string> usable_webm_encoders();
/// What prores_encoders() gives.
std::vector<std::string> usable_prores_encoders();
/// What sound_encoders() gives.
std::vector<std::string> usable_sound_encoders();

/// Whether the encoder opens for a small picture in 4:2:0. Being registered is not enough: wrappers
/// load what they wrap only when they are opened.
/// @param set_up  sets its own options before.
bool can_be_opened(const AVCodec& codec, const std::function<void(AVCodecContext&)>& set_up = {});

/// libavcodec's encoder of that name, or the first of its own. The object is libavcodec's and
/// lives as long as the program.
/// @param usable  names those that may be asked for.
/// @throws UsageError if there is none, or it is not one of these; the message lists them.
const AVCodec& find_encoder(const std::optional<std::string>& name,
                            std::vector<std::string> (*usable)());

}  // namespace piblocks
