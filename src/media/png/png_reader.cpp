#include "media/png/png_reader.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <png.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csetjmp>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "core/descriptor.hpp"
#include "core/input_file.hpp"
#include "media/pixels/animation.hpp"
#include "media/png/png_chunk.hpp"

namespace piblocks {
namespace fs = std::filesystem;
namespace {

/// Mirrored from top to bottom, as libavcodec says it of JPEG.
constexpr std::array<const char*, 8> kTurns = {"",
                                               "mirrored and turned clockwise by 180 degrees",
                                               "turned clockwise by 180 degrees",
                                               "mirrored and turned clockwise by 0 degrees",
                                               "mirrored and turned clockwise by 90 degrees",
                                               "turned clockwise by 90 degrees",
                                               "mirrored and turned clockwise by 270 degrees",
                                               "turned clockwise by 270 degrees"};

using FilePtr = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

FilePtr open_file(const fs::path& path) {
  std::error_code error;
  if (fs::is_directory(path, error)) error = std::make_error_code(std::errc::is_a_directory);
  FilePtr file(error ? nullptr : std::fopen(path.c_str(), "rbe"), std::fclose);
  if (!file && !error) error.assign(errno, std::generic_category());
  if (!file) {
    throw IoError(fmt::format("png: cannot read '{}': {}", path.string(), error.message()));
  }
  return file;
}

struct PngStructs {
  png_structp png = nullptr;
  png_infop info = nullptr;

  PngStructs() = default;
  PngStructs(const PngStructs&) = delete;
  PngStructs& operator=(const PngStructs&) = delete;
  ~PngStructs() { png_destroy_read_struct(&png, &info, nullptr); }
};

/// libpng reports an error by a jump, which runs no destructors. Every call that may fail is made
/// in a step without local objects; members own everything.
class PngFile {
 public:
  explicit PngFile(const fs::path& path) : PngFile(path, open_file(path)) {}
  /// @param path  for messages
  PngFile(fs::path path, FilePtr file) : path_(std::move(path)), file_(std::move(file)) {
    structs_.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, on_error, on_warning);
    if (structs_.png != nullptr) structs_.info = png_create_info_struct(structs_.png);
    if (structs_.info == nullptr) throw std::bad_alloc();
    run(&PngFile::read_header);
    check_size();
  }

  bool has_frame_rate() const {
    png_textp texts = nullptr;
    int count = 0;
    png_get_text(structs_.png, structs_.info, &texts, &count);
    return std::ranges::any_of(std::span(texts, std::size_t(count)),
                               [](const png_text& text) { return text.key == kFrameRateKeyword; });
  }
  bool is_deep() const { return png_get_bit_depth(structs_.png, structs_.info) == 16; }
  /// A file with one image counts as animated if other programs show another picture, or if it is
  /// one of ours, in which the image may stand for several frames.
  bool is_animated() const {
    png_unknown_chunkp chunks = nullptr;
    const int count = png_get_unknown_chunks(structs_.png, structs_.info, &chunks);
    std::uint32_t frames = 0;
    bool begins_with_picture = false;
    for (const png_unknown_chunk& chunk : std::span(chunks, std::size_t(count))) {
      const std::string_view name = reinterpret_cast<const char*>(chunk.name);
      if (name == "acTL" && chunk.size >= 4) frames = png_get_uint_32(chunk.data);
      begins_with_picture = begins_with_picture || name == "fcTL";
    }
    return frames > (begins_with_picture && !has_frame_rate() ? 1 : 0);
  }
  /// FrameReader::presentation()
  std::string presentation() const {
    png_uint_32 bytes = 0;
    png_bytep exif = nullptr;
    if (png_get_eXIf_1(structs_.png, structs_.info, &bytes, &exif) == 0) return {};
    return presentation_by_exif({exif, bytes});
  }
  // Call one of these, once.
  DeepImage read_deep() { return read(DeepImage{.width_px = width(), .height_px = height()}); }
  Image read_flat() {
    is_flat_ = true;
    if (is_palette()) return read_palette();
    return read(Image{.width_px = width(), .height_px = height()});
  }

 private:
  using Step = void (PngFile::*)();

  [[noreturn]] static void on_error(png_structp png, png_const_charp message) {
    auto& self = *static_cast<PngFile*>(png_get_error_ptr(png));
    std::strncpy(self.message_.data(), message, self.message_.size() - 1);
    png_longjmp(png, 1);
  }
  /// libpng leaves out ancillary chunks that are damaged. Pixels depend on these two, though. From
  /// 1.6.48 on, it leaves out some critical ones too, whose names begin with a capital.
  static void on_warning(png_structp png, png_const_charp message) {
    const std::string_view text = message;
    const bool is_critical = 'A' <= *message && *message <= 'Z';
    const bool is_damaged = is_critical && text.ends_with(": CRC error");
    if (is_damaged || text.starts_with("tRNS") || text.starts_with("acTL")) on_error(png, message);
  }

  int width() const { return int(png_get_image_width(structs_.png, structs_.info)); }
  int height() const { return int(png_get_image_height(structs_.png, structs_.info)); }
  void run(Step step) {
    // NOLINTNEXTLINE(cert-err52-cpp): libpng offers nothing else
    if (setjmp(png_jmpbuf(structs_.png)) == 0) {
      (this->*step)();
      return;
    }
    fail(message_.data());
  }
  void read_header() {
    png_init_io(structs_.png, file_.get());
    png_set_crc_action(structs_.png, PNG_CRC_ERROR_QUIT, PNG_CRC_WARN_DISCARD);
    constexpr int kKept = 2;
    png_set_keep_unknown_chunks(structs_.png, PNG_HANDLE_CHUNK_ALWAYS,
                                reinterpret_cast<png_const_bytep>("acTL\0fcTL"), kKept);
    png_read_info(structs_.png, structs_.info);
  }
  void check_size() const {
    const std::int64_t pixels = std::int64_t{width()} * height();
    if (width() <= kMaxSide_px && height() <= kMaxSide_px && pixels <= kMaxFrame_px) return;
    fail(fmt::format("{}x{} is too large", width(), height()));
  }
  bool is_palette() const {
    return png_get_color_type(structs_.png, structs_.info) == PNG_COLOR_TYPE_PALETTE;
  }
  /// Samples in the order of words 0xAARRGGBB on a little-endian machine.
  void set_words() const {
    if (is_flat_) png_set_scale_16(structs_.png);
    png_set_expand(structs_.png);  // greys of less than 8 bits, tRNS
    png_set_gray_to_rgb(structs_.png);
    constexpr png_uint_32 kOpaque = 0xffff;
    png_set_add_alpha(structs_.png, kOpaque, PNG_FILLER_AFTER);
    png_set_bgr(structs_.png);
    png_set_swap(structs_.png);
  }
  void read_rows() {
    if (is_palette()) {
      png_set_packing(structs_.png);  // a byte for each index
    } else {
      set_words();
    }
    const int passes = png_set_interlace_handling(structs_.png);
    png_read_update_info(structs_.png, structs_.info);
    const png_uint_32 height = png_get_image_height(structs_.png, structs_.info);
    for (int pass = 0; pass < passes; ++pass) {
      for (png_uint_32 y = 0; y < height; ++y) {
        png_read_row(structs_.png, rows_ + y * row_bytes_, nullptr);
      }
    }
    png_read_end(structs_.png, nullptr);
  }
  [[noreturn]] void fail(const std::string& reason) const {
    if (std::ferror(file_.get()) != 0) {
      throw IoError(fmt::format("png: cannot read '{}': {}", path_.string(), error_text(EIO)));
    }
    throw MediaError(fmt::format("png: cannot read '{}': {}", path_.string(), reason));
  }

  template <typename Picture>
  Picture read(Picture picture) {
    picture.words.resize(std::size_t(picture.width_px) * std::size_t(picture.height_px));
    rows_ = reinterpret_cast<png_bytep>(picture.words.data());
    row_bytes_ = sizeof picture.words[0] * std::size_t(picture.width_px);
    run(&PngFile::read_rows);
    return picture;
  }
  /// Expands the palette here, since libpng does not check indices when it does.
  Image read_palette() {
    Image picture{width(), height(), {}};
    std::vector<std::uint8_t> indices(std::size_t(width()) * std::size_t(height()));
    rows_ = indices.data();
    row_bytes_ = std::size_t(width());
    run(&PngFile::read_rows);
    const std::vector<std::uint32_t> colors = palette();
    picture.words.reserve(indices.size());
    for (const std::uint8_t index : indices) {
      if (index >= colors.size()) {
        fail(fmt::format("a pixel has colour {} of a palette of {}", index, colors.size()));
      }
      picture.words.push_back(colors[index]);
    }
    return picture;
  }
  /// As words 0xAARRGGBB.
  std::vector<std::uint32_t> palette() const {
    png_colorp colors = nullptr;
    int count = 0;
    png_bytep alphas = nullptr;
    int alpha_count = 0;
    png_get_PLTE(structs_.png, structs_.info, &colors, &count);
    png_get_tRNS(structs_.png, structs_.info, &alphas, &alpha_count, nullptr);
    std::vector<std::uint32_t> words;
    for (int i = 0; i < count; ++i) {
      const std::uint32_t alpha = i < alpha_count ? alphas[i] : 255;
      words.push_back(alpha << 24 | std::uint32_t{colors[i].red} << 16 |
                      std::uint32_t{colors[i].green} << 8 | colors[i].blue);
    }
    return words;
  }

  fs::path path_;
  FilePtr file_;
  PngStructs structs_;
  std::array<char, 128> message_{};
  // Where read_rows() puts the rows.
  png_bytep rows_ = nullptr;
  std::size_t row_bytes_ = 0;
  bool is_flat_ = false;
};

/// @param path  for messages
PngFile file_in_memory(const fs::path& path, ByteSpan bytes) {
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-const-cast): fmemopen() only reads in mode "r"
  auto* const memory = const_cast<std::uint8_t*>(bytes.data());
  FilePtr file(::fmemopen(memory, bytes.size(), "rb"), std::fclose);
  if (!file) throw std::bad_alloc();
  return {path, std::move(file)};
}

AnyImage samples_of(PngFile& file) {
  if (file.is_deep()) return file.read_deep();
  return file.read_flat();
}

/// One frame.
class PngReader final : public FrameReader {
 public:
  enum class Place { on_disk, in_memory };

  PngReader(fs::path path, Bytes file, Place place)
      : path_(std::move(path)), file_(std::move(file)), place_(place) {}

  bool next() override {
    if (std::exchange(is_read_, true)) return false;
    if constexpr (kReadsPackedPng) {
      if (auto packed = read_packed_png(place_ == Place::in_memory ? file_ : std::move(file_))) {
        samples_ = *std::move(packed);
        return true;
      }
    }
    PngFile file = place_ == Place::in_memory ? file_in_memory(path_, file_) : PngFile(path_);
    if (file.is_animated()) {
      throw MediaError(fmt::format(
          "png: cannot read '{}' as one picture: it is animated; compare it by itself, as a video",
          path_.string()));
    }
    samples_ = samples_of(file);
    presentation_ = file.presentation();  // the chunk may follow the pixels
    return true;
  }
  std::string presentation() const override { return presentation_; }
  AnyImage samples() override { return std::move(samples_); }

 private:
  fs::path path_;
  Bytes file_;
  Place place_;
  std::string presentation_;
  bool is_read_ = false;
  AnyImage samples_;
};

}  // namespace

std::string presentation_by_exif(ByteSpan exif) {
  constexpr std::uint64_t kOrientation = 0x112;
  constexpr std::size_t kEntry_bytes = 12;
  // A TIFF structure says in which order it has the bytes of its numbers.
  const bool is_big = !exif.empty() && exif[0] == 'M';
  const auto number_at = [&](std::size_t offset,
                             std::size_t size_bytes) -> std::optional<std::uint64_t> {
    if (offset > exif.size() || size_bytes > exif.size() - offset) return std::nullopt;
    const ByteSpan number = exif.subspan(offset, size_bytes);
    return is_big ? from_big_endian(number) : from_little_endian(number);
  };
  const auto directory = number_at(4, 4);
  const auto count = directory ? number_at(*directory, 2) : std::nullopt;
  for (std::size_t i = 0; i < count.value_or(0); ++i) {
    const std::size_t entry = *directory + 2 + i * kEntry_bytes;
    if (number_at(entry, 2) != kOrientation) continue;
    const std::uint64_t value = number_at(entry + 8, 2).value_or(0);
    return 1 <= value && value <= kTurns.size() ? kTurns.at(value - 1) : "";
  }
  return {};
}

Image read_png(const fs::path& path) { return PngFile(path).read_flat(); }

AnyImage read_png_samples(const fs::path& path, std::span<const std::uint8_t> bytes) {
  PngFile png = file_in_memory(path, bytes);
  return samples_of(png);
}

bool is_png_file(const fs::path& path) {
  return beginning_of(path, kPngSignature.size()) == kPngSignature;
}

bool is_animated_png(const fs::path& path) { return PngFile(path).is_animated(); }

std::unique_ptr<FrameReader> read_png_frame(fs::path path, Bytes file) {
  return std::make_unique<PngReader>(std::move(path), std::move(file), PngReader::Place::on_disk);
}

std::unique_ptr<FrameReader> read_png_bytes(std::string name, Bytes file) {
  return std::make_unique<PngReader>(std::move(name), std::move(file), PngReader::Place::in_memory);
}

}  // namespace piblocks
