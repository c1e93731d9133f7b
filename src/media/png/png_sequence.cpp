#include <fmt/format.h>
#include <zlib.h>

#include <filesystem>
#include <span>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "core/output_file.hpp"
#include "media/output/frame_pattern.hpp"
#include "media/output/output_kinds.hpp"
#include "media/output/simple_output.hpp"
#include "media/png/png_encoder.hpp"

namespace piblocks {
namespace fs = std::filesystem;
namespace {

/// Number of the first file, as that of FFmpeg's image2 muxer.
constexpr std::int64_t kFirstNumber = 1;

class PngFrameEncoder final : public PacketPerFrameEncoder {
 public:
  using PacketPerFrameEncoder::PacketPerFrameEncoder;

 private:
  void convert(const ImageView& frame, std::span<const PixelRect> rects) override {
    png_.filter(frame, rects);
  }
  std::vector<std::uint8_t> encode_picture(std::int64_t /*number*/, bool /*is_first*/) override {
    return png_.compress();
  }

  PngEncoder png_;
};

class PngSequence final : public FrameSink {
 public:
  explicit PngSequence(FramePattern pattern)
      : pattern_(std::move(pattern)), files_(pattern_.folder(), pattern_.label()) {}

  void append(const EncodedChunk& chunk) override {
    std::int64_t number = next_number();
    counter_.take(chunk);
    for (const Packet& packet : chunk) files_.add(pattern_.name(number++), packet.bytes);
  }
  void finish() override {
    remove_longer_sequence();
    files_.commit();
  }

 private:
  std::int64_t next_number() const { return kFirstNumber + counter_.frames(); }
  void remove_longer_sequence();

  FramePattern pattern_;
  FileSet files_;
  FrameCounter counter_;
};

/// Pictures of an earlier, longer sequence would look like the end of this one, up to the first
/// gap.
void PngSequence::remove_longer_sequence() {
  std::error_code error;
  for (std::int64_t number = next_number();; ++number) {
    const std::string name = pattern_.name(number);
    const fs::path path = fs::path(pattern_.folder()) / name;
    if (!fs::is_regular_file(fs::symlink_status(path, error))) return;
    files_.remove(name);
  }
}

}  // namespace

std::unique_ptr<Output> png_output(const OutputRequest& request) {
  // So few that little waits to be written, and that the workers end at nearly the same time.
  constexpr std::int64_t kFramesPerChunk = 16;
  return std::make_unique<SimpleOutput>(SimpleOutput::Parts{
      .frames_per_chunk = kFramesPerChunk,
      .signature = fmt::format("png by zlib {}", zlibVersion()),
      .make_encoder = [format =
                           request.format] { return std::make_unique<PngFrameEncoder>(format); },
      .open = [pattern =
                   FramePattern(request.name)] { return std::make_unique<PngSequence>(pattern); }});
}

}  // namespace piblocks
