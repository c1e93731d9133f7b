// Animated PNG: https://wiki.mozilla.org/APNG_Specification, since 2025 part of PNG itself.
#include <fmt/format.h>

#include "media/output/animated_output.hpp"
#include "media/pixels/animation.hpp"
#include "media/pixels/rgb24.hpp"
#include "media/png/png_chunk.hpp"

namespace piblocks {
namespace {

/// A delay is a fraction of two 16-bit numbers.
constexpr int kMaxTerm = 65535;
/// Where acTL stands: behind the signature and IHDR.
constexpr std::uint64_t kAnimationControl = 8 + 25;

/// @param plays  0 for ever
void append_animation_control(Bytes& bytes, std::int64_t images, int plays) {
  const std::size_t chunk = begin_png_chunk(bytes, "acTL");
  append_big_endian(bytes, std::uint64_t(images), 4);
  append_big_endian(bytes, std::uint64_t(plays), 4);
  end_png_chunk(bytes, chunk);
}

constexpr std::size_t kApngPlace_bytes = 16;

/// An image is its size and place, as fcTL has them, and its compressed rows.
class ApngEncoder final : public AnimationEncoder {
 public:
  using AnimationEncoder::AnimationEncoder;

 private:
  Bytes encode_image(const ChangedPicture& picture) override {
    const PixelRect rect = picture.changed();
    const ImageView view = picture.view();
    Bytes bytes;
    for (const int value : {rect.width_px, rect.height_px, rect.x_px, rect.y_px}) {
      append_big_endian(bytes, std::uint64_t(value), 4);
    }
    rows_.clear();
    append_up_filtered(
        rows_, rect.height_px, std::size_t(rect.width_px) * packed_bytes(view.has_alpha),
        [&](int row, std::uint8_t* to) { pack_row(view, rect, rect.y_px + row, to); });
    append(bytes, deflater_.compress(rows_));
    return bytes;
  }

  Deflater deflater_{Deflater::Form::whole};
  Bytes rows_;  // filtered
};

class ApngSink final : public AnimationSink {
 public:
  explicit ApngSink(const OutputRequest& request) : AnimationSink(request, kApngPlace_bytes) {
    const VideoFormat& format = request.format;
    Bytes bytes;
    append_png_header(bytes, format.width_px, format.height_px,
                      format.has_alpha ? PngColors::rgba : PngColors::rgb);
    append_animation_control(bytes, 0, 0);  // write_end() writes the numbers
    append_png_srgb(bytes);
    const std::size_t rate = begin_png_chunk(bytes, "tEXt");
    piblocks::append(bytes, kFrameRateKeyword);
    bytes.push_back(0);
    piblocks::append(bytes, format.frame_rate.get_str());
    end_png_chunk(bytes, rate);
    file().write(bytes);
  }

 private:
  void write_image(Bytes image, std::int64_t first, std::int64_t end) override {
    const ByteSpan place = std::span(image).first(kApngPlace_bytes);
    Bytes bytes;
    // fcTL chunks and the fdAT chunks between them are numbered together.
    const std::size_t control = begin_png_chunk(bytes, "fcTL");
    append_big_endian(bytes, next_sequence_++, 4);
    piblocks::append(bytes, place);
    const Rational& rate = request().format.frame_rate;
    append_big_endian(bytes, std::uint64_t(end - first) * rate.get_den().get_ui(), 2);
    append_big_endian(bytes, rate.get_num().get_ui(), 2);
    bytes.push_back(0);  // stays until the next frame is drawn over it,
    bytes.push_back(0);  // which replaces it
    end_png_chunk(bytes, control);
    const std::size_t data = begin_png_chunk(bytes, first == 0 ? "IDAT" : "fdAT");
    if (first > 0) append_big_endian(bytes, next_sequence_++, 4);
    piblocks::append(bytes, ByteSpan(image).subspan(kApngPlace_bytes));
    end_png_chunk(bytes, data);
    file().write(bytes);
    ++images_;
  }
  void write_end() override {
    Bytes end;
    append_png_chunk(end, "IEND");
    file().write(end);
    Bytes control;
    append_animation_control(control, images_, plays());
    file().write_at(kAnimationControl, control);
  }

  std::uint64_t next_sequence_ = 0;
  std::int64_t images_ = 0;
};

}  // namespace

Output apng_output(const OutputRequest& request) {
  constexpr std::int64_t kFramesPerChunk = 64;
  const Rational& rate = request.format.frame_rate;
  if (rate.get_num() > kMaxTerm || rate.get_den() > kMaxTerm) {
    throw UsageError(
        fmt::format("apng: frame rate {} cannot be stored: use a fraction of numbers up to {}, "
                    "such as 60 or 30000/1001",
                    rate.get_str(), kMaxTerm));
  }
  const std::int64_t longest = kMaxTerm / rate.get_den().get_si();
  return animated_output<ApngEncoder, ApngSink>(request, kFramesPerChunk, longest,
                                                std::string("apng by zlib ") + zlibVersion());
}

}  // namespace piblocks
