#include "media/png/png_chunk.hpp"

#include <piblocks/error.hpp>

#include <algorithm>
#include <array>
#include <cerrno>
#include <fstream>
#include <string>
#include <system_error>

#include "core/descriptor.hpp"

namespace piblocks {
namespace fs = std::filesystem;
namespace {

/// The offset of the first chunk after IHDR.
constexpr std::size_t kMark_at = 33;

/// A tEXt chunk (PNG specification, section 11.3.4.3): keyword, zero, text.
Bytes chunk_of(PngMark mark) {
  Bytes text;
  append(text, std::string_view("Software\0", 9));
  append(text, mark == PngMark::sequence ? "piblocks render" : "piblocks compare --diff");
  Bytes chunk;
  append_png_chunk(chunk, "tEXt", text);
  return chunk;
}

}  // namespace

std::size_t begin_png_chunk(Bytes& png, std::string_view type) {
  const std::size_t start = png.size();
  append_big_endian(png, 0, 4);
  append(png, type);
  return start;
}

void end_png_chunk(Bytes& png, std::size_t start) {
  const ByteSpan checked = std::span(png).subspan(start + 4);
  Bytes length;
  append_big_endian(length, checked.size() - 4, 4);
  append_big_endian(png, crc32_z(0, checked.data(), checked.size()), 4);
  std::ranges::copy(length, png.begin() + std::ptrdiff_t(start));
}

void append_png_chunk(Bytes& png, std::string_view type, ByteSpan data) {
  const std::size_t start = begin_png_chunk(png, type);
  append(png, data);
  end_png_chunk(png, start);
}

void append_png_header(Bytes& png, int width_px, int height_px, PngColors colors,
                       std::uint8_t bits) {
  append(png, kPngSignature);
  const std::size_t header = begin_png_chunk(png, "IHDR");
  append_big_endian(png, std::uint64_t(width_px), 4);
  append_big_endian(png, std::uint64_t(height_px), 4);
  append(png, std::array<std::uint8_t, 5>{bits, static_cast<std::uint8_t>(colors), 0, 0, 0});
  end_png_chunk(png, header);
}

void append_png_srgb(Bytes& png) {
  constexpr std::uint8_t kPerceptual = 0;
  append_png_chunk(png, "sRGB", {&kPerceptual, 1});
}

Bytes with_png_mark(ByteSpan png, PngMark mark) {
  const Bytes chunk = chunk_of(mark);
  Bytes marked;
  marked.reserve(png.size() + chunk.size());
  append(marked, png.first(kMark_at));
  append(marked, chunk);
  append(marked, png.subspan(kMark_at));
  return marked;
}

bool has_png_mark(const fs::path& path, PngMark mark) {
  return has_bytes(path, kMark_at, chunk_of(mark));
}

bool has_bytes(const fs::path& path, std::size_t at, ByteSpan expected) {
  std::error_code unknown;
  if (!fs::is_regular_file(fs::symlink_status(path, unknown))) return false;
  std::string found(expected.size(), '\0');
  std::ifstream file(path, std::ios::binary);
  file.seekg(static_cast<std::streamoff>(at));
  file.read(found.data(), static_cast<std::streamsize>(found.size()));
  if (file.bad()) {
    throw IoError("output: cannot read '" + path.string() + "': " + error_text(errno));
  }
  return file && std::ranges::equal(found, expected, [](char a, std::uint8_t b) {
           return static_cast<std::uint8_t>(a) == b;
         });
}

Deflater::Deflater(Form form)
    : form_(form), stream_(new z_stream{}, [](z_stream* stream) {
        deflateEnd(stream);
        delete stream;  // NOLINT(cppcoreguidelines-owning-memory): this is the owner
      }) {
  constexpr int kLevel = 1;
  constexpr int kMemoryLevel = 8;
  const int window_bits = form == Form::whole ? 15 : -15;  // negative: without header and checksum
  if (deflateInit2(stream_.get(), kLevel, Z_DEFLATED, window_bits, kMemoryLevel, Z_RLE) != Z_OK) {
    throw MediaError("png: cannot compress images: out of memory");
  }
}

ByteSpan Deflater::compress(ByteSpan bytes) {
  constexpr std::size_t kFlush_bytes = 16;  // which the bound leaves out
  z_stream& stream = *stream_;
  deflateReset(&stream);
  compressed_.resize(deflateBound(&stream, bytes.size()) + kFlush_bytes);
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-const-cast): zlib does not write to it
  stream.next_in = const_cast<std::uint8_t*>(bytes.data());
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = compressed_.data();
  stream.avail_out = static_cast<uInt>(compressed_.size());
  const int code = deflate(&stream, form_ == Form::whole ? Z_FINISH : Z_SYNC_FLUSH);
  if (code != (form_ == Form::whole ? Z_STREAM_END : Z_OK) || stream.avail_in != 0) {
    throw MediaError("png: cannot compress an image");
  }
  return {compressed_.data(), stream.next_out};
}

}  // namespace piblocks
