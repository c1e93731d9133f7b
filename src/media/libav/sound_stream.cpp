#include "media/libav/sound_stream.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <new>
#include <utility>

namespace piblocks {

SoundStream::SoundStream(const SoundEncoder& encoder, AVFormatContext& muxer, bool from_zero,
                         std::string name)
    : encoder_(encoder),
      shift_(from_zero ? encoder.parameters().initial_padding : 0),
      muxer_(muxer),
      name_(std::move(name)),
      stream_(avformat_new_stream(&muxer, nullptr)),
      packet_(own_av<AvPacketPtr>(av_packet_alloc(), "packet")) {
  if (stream_ == nullptr) throw std::bad_alloc();
  check_av(avcodec_parameters_copy(stream_->codecpar, &encoder_.parameters()),
           "describe the sound of", name_);
  stream_->time_base = {1, encoder_.format().rate_hz};
}

bool SoundStream::fetch() {
  if (!next_ && source_ != nullptr) next_ = source_->next();
  return next_.has_value();
}

void SoundStream::write_until(std::int64_t time, AVRational time_base) {
  const AVRational samples = {1, encoder_.format().rate_hz};
  while (fetch() && av_compare_ts(next_->dts + shift_, samples, time, time_base) <= 0) write();
}

void SoundStream::write_all() {
  while (fetch()) write();
  if (is_whole_ || encoder_.format().size == 0) return;
  throw MediaError(
      fmt::format("sound: cannot write to '{}': the end of the sound is missing", name_));
}

void SoundStream::write() {
  av_packet_unref(packet_.get());
  packet_->data = next_->bytes.data();
  packet_->size = static_cast<int>(next_->bytes.size());
  packet_->pts = next_->pts + shift_;
  packet_->dts = next_->dts + shift_;
  // Silence fills up the last packet and is not counted.
  const std::int64_t whole = encoder_.packet_size();
  const std::int64_t size = encoder_.format().size;
  packet_->duration =
      next_->pts < 0 ? whole : std::clamp<std::int64_t>(size - next_->pts, 1, whole);
  is_whole_ = next_->pts >= size - whole;
  packet_->flags = AV_PKT_FLAG_KEY;
  packet_->stream_index = stream_->index;
  av_packet_rescale_ts(packet_.get(), {1, encoder_.format().rate_hz}, stream_->time_base);
  check_av(av_write_frame(&muxer_, packet_.get()), "write to", name_);
  ++packets_;
  next_.reset();
}

}  // namespace piblocks
