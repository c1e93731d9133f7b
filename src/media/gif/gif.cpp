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
#include "media/gif/lzw.hpp"
#include "media/output/animated_output.hpp"
#include "media/output/output_kinds.hpp"
#include "media/pixels/animation.hpp"

namespace piblocks {
namespace {

constexpr int kMaxDelay_cs = 65535;
constexpr std::size_t kMaxColors = 256;
using Colors = std::vector<std::uint32_t>;  // 0x00RRGGBB

/// An image before it is known how long it is shown, and whose colour table it uses.
struct GifImage {
  PixelRect rect = {};
  Colors colors = {};
  bool has_transparent = false;  ///< pixels; their value follows that of the last colour
  std::vector<LzwCode> codes = {};
};

Bytes packed(const GifImage& image) {
  Bytes bytes;
  for (const int value :
       {image.rect.x_px, image.rect.y_px, image.rect.width_px, image.rect.height_px,
        int(image.colors.size()), int(image.has_transparent)}) {
    append_little_endian(bytes, std::uint64_t(value), 2);
  }
  for (const std::uint32_t color : image.colors) append_little_endian(bytes, color, 3);
  for (const LzwCode code : image.codes) append_little_endian(bytes, code, 2);
  return bytes;
}

GifImage unpacked(ByteSpan bytes) {
  const auto take = [&](std::size_t size_bytes) {
    const std::uint64_t value = from_little_endian(bytes.first(size_bytes));
    bytes = bytes.subspan(size_bytes);
    return value;
  };
  GifImage image;
  for (int* const value :
       {&image.rect.x_px, &image.rect.y_px, &image.rect.width_px, &image.rect.height_px}) {
    *value = int(take(2));
  }
  image.colors.resize(take(2));
  image.has_transparent = take(2) != 0;
  for (std::uint32_t& color : image.colors) color = std::uint32_t(take(3));
  while (!bytes.empty()) image.codes.push_back(LzwCode(take(2)));
  return image;
}

class GifEncoder final : public AnimationEncoder {
 public:
  using AnimationEncoder::AnimationEncoder;

 private:
  Bytes encode_image(const ChangedPicture& picture) override {
    GifImage image{.rect = picture.changed()};
    image.has_transparent = choose_colors(picture, image.rect);
    image.colors = colors_.colors();
    image.codes = lzw_codes(values_of(picture, image.rect));
    return packed(image);
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

/// The colours that images share: those of the first images for which there is room.
class SharedColors {
 public:
  /// The places of these colours, then that of the transparent one, which is 0 so that images of
  /// few colours need few bits; nothing if they do not all have a place.
  std::optional<Bytes> indices_of(const Colors& wanted) {
    // Beside an image of more colours there would be no room for another.
    constexpr std::size_t kMaxNew = 192;
    const std::size_t before = colors_.size();
    Bytes indices;
    for (const std::uint32_t color : wanted) {
      const auto found = std::find(colors_.begin() + 1, colors_.end(), color);
      indices.push_back(std::uint8_t(found - colors_.begin()));
      if (found == colors_.end()) colors_.push_back(color);
    }
    indices.push_back(0);
    if (colors_.size() <= std::min(kMaxColors, before + kMaxNew)) return indices;
    colors_.resize(before);
    return std::nullopt;
  }
  const Colors& colors() const { return colors_; }

 private:
  Colors colors_ = {0};
};

void append_colors(Bytes& bytes, const Colors& colors, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    append_big_endian(bytes, i < colors.size() ? colors[i] : 0, 3);
  }
}

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
  append_colors(bytes, {}, kMaxColors);                    // write_end() knows them
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

/// @param indices  of the values of pixels in the shared colour table; nothing if the image needs
///                 one of its own
Bytes image_bytes(const GifImage& image, std::optional<Bytes> indices, std::uint64_t delay_cs) {
  const bool is_shared = indices.has_value();
  if (!is_shared) {
    indices.emplace(image.colors.size() + 1);
    std::iota(indices->begin(), indices->end(), std::uint8_t{0});
  }
  if (!image.has_transparent) indices->pop_back();
  const int bits = std::max(1, int(std::bit_width(unsigned{*std::ranges::max_element(*indices)})));
  Bytes bytes;
  append(bytes, std::array<std::uint8_t, 3>{0x21, 0xf9, 4});
  bytes.push_back(image.has_transparent ? 0x05 : 0x04);  // what it leaves out stays
  append_little_endian(bytes, delay_cs, 2);
  append(bytes, std::array<std::uint8_t, 3>{indices->back(), 0, 0x2c});
  for (const int value :
       {image.rect.x_px, image.rect.y_px, image.rect.width_px, image.rect.height_px}) {
    append_little_endian(bytes, std::uint64_t(value), 2);
  }
  bytes.push_back(is_shared ? 0 : std::uint8_t(0x80 | (bits - 1)));
  if (!is_shared) append_colors(bytes, image.colors, std::size_t{1} << bits);
  append_lzw(bytes, image.codes, *indices, std::max(2, bits));
  return bytes;
}

class GifSink final : public AnimationSink {
 public:
  explicit GifSink(const OutputRequest& request)
      : AnimationSink(request.name), rate_(request.format.frame_rate) {
    file().write(header_of(request.format, request.settings.plays.value_or(0)));
  }

 private:
  void write_image(Bytes bytes, std::int64_t first, std::int64_t end) override {
    const GifImage image = unpacked(bytes);
    const Integer delay_cs = tick_of(end, rate_, 100) - tick_of(first, rate_, 100);
    bytes = image_bytes(image, std::nullopt, delay_cs.get_ui());
    // The first image has many colours that no other one has.
    if (auto indices = first == 0 ? std::nullopt : shared_.indices_of(image.colors)) {
      Bytes other = image_bytes(image, std::move(indices), delay_cs.get_ui());
      if (other.size() < bytes.size()) bytes = std::move(other);
    }
    file().write(bytes);
  }
  void write_end() override {
    file().write(";");  // 0x3b
    Bytes colors;
    append_colors(colors, shared_.colors(), shared_.colors().size());
    file().write_at(kSharedColors_at, colors);
  }

  Rational rate_;
  SharedColors shared_;
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
  return {.frames_per_chunk = kFramesPerChunk,
          .signature = fmt::format("gif, plays {}", request.settings.plays.value_or(0)),
          .make_encoder = [format = request.format,
                           longest] { return std::make_unique<GifEncoder>(format, longest); },
          .open = [request](std::int64_t /*frames*/) { return std::make_unique<GifSink>(request); },
          .needs_frame_before = true};
}

}  // namespace piblocks
