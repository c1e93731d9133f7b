// Everything that needs libav or giflib, loaded when it is first asked for.
// libavcodec brings some 90 libraries with it, which take 15 ms to load: a still, a count or a PNG
// sequence does without. libavformat comes later still (av.hpp).
#pragma once

#include <piblocks/encode.hpp>

#include <functional>
#include <memory>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "h264/encoder.hpp"
#include "h264/mp4_writer.hpp"
#include "media/output/output_kinds.hpp"
#include "media/pixels/frame_reader.hpp"

namespace piblocks {

/// AAC of a soundtrack, for our own MP4 files.
struct AacSound {
  std::string signature;  ///< of the encoder
  h264::Mp4Sound track;
  std::function<std::unique_ptr<PacketSource>(SampleSource& samples)> encode;
};

/// The functions of the module.
struct AvModule {
  const char* version;  ///< kVersion of the build; if it is another, nothing else may be touched
  // output_kinds.hpp; the first is mp4_output() for what our own encoder does not make
  Output (*mp4_output)(const OutputRequest& request);
  Output (*mov_output)(const OutputRequest& request);
  Output (*webm_output)(const OutputRequest& request);
  Output (*webp_output)(const OutputRequest& request);
  Output (*framehash_output)(const OutputRequest& request);
  /// @throws UsageError if libavcodec has no encoder
  AacSound (*aac_sound)(const SoundFormat& format);
  /// MakeSuccessor
  std::unique_ptr<ChunkEncoder> (*h264_successor)(const VideoFormat& format,
                                                  const h264::Config& config);
  // The module's sides of the functions below, and of media_library_versions().
  std::unique_ptr<FrameReader> (*read_video)(const std::string& path, const std::stop_token& stop);
  std::string (*hash_of_bytes)(ByteSpan bytes);
  std::vector<std::string> (*encoder_names)(EncoderKind kind);
  std::vector<std::string> (*library_versions)();
};

/// The name of the module's one symbol, a function that returns const AvModule*.
inline constexpr const char* kAvModuleEntry = "piblocks_av_module";

/// Loads the module, once for the process. Thread-safe. It may be where the binary's own search
/// path says, beside the binary that this code is part of, or where the build was to install it.
/// @throws MediaError if it is in none of these places, or of another version.
const AvModule& av_module();

// What follows loads the module, and throws as av_module().

/// The first video stream of any file that libavformat reads; or an animated PNG, without the
/// module.
/// @param stop  breaks off a call that waits, such as for somebody to write to a pipe.
/// @throws IoError, MediaError
std::unique_ptr<FrameReader> read_video(const std::string& path, const std::stop_token& stop = {});

/// 32 hexadecimal digits that tell pictures apart, the same on every machine; can be forged.
std::string hash_of_bytes(ByteSpan bytes);

// The module's own functions, behind those above. Only the module and tests link them.

/// mp4_output() by libavformat and one of libavcodec's encoders.
Output mp4_output_by_libav(const OutputRequest& request);
AacSound aac_sound(const SoundFormat& format);
/// libavcodec's encoder for a stream of this config; null if there is none.
std::unique_ptr<ChunkEncoder> h264_successor(const VideoFormat& format, const h264::Config& config);
/// read_video()
std::unique_ptr<FrameReader> decode_video_file(const std::string& path,
                                               const std::stop_token& stop = {});
struct VideoInput;
/// The frames of a GIF, each a whole picture.
std::unique_ptr<FrameReader> read_gif(const std::string& path, std::unique_ptr<VideoInput> input);
/// hash_of_bytes()
std::string compute_hash(ByteSpan bytes);
/// encoder_names()
std::vector<std::string> usable_encoders(EncoderKind kind);
/// Name and version of each library that the module needs.
std::vector<std::string> av_library_versions();

}  // namespace piblocks
