// Animated PNG: https://wiki.mozilla.org/APNG_Specification, since 2025 part of PNG itself.
#include <fmt/format.h>

#include "media/output/output_kinds.hpp"
#include "media/pixels/changed_picture.hpp"
#include "media/pixels/rgb24.hpp"
#include "media/png/png_chunk.hpp"

namespace piblocks {
namespace {

/// A delay is a fraction of two 16-bit numbers.
constexpr int kMaxTerm = 65535;
/// Where acTL stands: behind the signature and IHDR.
constexpr std::uint64_t kAnimationControl = 8 + 25;

/// @param plays  0 for ever
void append_animation_control(Bytes& bytes, std::int64_t frames, int plays) {
  const std::size_t chunk = begin_png_chunk(bytes, "acTL");
  append_big_endian(bytes, std::uint64_t(frames), 4);
  append_big_endian(bytes, std::uint64_t(plays), 4);
  end_png_chunk(bytes, chunk);
}

class ApngEncoder final : public PacketPerFrameEncoder {
 public:
  explicit ApngEncoder(const VideoFormat& format)
      : PacketPerFrameEncoder(format),
        format_(format),
        picture_(format.width_px, format.height_px) {}

 private:
  void convert(const ImageView& frame, std::span<const PixelRect> rects) override {
    picture_.take(frame, rects);
  }
  Bytes encode_picture(std::int64_t number, bool is_first) override {
    const PixelRect rect = is_first ? picture_.whole() : picture_.changed();
    picture_.settle();
    filter(rect);
    Bytes bytes;
    if (number == 0) {
      append_png_header(bytes, format_.width_px, format_.height_px,
                        format_.has_alpha ? PngColors::rgba : PngColors::rgb);
      append_animation_control(bytes, 0, 0);  // write_trailer() writes the numbers
      append_png_srgb(bytes);
    }
    append_frame_control(bytes, number, rect);
    const std::size_t data = begin_png_chunk(bytes, number == 0 ? "IDAT" : "fdAT");
    if (number > 0) append_big_endian(bytes, std::uint64_t(2 * number), 4);
    append(bytes, deflater_.compress(rows_));
    end_png_chunk(bytes, data);
    return bytes;
  }
  /// fcTL chunks and the fdAT chunks between them are numbered together.
  void append_frame_control(Bytes& bytes, std::int64_t number, const PixelRect& rect) const {
    const std::size_t control = begin_png_chunk(bytes, "fcTL");
    append_big_endian(bytes, number == 0 ? 0 : std::uint64_t(2 * number - 1), 4);
    for (const int value : {rect.width_px, rect.height_px, rect.x_px, rect.y_px}) {
      append_big_endian(bytes, std::uint64_t(value), 4);
    }
    append_big_endian(bytes, format_.frame_rate.get_den().get_ui(), 2);
    append_big_endian(bytes, format_.frame_rate.get_num().get_ui(), 2);
    bytes.push_back(0);  // stays until the next frame is drawn over it,
    bytes.push_back(0);  // which replaces it
    end_png_chunk(bytes, control);
  }
  void filter(const PixelRect& rect) {
    rows_.clear();
    append_up_filtered(rows_, rect.height_px,
                       std::size_t(rect.width_px) * packed_bytes(format_.has_alpha),
                       [&](int row, std::uint8_t* to) {
                         pack_row(picture_.view(format_.has_alpha), rect, rect.y_px + row, to);
                       });
  }

  VideoFormat format_;
  ChangedPicture picture_;
  Deflater deflater_{Deflater::Form::whole};
  Bytes rows_;  // filtered
};

void write_trailer(OutputFile& file, std::int64_t frames, int plays) {
  Bytes end;
  append_png_chunk(end, "IEND");
  file.write(end);
  Bytes control;
  append_animation_control(control, frames, plays);
  file.write_at(kAnimationControl, control);
}

}  // namespace

Output apng_output(const OutputRequest& request) {
  constexpr std::int64_t kFramesPerChunk = 64;  // the first of them whole
  const Rational& rate = request.format.frame_rate;
  if (rate.get_num() > kMaxTerm || rate.get_den() > kMaxTerm) {
    throw UsageError(
        fmt::format("apng: frame rate {} cannot be stored: use a fraction of numbers up to {}, "
                    "such as 60 or 30000/1001",
                    rate.get_str(), kMaxTerm));
  }
  const int plays = request.settings.plays.value_or(0);
  return stream_output<ApngEncoder>(
      request, kFramesPerChunk, fmt::format("apng by zlib {}, plays {}", zlibVersion(), plays),
      [plays](OutputFile& file, std::int64_t frames) { write_trailer(file, frames, plays); });
}

}  // namespace piblocks
