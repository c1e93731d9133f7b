// Decoded pictures as RGB, against the definitions of ITU-T H.273 in exact arithmetic.
#include <gtest/gtest.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "media/libav/decoded_frame.hpp"
#include "support/contains.hpp"
#include "support/message_of.hpp"
#include "support/traced_random.hpp"

extern "C" {
#include <libavutil/imgutils.h>
}

namespace piblocks {
namespace {
using testing_support::contains;

struct PictureKind {
  AVPixelFormat format;
  AVColorSpace matrix = AVCOL_SPC_BT709;
  AVColorRange range = AVCOL_RANGE_MPEG;
  AVChromaLocation siting = AVCHROMA_LOC_UNSPECIFIED;
};

std::string text(const PictureKind& kind) {
  return std::string(av_get_pix_fmt_name(kind.format)) + " matrix " + std::to_string(kind.matrix) +
         " range " + std::to_string(kind.range) + " siting " + std::to_string(kind.siting);
}

AvFramePtr empty_frame(const PictureKind& kind, int width, int height) {
  auto frame = own_av<AvFramePtr>(av_frame_alloc(), "picture");
  frame->format = kind.format;
  frame->width = width;
  frame->height = height;
  frame->colorspace = kind.matrix;
  frame->color_range = kind.range;
  frame->chroma_location = kind.siting;
  check_av(av_frame_get_buffer(frame.get(), 0), "allocate", "picture");
  for (int plane = 0; plane < 4; ++plane) {
    if (frame->buf[plane] == nullptr) continue;
    std::fill_n(frame->buf[plane]->data, frame->buf[plane]->size, std::uint8_t{0});
  }
  return frame;
}

void put(AVFrame& frame, int component, int x, int y, int level) {
  const auto stored = static_cast<std::uint16_t>(level);
  av_write_image_line2(&stored, frame.data, frame.linesize, &descriptor_of(frame), x, y, component,
                       1, sizeof stored);
}

/// The samples of a component, which are read beyond the edges too.
struct SampleGrid {
  int width, height;
  std::vector<int> levels;

  double at(int x, int y) const {
    x = std::clamp(x, 0, width - 1);
    y = std::clamp(y, 0, height - 1);
    return levels.at(std::size_t(y * width + x));
  }
  /// Between four samples, at a place counted in samples.
  double between(double x, double y) const {
    const double left = std::floor(x);
    const double top = std::floor(y);
    const auto row = [&](int at) {
      return this->at(int(left), at) * (1 - (x - left)) + this->at(int(left) + 1, at) * (x - left);
    };
    return row(int(top)) * (1 - (y - top)) + row(int(top) + 1) * (y - top);
  }
};

std::vector<SampleGrid> fill(Random& random, AVFrame& frame) {
  const AVPixFmtDescriptor& format = descriptor_of(frame);
  std::vector<SampleGrid> planes;
  for (int component = 0; component < format.nb_components; ++component) {
    SampleGrid plane{samples_in_row(frame, component), samples_in_column(frame, component), {}};
    const int greatest = (1 << format.comp[component].depth) - 1;
    for (int i = 0; i < plane.width * plane.height; ++i) {
      const std::int64_t kind = random.integer(0, 9);
      plane.levels.push_back(kind == 0   ? 0
                             : kind == 1 ? greatest
                                         : int(random.integer(0, greatest)));
      put(frame, component, i % plane.width, i / plane.width, plane.levels.back());
    }
    planes.push_back(std::move(plane));
  }
  return planes;
}

/// Where the middle of the first sample is, in pixels from the first pixel (H.273, figure 10).
std::array<double, 2> first_chroma(AVChromaLocation siting, int width, int height) {
  const double mid_x = (width - 1) / 2.0;
  const double mid_y = (height - 1) / 2.0;
  switch (siting) {
    case AVCHROMA_LOC_CENTER:
      return {mid_x, mid_y};
    case AVCHROMA_LOC_TOPLEFT:
      return {0, 0};
    case AVCHROMA_LOC_TOP:
      return {mid_x, 0};
    case AVCHROMA_LOC_BOTTOMLEFT:
      return {0, height - 1.0};
    case AVCHROMA_LOC_BOTTOM:
      return {mid_x, height - 1.0};
    default:
      return {0, mid_y};
  }
}

/// E'R, E'G, E'B from E'Y, E'PB, E'PR: the inverse of H.273, equations 39 to 44.
std::array<double, 3> rgb_by_weights(double red, double blue, const std::array<double, 3>& yuv) {
  const double r = yuv[0] + 2 * (1 - red) * yuv[2];
  const double b = yuv[0] + 2 * (1 - blue) * yuv[1];
  return {r, (yuv[0] - red * r - blue * b) / (1 - red - blue), b};
}

std::array<double, 3> rgb_by(AVColorSpace matrix, const std::array<double, 3>& yuv) {
  switch (matrix) {
    case AVCOL_SPC_RGB:
      return {yuv[2], yuv[0], yuv[1]};
    case AVCOL_SPC_YCGCO:
      return {yuv[0] - yuv[1] + yuv[2], yuv[0] + yuv[1], yuv[0] - yuv[1] - yuv[2]};
    case AVCOL_SPC_BT709:
      return rgb_by_weights(0.2126, 0.0722, yuv);
    case AVCOL_SPC_BT2020_NCL:
      return rgb_by_weights(0.2627, 0.0593, yuv);
    case AVCOL_SPC_SMPTE240M:
      return rgb_by_weights(0.212, 0.087, yuv);
    case AVCOL_SPC_FCC:
      return rgb_by_weights(0.30, 0.11, yuv);
    default:
      return rgb_by_weights(0.299, 0.114, yuv);
  }
}

/// From 0 to 1, or for chroma from -1/2 to 1/2 (H.273, equations 26 to 34, backwards).
/// @param chroma_range  of limited samples of 8 bits
double unit(double level, int depth, bool is_full, bool is_chroma, double chroma_range = 224) {
  const double steps = std::ldexp(1, depth - 8);
  if (is_full) return (level - (is_chroma ? 128 * steps : 0)) / (256 * steps - 1);
  return is_chroma ? (level / steps - 128) / chroma_range : (level / steps - 16) / 219;
}

/// Red, green, blue and alpha of a pixel, from 0 to 1.
std::array<double, 4> expected_at(const AVFrame& frame, const std::vector<SampleGrid>& planes,
                                  int x, int y) {
  const AVPixFmtDescriptor& format = descriptor_of(frame);
  const int depth = format.comp[0].depth;
  const bool is_full = frame.color_range == AVCOL_RANGE_JPEG;
  const auto alpha_of = [&](const SampleGrid& plane) {
    return plane.at(x, y) / ((1 << format.comp[format.nb_components - 1].depth) - 1);
  };
  const double luma = unit(planes[0].at(x, y), depth, is_full, false);
  if (format.nb_components <= 2) {
    return {luma, luma, luma, format.nb_components == 2 ? alpha_of(planes[1]) : 1};
  }
  const int width = 1 << format.log2_chroma_w;
  const int height = 1 << format.log2_chroma_h;
  const auto [left, top] = first_chroma(frame.chroma_location, width, height);
  const bool is_chroma = frame.colorspace != AVCOL_SPC_RGB;
  std::array<double, 3> yuv = {luma};
  for (std::size_t i = 1; i < 3; ++i) {
    const double level = planes[i].between((x - left) / width, (y - top) / height);
    // YCgCo is of red, green and blue that are quantised already (equations 45 to 47).
    const double range = frame.colorspace == AVCOL_SPC_YCGCO ? 219 : 224;
    yuv.at(i) = unit(level, depth, is_full, is_chroma, range);
  }
  const bool is_rgb_format = (format.flags & AV_PIX_FMT_FLAG_RGB) != 0;
  const auto rgb = is_rgb_format ? yuv : rgb_by(frame.colorspace, yuv);
  return {rgb[0], rgb[1], rgb[2], format.nb_components == 4 ? alpha_of(planes[3]) : 1};
}

/// The largest error of a sample, in levels, of which rounding is one half.
template <typename Picture>
double worst_error(const Picture& picture, int max_level, const AVFrame& frame,
                   const std::vector<SampleGrid>& planes) {
  constexpr int kBits = sizeof picture.words[0] * 2;
  double worst = 0;
  for (int y = 0; y < frame.height; ++y) {
    for (int x = 0; x < frame.width; ++x) {
      const auto expected = expected_at(frame, planes, x, y);
      const std::uint64_t word = picture.words.at(std::size_t(y * frame.width + x));
      for (std::size_t i = 0; i < 4; ++i) {
        const std::size_t place = i == 3 ? 3 : 2 - i;
        const auto level = double(word >> (place * kBits) & ((std::uint64_t{1} << kBits) - 1));
        const double exact = std::clamp(expected.at(i), 0.0, 1.0) * max_level;
        worst = std::max(worst, std::abs(level - exact));
      }
    }
  }
  return worst;
}

void expect_exact(Random& random, const PictureKind& kind, int width, int height) {
  SCOPED_TRACE(text(kind) + " " + std::to_string(width) + "x" + std::to_string(height));
  const AvFramePtr frame = empty_frame(kind, width, height);
  const std::vector<SampleGrid> planes = fill(random, *frame);
  const AnyImage image = rgb_of(*frame, "a.nut");
  const bool is_flat = std::holds_alternative<Image>(image);
  EXPECT_EQ(is_flat, greatest_depth(descriptor_of(*frame)) <= 8);
  const double worst = is_flat ? worst_error(std::get<Image>(image), 255, *frame, planes)
                               : worst_error(std::get<DeepImage>(image), 65535, *frame, planes);
  EXPECT_LT(worst, 0.5001);
}

constexpr std::array kMatrices = {AVCOL_SPC_BT709,     AVCOL_SPC_BT470BG, AVCOL_SPC_SMPTE170M,
                                  AVCOL_SPC_SMPTE240M, AVCOL_SPC_FCC,     AVCOL_SPC_BT2020_NCL,
                                  AVCOL_SPC_YCGCO,     AVCOL_SPC_RGB};
constexpr std::array kFormats = {
    AV_PIX_FMT_YUV420P,      AV_PIX_FMT_YUV422P,     AV_PIX_FMT_YUV444P,     AV_PIX_FMT_YUV440P,
    AV_PIX_FMT_YUV411P,      AV_PIX_FMT_YUV410P,     AV_PIX_FMT_NV12,        AV_PIX_FMT_NV24,
    AV_PIX_FMT_UYVY422,      AV_PIX_FMT_YUVA420P,    AV_PIX_FMT_YUVA444P,    AV_PIX_FMT_YUV420P9,
    AV_PIX_FMT_YUV420P10,    AV_PIX_FMT_P010LE,      AV_PIX_FMT_P010BE,      AV_PIX_FMT_YUV444P12,
    AV_PIX_FMT_YUV422P14,    AV_PIX_FMT_YUV420P16LE, AV_PIX_FMT_YUV444P16BE, AV_PIX_FMT_Y210LE,
    AV_PIX_FMT_YUVA444P16LE, AV_PIX_FMT_YUVA422P10,  AV_PIX_FMT_YUVA420P9,   AV_PIX_FMT_AYUV64LE};

TEST(DecodedRgb, IsExactForEveryFormatMatrixAndRange) {
  TracedRandom random(61);
  for (const AVPixelFormat format : kFormats) {
    for (const AVColorSpace matrix : kMatrices) {
      for (const AVColorRange range : {AVCOL_RANGE_MPEG, AVCOL_RANGE_JPEG}) {
        expect_exact(random, {format, matrix, range}, 12, 8);
      }
    }
  }
  for (const AVPixelFormat format :
       {AV_PIX_FMT_GRAY8, AV_PIX_FMT_GRAY10, AV_PIX_FMT_YA8, AV_PIX_FMT_YA16LE, AV_PIX_FMT_RGB24,
        AV_PIX_FMT_GBRP10, AV_PIX_FMT_GBRAP16LE, AV_PIX_FMT_RGBA64BE}) {
    expect_exact(random, {format, AVCOL_SPC_RGB, AVCOL_RANGE_MPEG}, 12, 8);
  }
}

TEST(DecodedRgb, ChromaIsWhereItIsSited) {
  TracedRandom random(62);
  for (const AVPixelFormat format :
       {AV_PIX_FMT_YUV420P, AV_PIX_FMT_YUV422P, AV_PIX_FMT_YUV440P, AV_PIX_FMT_YUV411P,
        AV_PIX_FMT_YUV410P, AV_PIX_FMT_YUV420P10, AV_PIX_FMT_YUVA420P16LE}) {
    for (int siting = AVCHROMA_LOC_UNSPECIFIED; siting <= AVCHROMA_LOC_BOTTOM; ++siting) {
      const PictureKind kind{format, AVCOL_SPC_BT709, AVCOL_RANGE_MPEG, AVChromaLocation(siting)};
      for (const auto& [width, height] :
           {std::pair{1, 1}, {2, 1}, {1, 2}, {3, 5}, {7, 4}, {16, 9}, {21, 13}}) {
        expect_exact(random, kind, width, height);
      }
    }
  }
}

/// Samples of all components at once.
AnyImage colour_of(const PictureKind& kind, const std::array<int, 3>& levels, int alpha = 0) {
  const AvFramePtr frame = empty_frame(kind, 4, 4);
  for (int component = 0; component < descriptor_of(*frame).nb_components; ++component) {
    for (int i = 0; i < 16; ++i) {
      if (i % 4 >= samples_in_row(*frame, component)) continue;
      if (i / 4 >= samples_in_column(*frame, component)) continue;
      put(*frame, component, i % 4, i / 4,
          component == 3 ? alpha : levels.at(std::size_t(component)));
    }
  }
  return rgb_of(*frame, "a.nut");
}

TEST(DecodedRgb, WhiteBlackAndAlphaEndWhereTheyEnd) {
  for (const AVPixelFormat format : kFormats) {
    const AVPixFmtDescriptor& descriptor = *av_pix_fmt_desc_get(format);
    const int depth = descriptor.comp[0].depth;
    const int step = 1 << (depth - 8);
    const int greatest = (1 << depth) - 1;
    for (const AVColorSpace matrix : kMatrices) {
      for (const bool is_full : {false, true}) {
        const PictureKind kind{format, matrix, is_full ? AVCOL_RANGE_JPEG : AVCOL_RANGE_MPEG};
        SCOPED_TRACE(text(kind));
        const int black = is_full ? 0 : 16 * step;
        const int white = is_full ? greatest : 235 * step;
        const bool is_rgb = matrix == AVCOL_SPC_RGB;
        const int middle = 128 * step;
        const std::array<int, 3> whites = {white, is_rgb ? white : middle, is_rgb ? white : middle};
        const std::array<int, 3> blacks = {black, is_rgb ? black : middle, is_rgb ? black : middle};
        const auto word = [](const AnyImage& image) { return deepened(image, 65535).words.at(5); };
        EXPECT_EQ(word(colour_of(kind, whites, greatest)), 0xffffffffffffffff);
        const bool has_alpha = descriptor.nb_components == 4;
        EXPECT_EQ(word(colour_of(kind, blacks)), has_alpha ? 0 : 0xffff000000000000);
      }
    }
  }
}

TEST(DecodedRgb, RefusesAMatrixThatIsNone) {
  for (const AVColorSpace matrix :
       {AVCOL_SPC_BT2020_CL, AVCOL_SPC_ICTCP, AVCOL_SPC_SMPTE2085, AVCOL_SPC_CHROMA_DERIVED_NCL,
        AVCOL_SPC_CHROMA_DERIVED_CL, AVCOL_SPC_RESERVED}) {
    const AvFramePtr frame = empty_frame({AV_PIX_FMT_YUV420P10, matrix}, 4, 4);
    EXPECT_NO_THROW(samples_of(*frame));
    const std::string message =
        testing_support::message_of<MediaError>([&] { rgb_of(*frame, "a.nut"); });
    EXPECT_TRUE(contains(message, "cannot compare 'a.nut' as RGB"));
    const char* const name = av_color_space_name(matrix);
    EXPECT_TRUE(contains(message, name == nullptr ? std::to_string(matrix) : name));
  }
}

}  // namespace
}  // namespace piblocks
