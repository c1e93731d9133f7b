#include <fmt/format.h>
#include <zlib.h>

#include <filesystem>
#include <span>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "core/file_set.hpp"
#include "media/output/frame_pattern.hpp"
#include "media/output/intra_encoder.hpp"
#include "media/output/output_kinds.hpp"
#include "media/png/png_encoder.hpp"

namespace piblocks {
namespace fs = std::filesystem;
namespace {

/// Few frames wait for their turn to be written, and the workers end at nearly the same time.
constexpr std::int64_t kPngFramesPerChunk = 16;
/// Number of the first file, as that of FFmpeg's image2 muxer.
constexpr std::int64_t kFirstNumber = 1;

class PngFrameEncoder final : public IntraEncoder {
 public:
  using IntraEncoder::IntraEncoder;

 private:
  void convert(const ImageView& frame, std::span<const PixelRect> rects) override {
    png_.filter(frame, rects);
  }
  std::vector<std::uint8_t> encode_picture(std::int64_t /*number*/) override {
    return png_.compress();
  }

  PngEncoder png_;
};

class PngSequence final : public FrameSink {
 public:
  explicit PngSequence(FramePattern pattern)
      : pattern_(std::move(pattern)), files_(pattern_.folder(), pattern_.label()) {}

  void append(const EncodedChunk& chunk) override;
  void finish() override;

 private:
  void remove_longer_sequence();

  FramePattern pattern_;
  FileSet files_;
  FrameCounter counter_;
  std::int64_t next_ = kFirstNumber;  // the number of the next file
};

void PngSequence::append(const EncodedChunk& chunk) {
  counter_.take(chunk);
  for (const Packet& packet : chunk) files_.add(pattern_.name(next_++), packet.bytes);
}

/// Pictures of an earlier, longer sequence would look like the end of this one. What comes after a
/// gap is no part of that.
void PngSequence::remove_longer_sequence() {
  std::error_code error;
  for (std::int64_t number = next_;; ++number) {
    const std::string name = pattern_.name(number);
    const fs::path path = fs::path(pattern_.folder()) / name;
    if (!fs::is_regular_file(fs::symlink_status(path, error))) return;
    files_.remove(name);
  }
}

void PngSequence::finish() {
  remove_longer_sequence();
  files_.commit();
}

class PngOutput final : public Output {
 public:
  explicit PngOutput(const OutputRequest& request)
      : format_(request.format), pattern_(request.name) {}
  std::int64_t frames_per_chunk() const override { return kPngFramesPerChunk; }
  std::unique_ptr<ChunkEncoder> make_encoder() const override {
    return std::make_unique<PngFrameEncoder>(format_);
  }
  std::string signature() const override { return fmt::format("png by zlib {}", zlibVersion()); }
  std::unique_ptr<FrameSink> open() const override {
    return std::make_unique<PngSequence>(pattern_);
  }

 private:
  VideoFormat format_;
  FramePattern pattern_;
};

}  // namespace

std::unique_ptr<Output> png_output(const OutputRequest& request) {
  return std::make_unique<PngOutput>(request);
}

}  // namespace piblocks
