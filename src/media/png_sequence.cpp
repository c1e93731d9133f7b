#include <fcntl.h>
#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <unistd.h>
#include <zlib.h>

#include <cerrno>
#include <filesystem>
#include <span>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "core/descriptor.hpp"
#include "core/file_set.hpp"
#include "media/frame_pattern.hpp"
#include "media/intra_encoder.hpp"
#include "media/output_kinds.hpp"
#include "media/png_encoder.hpp"

namespace piblocks {
namespace fs = std::filesystem;
namespace {

/// Few frames wait for their turn to be written, and the workers end at nearly the same time.
constexpr std::int64_t kFramesPerChunk = 16;
/// Number of the first file, as that of FFmpeg's image2 muxer.
constexpr std::int64_t kFirstNumber = 1;

[[noreturn]] void fail(const char* operation, const fs::path& path, int error_number) {
  throw IoError(fmt::format("output: cannot {} '{}': {}", operation, path.string(),
                            std::generic_category().message(error_number)));
}

/// Writes a whole new file; not yet synced to its device.
void write_file(const fs::path& path, std::span<const std::uint8_t> bytes) {
  Descriptor file(::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
  if (!file.is_open()) fail("make", path, errno);
  if (const int error = file.write(bytes)) fail("write", path, error);
  if (const int error = file.close()) fail("close", path, error);
}

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
      : pattern_(std::move(pattern)), files_(pattern_.folder(), "frames") {}

  void append(const EncodedChunk& chunk) override;
  void finish() override { files_.commit(); }

 private:
  FramePattern pattern_;
  FileSet files_;
  FrameCounter counter_;
};

void PngSequence::append(const EncodedChunk& chunk) {
  counter_.take(chunk);
  for (const Packet& packet : chunk) {
    write_file(files_.add(pattern_.name(kFirstNumber + packet.pts)), packet.bytes);
  }
}

class PngOutput final : public Output {
 public:
  explicit PngOutput(const OutputRequest& request)
      : format_(request.format), pattern_(request.name) {}
  std::int64_t frames_per_chunk() const override { return kFramesPerChunk; }
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
