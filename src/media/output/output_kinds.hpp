// The kinds of output: the functions that set them up, and what several of them share.
// In: a request whose name the kind matches. Out: the output, set up but not opened.
#pragma once

#include <piblocks/error.hpp>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/output_file.hpp"
#include "media/output/output.hpp"

namespace piblocks {

/// Delays are whole hundredths of a second, and viewers show less than two as ten.
inline constexpr int kMaxFrameRate_gif = 50;
/// Viewers show less than 11 milliseconds as 100.
inline constexpr int kMaxFrameRate_webp = 90;

/// The arguments of set_up_output(), already known to be in range.
struct OutputRequest {
  std::string name;
  VideoFormat format;
  EncoderSettings settings;
  std::optional<SoundFormat> sound = {};
  bool overwrite = false;
  std::vector<Caption> captions = {};
};

/// Collects everything that is wrong, to report it at once.
class Problems {
 public:
  /// @param problem  empty if nothing is wrong.
  void add(std::string problem) {
    if (!problem.empty()) problems_.push_back(std::move(problem));
  }
  /// @throws UsageError if anything is wrong.
  void check() const {
    if (!problems_.empty()) throw UsageError(problems_);
  }

 private:
  std::vector<std::string> problems_;
};

/// Empty if both sides are even, as 4:2:0 needs; else what is wrong and which size to use.
/// @param what  what needs it, such as "H.264 in 4:2:0".
std::string odd_size_problem(const VideoFormat& format, const std::string& what);

/// Frames of a closed group of pictures that lasts about a second; 2 to 300.
int frames_in_a_second(const Rational& frame_rate);

/// @throws UsageError if a frame lasts longer than *.mp4 and *.mov can say.
void check_duration_of_frame(const Rational& frame_rate);

// Messages about a setting that an encoder does not take.
std::string no_crf(std::string_view encoder);
std::string no_preset(std::string_view encoder);

/// Makes one packet of each frame.
class PacketPerFrameEncoder : public ChunkEncoder {
 public:
  using ChunkEncoder::ChunkEncoder;
  void begin(std::int64_t first_frame) override { next_frame_ = first_frame; }
  void encode() final {
    const std::int64_t number = next_frame_++;
    chunk_.push_back({.bytes = encode_picture(number), .pts = number, .dts = number});
  }
  EncodedChunk finish() final { return std::exchange(chunk_, {}); }

 private:
  /// The bytes of a picture. @param number  of the frame, from 0.
  virtual Bytes encode_picture(std::int64_t number) = 0;

  std::int64_t next_frame_ = 0;
  EncodedChunk chunk_;
};

/// The bytes of all packets, in one file or on standard output.
class StreamSink final : public FrameSink {
 public:
  /// @throws UsageError if the file cannot be opened.
  explicit StreamSink(const std::string& name) : file_(name) {}

  void append(const EncodedChunk& chunk) override {
    counter_.take(chunk);
    for (const Packet& packet : chunk) file_.write(packet.bytes);
  }
  void finish() override { file_.finish(); }

 private:
  FrameCounter counter_;
  OutputFile file_;
};

/// An output whose Encoder is made from the format, into a StreamSink.
template <typename Encoder>
Output stream_output(const OutputRequest& request, std::int64_t frames_per_chunk,
                     const std::string& signature) {
  return {.frames_per_chunk = frames_per_chunk,
          .signature = signature,
          .make_encoder = [format = request.format] { return std::make_unique<Encoder>(format); },
          .open = [name = request.name](
                      const Opening& /*opening*/) { return std::make_unique<StreamSink>(name); }};
}

/// Numbered pictures, each a file: how piblocks knows its own.
struct PictureKind {
  Bytes (*with_mark)(ByteSpan picture);
  bool (*has_mark)(const std::filesystem::path& path);
  std::string_view ending;  ///< the last bytes of every file
};

/// The sinks of an output. @throws UsageError if its name is no FramePattern.
decltype(Output::open) sequence_of(const OutputRequest& request, const PictureKind& kind);

// All throw UsageError if the kind cannot hold the format or does not take a setting.
// src/media/README.md says what each kind holds.
Output mp4_output(const OutputRequest& request);
Output mov_output(const OutputRequest& request);
Output webm_output(const OutputRequest& request);
Output gif_output(const OutputRequest& request);
Output apng_output(const OutputRequest& request);
Output webp_output(const OutputRequest& request);
Output png_output(const OutputRequest& request);
Output svg_output(const OutputRequest& request);
Output pdf_output(const OutputRequest& request);
Output y4m_output(const OutputRequest& request);
/// A comment (X…) in the header of our y4m files: y4m has no tag for the matrix. Other programs
/// skip it.
inline constexpr std::string_view kY4mMatrixTag = "XCOLORMATRIX=BT709";
/// As FFmpeg's framehash muxer writes rawvideo rgb24 or, with alpha, rgba, less its #software line.
Output framehash_output(const OutputRequest& request);
Output wav_output(const OutputRequest& request);

/// Pairs of samples in a packet of pcm_packets(); the last may have fewer.
inline constexpr int kPcmPacket_pairs = 4096;
/// Samples of 24 bits, little-endian, left and right in turn: those of a WAV file.
/// @param samples  must outlive the packets.
std::unique_ptr<PacketSource> pcm_packets(SampleSource& samples);
/// Takes frames and keeps nothing: what rendering costs without an output.
Output null_output(const OutputRequest& request);

}  // namespace piblocks
