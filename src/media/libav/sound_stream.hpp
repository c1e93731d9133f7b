// The sound of a video file: its encoder and its stream.
// In: samples, and the time that the pictures have reached. Out: packets in the file, each before
// the first picture that is decoded later.
#pragma once

#include <optional>
#include <string>

#include "media/libav/av.hpp"
#include "media/output/output.hpp"

namespace piblocks {

struct SoundCodec {
  const char* name = nullptr;    ///< libavcodec's name of the encoder
  int bit_rate = 0;              ///< per second; 0 for constant quality
  double quality = 0;            ///< as ffmpeg's -q:a has it, of an encoder without bit_rate
  const char* option = nullptr;  ///< one of the encoder's own, and its value
  const char* value = nullptr;
  AVSampleFormat format = AV_SAMPLE_FMT_FLTP;  ///< of the samples that it takes
  bool is_pcm = false;                         ///< whether pcm_packets() makes its packets
};

/// For MP4 and MOV. The coder takes half the default one's time, and is as true to dense clacks.
/// At constant quality it encodes each packet once; to meet a bit rate it would do so several
/// times.
inline constexpr SoundCodec kAac = {
    .name = "aac", .quality = 2.5, .option = "aac_coder", .value = "fast"};
/// For MOV of ProRes: editors on Linux play no AAC.
inline constexpr SoundCodec kPcm = {
    .name = "pcm_s24le", .format = AV_SAMPLE_FMT_S32, .is_pcm = true};
/// For WebM.
inline constexpr SoundCodec kOpus = {
    .name = "libopus", .bit_rate = 160'000, .format = AV_SAMPLE_FMT_FLT};

/// An encoder of sound that exists and opens.
class SoundEncoder {
 public:
  /// @throws UsageError if libavcodec lacks it.
  SoundEncoder(const SoundCodec& codec, SoundFormat format);

  const SoundFormat& format() const noexcept { return format_; }
  const AVCodecParameters& parameters() const noexcept { return *parameters_; }
  /// Pairs of samples in a packet; the last packet may have fewer.
  int packet_size() const noexcept { return parameters_->frame_size; }
  /// The encoder's name and settings, and libavcodec's version.
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

/// The sound's place in a file that is being written.
class SoundStream {
 public:
  /// Adds the stream to a muxer whose header is not written yet. Encoder and muxer must outlive it.
  /// @param from_zero  whether times count from the first packet; players then skip to sample 0.
  /// @param name       of the file, for messages.
  SoundStream(const SoundEncoder& encoder, AVFormatContext& muxer, bool from_zero,
              std::string name);

  void take(PacketSource& sound) { source_ = &sound; }
  /// Writes the packets that are decoded at that time or before. @throws IoError, MediaError
  void write_until(std::int64_t time, AVRational time_base);
  /// Writes the rest. @throws IoError, MediaError; MediaError if the sound ended too early.
  void write_all();
  std::int64_t packets() const noexcept { return packets_; }

 private:
  bool fetch();
  void write();

  const SoundEncoder& encoder_;
  std::int64_t shift_;  // of time stamps, in samples
  AVFormatContext& muxer_;
  std::string name_;
  AVStream* stream_;
  AvPacketPtr packet_;
  PacketSource* source_ = nullptr;
  std::optional<Packet> next_;
  std::int64_t packets_ = 0;
  bool is_whole_ = false;
};

}  // namespace piblocks
