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
  /// One of encoder_names(). "builtin" is our own, the one that encodes only what changes.
  std::optional<std::string> encoder = {};
  /// Of the first of numbered pictures, 0 … kMaxStartNumber; else 1. What follows the last one then
  /// stays, as part of a longer sequence.
  std::optional<int> start_number = {};
  /// How often a GIF, APNG or WebP plays, 1 … kMaxPlays; else for ever.
  std::optional<int> plays = {};
};

inline constexpr int kMaxStartNumber = 999'999'999;
inline constexpr int kMaxPlays = 65535;

/// What an encoder is for: MP4 and MOV, WebM, MOV with alpha, or sound.
enum class EncoderKind : std::uint8_t { h264, webm, prores, sound };

/// Names of the encoders that can be used on this machine, the default first. Of sound: that of MP4
/// and MOV, that of WebM.
std::vector<std::string> encoder_names(EncoderKind kind);

/// The picture as a PNG file: 8-bit RGB in sRGB, with alpha if the view has it. Equal pixels give
/// equal bytes. The colours, which PNG does not multiply by alpha, are rounded to the nearest.
/// @throws MediaError if memory for the compressor runs out.
std::vector<std::uint8_t> encode_png(const ImageView& image);

}  // namespace piblocks
