#include <fcntl.h>
#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <unistd.h>
#include <zlib.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <span>
#include <system_error>
#include <utility>

#include "core/output_file.hpp"
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

/// A new folder inside `parent`, and so on the same device.
fs::path make_folder_in(const fs::path& parent) {
  std::string name = parent / "frames.part-XXXXXX";
  if (::mkdtemp(name.data()) != nullptr) return name;
  throw UsageError(fmt::format("output: cannot write into '{}': {}", parent.string(),
                               std::generic_category().message(errno)));
}

/// Owns an open file and closes it when an exception passes.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const noexcept { return number_; }
  int close() noexcept { return ::close(std::exchange(number_, -1)); }

 private:
  int number_;
};

/// Writes a whole new file; not yet synced to its device.
void write_file(const fs::path& path, std::span<const std::uint8_t> bytes) {
  Descriptor file(::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
  if (file.get() < 0) fail("make", path, errno);
  while (!bytes.empty()) {
    const ssize_t written = ::write(file.get(), bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail("write", path, errno);
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
  if (file.close() != 0) fail("close", path, errno);
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
      : pattern_(std::move(pattern)),
        folder_(pattern_.folder().empty() ? "." : pattern_.folder()),
        made_folders_(folder_),
        temporary_(make_folder_in(folder_)) {}
  ~PngSequence() override;
  PngSequence(const PngSequence&) = delete;
  PngSequence& operator=(const PngSequence&) = delete;

  void append(const EncodedChunk& chunk) override;
  void finish() override;

 private:
  void sync() const;
  void check_destinations() const;
  void move_into_place();

  FramePattern pattern_;
  fs::path folder_;
  MadeFolders made_folders_;
  fs::path temporary_;  // holds the files until they take their names; empty afterwards
  FrameCounter counter_;
  std::int64_t files_ = 0;
};

PngSequence::~PngSequence() {
  std::error_code ignored;
  if (!temporary_.empty()) fs::remove_all(temporary_, ignored);
}

void PngSequence::append(const EncodedChunk& chunk) {
  counter_.take(chunk);
  for (const Packet& packet : chunk) {
    write_file(temporary_ / pattern_.name(kFirstNumber + packet.pts), packet.bytes);
    ++files_;
  }
}

void PngSequence::finish() {
  sync();
  check_destinations();
  move_into_place();
  std::error_code error;
  fs::remove(temporary_, error);
  if (error) fail("remove", temporary_, error.value());
  temporary_.clear();
  made_folders_.keep();
}

/// One call for the whole file system: a sync for each of thousands of files takes far longer.
void PngSequence::sync() const {
  const Descriptor folder(::open(temporary_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (folder.get() < 0) fail("open", temporary_, errno);
  if (::syncfs(folder.get()) != 0) fail("sync", temporary_, errno);
}

/// Finds what renaming would fail on before the first file is renamed.
void PngSequence::check_destinations() const {
  for (std::int64_t i = 0; i < files_; ++i) {
    const fs::path to = folder_ / pattern_.name(kFirstNumber + i);
    std::error_code none;
    if (fs::is_directory(fs::symlink_status(to, none))) fail("replace", to, EISDIR);
  }
}

void PngSequence::move_into_place() {
  for (std::int64_t i = 0; i < files_; ++i) {
    const std::string name = pattern_.name(kFirstNumber + i);
    if (::rename((temporary_ / name).c_str(), (folder_ / name).c_str()) == 0) continue;
    const int error_number = errno;
    std::error_code ignored;
    for (std::int64_t j = 0; j < i; ++j) {
      fs::remove(folder_ / pattern_.name(kFirstNumber + j), ignored);
    }
    fail("rename", folder_ / name, error_number);
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
