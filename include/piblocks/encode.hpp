// Encoders: which there are, what they can be told, and a picture as PNG.
// In: names and settings, or pixels. Out: what a rendering is encoded with, or bytes.
#pragma once

#include <piblocks/image.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace piblocks {

/// Settings of a video encoder; where one is not set, the program's default holds.
struct EncoderSettings {
  /// Constant rate factor, 1 (best) … 51; for WebM whole, 0 … 63.
  std::optional<double> crf = {};
  std::optional<std::string> preset = {};  ///< the encoder's own name for a speed
  /// One of h264_encoders(), webm_encoders() or prores_encoders(). "damage" is the one that encodes
  /// only what changes.
  std::optional<std::string> encoder = {};
};

/// Names of the encoders for MP4 and MOV, the default first.
std::vector<std::string> h264_encoders();
/// The same for WebM.
std::vector<std::string> webm_encoders();
/// The same for MOV with alpha.
std::vector<std::string> prores_encoders();
/// Names of the sound encoders: that of MP4 and MOV, that of WebM.
std::vector<std::string> sound_encoders();

/// The picture as a PNG file: 8-bit RGB in sRGB, with alpha if the view has it. Equal pixels give
/// equal bytes. PNG keeps colours that are not multiplied by alpha; these are rounded to the
/// nearest.
/// @throws MediaError if memory for the compressor runs out.
std::vector<std::uint8_t> encode_png(const ImageView& image);

}  // namespace piblocks
