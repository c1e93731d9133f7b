// What kinds of output share, and the kinds that need no encoder: none, y4m and WAV.
#include "media/output/output_kinds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

#include "h264/mp4_writer.hpp"
#include "media/pixels/yuv.hpp"
#include "media/png/png_chunk.hpp"

namespace piblocks {
namespace {

class NullEncoder final : public ChunkEncoder {
 public:
  using ChunkEncoder::ChunkEncoder;
  void begin(std::int64_t /*first_frame*/) override {}
  void encode() override {}
  EncodedChunk finish() override { return {}; }

 private:
  void convert(const ImageView& /*frame*/, std::span<const PixelRect> /*rects*/) override {}
};

class NullSink final : public FrameSink {
 public:
  void append(const EncodedChunk& /*chunk*/) override {}
  void finish() override {}
};

/// 420mpeg2 is 4:2:0 with chroma sited left. FFmpeg reads XCOLORRANGE.
std::string file_header(const VideoFormat& format) {
  return fmt::format("YUV4MPEG2 W{} H{} F{}:{} Ip A1:1 C420mpeg2 XCOLORRANGE=LIMITED {}\n",
                     format.width_px, format.height_px, format.frame_rate.get_num().get_str(),
                     format.frame_rate.get_den().get_str(), kY4mMatrixTag);
}

class Y4mEncoder final : public PacketPerFrameEncoder {
 public:
  explicit Y4mEncoder(const VideoFormat& format)
      : PacketPerFrameEncoder(format),
        file_header_(file_header(format)),
        planes_(yuv420_bytes(format.width_px, format.height_px)) {}

 private:
  void convert(const ImageView& frame, std::span<const PixelRect> rects) override {
    const auto picture = yuv420_view(planes_.data(), frame.width_px, frame.height_px);
    for (const PixelRect& rect : rects) {
      convert_to_yuv420(frame, chroma_aligned(rect, frame), picture);
    }
  }
  Bytes encode_picture(std::int64_t number) override {
    const std::string header = (number == 0 ? file_header_ : "") + "FRAME\n";
    Bytes bytes;
    bytes.reserve(header.size() + planes_.size());
    append(bytes, header);
    append(bytes, planes_);
    return bytes;
  }

  std::string file_header_;
  Bytes planes_;
};

constexpr int kChannels = 2;
constexpr int kSample_bytes = 3;
constexpr int kPair_bytes = kChannels * kSample_bytes;
constexpr std::int64_t kHeader_bytes = 44;
/// The file's own length field has 32 bits and leaves out the first 8 bytes.
constexpr std::int64_t kMaxFile_bytes = 0xFFFFFFFF;

/// RIFF WAVE with one "fmt " chunk of PCM and one "data" chunk (Multimedia Programming Interface
/// and Data Specifications 1.0, 1991).
Bytes header(const SoundFormat& sound) {
  constexpr int kPcm = 1;
  const std::int64_t data_bytes = sound.size * kPair_bytes;
  Bytes bytes;
  const auto put = [&](std::string_view text, std::int64_t value, std::size_t size_bytes) {
    append(bytes, text);
    append_little_endian(bytes, std::uint64_t(value), size_bytes);
  };
  put("RIFF", kHeader_bytes - 8 + data_bytes, 4);
  put("WAVEfmt ", 16, 4);
  put("", kPcm, 2);
  put("", kChannels, 2);
  put("", sound.rate_hz, 4);
  put("", std::int64_t{sound.rate_hz} * kPair_bytes, 4);
  put("", kPair_bytes, 2);
  put("", 8 * kSample_bytes, 2);
  put("data", data_bytes, 4);
  return bytes;
}

class PcmPackets final : public PacketSource {
 public:
  explicit PcmPackets(SampleSource& samples) : samples_(samples) {}

  std::optional<Packet> next() override {
    constexpr double kFullScale = (1 << (8 * kSample_bytes - 1)) - 1;
    std::array<float, std::size_t{kChannels} * kPcmPacket_pairs> block{};
    const std::size_t count = samples_.read(block) * kChannels;
    if (count == 0) return std::nullopt;
    Packet packet{.bytes = {}, .pts = next_, .dts = next_};
    packet.bytes.reserve(count * kSample_bytes);
    for (std::size_t i = 0; i < count; ++i) {
      const long level = std::lround(kFullScale * std::clamp(double(block[i]), -1.0, 1.0));
      append_little_endian(packet.bytes, std::uint64_t(level), kSample_bytes);
    }
    next_ += std::int64_t(count / kChannels);
    return packet;
  }

 private:
  SampleSource& samples_;
  std::int64_t next_ = 0;
};

class WavSink final : public FrameSink {
 public:
  WavSink(std::string name, SoundFormat format)
      : name_(std::move(name)), format_(std::move(format)), file_(name_) {}

  void take_sound(PacketSource& sound) override { sound_ = &sound; }
  void append(const EncodedChunk& /*chunk*/) override {
    throw MediaError("output: cannot append frames to sound alone");
  }
  void finish() override {
    file_.write(header(format_));
    std::int64_t left_bytes = format_.size * kPair_bytes;
    while (auto packet = sound_ == nullptr ? std::nullopt : sound_->next()) {
      left_bytes -= std::int64_t(packet->bytes.size());
      file_.write(packet->bytes);
    }
    if (left_bytes != 0) {
      throw MediaError(fmt::format("output: the sound of '{}' is not as long as announced", name_));
    }
    file_.finish();
  }

 private:
  std::string name_;
  SoundFormat format_;
  OutputFile file_;
  PacketSource* sound_ = nullptr;
};

}  // namespace

std::string odd_size_problem(const VideoFormat& format, const std::string& what) {
  const int width = format.width_px;
  const int height = format.height_px;
  if (width % 2 == 0 && height % 2 == 0) return {};
  const auto even = [](int side) { return std::max(2, side - side % 2); };
  return fmt::format("output: size {}x{} is odd: {} needs even sides; use {}x{}", width, height,
                     what, even(width), even(height));
}

/// At least 2: decoders take successive IDR pictures with equal headers for one (H.264, 7.4.1.2.4).
int frames_in_a_second(const Rational& frame_rate) {
  constexpr int kMaxFramesPerChunk = 300;
  return int(std::clamp<Integer>(floor(frame_rate), 2, kMaxFramesPerChunk).get_si());
}

std::string no_crf(std::string_view encoder) {
  return fmt::format("video: encoder '{}' has no crf; leave it out", encoder);
}

std::string no_preset(std::string_view encoder) {
  return fmt::format("video: encoder '{}' has no presets; leave the preset out", encoder);
}

void check_duration_of_frame(const Rational& frame_rate) {
  // A frame's duration has 31 bits in libavformat 59 (movenc.c), and in our own files.
  const Integer longest = std::numeric_limits<std::int32_t>::max() - 1;
  const Integer units_per_s = to_integer(h264::mp4_time_scale(frame_rate.get_num().get_si()));
  if (units_per_s / frame_rate <= longest) return;
  const Integer longest_s = longest / units_per_s;
  throw UsageError(
      fmt::format("output: frame rate {} is too low for *.mp4 and *.mov: a frame can last {} s at "
                  "most; use --fps 1/100000 or more, or write *.webm or *.png",
                  frame_rate.get_str(), longest_s.get_str()));
}

std::unique_ptr<PacketSource> pcm_packets(SampleSource& samples) {
  return std::make_unique<PcmPackets>(samples);
}

Output null_output(const OutputRequest& request) {
  return {
      .frames_per_chunk = 64,
      .signature = "null",
      .make_encoder = [format = request.format] { return std::make_unique<NullEncoder>(format); },
      .open = [](const Opening& /*opening*/) { return std::make_unique<NullSink>(); }};
}

Output svg_output(const OutputRequest& request) {
  static constexpr std::string_view kHead = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
  static const auto marked_head = [] {
    Bytes bytes(kHead.begin(), kHead.end());
    append(bytes, "<!-- Software: piblocks render -->\n");
    return bytes;
  }();
  const PictureKind kind = {
      [](ByteSpan svg) {
        Bytes marked = marked_head;
        append(marked, svg.subspan(kHead.size()));
        return marked;
      },
      [](const std::filesystem::path& path) { return has_bytes(path, 0, marked_head); },
      "</svg>\n"};
  return {.frames_per_chunk = 16, .signature = "svg", .open = sequence_of(request, kind)};
}

Output pdf_output(const OutputRequest& request) {
  if (request.name.find('%') != std::string::npos) {
    throw UsageError(fmt::format(
        "output: '{}': a PDF has all frames as its pages; leave '%' out, or write numbered *.svg",
        request.name));
  }
  return {.signature = "pdf"};
}

Output y4m_output(const OutputRequest& request) {
  Problems problems;
  problems.add(odd_size_problem(request.format, "y4m in 4:2:0"));
  problems.check();
  // A frame has 3 MB at 1080p: as few as possible wait to be written.
  Output output = stream_output<Y4mEncoder>(request, 1, "y4m");
  output.notes = {
      "y4m does not say that these colours are BT.709, and most programs take BT.601; tell ffmpeg "
      "and ffplay by -colorspace bt709 before -i"};
  return output;
}

Output wav_output(const OutputRequest& request) {
  const SoundFormat sound = request.sound.value_or(SoundFormat{});
  if (sound.size > (kMaxFile_bytes - kHeader_bytes) / kPair_bytes) {
    throw UsageError(fmt::format(
        "output: '{}' cannot be that long: WAV ends at 4 GiB, which is {} s; write *.mp4 --sound",
        request.name, (kMaxFile_bytes - kHeader_bytes) / kPair_bytes / sound.rate_hz));
  }
  return {
      .signature = "wav",
      .make_encoder = []() -> std::unique_ptr<ChunkEncoder> {
        throw MediaError("output: cannot encode frames as sound");
      },
      .open = [name = request.name, sound](
                  const Opening& /*opening*/) { return std::make_unique<WavSink>(name, sound); },
      .encode_sound = [](SampleSource& samples) { return pcm_packets(samples); },
      .has_frames = false};
}

}  // namespace piblocks
