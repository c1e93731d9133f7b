// Where frames go: a video, an animated picture, a sequence, frame hashes, or nowhere.
// In: chunks of consecutive frames, each encoded by any thread. Out: one output, written in order
// by one thread, which gets its final name only when it is complete.
#pragma once

#include <piblocks/encode.hpp>
#include <piblocks/exact.hpp>
#include <piblocks/image.hpp>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/file_set.hpp"
#include "media/output/bytes.hpp"

namespace piblocks {

class OverwriteCheck;
struct CodedSound;

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
  /// What the samples have been encoded to, for MP4 of our own encoder; null: they are still to be.
  std::shared_ptr<const CodedSound> coded = {};
};

/// A text that is shown from a frame on until the next one; an empty text is none.
struct Caption {
  std::int64_t frame;
  std::string text;
};

/// The samples of a soundtrack. Used by one thread at a time.
class SampleSource {
 public:
  virtual ~SampleSource() = default;
  /// Writes the next samples, left and right in turn, from -1 to 1.
  /// @return how many pairs; fewer than there is room for only at the end.
  virtual std::size_t read(std::span<float> samples) = 0;
};

/// One video frame, one image file, one line of text, or some sound, encoded.
struct Packet {
  Bytes bytes;
  std::int64_t pts = 0;  ///< index of the frame it shows, or of its first pair of samples
  std::int64_t dts = 0;  ///< order of decoding, in frames or samples; may start below zero
  bool key_frame = true;
};

/// In the order of writing.
using EncodedChunk = std::vector<Packet>;

/// The packets of a soundtrack, in order. Used by one thread at a time.
class PacketSource {
 public:
  virtual ~PacketSource() = default;
  /// The next packet; nothing after the last.
  virtual std::optional<Packet> next() = 0;
};

/// Turns consecutive frames into packets, one chunk after another. A chunk's bytes depend on its
/// frames, their numbers and, if Output says so, the frame before, not on the chunks before. Used
/// by one thread at a time.
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
  ///                 taken before, in this chunk or the last; of the very first frame, all
  /// @throws MediaError if the frame is not of the size of the output.
  void take(const ImageView& frame, std::span<const PixelRect> changed);
  /// The same if all pixels may differ.
  void take(const ImageView& frame);
  /// Encodes that picture as the chunk's next frame. @throws MediaError if the encoder refuses it.
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
};

/// An output being written. Destroying it before finish() removes every trace of it, unless it was
/// opened to be resumed.
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
  /// So many frames, from the first on, have been left by an earlier run: append() begins behind
  /// them.
  virtual std::int64_t kept_frames() const { return 0; }
  /// What finish() did to the files of an earlier output, such as "removed 12 pictures of an
  /// earlier run"; empty if it did nothing.
  virtual std::string aftermath() const { return {}; }
};

/// Checks that an output gets every frame once and in order.
class FrameCounter {
 public:
  /// @param frames  those that it has already.
  explicit FrameCounter(std::int64_t frames = 0) : frames_(frames) {}
  /// @throws MediaError if the chunk does not start where the last one ended.
  void take(const EncodedChunk& chunk);
  std::int64_t frames() const noexcept { return frames_; }

 private:
  std::int64_t frames_;
};

/// Output::encode_sound of outputs without sound: throws MediaError.
[[noreturn]] std::unique_ptr<PacketSource> reject_sound(SampleSource& samples);

/// What a sink is opened for.
struct Opening {
  std::int64_t frames = 0;  ///< at most so many
  /// Of numbered pictures: whether they go on with those of an earlier run.
  Resumption resumption = {};
};

/// How frames become packets, and where the packets go.
struct Output {
  std::int64_t frames_per_chunk = 1;
  /// The kind, what makes the bytes, and its version, in one line: packets of outputs with the same
  /// format, settings and signature can be mixed.
  std::string signature;
  /// Makes an encoder for one worker; it must not outlive the output. Thread-safe. There is none of
  /// vectors: packets are SVG files, or, without `open`, frames are pages of a PDF file.
  std::function<std::unique_ptr<ChunkEncoder>()> make_encoder = {};
  /// A sink; it must not outlive the output.
  /// @throws UsageError if it cannot be opened; nothing is left behind then.
  std::function<std::unique_ptr<FrameSink>(const Opening&)> open = {};
  /// The packets that this output makes of a soundtrack; both must outlive them.
  /// @throws MediaError if the output was set up without sound, or its encoder cannot be opened.
  std::function<std::unique_ptr<PacketSource>(SampleSource& samples)> encode_sound = reject_sound;
  bool has_frames = true;  ///< if false, no frames may be encoded or appended
  /// Whether an encoder has to take() the frame before a chunk's first one, if there is one, ahead
  /// of begin().
  bool needs_frame_before = false;
  std::vector<std::string> notes = {};  ///< as Rendered's
};

/// Sets up the output whose kind the name tells (the table in output.cpp), such as `*.mp4`, `*.png`
/// with one integer field such as `%06d`, `-` (y4m on standard output) or `null`.
/// @param overwrite  whether pictures may replace files that are no pictures of a sequence.
/// @param captions   that the file itself is to have, in order
/// @throws UsageError if the name has no known kind, the format or the settings do not suit the
///         kind, or there is no encoder.
Output set_up_output(const std::string& name, const VideoFormat& format,
                     const EncoderSettings& settings, const std::optional<SoundFormat>& sound = {},
                     bool overwrite = false, const std::vector<Caption>& captions = {});

// Of an output of this name, whether it
bool is_sound_alone(const std::string& name);  ///< has no pictures: `*.wav`
bool has_numbers(const std::string& name);     ///< is numbered pictures
bool is_vector(const std::string& name);       ///< holds vectors: `*.svg`, `*.pdf`
bool has_parts(const std::string& name);       ///< can be joined of parts
bool takes_sound(const std::string& name);     ///< can have sound
/// The message for a name that cannot.
std::string no_sound_in(const std::string& name);

/// The highest frame rate that an output of this name can show; nothing if there is no limit.
std::optional<int> max_frame_rate_of(const std::string& name);

/// Enters the files of an output into the check that no input is overwritten.
/// @param what  the output's part in the command, for messages.
void claim_output(OverwriteCheck& check, const std::string& what, const std::string& name);

/// Name and version of each codec library, such as "libavcodec 59.37.100".
std::vector<std::string> media_library_versions();

}  // namespace piblocks
