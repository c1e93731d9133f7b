#include "media/output/frame_sink.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

namespace piblocks {

void ChunkEncoder::take(const ImageView& frame, std::span<const PixelRect> changed) {
  if (frame.width_px != width_px_ || frame.height_px != height_px_) {
    throw MediaError(fmt::format("output: cannot take frame: it is {}x{}, the output {}x{}",
                                 frame.width_px, frame.height_px, width_px_, height_px_));
  }
  const PixelRect whole{0, 0, width_px_, height_px_};
  convert(frame, is_empty_ ? std::span(&whole, 1) : changed);
  is_empty_ = false;
}

void FrameSink::take_sound(PacketSource& /*sound*/) {
  throw MediaError("output: cannot take sound: it has no place for any");
}

std::unique_ptr<PacketSource> Output::encode_sound(SampleSource& /*samples*/) const {
  throw MediaError("output: cannot encode sound: it has no place for any");
}

}  // namespace piblocks
