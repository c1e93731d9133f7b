#include "media/output/animated_output.hpp"

#include <piblocks/error.hpp>

namespace piblocks {

void AnimationEncoder::begin(std::int64_t first_frame) {
  next_frame_ = first_frame;
  picture_.settle();  // the frame before; nothing follows from it in frame 0
}

void AnimationEncoder::encode() {
  if (next_frame_ == 0) picture_.mark_all();
  const bool has_image = picture_.has_changed() || next_frame_ % most_frames_ == 0;
  chunk_.push_back({.bytes = has_image ? encode_image(picture_) : Bytes(),
                    .pts = next_frame_,
                    .dts = next_frame_});
  ++next_frame_;
  picture_.settle();
}

void AnimationSink::append(const EncodedChunk& chunk) {
  counter_.take(chunk);
  for (const Packet& packet : chunk) {
    if (packet.bytes.empty() && last_.bytes.empty()) {
      throw MediaError("output: the first image is missing");
    }
    if (packet.bytes.empty()) continue;
    if (packet.bytes.size() < least_bytes_) throw MediaError("output: an image is cut off");
    write_last(packet.pts);
    last_ = packet;
  }
}

void AnimationSink::finish() {
  write_last(counter_.frames());
  write_end();
  file_.finish();
}

void AnimationSink::write_last(std::int64_t end) {
  if (!last_.bytes.empty()) write_image(std::move(last_.bytes), last_.pts, end);
}

}  // namespace piblocks
