#include "media/png/png_file.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <cerrno>
#include <csetjmp>
#include <cstdint>
#include <cstring>
#include <new>
#include <system_error>
#include <utility>

#include "core/system_error.hpp"

namespace piblocks {
namespace fs = std::filesystem;

PngFile::PngFile(fs::path path)
    : path_(std::move(path)),
      file_(open(path_)),
      png_(png_create_read_struct(PNG_LIBPNG_VER_STRING, this, on_error, on_warning)) {
  if (png_ != nullptr) info_ = png_create_info_struct(png_);
  if (info_ == nullptr) {
    close();
    throw std::bad_alloc();
  }
  try {
    run(&PngFile::read_header);
    check_size();
  } catch (...) {
    close();
    throw;
  }
}

PngFile::~PngFile() { close(); }

void PngFile::close() { png_destroy_read_struct(&png_, &info_, nullptr); }

std::unique_ptr<std::FILE, PngFile::FileCloser> PngFile::open(const fs::path& path) {
  std::error_code error;
  if (fs::is_directory(path, error)) error = std::make_error_code(std::errc::is_a_directory);
  std::unique_ptr<std::FILE, FileCloser> file(error ? nullptr : std::fopen(path.c_str(), "rbe"));
  if (!file && !error) error.assign(errno, std::generic_category());
  if (!file) {
    throw IoError(fmt::format("png: cannot read '{}': {}", path.string(), error.message()));
  }
  return file;
}

void PngFile::on_error(png_structp png, png_const_charp message) {
  auto& self = *static_cast<PngFile*>(png_get_error_ptr(png));
  std::strncpy(self.message_.data(), message, self.message_.size() - 1);
  png_longjmp(png, 1);
}

void PngFile::run(Step step) {
  // NOLINTNEXTLINE(cert-err52-cpp): libpng offers nothing else
  if (setjmp(png_jmpbuf(png_)) == 0) {
    (this->*step)();
    return;
  }
  fail(message_.data());
}

void PngFile::fail(const std::string& reason) const {
  if (std::ferror(file_.get()) != 0) {
    throw IoError(fmt::format("png: cannot read '{}': {}", path_.string(), text_of_error(EIO)));
  }
  throw MediaError(fmt::format("png: cannot read '{}': {}", path_.string(), reason));
}

void PngFile::read_header() {
  png_init_io(png_, file_.get());
  // tRNS is no critical chunk, but pixels depend on it.
  png_set_crc_action(png_, PNG_CRC_ERROR_QUIT, PNG_CRC_ERROR_QUIT);
  png_set_keep_unknown_chunks(png_, PNG_HANDLE_CHUNK_ALWAYS,
                              reinterpret_cast<png_const_bytep>("acTL"), 1);
  png_read_info(png_, info_);
}

void PngFile::check_size() const {
  const std::int64_t width = png_get_image_width(png_, info_);
  const std::int64_t height = png_get_image_height(png_, info_);
  if (width > kMaxSide_px || height > kMaxSide_px || width * height > kMaxFrame_px) {
    fail(fmt::format("{}x{} is too large", width, height));
  }
}

bool PngFile::is_deep() const { return png_get_bit_depth(png_, info_) == 16; }

bool PngFile::is_animated() const {
  png_unknown_chunkp chunks = nullptr;
  const int count = png_get_unknown_chunks(png_, info_, &chunks);
  return std::any_of(chunks, chunks + count, [](const png_unknown_chunk& chunk) {
    // The number of frames comes first.
    return std::memcmp(chunk.name, "acTL", 4) == 0 && chunk.size >= 4 &&
           png_get_uint_32(chunk.data) > 1;
  });
}

/// Samples in the order of words 0xAARRGGBB on a little-endian machine.
void PngFile::read_rows() {
  if (is_flat_) png_set_scale_16(png_);
  png_set_expand(png_);  // palettes, greys of less than 8 bits, tRNS
  png_set_gray_to_rgb(png_);
  constexpr png_uint_32 kOpaque = 0xffff;
  png_set_add_alpha(png_, kOpaque, PNG_FILLER_AFTER);
  png_set_bgr(png_);
  png_set_swap(png_);
  const int passes = png_set_interlace_handling(png_);
  png_read_update_info(png_, info_);
  const png_uint_32 height = png_get_image_height(png_, info_);
  for (int pass = 0; pass < passes; ++pass) {
    for (png_uint_32 y = 0; y < height; ++y) {
      png_read_row(png_, rows_ + y * row_bytes_, nullptr);
    }
  }
  png_read_end(png_, nullptr);
}

void PngFile::read_rows_to(void* rows, std::size_t row_bytes) {
  rows_ = static_cast<png_bytep>(rows);
  row_bytes_ = row_bytes;
  run(&PngFile::read_rows);
}

DeepImage PngFile::read_deep() {
  const png_uint_32 width = png_get_image_width(png_, info_);
  const png_uint_32 height = png_get_image_height(png_, info_);
  DeepImage image{static_cast<int>(width), static_cast<int>(height), 65535, {}};
  image.words.resize(std::size_t{width} * height);
  read_rows_to(image.words.data(), sizeof(std::uint64_t) * width);
  return image;
}

Image PngFile::read_flat() {
  const png_uint_32 width = png_get_image_width(png_, info_);
  const png_uint_32 height = png_get_image_height(png_, info_);
  Image image{static_cast<int>(width), static_cast<int>(height), {}};
  image.words.resize(std::size_t{width} * height);
  is_flat_ = true;
  read_rows_to(image.words.data(), sizeof(std::uint32_t) * width);
  return image;
}

}  // namespace piblocks
