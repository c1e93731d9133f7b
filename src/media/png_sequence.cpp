#include <fcntl.h>
#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <sys/stat.h>
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
#include "core/output_file.hpp"
#include "core/unfinished.hpp"
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
      : pattern_(std::move(pattern)),
        folder_(pattern_.folder().empty() ? "." : pattern_.folder()),
        made_folders_(folder_),
        temporary_(folder_ / "frames", Unfinished::Kind::folder) {}

  void append(const EncodedChunk& chunk) override;
  void finish() override;

 private:
  void sync() const;
  void check_destinations() const;
  void move_into_place() const;
  FramePattern pattern_;
  fs::path folder_;
  MadeFolders made_folders_;
  Unfinished temporary_;  // holds the files until they take their names
  FrameCounter counter_;
  std::vector<std::string> names_;
};

void PngSequence::append(const EncodedChunk& chunk) {
  counter_.take(chunk);
  for (const Packet& packet : chunk) {
    names_.push_back(pattern_.name(kFirstNumber + packet.pts));
    write_file(temporary_.path() / names_.back(), packet.bytes);
  }
}

void PngSequence::finish() {
  sync();
  check_destinations();
  move_into_place();
  made_folders_.keep();
  std::error_code error;
  fs::remove_all(temporary_.path(), error);
  if (error) fail("remove", temporary_.path(), error.value());
  temporary_.release();
  sync_folder(folder_);
}

/// One call for the whole file system: a sync for each of thousands of files takes far longer.
void PngSequence::sync() const {
  if (::syncfs(temporary_.descriptor()) != 0) fail("sync", temporary_.path(), errno);
}

/// Finds what renaming would fail on before the first file is renamed.
void PngSequence::check_destinations() const {
  for (const std::string& name : names_) {
    const fs::path to = folder_ / name;
    std::error_code none;
    if (fs::is_directory(fs::symlink_status(to, none))) fail("replace", to, EISDIR);
  }
}

/// All files take their names, or none does. What else has a name waits among the old ones until
/// all are done. Needs no new memory once it has begun.
class Renaming {
 public:
  Renaming(const fs::path& from, const fs::path& to, const fs::path& old)
      : from_(open_folder(from)), to_(open_folder(to)), old_(open_folder(old)) {}

  /// @return 0, or an errno, and the name is as it was.
  int place(const char* name) const noexcept {
    if (move(to_, old_, name) != 0 && errno != ENOENT) return errno;
    if (move(from_, to_, name) == 0) return 0;
    const int error = errno;
    move(old_, to_, name);
    return error;
  }
  void take_back(const char* name) const noexcept {
    move(to_, from_, name);
    move(old_, to_, name);
  }

 private:
  /// For naming files in it only: that needs no right to read it.
  static Descriptor open_folder(const fs::path& path) {
    Descriptor folder(::open(path.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC));
    if (!folder.is_open()) fail("open", path, errno);
    return folder;
  }
  static int move(const Descriptor& from, const Descriptor& to, const char* name) noexcept {
    return ::renameat(from.get(), name, to.get(), name);
  }

  Descriptor from_;
  Descriptor to_;
  Descriptor old_;
};

void PngSequence::move_into_place() const {
  const fs::path old = temporary_.path() / "old";
  if (::mkdir(old.c_str(), 0777) != 0) fail("make", old, errno);
  const Renaming renaming(temporary_.path(), folder_, old);
  for (std::size_t i = 0; i < names_.size(); ++i) {
    const int error = renaming.place(names_[i].c_str());
    if (error == 0) continue;
    for (std::size_t j = 0; j < i; ++j) renaming.take_back(names_[j].c_str());
    fail("rename to", folder_ / names_[i], error);
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
