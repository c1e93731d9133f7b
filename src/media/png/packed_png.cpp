// PNG specification, third edition; zlib streams by libdeflate, which needs a third of zlib's time.
#include "media/png/packed_png.hpp"

#include <libdeflate.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdlib>
#include <cstring>
#include <span>
#include <string_view>
#include <utility>

#include "core/large_pages.hpp"
#include "media/png/png_chunk.hpp"

namespace piblocks {
namespace {

constexpr std::size_t bytes_of(Packing packing) {
  constexpr std::array<std::size_t, 7> kBytes = {1, 0, 3, 1, 2, 0, 4};
  return kBytes.at(std::size_t(packing));
}

struct FileChunk {
  std::string_view type;  // empty at the end of the file, and where it is damaged
  std::span<std::uint8_t> data;
};

/// Takes the next chunk off the front of a file.
FileChunk take_chunk(std::span<std::uint8_t>& file) {
  constexpr std::size_t kFrame_bytes = 12;  // length, type, checksum
  if (file.size() < kFrame_bytes) return {};
  const std::uint64_t length = from_big_endian(file.first(4));
  if (length > file.size() - kFrame_bytes) return {};
  const auto checked = file.subspan(4, length + 4);
  const std::uint64_t checksum = from_big_endian(file.subspan(length + 8, 4));
  if (libdeflate_crc32(0, checked.data(), checked.size()) != checksum) return {};
  file = file.subspan(length + kFrame_bytes);
  return {{reinterpret_cast<const char*>(checked.data()), 4}, checked.subspan(4)};
}

/// What the chunks of a file say.
struct PackedFile {
  PackedImage image;
  std::span<std::uint8_t> data;  // of all IDAT chunks
  bool has_data = false;
  bool has_palette = false;
  bool has_transparency = false;
  std::shared_ptr<std::uint8_t> rows;
};

bool take_header(ByteSpan data, PackedImage& image) {
  constexpr std::size_t kHeader_bytes = 13;
  if (data.size() != kHeader_bytes) return false;
  const std::uint64_t width = from_big_endian(data.first(4));
  const std::uint64_t height = from_big_endian(data.subspan(4, 4));
  constexpr std::array<std::uint8_t, 4> kPlain = {8, 0, 0, 0};  // depth, methods, no interlacing
  const std::array<std::uint8_t, 4> kind = {data[8], data[10], data[11], data[12]};
  const bool is_fit = width >= 1 && height >= 1 && width <= kMaxSide_px && height <= kMaxSide_px &&
                      width * height <= std::uint64_t(kMaxFrame_px);
  if (!is_fit || kind != kPlain || data[9] > 6 || bytes_of(Packing(data[9])) == 0) return false;
  image.width_px = int(width);
  image.height_px = int(height);
  image.packing = Packing(data[9]);
  return true;
}

bool take_palette(ByteSpan data, PackedFile& file) {
  if (std::exchange(file.has_palette, true) || file.has_data) return false;
  if (data.empty() || data.size() % 3 != 0 || data.size() > std::size_t{3} * 256) return false;
  if (file.image.packing != Packing::palette) {  // a hint
    return file.image.packing == Packing::rgb || file.image.packing == Packing::rgba;
  }
  for (std::size_t i = 0; i < data.size(); i += 3) {
    file.image.palette.push_back(0xff000000 | std::uint32_t(from_big_endian(data.subspan(i, 3))));
  }
  return true;
}

/// Alphas of the first colours of a palette. A grey or a colour that stands for transparency is
/// left to libpng.
bool take_transparency(ByteSpan data, PackedFile& file) {
  std::vector<std::uint32_t>& palette = file.image.palette;
  if (std::exchange(file.has_transparency, true) || file.has_data) return false;
  if (data.empty() || data.size() > palette.size()) return false;
  for (std::size_t i = 0; i < data.size(); ++i) {
    palette[i] = (palette[i] & 0x00ffffff) | std::uint32_t{data[i]} << 24;
  }
  return true;
}

/// Moves the data behind those of the chunks before, which end where it begins.
void take_data(std::span<std::uint8_t> data, PackedFile& file) {
  if (!std::exchange(file.has_data, true)) {
    file.data = data;
    return;
  }
  std::uint8_t* const end = file.data.data() + file.data.size();
  std::memmove(end, data.data(), data.size());
  file.data = {file.data.data(), file.data.size() + data.size()};
}

/// Not those of animations and of turned pictures, and not those that have to be understood.
bool may_be_skipped(std::string_view type) {
  const auto is_letter = [](char c) { return ('a' <= (c | 0x20)) && ((c | 0x20) <= 'z'); };
  const bool is_ancillary =
      type.size() == 4 && std::ranges::all_of(type, is_letter) && (type[0] & 0x20) != 0;
  return is_ancillary && type != "acTL" && type != "fcTL" && type != "eXIf";
}

/// @returns false if the file is not whole, or not of the kind that is read here.
bool take_chunks(std::span<std::uint8_t> chunks, PackedFile& file) {
  FileChunk chunk = take_chunk(chunks);
  if (chunk.type != "IHDR" || !take_header(chunk.data, file.image)) return false;
  bool is_data_over = false;
  while (true) {
    chunk = take_chunk(chunks);
    is_data_over |= file.has_data && chunk.type != "IDAT";
    if (chunk.type == "IDAT") {
      if (is_data_over) return false;
      take_data(chunk.data, file);
    } else if (chunk.type == "IEND") {
      return chunk.data.empty() && file.has_data;
    } else if (chunk.type == "PLTE") {
      if (!take_palette(chunk.data, file)) return false;
    } else if (chunk.type == "tRNS") {
      if (!take_transparency(chunk.data, file)) return false;
    } else if (!may_be_skipped(chunk.type)) {
      return false;
    }
  }
}

/// Whether the stream may look back as far as libdeflate allows, whatever the stream announces.
bool has_full_window(ByteSpan zlib, std::size_t bytes) {
  const std::size_t window = std::size_t{1} << ((zlib[0] >> 4) + 8);
  return window >= 32768 || bytes <= window;
}

/// Rows are read and written by four bytes: so many may lie behind their end.
constexpr std::size_t kSlack = 3;

/// Deflate expands a byte to at most 1032 (RFC 1951): a small file cannot ask for much memory.
constexpr std::size_t kMostInflation = 1032;

std::shared_ptr<std::uint8_t> inflate(ByteSpan zlib, std::size_t bytes) {
  if (zlib.size() < 2 || bytes / kMostInflation > zlib.size() || !has_full_window(zlib, bytes)) {
    return {};
  }
  using Decompressor =
      std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)>;
  const Decompressor decompressor(libdeflate_alloc_decompressor(), libdeflate_free_decompressor);
  if (!decompressor) return {};
  // NOLINTNEXTLINE(cppcoreguidelines-avoid-c-arrays,modernize-avoid-c-arrays): not filled twice
  const auto array = std::make_shared_for_overwrite<std::uint8_t[]>(bytes + kSlack);
  std::shared_ptr<std::uint8_t> rows(array, array.get());
  prefer_large_pages(rows.get(), bytes);
  std::size_t consumed = 0;
  const auto result = libdeflate_zlib_decompress_ex(decompressor.get(), zlib.data(), zlib.size(),
                                                    rows.get(), bytes, &consumed, nullptr);
  const bool is_whole = result == LIBDEFLATE_SUCCESS && consumed == zlib.size();
  return is_whole ? rows : nullptr;
}

// The samples of a pixel, or of less than one and what follows them: vectors of GCC and clang.
using Lanes [[gnu::vector_size(8)]] = std::int16_t;
using LaneBytes [[gnu::vector_size(4)]] = std::uint8_t;

Lanes load(const std::uint8_t* bytes) {
  LaneBytes lanes;
  std::memcpy(&lanes, bytes, sizeof lanes);
  return __builtin_convertvector(lanes, Lanes);
}

enum Filter : std::uint8_t { none, sub, up, average, paeth };

Lanes left_of(Lanes a, Lanes /*b*/, Lanes /*c*/) { return a; }
Lanes mean_of(Lanes a, Lanes b, Lanes /*c*/) { return (a + b) / 2; }

/// The one of three neighbours that is nearest to a + b - c, the first of equally near ones
/// (PNG specification, 9.4). With 3c - (a + b) = c - (a + b - 2c) as a bound: at or above the
/// larger of a and b the smaller is nearest, at or below the smaller the larger, in between c.
Lanes nearest_of(Lanes a, Lanes b, Lanes c) {
  const Lanes bound = 3 * c - (a + b);
  const Lanes low = a < b ? a : b;
  const Lanes high = a < b ? b : a;
  const Lanes nearest = high <= bound ? low : c;
  return bound <= low ? high : nearest;
}

/// Adds to every byte what `predict` makes of those left, above, and above left of it. Reads and
/// writes kSlack bytes behind the rows.
template <std::size_t kBytes, typename Predict>
void add_predicted(const std::uint8_t* filtered, const std::uint8_t* above, std::size_t count,
                   const Predict& predict, std::uint8_t* row) {
  Lanes left = {};
  Lanes above_left = {};
  for (std::size_t i = 0; i < count; i += kBytes) {
    const Lanes over = load(above + i);
    left = (load(filtered + i) + predict(left, over, above_left)) & 0xff;
    above_left = over;
    const LaneBytes bytes = __builtin_convertvector(left, LaneBytes);
    std::memcpy(row + i, &bytes, sizeof bytes);
  }
}

/// @returns false if the filter is unknown.
template <std::size_t kBytes>
bool unfilter_row(std::uint8_t filter, const std::uint8_t* filtered, const std::uint8_t* above,
                  std::size_t count, std::uint8_t* row) {
  switch (filter) {
    case none:
      return true;
    case up:
      for (std::size_t i = 0; i < count; ++i) row[i] = std::uint8_t(row[i] + above[i]);
      return true;
    case sub:
      add_predicted<kBytes>(filtered, above, count, left_of, row);
      return true;
    case average:
      add_predicted<kBytes>(filtered, above, count, mean_of, row);
      return true;
    case paeth:
      add_predicted<kBytes>(filtered, above, count, nearest_of, row);
      return true;
    default:
      return false;
  }
}

/// @param rows  each behind its filter; kSlack bytes follow the last
/// @returns false if a row has an unknown filter.
template <std::size_t kBytes>
bool unfilter(const PackedImage& image, std::uint8_t* rows) {
  const std::size_t count = image.row_bytes();
  Bytes filtered(count + kSlack);
  const Bytes zeros(count + kSlack);
  const std::uint8_t* above = zeros.data();
  std::uint8_t filter = rows[0];
  for (int y = 0; y < image.height_px; ++y, rows += count + 1) {
    std::uint8_t* const row = rows + 1;
    // A copy, since a row that is read where it has just been written waits for the writes.
    if (filter != none && filter != up) std::memcpy(filtered.data(), row, count);
    std::array<std::uint8_t, kSlack> behind{};
    std::memcpy(behind.data(), row + count, kSlack);
    if (!unfilter_row<kBytes>(filter, filtered.data(), above, count, row)) return false;
    std::memcpy(row + count, behind.data(), kSlack);
    filter = behind[0];
    above = row;
  }
  return true;
}

bool unfilter(const PackedImage& image, std::uint8_t* rows) {
  switch (image.pixel_bytes()) {
    case 1:
      return unfilter<1>(image, rows);
    case 2:
      return unfilter<2>(image, rows);
    case 3:
      return unfilter<3>(image, rows);
    default:
      return unfilter<4>(image, rows);
  }
}

bool has_known_filters(const PackedImage& image, const std::uint8_t* rows) {
  for (int y = 0; y < image.height_px; ++y, rows += image.row_bytes() + 1) {
    if (rows[0] > paeth) return false;
  }
  return true;
}

/// What is in a file, with the rows still filtered.
std::optional<PackedFile> inflated(std::span<std::uint8_t> file) {
  const std::size_t signature = kPngSignature.size();
  if (file.size() < signature || std::memcmp(file.data(), kPngSignature.data(), signature) != 0) {
    return std::nullopt;
  }
  PackedFile packed;
  if (!take_chunks(file.subspan(signature), packed)) return std::nullopt;
  const PackedImage& image = packed.image;
  packed.rows = inflate(packed.data, (image.row_bytes() + 1) * std::size_t(image.height_px));
  if (!packed.rows) return std::nullopt;
  return packed;
}

bool has_all_colors(const PackedImage& image) {
  if (image.packing != Packing::palette) return true;
  std::uint8_t largest = 0;
  for (int y = 0; y < image.height_px; ++y) {
    for (const std::uint8_t index : std::span(image.row(y), image.row_bytes())) {
      largest = std::max(largest, index);
    }
  }
  return largest < image.palette.size();
}

}  // namespace

std::size_t PackedImage::pixel_bytes() const noexcept { return bytes_of(packing); }

void PackedImage::unpack_row(int y, std::uint32_t* words) const {
  constexpr std::uint32_t kOpaque = 0xff000000;
  constexpr std::uint32_t kGrey = 0x010101;
  const std::uint8_t* const from = row(y);
  // Four bytes at once, for RGB with a byte of the next pixel or of what lies behind the rows.
  const auto word_at = [](const std::uint8_t* p) {
    return std::uint32_t{p[0]} << 24 | std::uint32_t{p[1]} << 16 | std::uint32_t{p[2]} << 8 | p[3];
  };
  const auto each = [&](const auto& word_of) {
    for (std::ptrdiff_t x = 0; x < width_px; ++x) words[x] = word_of(x);
  };
  switch (packing) {
    case Packing::grey:
      return each([&](std::ptrdiff_t x) { return kOpaque | kGrey * from[x]; });
    case Packing::palette:
      return each([&](std::ptrdiff_t x) { return palette[from[x]]; });
    case Packing::grey_alpha:
      return each([&](std::ptrdiff_t x) {
        return std::uint32_t{from[2 * x + 1]} << 24 | kGrey * from[2 * x];
      });
    case Packing::rgb:
      return each([&](std::ptrdiff_t x) { return kOpaque | word_at(from + 3 * x) >> 8; });
    case Packing::rgba:
      return each([&](std::ptrdiff_t x) { return std::rotr(word_at(from + 4 * x), 8); });
  }
}

Image unpacked(const PackedImage& packed) {
  Image image{packed.width_px, packed.height_px, {}};
  image.words.resize(std::size_t(packed.width_px) * std::size_t(packed.height_px));
  for (int y = 0; y < packed.height_px; ++y) {
    packed.unpack_row(y, image.words.data() + std::ptrdiff_t{y} * packed.width_px);
  }
  return image;
}

// cppcheck-suppress passedByValue ; chunks are joined in it
std::optional<PackedImage> read_packed_png(Bytes file) {
  std::optional<PackedFile> packed = inflated(file);
  if (!packed || !unfilter(packed->image, packed->rows.get())) return std::nullopt;
  packed->image.bytes = packed->rows;
  if (!has_all_colors(packed->image)) return std::nullopt;
  return std::move(packed->image);
}

// cppcheck-suppress passedByValue ; chunks are joined in it
bool is_whole_png(Bytes file) {
  std::optional<PackedFile> packed = inflated(file);
  if (!packed) return false;
  PackedImage& image = packed->image;
  if (image.packing != Packing::palette) return has_known_filters(image, packed->rows.get());
  const bool is_known = unfilter(image, packed->rows.get());
  image.bytes = packed->rows;
  return is_known && has_all_colors(image);
}

}  // namespace piblocks
