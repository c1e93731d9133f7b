// Which encoder makes the sound of a file, and how it is set up.
// In: the format of the sound and the codec that a container has for it. Out: packets.
#pragma once

#include "media/libav/av.hpp"
#include "media/output/frame_sink.hpp"

namespace piblocks {

/// What a container has its sound encoded by.
struct SoundCodec {
  const char* name;              ///< libavcodec's name of the encoder
  int bit_rate;                  ///< per second
  const char* option = nullptr;  ///< one of the encoder's own
  const char* value = nullptr;
};

/// For MP4 and MOV. In half the time of the default coder, and as near to the original where clacks
/// are dense.
inline constexpr SoundCodec kAac = {"aac", 192'000, "aac_coder", "fast"};
/// For WebM.
inline constexpr SoundCodec kOpus = {"libopus", 160'000};

/// An encoder that is known to be there, and to open.
class SoundEncoder {
 public:
  /// @throws UsageError if libavcodec lacks it.
  SoundEncoder(const SoundCodec& codec, const SoundFormat& format);

  const SoundFormat& format() const noexcept { return format_; }
  /// What the stream's header says.
  const AVCodecParameters& parameters() const noexcept { return *parameters_; }
  /// Pairs of samples in a packet; the last may stand for less.
  int packet_size() const noexcept { return parameters_->frame_size; }
  /// The encoder's name and bit rate, and libavcodec's version.
  std::string signature() const;
  /// The first packet begins before sample 0, by as much as the encoder needs to get going.
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
