// Animated PNG: https://wiki.mozilla.org/APNG_Specification, since 2025 part of PNG itself.
#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/output_file.hpp"
#include "media/output/intra_encoder.hpp"
#include "media/output/output_kinds.hpp"
#include "media/pixels/changed_picture.hpp"
#include "media/pixels/rgb24.hpp"
#include "media/png/deflate.hpp"
#include "media/png/png_chunk.hpp"

namespace piblocks {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// A chunk begins with a whole picture. A second or so, as in a video.
constexpr std::int64_t kApngFramesPerChunk = 64;
/// A delay is a fraction of two numbers of 16 bits.
constexpr int kMaxTerm = 65535;

constexpr std::size_t kSignature_bytes = 8;
constexpr std::size_t kIhdr_bytes = 25;

/// How many frames there are, and that they are shown over and over.
Bytes animation_control(std::int64_t frames) {
  Bytes chunk;
  const std::size_t start = begin_png_chunk(chunk, "acTL");
  append_u32(chunk, static_cast<std::uint32_t>(frames));
  append_u32(chunk, 0);
  end_png_chunk(chunk, start);
  return chunk;
}

class ApngEncoder final : public IntraEncoder {
 public:
  explicit ApngEncoder(const VideoFormat& format)
      : IntraEncoder(format),
        format_(format),
        picture_(format.width_px, format.height_px, ChangedPicture::Marks::none),
        stream_(open_deflate(DeflateForm::zlib)) {}

  void begin(std::int64_t first_frame) override {
    IntraEncoder::begin(first_frame);
    is_whole_ = true;
  }

 private:
  void convert(const ImageView& frame, std::span<const PixelRect> rects) override {
    picture_.take(frame, rects);
  }
  std::vector<std::uint8_t> encode_picture(std::int64_t number) override;
  void append_frame_control(Bytes& bytes, std::int64_t number, const PixelRect& rect) const;
  void filter(const PixelRect& rect);
  void append_deflated(Bytes& bytes);

  VideoFormat format_;
  ChangedPicture picture_;
  DeflatePtr stream_;
  bool is_whole_ = true;
  Bytes rows_;  // filtered
};

Bytes ApngEncoder::encode_picture(std::int64_t number) {
  const PixelRect rect = std::exchange(is_whole_, false) ? picture_.whole() : picture_.changed();
  picture_.settle();
  filter(rect);
  Bytes bytes;
  if (number == 0) {
    append_png_header(bytes, format_.width_px, format_.height_px, format_.has_alpha);
    const Bytes control = animation_control(0);  // the sink knows better
    bytes.insert(bytes.end(), control.begin(), control.end());
    append_png_srgb(bytes);
  }
  append_frame_control(bytes, number, rect);
  const std::size_t data = begin_png_chunk(bytes, number == 0 ? "IDAT" : "fdAT");
  if (number > 0) append_u32(bytes, static_cast<std::uint32_t>(2 * number));
  append_deflated(bytes);
  end_png_chunk(bytes, data);
  return bytes;
}

/// The control chunks of frames and the data of all but the first are numbered together.
void ApngEncoder::append_frame_control(Bytes& bytes, std::int64_t number,
                                       const PixelRect& rect) const {
  const std::size_t control = begin_png_chunk(bytes, "fcTL");
  append_u32(bytes, number == 0 ? 0 : static_cast<std::uint32_t>(2 * number - 1));
  append_u32(bytes, static_cast<std::uint32_t>(rect.width_px));
  append_u32(bytes, static_cast<std::uint32_t>(rect.height_px));
  append_u32(bytes, static_cast<std::uint32_t>(rect.x_px));
  append_u32(bytes, static_cast<std::uint32_t>(rect.y_px));
  append_u16(bytes, static_cast<std::uint32_t>(format_.frame_rate.get_den().get_ui()));
  append_u16(bytes, static_cast<std::uint32_t>(format_.frame_rate.get_num().get_ui()));
  bytes.push_back(0);  // stays until the next frame is put over it,
  bytes.push_back(0);  // which replaces it
  end_png_chunk(bytes, control);
}

/// By filter Up, as in a sequence of PNG files: it leaves zeros wherever a row equals the one
/// above.
void ApngEncoder::filter(const PixelRect& rect) {
  constexpr std::uint8_t kUp = 2;
  const std::size_t row_bytes = std::size_t(rect.width_px) * (format_.has_alpha ? 4 : 3);
  const auto pack = format_.has_alpha ? pack_rgba32 : pack_rgb24;
  Bytes above(row_bytes);
  Bytes current(row_bytes);
  rows_.resize((row_bytes + 1) * std::size_t(rect.height_px));
  std::uint8_t* to = rows_.data();
  for (int y = rect.y_px; y < rect.y_px + rect.height_px; ++y) {
    pack(reinterpret_cast<const std::uint8_t*>(picture_.row(y) + rect.x_px), rect.width_px,
         current.data());
    *to++ = kUp;
    subtract_bytes(current.data(), above.data(), row_bytes, to);
    to += row_bytes;
    current.swap(above);
  }
}

void ApngEncoder::append_deflated(Bytes& bytes) {
  z_stream& stream = *stream_;
  deflateReset(&stream);
  const std::size_t start = bytes.size();
  bytes.resize(start + deflateBound(&stream, rows_.size()));
  stream.next_in = rows_.data();
  stream.avail_in = static_cast<uInt>(rows_.size());
  stream.next_out = bytes.data() + start;
  stream.avail_out = static_cast<uInt>(bytes.size() - start);
  if (deflate(&stream, Z_FINISH) != Z_STREAM_END) throw MediaError("apng: cannot compress a frame");
  bytes.resize(bytes.size() - stream.avail_out);
}

/// Writes the packets one after another, and in the end how many there were.
class ApngSink final : public FrameSink {
 public:
  explicit ApngSink(const std::string& name) : file_(name) {}

  void append(const EncodedChunk& chunk) override {
    counter_.take(chunk);
    for (const Packet& packet : chunk) file_.write(packet.bytes);
    frames_ += static_cast<std::int64_t>(chunk.size());
  }
  void finish() override {
    Bytes end;
    end_png_chunk(end, begin_png_chunk(end, "IEND"));
    file_.write(end);
    file_.overwrite(kSignature_bytes + kIhdr_bytes, animation_control(frames_));
    file_.finish();
  }

 private:
  FrameCounter counter_;
  OutputFile file_;
  std::int64_t frames_ = 0;
};

class ApngOutput final : public Output {
 public:
  explicit ApngOutput(OutputRequest request) : request_(std::move(request)) {}
  std::int64_t frames_per_chunk() const override { return kApngFramesPerChunk; }
  std::unique_ptr<ChunkEncoder> make_encoder() const override {
    return std::make_unique<ApngEncoder>(request_.format);
  }
  std::string signature() const override { return fmt::format("apng by zlib {}", zlibVersion()); }
  std::unique_ptr<FrameSink> open() const override {
    return std::make_unique<ApngSink>(request_.name);
  }

 private:
  OutputRequest request_;
};

}  // namespace

std::unique_ptr<Output> apng_output(const OutputRequest& request) {
  const Rational& rate = request.format.frame_rate;
  if (rate.get_num() > kMaxTerm || rate.get_den() > kMaxTerm) {
    throw UsageError(
        fmt::format("apng: frame rate {} cannot be stored: use a fraction of numbers up to {}, "
                    "such as 60 or 30000/1001",
                    rate.get_str(), kMaxTerm));
  }
  return std::make_unique<ApngOutput>(request);
}

}  // namespace piblocks
