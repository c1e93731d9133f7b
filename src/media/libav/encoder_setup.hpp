// Which of libavcodec's encoders makes a video's pictures, and how it is set up.
// In: the format of the output and the encoder settings. Out: the encoder, its pixels, its options.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "media/libav/av.hpp"
#include "media/libav/av_module.hpp"
#include "media/output/output_kinds.hpp"

namespace piblocks {

inline constexpr std::string_view kX264 = "libx264";
inline constexpr std::string_view kProres = "prores_ks";

struct EncoderSetup {
  const AVCodec* codec;  ///< libavcodec's, which lives as long as the program
  AVPixelFormat pixel_format;
  int frames_per_chunk;
  /// Applies the settings to an encoder that is not open yet. Thread-safe.
  std::function<void(AVCodecContext& context)> apply;
  /// What may be used if this encoder cannot be opened.
  std::vector<EncoderKind> alternatives;
};

/// H.264 in 4:2:0. @param kinds  of the encoders that may be asked for.
/// @throws UsageError listing everything that is wrong with the size and the settings.
EncoderSetup h264_setup(const VideoFormat& format, const EncoderSettings& settings,
                        const std::vector<EncoderKind>& kinds);
/// ProRes 4444, with alpha if the frames have it.
/// @throws UsageError if a setting is given, or the encoder is missing.
EncoderSetup prores_setup(const VideoFormat& format, const EncoderSettings& settings);
/// VP9 or AV1 in 4:2:0; VP9 with alpha if the frames have it. @throws UsageError as h264_setup().
EncoderSetup webm_setup(const VideoFormat& format, const EncoderSettings& settings);

/// The encoders of all these kinds.
std::vector<std::string> usable_encoders(std::span<const EncoderKind> kinds);

/// Whether the encoder has an option of its own with this name.
bool has_option(const AVCodec& codec, const char* name);
/// Sets it. @throws MediaError if the encoder does not take the value.
void set_option(AVCodecContext& context, const char* name, const std::string& value);

/// Whether the encoder opens for a small picture in 4:2:0. Being registered is not enough: wrappers
/// load what they wrap only when they are opened. @param set_up  sets the encoder's own options.
bool can_be_opened(const AVCodec& codec, const std::function<void(AVCodecContext&)>& set_up = {});

}  // namespace piblocks
