// Sound that was encoded elsewhere, as by a browser, for our own MP4 files.
// In: its packets. Out: the same, one after the other.
#pragma once

#include <memory>
#include <vector>

#include "h264/mp4_writer.hpp"
#include "media/output/output.hpp"

namespace piblocks {

struct CodedSound {
  h264::Mp4Sound track;  ///< the file says for itself how many samples are heard
  std::vector<Bytes> packets;
};

/// Those that the track needs. @param sound  must outlive them
std::unique_ptr<PacketSource> packets_of(const CodedSound& sound, const SoundFormat& format);

}  // namespace piblocks
