#include "media/libav/decoded_frame.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <array>
#include <cstring>
#include <vector>

extern "C" {
#include <libavutil/imgutils.h>
}

namespace piblocks {
namespace {

bool is_chroma(const AVPixFmtDescriptor& format, int component) {
  return (component == 1 || component == 2) && !is_grey(format) &&
         !has_flag(format, AV_PIX_FMT_FLAG_RGB);
}

/// False if libavutil's distance of samples leads out of the row, as where it varies (uyyvyy411).
bool rows_hold_components(const AVFrame& frame) {
  const AVPixFmtDescriptor& format = descriptor_of(frame);
  const bool is_bits = has_flag(format, AV_PIX_FMT_FLAG_BITSTREAM);
  for (int i = 0; i < format.nb_components; ++i) {
    const AVComponentDescriptor& component = format.comp[i];
    const int row_bytes =
        av_image_get_linesize(pixel_format_of(frame), frame.width, component.plane);
    const std::int64_t last =
        component.offset + std::int64_t{samples_in_row(frame, i) - 1} * component.step;
    // For bitstreams the distance is in bits, and the shift has no meaning.
    const std::int64_t end_bits =
        is_bits ? last + component.depth : 8 * last + component.shift + component.depth;
    if (row_bytes < 0 || end_bits > std::int64_t{8} * row_bytes) return false;
  }
  return true;
}

constexpr int kChannels = 4;

/// Whether every sample is a byte of its own.
bool is_made_of_bytes(const AVPixFmtDescriptor& format) {
  if (has_flag(format, AV_PIX_FMT_FLAG_BITSTREAM | AV_PIX_FMT_FLAG_PAL)) return false;
  return std::all_of(format.comp, format.comp + format.nb_components,
                     [](const AVComponentDescriptor& c) { return c.depth == 8 && c.shift == 0; });
}

/// A row of one channel: a sample every `step` bytes, for 2^x_shift pixels.
struct ByteRow {
  const std::uint8_t* data;
  int step;
  int x_shift;

  std::uint32_t at(int x) const { return data[std::ptrdiff_t{x >> x_shift} * step]; }
};

constexpr std::uint8_t kOpaque = 255;

ByteRow byte_row(const AVFrame& frame, int channel, int y) {
  const AVPixFmtDescriptor& format = descriptor_of(frame);
  const int index = component_of(format, channel);
  if (index < 0) return {&kOpaque, 0, 0};
  const AVComponentDescriptor& component = format.comp[index];
  const std::ptrdiff_t line = y >> y_shift_of(format, index);
  return {frame.data[component.plane] + line * frame.linesize[component.plane] + component.offset,
          component.step, x_shift_of(format, index)};
}

/// The usual layout, in which 2^kShift pixels share chroma. With the general loop below alone,
/// comparing two videos of 4:2:0 takes half as long again.
template <int kShift>
void read_planes(const std::array<ByteRow, 3>& rows, int width, std::uint32_t* words) {
  constexpr int kPixels = 1 << kShift;
  const auto& [luma, cb, cr] = rows;
  for (int x = 0; x < width; x += kPixels) {
    const int at = x >> kShift;
    const std::uint32_t chroma =
        0xff000000U | std::uint32_t{cb.data[at]} << 8 | std::uint32_t{cr.data[at]};
    const int count = std::min(kPixels, width - x);
    for (int i = 0; i < count; ++i) words[x + i] = chroma | std::uint32_t{luma.data[x + i]} << 16;
  }
}

void read_bytes(const AVFrame& frame, std::vector<std::uint32_t>& words) {
  const int width = frame.width;
  for (int y = 0; y < frame.height; ++y) {
    std::uint32_t* const to = words.data() + std::ptrdiff_t{y} * width;
    const std::array rows = {byte_row(frame, 0, y), byte_row(frame, 1, y), byte_row(frame, 2, y)};
    const ByteRow alpha = byte_row(frame, kAlpha, y);
    const bool is_planar = alpha.step == 0 && std::ranges::all_of(rows, [](const ByteRow& row) {
                             return row.step == 1;
                           });
    if (is_planar && rows[1].x_shift == 0) {
      read_planes<0>(rows, width, to);
    } else if (is_planar && rows[1].x_shift == 1) {
      read_planes<1>(rows, width, to);
    } else {
      for (int x = 0; x < width; ++x) {
        to[x] = alpha.at(x) << 24 | rows[0].at(x) << 16 | rows[1].at(x) << 8 | rows[2].at(x);
      }
    }
  }
}

/// Indices into a table of words 0xAARRGGBB.
void read_palette(const AVFrame& frame, std::vector<std::uint32_t>& words) {
  for (int y = 0; y < frame.height; ++y) {
    const std::uint8_t* const row = frame.data[0] + std::ptrdiff_t{y} * frame.linesize[0];
    std::uint32_t* const to = words.data() + std::ptrdiff_t{y} * frame.width;
    for (int x = 0; x < frame.width; ++x) {
      std::memcpy(to + x, frame.data[1] + std::ptrdiff_t{row[x]} * 4, sizeof *to);
    }
  }
}

/// One row of a component, as levels up to `max_level`.
std::vector<std::uint16_t> levels_of(const AVFrame& frame, int component, int y, int max_level) {
  const AVPixFmtDescriptor& format = descriptor_of(frame);
  std::vector<std::uint16_t> levels(std::size_t(samples_in_row(frame, component)));
  read_levels(frame, component, y >> y_shift_of(format, component), levels.data());
  const int own_max = (1 << format.comp[component].depth) - 1;
  if (own_max == max_level) return levels;
  for (std::uint16_t& level : levels) {
    level = std::uint16_t(scaled_level(level, own_max, max_level));
  }
  return levels;
}

/// Any arrangement of bits.
template <typename Word>
void read_bits(const AVFrame& frame, int max_level, std::vector<Word>& words) {
  constexpr std::array kPlaces = {2, 1, 0, 3};  // of the channels in a word
  const AVPixFmtDescriptor& format = descriptor_of(frame);
  std::vector<std::uint16_t> levels;
  for (int y = 0; y < frame.height; ++y) {
    Word* const row = words.data() + std::ptrdiff_t{y} * frame.width;
    for (int channel = 0; channel < kChannels; ++channel) {
      const int place = int(sizeof(Word)) * 2 * kPlaces[std::size_t(channel)];
      const int component = component_of(format, channel);
      int x_shift = 0;
      if (component < 0) {
        levels.assign(std::size_t(frame.width), std::uint16_t(max_level));
      } else {
        levels = levels_of(frame, component, y, max_level);
        x_shift = x_shift_of(format, component);
      }
      for (int x = 0; x < frame.width; ++x) {
        row[x] |= static_cast<Word>(levels[std::size_t(x >> x_shift)]) << place;
      }
    }
  }
}

template <typename Picture>
Picture blank(const AVFrame& frame) {
  return {.width_px = frame.width,
          .height_px = frame.height,
          .words = decltype(Picture::words)(std::size_t(frame.width) * std::size_t(frame.height))};
}

}  // namespace

AVPixelFormat pixel_format_of(const AVFrame& frame) {
  return static_cast<AVPixelFormat>(frame.format);
}

const AVPixFmtDescriptor& descriptor_of(const AVFrame& frame) {
  return *av_pix_fmt_desc_get(pixel_format_of(frame));
}

bool has_flag(const AVPixFmtDescriptor& format, std::uint64_t flag) {
  return (format.flags & flag) != 0;
}

bool is_grey(const AVPixFmtDescriptor& format) {
  return format.nb_components <= 2 && !has_flag(format, AV_PIX_FMT_FLAG_PAL);
}

bool is_xyz(const AVPixFmtDescriptor& format) { return std::strncmp(format.name, "xyz", 3) == 0; }

bool is_full_range(const AVFrame& frame) {
  const AVPixFmtDescriptor& format = descriptor_of(frame);
  // The table of a palette is always RGB; fewer than 8 bits have no limited range.
  if (has_flag(format, AV_PIX_FMT_FLAG_PAL) || greatest_depth(format) < 8) return true;
  if (frame.color_range != AVCOL_RANGE_UNSPECIFIED) return frame.color_range == AVCOL_RANGE_JPEG;
  return is_grey(format) || has_flag(format, AV_PIX_FMT_FLAG_RGB) ||
         std::strncmp(format.name, "yuvj", 4) == 0;
}

AVColorSpace matrix_of(const AVFrame& frame) {
  constexpr int kHdLines = 720;
  constexpr std::uint64_t kRgb = AV_PIX_FMT_FLAG_RGB | AV_PIX_FMT_FLAG_PAL;
  const AVPixFmtDescriptor& format = descriptor_of(frame);
  if (is_grey(format) || has_flag(format, kRgb)) return AVCOL_SPC_RGB;
  if (frame.colorspace == AVCOL_SPC_BT470BG) return AVCOL_SPC_SMPTE170M;  // the same numbers
  if (frame.colorspace != AVCOL_SPC_UNSPECIFIED) return frame.colorspace;
  return frame.height >= kHdLines ? AVCOL_SPC_BT709 : AVCOL_SPC_SMPTE170M;
}

bool is_rgb(const AVFrame& frame) {
  const AVPixFmtDescriptor& format = descriptor_of(frame);
  return is_full_range(frame) && (is_grey(format) || has_flag(format, AV_PIX_FMT_FLAG_RGB) ||
                                  has_flag(format, AV_PIX_FMT_FLAG_PAL));
}

Siting siting_of(const AVFrame& frame) {
  const AVPixFmtDescriptor& format = descriptor_of(frame);
  const AVChromaLocation place = frame.chroma_location;
  const bool is_centred =
      place == AVCHROMA_LOC_CENTER || place == AVCHROMA_LOC_TOP || place == AVCHROMA_LOC_BOTTOM;
  const bool is_top = place == AVCHROMA_LOC_TOPLEFT || place == AVCHROMA_LOC_TOP;
  const bool is_bottom = place == AVCHROMA_LOC_BOTTOMLEFT || place == AVCHROMA_LOC_BOTTOM;
  const int last_column = (1 << format.log2_chroma_w) - 1;
  const int last_row = (1 << format.log2_chroma_h) - 1;
  return {.right = is_centred ? last_column : 0,
          .down = is_top      ? 0
                  : is_bottom ? 2 * last_row
                              : last_row};
}

int greatest_depth(const AVPixFmtDescriptor& format) {
  int depth = 0;
  for (int i = 0; i < format.nb_components; ++i) depth = std::max(depth, format.comp[i].depth);
  return depth;
}

int component_of(const AVPixFmtDescriptor& format, int channel) {
  const bool has_alpha = has_flag(format, AV_PIX_FMT_FLAG_ALPHA);
  if (channel == kAlpha) return has_alpha ? format.nb_components - 1 : -1;
  return is_grey(format) ? 0 : channel;
}

int x_shift_of(const AVPixFmtDescriptor& format, int component) {
  return is_chroma(format, component) ? format.log2_chroma_w : 0;
}

int y_shift_of(const AVPixFmtDescriptor& format, int component) {
  return is_chroma(format, component) ? format.log2_chroma_h : 0;
}

int samples_in_row(const AVFrame& frame, int component) {
  return AV_CEIL_RSHIFT(frame.width, x_shift_of(descriptor_of(frame), component));
}

int samples_in_column(const AVFrame& frame, int component) {
  return AV_CEIL_RSHIFT(frame.height, y_shift_of(descriptor_of(frame), component));
}

void check_pixel_format(const AVFrame& frame, const std::string& path) {
  constexpr std::uint64_t kOther =
      AV_PIX_FMT_FLAG_HWACCEL | AV_PIX_FMT_FLAG_BAYER | AV_PIX_FMT_FLAG_FLOAT;
  const AVPixFmtDescriptor* const format = av_pix_fmt_desc_get(pixel_format_of(frame));
  const bool is_known = format != nullptr && format->nb_components > 0 &&
                        !has_flag(*format, kOther) && greatest_depth(*format) <= 16 &&
                        rows_hold_components(frame);
  if (is_known) return;
  throw MediaError(
      fmt::format("video: cannot compare '{}': its pixel format {} has no samples of up to 16 bits "
                  "in regular rows; convert it, such as by ffmpeg -pix_fmt gbrp16",
                  path, format == nullptr ? "unknown" : format->name));
}

std::string layout_of(const AVFrame& frame) {
  if (is_rgb(frame)) return std::string(kRgba);
  const AVPixFmtDescriptor& format = descriptor_of(frame);
  const char* const matrix = av_color_space_name(matrix_of(frame));
  const Siting siting = siting_of(frame);
  return fmt::format(
      "{} of {} bits{}, chroma {}x{} at {}, {}, {} range, {}",
      is_grey(format)                         ? "grey"
      : has_flag(format, AV_PIX_FMT_FLAG_RGB) ? "rgb"
      : is_xyz(format)                        ? "xyz"
                                              : "yuv",
      greatest_depth(format), has_flag(format, AV_PIX_FMT_FLAG_ALPHA) ? " with alpha" : "",
      1 << format.log2_chroma_w, 1 << format.log2_chroma_h, siting.right, siting.down,
      is_full_range(frame) ? "full" : "limited", matrix == nullptr ? "unknown" : matrix);
}

void read_levels(const AVFrame& frame, int component, int row, std::uint16_t* levels) {
  const AVPixFmtDescriptor& format = descriptor_of(frame);
  const AVComponentDescriptor& place = format.comp[component];
  const int count = samples_in_row(frame, component);
  const bool is_plain = place.shift == 0 && place.depth >= 8 &&
                        !has_flag(format, AV_PIX_FMT_FLAG_BITSTREAM | AV_PIX_FMT_FLAG_BE);
  const std::uint8_t* const bytes =
      frame.data[place.plane] + std::ptrdiff_t{row} * frame.linesize[place.plane] + place.offset;
  if (is_plain && place.depth == 8) {
    for (int i = 0; i < count; ++i) {
      const std::uint8_t level = bytes[std::ptrdiff_t{i} * place.step];
      levels[i] = level;
    }
    return;
  }
  if (is_plain && place.step == 2) {
    const auto mask = std::uint16_t((1 << place.depth) - 1);
    std::memcpy(levels, bytes, std::size_t(count) * sizeof *levels);
    for (int i = 0; i < count; ++i) levels[i] &= mask;
    return;
  }
  std::array<const std::uint8_t*, 4> planes{};
  std::copy_n(frame.data, planes.size(), planes.begin());
  av_read_image_line2(levels, planes.data(), frame.linesize, &format, 0, row, component, count, 0,
                      sizeof *levels);
  if (pixel_format_of(frame) != AV_PIX_FMT_MONOWHITE) return;
  for (int i = 0; i < count; ++i) levels[i] ^= 1;
}

AnyImage samples_of(const AVFrame& frame) {
  const AVPixFmtDescriptor& format = descriptor_of(frame);
  const int depth = greatest_depth(format);
  if (depth > 8) {
    auto image = blank<DeepImage>(frame);
    image.max_level = (1 << depth) - 1;
    read_bits(frame, image.max_level, image.words);
    return image;
  }
  auto image = blank<Image>(frame);
  if (has_flag(format, AV_PIX_FMT_FLAG_PAL)) {
    read_palette(frame, image.words);
  } else if (is_made_of_bytes(format)) {
    read_bytes(frame, image.words);
  } else {
    read_bits(frame, 255, image.words);
  }
  return image;
}

}  // namespace piblocks
