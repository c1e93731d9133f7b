// The sound stream of a video file.
// In: packets of sound, and the time that the pictures have reached. Out: packets in the file, each
// before the first picture that is decoded later.
#pragma once

#include <optional>
#include <string>

#include "media/libav/sound_encoder.hpp"

namespace piblocks {

class SoundStream {
 public:
  /// Adds the stream to a muxer whose header is not written yet. Encoder and muxer must outlive it.
  /// @param from_zero  whether times count from the first packet; players then skip what is before
  ///                   sample 0.
  /// @param name       of the file, for messages.
  SoundStream(const SoundEncoder& encoder, AVFormatContext& muxer, bool from_zero,
              std::string name);

  void take(PacketSource& sound) { source_ = &sound; }
  /// Writes the packets that are decoded at that time or before.
  /// @throws IoError, MediaError
  void write_until(std::int64_t time, AVRational time_base);
  /// Writes the rest.
  /// @throws IoError, MediaError; MediaError if the sound ended too early.
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
