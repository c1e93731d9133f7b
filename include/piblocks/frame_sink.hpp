// Where frames go: MP4, PNG sequence, y4m, frame hashes, or nowhere.
// In: chunks of consecutive frames, each encoded on its own by any thread. Out: one output,
// written in order by one thread, that bears its final name only when it is complete.
#pragma once

#include <piblocks/exact.hpp>
#include <piblocks/image.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace piblocks {

/// What every frame of an output has in common.
struct VideoFormat {
  int width_px = 1920;       ///< 1 … kMaxSide_px
  int height_px = 1080;      ///< 1 … kMaxSide_px
  Rational frame_rate = 60;  ///< frames per second, > 0
};

/// What may be said to a video encoder; unset means the measured default.
struct EncoderSettings {
  std::optional<double> crf = {};           ///< constant rate factor, 0 (lossless) … 51
  std::optional<std::string> preset = {};   ///< the encoder's own name for a speed
  std::optional<std::string> encoder = {};  ///< libavcodec's name of the encoder
};

/// A piece of encoded output: one video frame, one image file, one line of text.
struct Packet {
  std::vector<std::uint8_t> bytes;
  std::int64_t pts = 0;  ///< index of the frame it shows
  std::int64_t dts = 0;  ///< order of decoding, in frames; may start below zero
  bool key_frame = true;
};

/// The packets of one chunk, in the order they are to be written.
using EncodedChunk = std::vector<Packet>;

/// Turns consecutive frames into packets. Knows no other chunk, so the bytes it makes do not
/// depend on what else is being encoded. Used by one thread at a time.
class ChunkEncoder {
 public:
  virtual ~ChunkEncoder() = default;
  /// The view need only be valid during the call.
  /// @param changed  rectangles that cover every pixel in which the frame differs from the one
  ///                 added before. A chunk's first frame is taken whole.
  /// @throws MediaError if the encoder refuses the frame.
  virtual void add(const ImageView& frame, std::span<const PixelRect> changed) = 0;
  /// The same for a frame that may differ everywhere.
  void add(const ImageView& frame) {
    const PixelRect whole{0, 0, frame.width_px, frame.height_px};
    add(frame, {&whole, 1});
  }
  /// The chunk's packets; call once, after the last add().
  virtual EncodedChunk finish() = 0;
};

/// One output being written. Destroying it before finish() removes every trace of it.
class FrameSink {
 public:
  virtual ~FrameSink() = default;
  /// Frames in every chunk but the last: how far frames of this output depend on each other.
  virtual std::int64_t frames_per_chunk() const = 0;
  /// An encoder for the chunk that starts at frame `first_frame`. Thread-safe.
  virtual std::unique_ptr<ChunkEncoder> begin_chunk(std::int64_t first_frame) const = 0;
  /// Writes the next chunk; chunks must come in the order of their frames.
  /// @throws IoError, MediaError if it cannot be written.
  virtual void append(const EncodedChunk& chunk) = 0;
  /// Completes the output and gives it its final name.
  /// @throws IoError, MediaError if that fails; the output is then removed.
  virtual void finish() = 0;
};

/// Opens the output whose kind `output` names:
/// `*.mp4`, `*.png` with one integer field such as `%06d`, `*.y4m`, `-` (y4m on standard
/// output), `*.framehash`, or the word `null`.
/// PNG files are numbered from 1, as FFmpeg numbers them; the rest counts frames from 0. Settings
/// are for `*.mp4` alone.
/// @throws UsageError if the name has no known kind, the format does not suit the kind, no
///         encoder is there, or the output cannot be opened; nothing is left behind then.
std::unique_ptr<FrameSink> open_sink(const std::string& output, const VideoFormat& format,
                                     const EncoderSettings& settings);

/// Names of the H.264 encoders that the linked libavcodec offers for MP4, the default first.
std::vector<std::string> h264_encoders();

/// Name and version of each codec library that is linked, such as "libavcodec 59.37.100".
std::vector<std::string> media_library_versions();

}  // namespace piblocks
