// GIF 89a by giflib: of each frame what changes, with colours of its own.
#include <fmt/format.h>
#include <gif_lib.h>

#include <algorithm>
#include <array>
#include <bit>

#include "media/libav/av.hpp"
#include "media/libav/color_table.hpp"
#include "media/output/output_kinds.hpp"
#include "media/pixels/changed_picture.hpp"

namespace piblocks {
namespace {

constexpr int kMaxDelay_cs = 65535;
constexpr std::size_t kMaxColors = 256;

/// When frame `number` appears, rounded to the nearest hundredth of a second. Rounding times
/// instead of delays keeps every frame within half a hundredth.
Integer time_cs(std::int64_t number, const Rational& frame_rate) {
  return floor(Rational(number) * 100 / frame_rate + Rational(1, 2));
}

void check_gif(int code, const char* operation) {
  if (code != GIF_ERROR) return;
  throw MediaError(fmt::format("gif: cannot {}: giflib reports an error", operation));
}

using ColorMapPtr = std::unique_ptr<ColorMapObject, void (*)(ColorMapObject*)>;

/// giflib wants a power of two of colours, at least two.
ColorMapPtr color_map(const std::vector<std::uint32_t>& colors, std::size_t count) {
  std::array<GifColorType, kMaxColors> table{};
  for (std::size_t i = 0; i < colors.size(); ++i) {
    table.at(i) = {static_cast<GifByteType>(colors[i] >> 16),
                   static_cast<GifByteType>(colors[i] >> 8), static_cast<GifByteType>(colors[i])};
  }
  const auto size = int(std::bit_ceil(std::max<std::size_t>(2, count)));
  ColorMapPtr map(GifMakeMapObject(size, table.data()), GifFreeMapObject);
  if (!map) throw std::bad_alloc();
  return map;
}

/// giflib calls this; no exception may pass through it.
int append_to_bytes(GifFileType* file, const GifByteType* data, int count) {
  try {
    append(*static_cast<Bytes*>(file->UserData), std::span(data, std::size_t(count)));
  } catch (const std::bad_alloc&) {
    return 0;
  }
  return count;
}

class GifEncoder final : public PacketPerFrameEncoder {
 public:
  /// @param plays  0 for ever
  GifEncoder(const VideoFormat& format, int plays)
      : PacketPerFrameEncoder(format),
        frame_rate_(format.frame_rate),
        picture_(format.width_px, format.height_px),
        file_(EGifOpen(&bytes_, append_to_bytes, nullptr),
              [](GifFileType* file) { EGifCloseFile(file, nullptr); }) {
    if (!file_) throw std::bad_alloc();
    put_header(format, plays);
    header_ = std::exchange(bytes_, {});
  }

 private:
  void convert(const ImageView& frame, std::span<const PixelRect> rects) override {
    picture_.take(frame, rects);
  }
  Bytes encode_picture(std::int64_t number, bool is_first) override {
    is_whole_ = is_first;
    const PixelRect rect = is_whole_ ? picture_.whole() : picture_.changed();
    const bool has_others = choose_colors(rect);
    const int transparent = has_others ? int(colors_.colors().size()) : NO_TRANSPARENT_COLOR;
    put_control(number, transparent);
    put_image(rect, transparent);
    picture_.settle();
    if (number == 0) bytes_.insert(bytes_.begin(), header_.begin(), header_.end());
    return std::exchange(bytes_, {});
  }
  /// The screen, and Netscape's extension, which every viewer knows: how often to repeat, 0 for
  /// ever. Without it a GIF plays once.
  void put_header(const VideoFormat& format, int plays) {
    constexpr int kColorResolution_bits = 8;
    const int repeats = std::max(0, plays - 1);
    const std::array<std::uint8_t, 3> repetition = {1, std::uint8_t(repeats & 0xff),
                                                    std::uint8_t(repeats >> 8)};
    const auto check = [](int code) { check_gif(code, "write the header"); };
    GifFileType* const file = file_.get();
    EGifSetGifVersion(file, true);
    check(EGifPutScreenDesc(file, format.width_px, format.height_px, kColorResolution_bits, 0,
                            nullptr));
    if (plays == 1) return;
    check(EGifPutExtensionLeader(file, APPLICATION_EXT_FUNC_CODE));
    check(EGifPutExtensionBlock(file, 11, "NETSCAPE2.0"));
    check(EGifPutExtensionBlock(file, repetition.size(), repetition.data()));
    check(EGifPutExtensionTrailer(file));
  }
  /// Chooses colours for the pixels to be written. @return whether other pixels are left out.
  bool choose_colors(const PixelRect& rect) {
    bool has_others = false;
    colors_.clear();
    for (int y = rect.y_px; y < rect.bottom_px(); ++y) {
      const std::uint32_t* const pixels = picture_.row(y);
      for (int x = rect.x_px; x < rect.right_px(); ++x) {
        if (is_left_out(x, y)) {
          has_others = true;
        } else {
          colors_.count(pixels[x] & 0xffffff);
        }
      }
    }
    colors_.choose(kMaxColors - (has_others ? 1 : 0));
    return has_others;
  }
  void put_control(std::int64_t number, int transparent) {
    const Integer delay = time_cs(number + 1, frame_rate_) - time_cs(number, frame_rate_);
    const GraphicsControlBlock control = {DISPOSE_DO_NOT, false, int(delay.get_si()), transparent};
    std::array<GifByteType, 4> block{};
    EGifGCBToExtension(&control, block.data());
    check_gif(EGifPutExtension(file_.get(), GRAPHICS_EXT_FUNC_CODE, block.size(), block.data()),
              "write a frame");
  }
  void put_image(const PixelRect& rect, int transparent) {
    const std::size_t colors = colors_.colors().size() + (transparent >= 0 ? 1 : 0);
    const auto map = color_map(colors_.colors(), colors);
    check_gif(EGifPutImageDesc(file_.get(), rect.x_px, rect.y_px, rect.width_px, rect.height_px,
                               false, map.get()),
              "write a frame");
    row_.resize(std::size_t(rect.width_px));
    for (int y = rect.y_px; y < rect.bottom_px(); ++y) {
      const std::uint32_t* const pixels = picture_.row(y);
      for (int i = 0; i < rect.width_px; ++i) {
        const int x = rect.x_px + i;
        row_[std::size_t(i)] =
            is_left_out(x, y) ? std::uint8_t(transparent) : colors_.index_of(pixels[x] & 0xffffff);
      }
      check_gif(EGifPutLine(file_.get(), row_.data(), rect.width_px), "write a frame");
    }
  }
  /// Whether a pixel keeps what the frames before have there.
  bool is_left_out(int x, int y) const { return !is_whole_ && picture_.marks(y)[x] == 0; }

  Rational frame_rate_;
  ChangedPicture picture_;
  Bytes bytes_;  // written since the last packet
  std::unique_ptr<GifFileType, void (*)(GifFileType*)> file_;
  Bytes header_;
  ColorTable colors_;
  bool is_whole_ = true;  // the frame that is being encoded
  Bytes row_;
};

std::string frame_rate_problem(const Rational& rate) {
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
  constexpr std::int64_t kFramesPerChunk = 50;  // the first of them whole
  const std::string problem = frame_rate_problem(request.format.frame_rate);
  if (!problem.empty()) throw UsageError(problem);
  const int plays = request.settings.plays.value_or(0);
  return stream_output<GifEncoder>(
      request, kFramesPerChunk, fmt::format("gif by {}, plays {}", giflib_version(), plays),
      [](OutputFile& file, std::int64_t /*frames*/) { file.write(";"); },  // the trailer, 0x3b
      plays);
}

}  // namespace piblocks
