// One PNG file, read by libpng.
// In: a path. Out: its samples as they are stored.
#pragma once

#include <png.h>

#include <array>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include "media/pixels/samples.hpp"

namespace piblocks {

/// libpng reports an error by a jump, which runs no destructors: every call that may fail is made
/// in a step that has no objects, and all that is owned belongs to members.
class PngFile {
 public:
  /// @throws IoError, MediaError as read_png().
  explicit PngFile(std::filesystem::path path);
  ~PngFile();
  PngFile(const PngFile&) = delete;
  PngFile& operator=(const PngFile&) = delete;

  bool is_deep() const;
  bool is_animated() const;
  /// Of 16 bits: all of them. Call only one of these, once.
  DeepImage read_deep();
  /// Of 16 bits: rounded to 8.
  Image read_flat();

 private:
  struct FileCloser {
    // NOLINTNEXTLINE(cppcoreguidelines-owning-memory): this is the owner
    void operator()(std::FILE* file) const noexcept { std::fclose(file); }
  };
  using Step = void (PngFile::*)();

  static std::unique_ptr<std::FILE, FileCloser> open(const std::filesystem::path& path);
  [[noreturn]] static void on_error(png_structp png, png_const_charp message);
  static void on_warning(png_structp /*png*/, png_const_charp /*message*/) {}

  void run(Step step);
  void read_header();
  void read_rows();
  void read_rows_to(void* rows, std::size_t row_bytes);
  void close();
  void check_size() const;
  [[noreturn]] void fail(const std::string& reason) const;

  std::filesystem::path path_;
  std::unique_ptr<std::FILE, FileCloser> file_;
  std::array<char, 128> message_{};
  png_structp png_;
  png_infop info_ = nullptr;
  // Where the rows go, which read_rows() must not own.
  png_bytep rows_ = nullptr;
  std::size_t row_bytes_ = 0;
  bool is_flat_ = false;
};

}  // namespace piblocks
