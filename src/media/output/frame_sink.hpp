// Where frames go: a video, an animated picture, a sequence, frame hashes, or nowhere.
// In: chunks of consecutive frames, each encoded by any thread. Out: one output, written in order
// by one thread, which gets its final name only when it is complete.
#pragma once

#include <piblocks/encode.hpp>
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
  bool has_alpha = false;    ///< as ImageView's
};

/// Sound in stereo, which begins with the first frame.
struct SoundFormat {
  int rate_hz = 48000;
  std::int64_t size = 0;  ///< pairs of samples, >= 0
};

/// The samples of a soundtrack. Used by one thread at a time.
class SampleSource {
 public:
  virtual ~SampleSource() = default;
  /// Writes the next samples, left and right in turn, from -1 to 1.
  /// @return how many pairs; fewer than there is room for only at the end.
  virtual std::size_t read(std::span<float> samples) = 0;
};

/// A piece of encoded output: one video frame, one image file, one line of text, some sound.
struct Packet {
  std::vector<std::uint8_t> bytes;
  std::int64_t pts = 0;  ///< index of the frame it shows, or of its first pair of samples
  std::int64_t dts = 0;  ///< order of decoding, in frames or samples; may start below zero
  bool key_frame = true;
};

/// The packets of one chunk, in the order of writing.
using EncodedChunk = std::vector<Packet>;

/// The packets of a soundtrack, in order. Used by one thread at a time.
class PacketSource {
 public:
  virtual ~PacketSource() = default;
  /// The next packet; nothing after the last.
  virtual std::optional<Packet> next() = 0;
};

/// Turns consecutive frames into packets, one chunk after another. A chunk's bytes depend on its
/// frames and their numbers alone, not on the chunks before. Used by one thread at a time.
class ChunkEncoder {
 public:
  explicit ChunkEncoder(const VideoFormat& format)
      : width_px_(format.width_px), height_px_(format.height_px) {}
  virtual ~ChunkEncoder() = default;
  ChunkEncoder(const ChunkEncoder&) = delete;
  ChunkEncoder& operator=(const ChunkEncoder&) = delete;

  /// Starts the chunk whose first frame has this number.
  /// @throws MediaError if the encoder cannot be opened.
  virtual void begin(std::int64_t first_frame) = 0;
  /// Updates the picture that the encoder keeps from frame to frame.
  /// @param changed  rectangles that cover every pixel in which the frame differs from the one
  ///                 taken before, in this chunk or the last. The very first is taken whole.
  /// @throws MediaError if the frame is not of the size of the output.
  void take(const ImageView& frame, std::span<const PixelRect> changed);
  /// Encodes that picture as the chunk's next frame.
  /// @throws MediaError if the encoder refuses it.
  virtual void encode() = 0;
  /// The chunk's packets.
  virtual EncodedChunk finish() = 0;
  /// How the last finished chunk was encoded, if the encoder has several ways.
  virtual std::string method() const { return {}; }

 protected:
  virtual void convert(const ImageView& frame, std::span<const PixelRect> rects) = 0;

 private:
  int width_px_;
  int height_px_;
  bool is_empty_ = true;
};

/// An output being written. Destroying it before finish() removes every trace of it.
class FrameSink {
 public:
  virtual ~FrameSink() = default;
  /// Call this before append() if the output was set up with sound.
  /// @param sound  must live until finish() returns.
  /// @throws MediaError if the output has no place for sound.
  virtual void take_sound(PacketSource& sound);
  /// Writes the next chunk; chunks must come in the order of their frames.
  /// @throws IoError, MediaError if it cannot be written.
  virtual void append(const EncodedChunk& chunk) = 0;
  /// Completes the output and gives it its final name.
  /// @throws IoError, MediaError if that fails; the output is then removed.
  virtual void finish() = 0;
};

/// How frames become packets, and where the packets go.
class Output {
 public:
  virtual ~Output() = default;
  /// How many frames are encoded together, since they depend on each other.
  virtual std::int64_t frames_per_chunk() const = 0;
  /// Makes an encoder for one worker; it must not outlive the output. Thread-safe.
  virtual std::unique_ptr<ChunkEncoder> make_encoder() const = 0;
  /// If false, no frames may be encoded or appended.
  virtual bool has_frames() const { return true; }
  /// The packets that this output makes of a soundtrack. `samples` must outlive them.
  /// @throws MediaError if the output was set up without sound, or its encoder cannot be opened.
  virtual std::unique_ptr<PacketSource> encode_sound(SampleSource& samples) const;
  /// The kind, what makes the bytes, and its version, in one line: packets of outputs with the same
  /// format, settings and signature can be mixed.
  virtual std::string signature() const = 0;
  /// The sink must not outlive the output.
  /// @throws UsageError if it cannot be opened; nothing is left behind then.
  virtual std::unique_ptr<FrameSink> open() const = 0;
};

}  // namespace piblocks
