// Animated PNG (PNG specification, third edition, 11.3.2 and 13): libpng decodes the frames, each
// of which becomes a PNG file in memory.
#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <variant>

#include "media/pixels/animation.hpp"
#include "media/png/png_chunk.hpp"
#include "media/png/png_reader.hpp"

namespace piblocks {
namespace fs = std::filesystem;
namespace {

std::uint32_t big_endian_at(ByteSpan bytes, std::size_t at) {
  return static_cast<std::uint32_t>(from_big_endian(bytes.subspan(at, 4)));
}

[[noreturn]] void fail(const fs::path& path, std::string_view reason) {
  throw MediaError(fmt::format("png: cannot read '{}': {}", path.string(), reason));
}

struct Chunk {
  std::string type;
  Bytes data;
};

/// The chunks that frames depend on, with their checksums checked.
class ChunkReader {
 public:
  explicit ChunkReader(const fs::path& path) : path_(path), file_(path, std::ios::binary) {
    std::error_code error;
    left_ = fs::file_size(path, error);
    std::string signature(kPngSignature.size(), '\0');
    read(signature.data(), signature.size());
    if (signature != kPngSignature) fail(path, "it is no PNG file");
  }

  /// Skips damaged ancillary chunks. Rejects damage in those that frames depend on.
  Chunk next() {
    while (true) {
      Bytes head(8);
      read(head.data(), head.size());
      const std::uint32_t length = big_endian_at(head, 0);
      if (length > left_) cut_off();  // before it asks for memory
      Bytes checked(length + std::size_t{4});
      std::ranges::copy(std::span(head).subspan(4), checked.begin());
      read(checked.data() + 4, length);
      Bytes crc(4);
      read(crc.data(), crc.size());
      const std::string type(checked.begin(), checked.begin() + 4);
      if (big_endian_at(crc, 0) == crc32_z(0, checked.data(), checked.size())) {
        return {type, Bytes(checked.begin() + 4, checked.end())};
      }
      constexpr std::array<std::string_view, 4> kNeeded = {"tRNS", "acTL", "fcTL", "fdAT"};
      const bool is_critical = (checked[0] & 0x20) == 0;
      if (is_critical || std::ranges::find(kNeeded, type) != kNeeded.end()) {
        fail(path_, type + ": CRC error");
      }
    }
  }
  [[noreturn]] void cut_off() const { fail(path_, "it is cut off before its last frame"); }

 private:
  template <typename Byte>
  void read(Byte* bytes, std::size_t count) {
    if (count > left_) cut_off();
    left_ -= count;
    if (!file_.read(reinterpret_cast<char*>(bytes), static_cast<std::streamsize>(count))) {
      throw IoError(fmt::format("png: cannot read '{}'", path_.string()));
    }
  }

  fs::path path_;
  std::ifstream file_;
  std::uintmax_t left_ = 0;
};

class ApngReader final : public FrameReader {
 public:
  explicit ApngReader(const fs::path& path) : path_(path), chunks_(path) {
    const Chunk header = chunks_.next();
    constexpr std::size_t kIhdr_bytes = 13;
    if (header.type != "IHDR" || header.data.size() != kIhdr_bytes) fail(path_, "no header");
    header_ = header.data;
    width_ = big_endian_at(header_, 0);
    height_ = big_endian_at(header_, 4);
    while (!control_) read_before_frames(chunks_.next());
  }

  bool next() override {
    if (more_frames_ > 0) return more_frames_-- > 0;
    if (!control_) return false;
    const FrameControl control = *control_;
    more_frames_ = frames_of_.of_next(duration_s_) - 1;
    show(control, read_frame());
    ++frames_;
    const bool is_last = !control_;
    if (is_last ? frames_ != announced_ : frames_ == announced_) {
      fail(path_, fmt::format("it announces {} frames and has {}", announced_,
                              is_last ? std::to_string(frames_) : "more"));
    }
    return true;
  }
  std::string presentation() const override { return presentation_; }
  AnyImage samples() override {
    return std::visit([](const auto* picture) { return AnyImage(*picture); }, shown_);
  }

 private:
  void read_before_frames(const Chunk& chunk) {
    if (chunk.type == "acTL") {
      if (chunk.data.size() != 8) fail(path_, "acTL: invalid length");
      announced_ = big_endian_at(chunk.data, 0);
    } else if (chunk.type == "PLTE" || chunk.type == "tRNS") {
      append_png_chunk(shared_, chunk.type, chunk.data);
    } else if (chunk.type == "tEXt") {
      const std::string text(chunk.data.begin(), chunk.data.end());
      const std::string keyword = std::string(kFrameRateKeyword) + '\0';
      if (text.starts_with(keyword)) frames_of_.set_rate(text.substr(keyword.size()));
    } else if (chunk.type == "eXIf") {
      presentation_ = presentation_by_exif(chunk.data);
    } else if (chunk.type == "fcTL") {
      take_control(chunk.data);
    } else if (chunk.type == "IDAT") {
      is_default_over_ = true;  // this picture is no frame
    } else if (chunk.type == "fdAT" || chunk.type == "IEND") {
      fail(path_, "it has no frames");
    }
  }
  /// The frame that control_ describes, as a PNG file. Sets control_ to that of the next one.
  Bytes read_frame() {
    const FrameControl control = *std::exchange(control_, std::nullopt);
    Bytes png;  // empty up to the first data
    const auto add_data = [&](ByteSpan data) {
      if (png.empty()) png = beginning_of(control);
      append_png_chunk(png, "IDAT", data);
    };
    while (!control_) {
      const Chunk chunk = chunks_.next();
      if (chunk.type == "IEND") break;
      if (chunk.type == "fcTL") {
        take_control(chunk.data);
      } else if (chunk.type == "IDAT") {
        if (is_default_over_) fail(path_, "IDAT: out of place");
        add_data(chunk.data);
      } else if (chunk.type == "fdAT") {
        check_sequence(chunk.data, 4);
        add_data(ByteSpan(chunk.data).subspan(4));
        is_default_over_ = true;
      } else if (frames_ == 0 && png.empty()) {
        read_before_frames(chunk);  // these may follow the first fcTL
      }
    }
    if (png.empty()) fail(path_, fmt::format("frame {} has no picture", frames_));
    is_default_over_ = true;
    append_png_chunk(png, "IEND");
    return png;
  }
  Bytes beginning_of(const FrameControl& control) const {
    Bytes png;
    append(png, kPngSignature);
    Bytes size;
    append_big_endian(size, control.width, 4);
    append_big_endian(size, control.height, 4);
    Bytes header = header_;
    std::ranges::copy(size, header.begin());
    append_png_chunk(png, "IHDR", header);
    append(png, shared_);
    return png;
  }
  void take_control(ByteSpan data) {
    constexpr std::size_t kControl_bytes = 26;
    check_sequence(data, kControl_bytes);
    if (data.size() != kControl_bytes) fail(path_, "fcTL: invalid length");
    const FrameControl control{.width = big_endian_at(data, 4),
                               .height = big_endian_at(data, 8),
                               .x = big_endian_at(data, 12),
                               .y = big_endian_at(data, 16),
                               .disposal = Disposal(data[24]),
                               .is_blended = data[25] == 1};
    const bool is_first = next_sequence_ == 1;
    const bool is_default = is_first && !is_default_over_;
    const bool fits = control.width > 0 && control.height > 0 &&
                      std::uint64_t{control.x} + control.width <= width_ &&
                      std::uint64_t{control.y} + control.height <= height_ &&
                      (!is_default || (control.width == width_ && control.height == height_));
    if (!fits || data[24] > 2 || data[25] > 1) fail(path_, "fcTL: invalid values");
    control_ = control;
    const auto numerator = static_cast<int>(from_big_endian(data.subspan(20, 2)));
    const auto denominator = static_cast<int>(from_big_endian(data.subspan(22, 2)));
    duration_s_ = Rational(numerator, denominator == 0 ? 100 : denominator);
    duration_s_.canonicalize();
    // Nothing was there before the first frame.
    if (is_first && control.disposal == Disposal::previous) {
      control_->disposal = Disposal::background;
    }
  }
  /// fcTL and fdAT chunks are numbered together.
  void check_sequence(ByteSpan data, std::size_t least_bytes) {
    if (data.size() < least_bytes || big_endian_at(data, 0) != next_sequence_++) {
      fail(path_, "its frames are out of order");
    }
  }
  void show(const FrameControl& control, const Bytes& png) {
    const AnyImage frame = read_png_samples(path_, png);
    if (const auto* const flat = std::get_if<Image>(&frame)) {
      if (!flat_) flat_.emplace(int(width_), int(height_), Image{});
      shown_ = &flat_->show(control, *flat);
    } else {
      constexpr int kMaxLevel = 65535;
      if (!deep_) deep_.emplace(int(width_), int(height_), DeepImage{.max_level = kMaxLevel});
      shown_ = &deep_->show(control, std::get<DeepImage>(frame));
    }
  }

  fs::path path_;
  ChunkReader chunks_;
  Bytes header_;  // of the file
  Bytes shared_;  // chunks that every frame needs
  std::string presentation_;
  std::uint32_t width_ = 0;
  std::uint32_t height_ = 0;
  std::uint32_t announced_ = 0;
  std::uint32_t frames_ = 0;  // that have been read
  ImageFrames frames_of_;
  std::int64_t more_frames_ = 0;  // that show the last one
  std::uint32_t next_sequence_ = 0;
  bool is_default_over_ = false;         // IDAT can be no frame any more
  std::optional<FrameControl> control_;  // of the next frame
  Rational duration_s_;                  // its own
  // Only one of them is used: all frames have the depth of the file.
  std::optional<Screen<Image>> flat_;
  std::optional<Screen<DeepImage>> deep_;
  std::variant<const Image*, const DeepImage*> shown_;
};

}  // namespace

std::unique_ptr<FrameReader> read_apng(const fs::path& path) {
  if (!is_animated_png(path)) fail(path, "it is not animated");  // and checks its size
  return std::make_unique<ApngReader>(path);
}

}  // namespace piblocks
