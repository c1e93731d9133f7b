// H.264, and sound and captions if wanted, in an MP4 file (ISO/IEC 14496-12 and -15), which is
// written once. In: a stream's headers, its access units one after another, packets of sound,
// texts. Out: bytes, and where they go.
//
// The file: ftyp | free | moov | free | mdat. The index, moov, stands in front, so that a player
// can begin before it has the whole file. Its longest table, stsz, is the last thing in it, and
// grows where it stands while the pictures come; finish() writes the rest directly in front of it,
// and other tracks directly behind it.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "h264/levels.hpp"

namespace piblocks::h264 {

enum class Mp4SoundCodec : std::uint8_t { aac, opus };

/// A track of sound in stereo.
struct Mp4Sound {
  Mp4SoundCodec codec = Mp4SoundCodec::aac;
  int rate_hz;  ///< 1 … 65535; 48000 of Opus
  /// Of AAC, AudioSpecificConfig (ISO/IEC 14496-3), up to 64 bytes. Of Opus, its identification
  /// header (RFC 7845, 5.1) of channel mapping family 0, 19 bytes.
  std::vector<std::uint8_t> config;
  int packet_samples;    ///< of each packet
  int delay;             ///< samples before those that are heard
  std::int64_t samples;  ///< that are heard, 1 … 2^47
};

/// A text that is shown from a picture on until the next one; an empty text is none.
struct Mp4Caption {
  std::int64_t picture;  ///< from 0, below max_pictures; greater than the one before
  std::string text;      ///< UTF-8, up to 65535 bytes
};

/// What an MP4 file says of its tracks.
struct Mp4Track {
  int width_px;      ///< 1 … 65535
  int height_px;     ///< 1 … 65535
  PictureRate rate;  ///< a picture's duration may not exceed 2^31 - 1 units of the time scale
  /// One sequence and one picture parameter set, with start codes: profile_idc 66, 77 or 88.
  std::span<const std::uint8_t> headers;
  /// No more may follow; 1 … 500,000,000. The file has 4 bytes for each.
  std::int64_t max_pictures;
  /// No more IDR pictures may follow; 0: all may be. The file has 4 bytes for each.
  std::int64_t max_key_frames = 0;
  std::optional<Mp4Sound> sound = {};
  std::vector<Mp4Caption> captions = {};
};

/// Its memory does not depend on the number of pictures, but for 4 bytes for each key frame and
/// each packet of sound.
class Mp4Writer {
 public:
  /// Writes bytes into a new file, whose other bytes are zeros, as those of a hole are. No byte is
  /// written twice. If it throws, only the destructor may follow.
  using WriteAt = std::function<void(std::uint64_t offset, std::span<const std::uint8_t> bytes)>;

  /// @throws Error naming what is out of range, and its limits.
  Mp4Writer(const Mp4Track& track, WriteAt write_at);
  ~Mp4Writer();
  Mp4Writer(const Mp4Writer&) = delete;
  Mp4Writer& operator=(const Mp4Writer&) = delete;

  /// Adds the next picture, without parameter sets and access unit delimiters.
  /// @param unit  an access unit with start codes of three or four bytes.
  /// @throws Error if there are more pictures or key frames than there is room for, or
  ///         the unit is empty, does not fit 32 bits, or comes with parameter sets that are not the
  ///         headers'. The file is then as it was before.
  void append(std::span<const std::uint8_t> unit, bool is_idr);
  /// Adds the next packet of sound. It is in front of the next second of pictures that begins.
  /// @throws Error if the file has no sound, or has all packets already.
  void append_sound(std::span<const std::uint8_t> packet);
  /// Writes the index and all that was held back. Only the destructor may follow.
  /// @throws Error if no picture was appended, or no packet of a sound.
  void finish();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// Units a second in which such files count time: the rate's numerator, doubled up to 10,000, as
/// libavformat does.
std::int64_t mp4_time_scale(std::int64_t rate_numerator);

/// Raises level_idc of a sequence parameter set to that of `level`. Does nothing if `level` is null
/// or not higher.
/// @param sequence  a NAL unit without a start code, of 4 bytes or more.
void raise_level(std::span<std::uint8_t> sequence, const Level* level);

}  // namespace piblocks::h264
