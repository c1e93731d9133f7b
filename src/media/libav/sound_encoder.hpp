// The encoder of a file's sound.
// In: the format of the sound and the codec of the container. Out: packets.
#pragma once

#include "media/libav/av.hpp"
#include "media/output/frame_sink.hpp"

namespace piblocks {

struct SoundCodec {
  const char* name = nullptr;    ///< libavcodec's name of the encoder
  int bit_rate = 0;              ///< per second
  const char* option = nullptr;  ///< one of the encoder's own, and its value
  const char* value = nullptr;
};

/// For MP4 and MOV. The coder takes half the time of the default one, and is as near to the
/// original where clacks are dense.
inline constexpr SoundCodec kAac = {
    .name = "aac", .bit_rate = 192'000, .option = "aac_coder", .value = "fast"};
/// For WebM.
inline constexpr SoundCodec kOpus = {.name = "libopus", .bit_rate = 160'000};

/// An encoder that exists and opens.
class SoundEncoder {
 public:
  /// @throws UsageError if libavcodec lacks it.
  SoundEncoder(const SoundCodec& codec, const SoundFormat& format);

  const SoundFormat& format() const noexcept { return format_; }
  const AVCodecParameters& parameters() const noexcept { return *parameters_; }
  /// Pairs of samples in a packet; the last packet may have fewer.
  int packet_size() const noexcept { return parameters_->frame_size; }
  /// The encoder's name and bit rate, and libavcodec's version.
  std::string signature() const;
  /// The first packet begins before sample 0, by the delay of the encoder.
  /// @throws MediaError if the encoder cannot be opened.
  std::unique_ptr<PacketSource> encode(SampleSource& samples) const;

 private:
  AvCodecContextPtr open() const;

  SoundCodec settings_;
  SoundFormat format_;
  const AVCodec* codec_;
  AvParametersPtr parameters_;
};

}  // namespace piblocks
