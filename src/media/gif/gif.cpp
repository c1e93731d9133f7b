// GIF 89a: of each frame what changes, in colours of its own or in those that images share.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "media/gif/color_table.hpp"
#include "media/output/animated_output.hpp"
#include "media/pixels/animation.hpp"

namespace piblocks {
namespace {

constexpr int kMaxDelay_cs = 65535;
constexpr std::size_t kMaxColors = 256;
/// Of the images that GifEncoder makes: the place, and all that is before the colours.
constexpr std::size_t kPlace_bytes = 8;
constexpr std::size_t kHead_bytes = 12;
using Colors = std::vector<std::uint32_t>;  // 0x00RRGGBB

constexpr int kMaxCode_bits = 12;
using LzwCode = std::uint16_t;
constexpr LzwCode kLzwClear = 256;

/// Which string is another one and a value behind it: a hash table.
class Strings {
 public:
  void clear() {
    std::ranges::fill(slots_, Slot{});
    last_ = kLzwClear;
  }
  /// The code of the longer string; 0 if there is none.
  LzwCode find(LzwCode code, std::uint8_t value) { return slot(code, value).code; }
  /// @return whether there is room, beside pixels of 8 bits, for one more.
  bool add(LzwCode code, std::uint8_t value) {
    constexpr LzwCode kLast = (1 << kMaxCode_bits) - 2;
    slot(code, value) = {key_of(code, value), ++last_};
    return last_ < kLast;
  }

 private:
  struct Slot {
    std::uint32_t key = 0;
    LzwCode code = 0;  // of no string: the slot is empty
  };

  static std::uint32_t key_of(LzwCode code, std::uint8_t value) {
    return std::uint32_t{code} << 8 | value;
  }
  Slot& slot(LzwCode code, std::uint8_t value) {
    constexpr std::uint32_t kFactor = 2654435761;  // 2^32 by the golden ratio
    const std::uint32_t key = key_of(code, value);
    std::size_t at = key * kFactor >> 19;
    while (slots_[at].code != 0 && slots_[at].key != key) at = (at + 1) % slots_.size();
    return slots_[at];
  }

  std::vector<Slot> slots_ = std::vector<Slot>(1 << 13);
  LzwCode last_ = kLzwClear;
};

/// Appends two bytes for each code: the value of a pixel, up to 255; or 256, which clears the table
/// of strings; or a string of that table, from 257 on. They suit any colour table; giflib
/// compresses only for one that is known. @param pixels  at least one
void append_lzw_codes(Bytes& bytes, ByteSpan pixels) {
  Strings strings;
  const auto put = [&](LzwCode code) { append_little_endian(bytes, code, 2); };
  put(kLzwClear);
  LzwCode open = pixels.front();  // the string of the pixels since the last code
  for (const std::uint8_t value : pixels.subspan(1)) {
    const LzwCode longer = strings.find(open, value);
    if (longer == 0) {
      put(open);
      if (!strings.add(open, value)) {
        put(kLzwClear);
        strings.clear();
      }
    }
    open = longer != 0 ? longer : value;
  }
  put(open);
}

/// Appends the data of an image (GIF 89a, appendix F). @param codes  as append_lzw_codes() writes
/// them
/// @param indices  of the colours that the values of pixels stand for
/// @param bits     of an index, 2 … 8
void append_lzw(Bytes& bytes, ByteSpan codes, const Bytes& indices, int bits) {
  const std::uint32_t clear = 1U << bits;
  Bytes data;
  std::uint32_t held = 0;
  int held_bits = 0;
  int width_bits = bits + 1;
  const auto put = [&](std::uint32_t code) {
    held |= code << held_bits;
    held_bits += width_bits;
    for (; held_bits >= 8; held_bits -= 8, held >>= 8) data.push_back(std::uint8_t(held));
  };
  std::uint32_t last_string = 0;  // the last one that a reader knows once it has the next code
  for (; codes.size() >= 2; codes = codes.subspan(2)) {
    const auto code = std::uint32_t(from_little_endian(codes.first(2)));
    if (code < kLzwClear && code >= indices.size()) throw MediaError("gif: an image is damaged");
    put(code < kLzwClear ? indices[code] : clear + code - kLzwClear + (code > kLzwClear ? 1 : 0));
    if (code == kLzwClear) {
      width_bits = bits + 1;
      last_string = clear + 1;
    } else if (++last_string == 1U << width_bits && width_bits < kMaxCode_bits) {
      ++width_bits;
    }
  }
  put(clear + 1);  // the end
  data.push_back(std::uint8_t(held));
  bytes.push_back(std::uint8_t(bits));
  for (ByteSpan rest = data; !rest.empty();) {
    const ByteSpan block = rest.first(std::min<std::size_t>(255, rest.size()));
    bytes.push_back(std::uint8_t(block.size()));
    append(bytes, block);
    rest = rest.subspan(block.size());
  }
  bytes.push_back(0);
}

void append_colors(Bytes& bytes, const Colors& colors) {
  for (const std::uint32_t color : colors) append_big_endian(bytes, color, 3);
}

/// An image before it is known how long it is shown, and which colour table it uses: its place and
/// size, the number of its colours, whether one more value of pixels is transparent, the colours,
/// the codes of its pixels.
class GifEncoder final : public AnimationEncoder {
 public:
  using AnimationEncoder::AnimationEncoder;

 private:
  Bytes encode_image(const ChangedPicture& picture) override {
    const PixelRect rect = picture.changed();
    const bool has_transparent = choose_colors(picture, rect);
    Bytes bytes;
    for (const int value : {rect.x_px, rect.y_px, rect.width_px, rect.height_px,
                            int(colors_.colors().size()), int(has_transparent)}) {
      append_little_endian(bytes, std::uint64_t(value), 2);
    }
    append_colors(bytes, colors_.colors());
    append_lzw_codes(bytes, values_of(picture, rect));
    return bytes;
  }
  /// Chooses colours for the pixels that have changed. @return whether there are others.
  bool choose_colors(const ChangedPicture& picture, const PixelRect& rect) {
    bool has_others = false;
    colors_.clear();
    for (int y = rect.y_px; y < rect.bottom_px(); ++y) {
      const std::uint32_t* const pixels = picture.row(y);
      const std::uint8_t* const marks = picture.marks(y);
      for (int x = rect.x_px; x < rect.right_px(); ++x) {
        if (marks[x] == 0) {
          has_others = true;
        } else {
          colors_.count(pixels[x] & 0xffffff);
        }
      }
    }
    colors_.choose(kMaxColors - (has_others ? 1 : 0));
    return has_others;
  }
  /// The values of the pixels: what has not changed is transparent.
  std::span<const std::uint8_t> values_of(const ChangedPicture& picture, const PixelRect& rect) {
    const auto transparent = std::uint8_t(colors_.colors().size());
    values_.clear();
    for (int y = rect.y_px; y < rect.bottom_px(); ++y) {
      const std::uint32_t* const pixels = picture.row(y);
      const std::uint8_t* const marks = picture.marks(y);
      for (int x = rect.x_px; x < rect.right_px(); ++x) {
        values_.push_back(marks[x] == 0 ? transparent : colors_.index_of(pixels[x] & 0xffffff));
      }
    }
    return values_;
  }

  ColorTable colors_;
  Bytes values_;
};

void append_application(Bytes& bytes, std::string_view name, ByteSpan data) {
  append(bytes, std::array<std::uint8_t, 3>{0x21, 0xff, 11});
  append(bytes, name);
  bytes.push_back(std::uint8_t(data.size()));
  append(bytes, data);
  bytes.push_back(0);
}

/// Where the colour table that images share begins.
constexpr std::size_t kSharedColors_at = 13;

Bytes header_of(const VideoFormat& format, int plays) {
  Bytes bytes;
  append(bytes, "GIF89a");
  append_little_endian(bytes, std::uint64_t(format.width_px), 2);
  append_little_endian(bytes, std::uint64_t(format.height_px), 2);
  append(bytes, std::array<std::uint8_t, 3>{0xf7, 0, 0});  // 8 bits a sample, 256 colours
  append_colors(bytes, Colors(kMaxColors));                // write_end() knows them
  // Netscape's extension, which every viewer knows: how often to repeat, 0 for ever. Without it a
  // GIF plays once.
  if (plays != 1) {
    Bytes repetition = {1};
    append_little_endian(repetition, std::uint64_t(std::max(0, plays - 1)), 2);
    append_application(bytes, "NETSCAPE2.0", repetition);
  }
  Bytes rate;
  append(rate, format.frame_rate.get_str());
  append_application(bytes, kFrameRateExtension, rate);
  return bytes;
}

/// @param image  as GifEncoder makes it
std::size_t colors_in(ByteSpan image) {
  return std::size_t(from_little_endian(image.subspan(kPlace_bytes, 2)));
}

/// @param image    as GifEncoder makes it
/// @param indices  of the values of pixels in the shared colour table; nothing if the image needs
///                 one of its own
Bytes image_bytes(ByteSpan image, std::optional<Bytes> indices, std::uint64_t delay_cs) {
  const std::size_t colors = colors_in(image);
  const bool has_transparent = image[10] != 0;
  const bool is_shared = indices.has_value();
  if (!is_shared) {
    indices.emplace(colors + 1);
    std::iota(indices->begin(), indices->end(), std::uint8_t{0});
  }
  if (!has_transparent) indices->pop_back();
  const int bits = std::max(1, int(std::bit_width(unsigned{*std::ranges::max_element(*indices)})));
  Bytes bytes;
  append(bytes, std::array<std::uint8_t, 3>{0x21, 0xf9, 4});
  bytes.push_back(has_transparent ? 0x05 : 0x04);  // what it leaves out stays
  append_little_endian(bytes, delay_cs, 2);
  append(bytes, std::array<std::uint8_t, 3>{indices->back(), 0, 0x2c});
  append(bytes, image.first(kPlace_bytes));
  bytes.push_back(is_shared ? 0 : std::uint8_t(0x80 | (bits - 1)));
  if (!is_shared) {
    append(bytes, image.subspan(kHead_bytes, 3 * colors));
    append_colors(bytes, Colors((std::size_t{1} << bits) - colors));
  }
  append_lzw(bytes, image.subspan(kHead_bytes + 3 * colors), *indices, std::max(2, bits));
  return bytes;
}

class GifSink final : public AnimationSink {
 public:
  explicit GifSink(const OutputRequest& request) : AnimationSink(request, kHead_bytes) {
    file().write(header_of(request.format, plays()));
  }

 private:
  void write_image(Bytes image, std::int64_t first, std::int64_t end) override {
    const std::size_t colors = colors_in(image);
    const bool has_values = colors + image[10] > 0 && colors <= kMaxColors;
    if (!has_values || image.size() < kHead_bytes + 3 * colors) {
      throw MediaError("gif: an image is damaged");
    }
    const std::uint64_t delay_cs = ticks_of(first, end, 100);
    Bytes bytes = image_bytes(image, std::nullopt, delay_cs);
    // The first image has many colours that no other one has.
    if (auto indices = first == 0 ? std::nullopt : shared_indices_of(image)) {
      Bytes other = image_bytes(image, std::move(indices), delay_cs);
      if (other.size() < bytes.size()) bytes = std::move(other);
    }
    file().write(bytes);
  }
  /// The places of an image's colours in the table, which takes them if there is room; then that of
  /// the transparent one, which is 0 so that images of few colours need few bits.
  std::optional<Bytes> shared_indices_of(ByteSpan image) {
    constexpr std::size_t kMaxNew = 192;  // beside more there would be no room for another image's
    const std::size_t before = shared_.size();
    Bytes indices;
    for (std::size_t i = 0; i < colors_in(image); ++i) {
      const auto color = std::uint32_t(from_big_endian(image.subspan(kHead_bytes + 3 * i, 3)));
      const auto found = std::find(shared_.begin() + 1, shared_.end(), color);
      indices.push_back(std::uint8_t(found - shared_.begin()));
      if (found == shared_.end()) shared_.push_back(color);
    }
    indices.push_back(0);
    if (shared_.size() <= std::min(kMaxColors, before + kMaxNew)) return indices;
    shared_.resize(before);
    return std::nullopt;
  }
  void write_end() override {
    file().write(";");  // 0x3b
    Bytes colors;
    append_colors(colors, shared_);
    file().write_at(kSharedColors_at, colors);
  }

  Colors shared_ = {0};  // the transparent one, then those of the first images with room for them
};

std::string gif_rate_problem(const Rational& rate) {
  if (rate > kMaxFrameRate_gif) {
    return fmt::format(
        "gif: frame rate {} is too high: the shortest delay is a fiftieth of a "
        "second; use --fps 50 or 25",
        rate.get_str());
  }
  if (100 / rate <= kMaxDelay_cs) return {};
  return fmt::format(
      "gif: frame rate {} is too low: the longest delay is {} hundredths of a second",
      rate.get_str(), kMaxDelay_cs);
}

}  // namespace

Output gif_output(const OutputRequest& request) {
  constexpr std::int64_t kFramesPerChunk = 50;
  const Rational& rate = request.format.frame_rate;
  const std::string problem = gif_rate_problem(rate);
  if (!problem.empty()) throw UsageError(problem);
  const std::int64_t longest = Integer(floor(kMaxDelay_cs * rate / 100)).get_si();
  return animated_output<GifEncoder, GifSink>(request, kFramesPerChunk, longest, "gif");
}

}  // namespace piblocks
