#include "media/libav/decoded_frame.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <cstring>

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

}  // namespace piblocks
