#include "media/mp4/coded_sound.hpp"

#include <optional>

namespace piblocks {
namespace {

class CodedPackets final : public PacketSource {
 public:
  CodedPackets(const CodedSound& sound, const SoundFormat& format)
      : sound_(sound), end_(format.size) {}

  std::optional<Packet> next() override {
    const std::int64_t time =
        static_cast<std::int64_t>(next_) * sound_.track.packet_samples - sound_.track.delay;
    if (time >= end_ || next_ == sound_.packets.size()) return std::nullopt;
    return Packet{.bytes = sound_.packets[next_++], .pts = time, .dts = time};
  }

 private:
  const CodedSound& sound_;
  std::int64_t end_;
  std::size_t next_ = 0;
};

}  // namespace

std::unique_ptr<PacketSource> packets_of(const CodedSound& sound, const SoundFormat& format) {
  return std::make_unique<CodedPackets>(sound, format);
}

}  // namespace piblocks
