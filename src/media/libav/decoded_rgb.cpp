#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "media/libav/decoded_frame.hpp"

namespace piblocks {
namespace {

/// Red, green and blue from Y, of 0 to 1, and Cb and Cr, of -1/2 to 1/2.
using Matrix = std::array<std::array<double, 3>, 3>;

/// @param red, blue  their weights in luma; what is left is green's.
Matrix matrix_by_weights(double red, double blue) {
  const double green = 1 - red - blue;
  return {{{1, 0, 2 * (1 - red)},
           {1, -2 * blue * (1 - blue) / green, -2 * red * (1 - red) / green},
           {1, 2 * (1 - blue), 0}}};
}

/// The matrices of ITU-T H.273, table 4. Nothing for conversions that are not linear in the stored
/// samples, or that depend on other tags.
std::optional<Matrix> matrix_to_rgb(const AVFrame& frame) {
  switch (matrix_of(frame)) {
    case AVCOL_SPC_BT709:
      return matrix_by_weights(0.2126, 0.0722);
    case AVCOL_SPC_FCC:
      return matrix_by_weights(0.30, 0.11);
    case AVCOL_SPC_SMPTE170M:
      return matrix_by_weights(0.299, 0.114);
    case AVCOL_SPC_SMPTE240M:
      return matrix_by_weights(0.212, 0.087);
    case AVCOL_SPC_BT2020_NCL:
      return matrix_by_weights(0.2627, 0.0593);
    case AVCOL_SPC_YCGCO:
      return Matrix{{{1, -1, 1}, {1, 1, 0}, {1, -1, -1}}};
    default:
      return std::nullopt;
  }
}

/// A colour sample is a weighted sum of the three stored samples, each minus its zero.
struct Conversion {
  std::array<int, 3> zeros;
  Matrix weights;
};

/// Chroma is interpolated in units of 1/kInterpolated.
constexpr int kInterpolatedBits = 6;
constexpr int kInterpolated = 1 << kInterpolatedBits;

/// Which component is red, green and blue in a format without chroma.
Matrix order_of_rgb(const AVPixFmtDescriptor& format) {
  if (is_grey(format)) return {{{1, 0, 0}, {1, 0, 0}, {1, 0, 0}}};
  if (has_flag(format, AV_PIX_FMT_FLAG_RGB)) return {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  return {{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}}};  // Y is green, Cb blue, Cr red
}

Conversion conversion_of(const AVFrame& frame, int max_level, const std::string& path) {
  const AVPixFmtDescriptor& format = descriptor_of(frame);
  const AVColorSpace space = matrix_of(frame);
  const bool has_chroma = space != AVCOL_SPC_RGB;
  const auto matrix = has_chroma ? matrix_to_rgb(frame) : order_of_rgb(format);
  if (!matrix || is_xyz(format)) {
    const char* const name = is_xyz(format) ? "xyz" : av_color_space_name(space);
    throw MediaError(
        fmt::format("video: cannot compare '{}' as RGB: there is no conversion from its colours, "
                    "{}; convert it, such as by ffmpeg -vf zscale=matrix=709",
                    path, name == nullptr ? fmt::format("matrix {}", int(space)) : name));
  }
  Conversion result{{}, *matrix};
  for (std::size_t i = 0; i < 3; ++i) {
    const int component = component_of(format, int(i));
    const int depth = format.comp[component].depth;
    const bool is_chroma = has_chroma && i > 0;
    const int one = 1 << std::max(0, depth - 8);
    const bool is_full = is_full_range(frame);
    // Cg and Co are sums of quantised red, green and blue (H.273, equations 45 to 47).
    const bool has_range_of_luma = !is_chroma || space == AVCOL_SPC_YCGCO;
    const int range = is_full ? (1 << depth) - 1 : (has_range_of_luma ? 219 : 224) * one;
    const int scale = i == 0 ? 1 : kInterpolated;
    result.zeros[i] = scale * (is_chroma ? 1 << (depth - 1) : is_full ? 0 : 16 * one);
    for (auto& weights : result.weights) weights[i] *= double(max_level) / range / scale;
  }
  return result;
}

/// Weights of two neighbours are in units of 1/kWhole.
constexpr int kWhole = 8;
static_assert(kWhole * kWhole == kInterpolated);

/// Between which samples of a row or column a pixel lies.
struct Neighbours {
  int first;
  int weight;  ///< of the sample after it
};

/// @param shift  log2 of the pixels that share a sample, at most 2
/// @param middle  of the sample, in halves of a pixel from the first of them
Neighbours neighbours_of(int pixel, int shift, int middle) {
  const int halves = 2 * pixel - middle;
  const int distance = 2 << shift;
  return {.first = halves >> (shift + 1), .weight = (halves & (distance - 1)) * kWhole / distance};
}

/// Interpolates a row that has one more sample at either end.
template <int kShift>
void spread(const int* __restrict row, int count, int middle, int* __restrict pixels) {
  constexpr std::size_t kPixels = std::size_t{1} << kShift;
  std::array<Neighbours, kPixels> of{};
  for (std::size_t i = 0; i < kPixels; ++i) of[i] = neighbours_of(int(i), kShift, middle);
  for (int at = 0; at < count; ++at) {
    for (std::size_t i = 0; i < kPixels; ++i) {
      const int* const first = row + at + of[i].first + 1;
      *pixels++ = (kWhole - of[i].weight) * first[0] + of[i].weight * first[1];
    }
  }
}

/// A component, row by row, with one sample for each pixel.
class Upsampler {
 public:
  Upsampler(const AVFrame& frame, int component)
      : frame_(frame),
        component_(component),
        x_shift_(x_shift_of(descriptor_of(frame), component)),
        y_shift_(y_shift_of(descriptor_of(frame), component)),
        count_(samples_in_row(frame, component)),
        last_row_(samples_in_column(frame, component) - 1),
        siting_(siting_of(frame)),
        blended_(std::size_t(count_) + 2),
        pixels_(std::size_t(count_) << x_shift_) {
    for (auto& levels : levels_) levels.resize(std::size_t(count_));
  }

  /// Row `y` of the picture, in units of 1/kInterpolated.
  const int* row(int y) {
    const auto [first, weight] = neighbours_of(y, y_shift_, y_shift_ == 0 ? 0 : siting_.down);
    const std::uint16_t* const upper = stored(std::clamp(first, 0, last_row_));
    const std::uint16_t* const lower = stored(std::clamp(first + 1, 0, last_row_));
    int* const blended = blended_.data() + 1;
    for (int i = 0; i < count_; ++i) blended[i] = (kWhole - weight) * upper[i] + weight * lower[i];
    blended[-1] = blended[0];
    blended[count_] = blended[count_ - 1];
    const int middle = siting_.right;
    switch (x_shift_) {
      case 0:
        spread<0>(blended_.data(), count_, 0, pixels_.data());
        break;
      case 1:
        spread<1>(blended_.data(), count_, middle, pixels_.data());
        break;
      default:
        spread<2>(blended_.data(), count_, middle, pixels_.data());
    }
    return pixels_.data();
  }

 private:
  /// A row as it is stored, valid until another row of the same parity is asked for.
  const std::uint16_t* stored(int row) {
    auto& levels = levels_.at(std::size_t(row & 1));
    int& number = numbers_.at(std::size_t(row & 1));
    if (number != row) read_levels(frame_, component_, row, levels.data());
    number = row;
    return levels.data();
  }

  const AVFrame& frame_;
  int component_;
  int x_shift_, y_shift_;
  int count_;
  int last_row_;
  Siting siting_;
  std::array<std::vector<std::uint16_t>, 2> levels_;
  std::array<int, 2> numbers_ = {-1, -1};
  std::vector<int> blended_;
  std::vector<int> pixels_;
};

/// The stored samples of a row, one for each pixel.
struct YuvRow {
  const std::uint16_t* y;
  const int* cb;
  const int* cr;
  const std::uint16_t* alpha;
};

/// @tparam Real  has more bits than the samples and their interpolation.
template <typename Real, typename Word>
void convert_row(const YuvRow& row, const Conversion& conversion, int max_level, Real alpha_weight,
                 int width, Word* __restrict words) {
  const std::uint16_t* __restrict const y = row.y;
  const int* __restrict const cb = row.cb;
  const int* __restrict const cr = row.cr;
  const std::uint16_t* __restrict const alpha = row.alpha;
  constexpr int kBits = sizeof(Word) * 2;
  std::array<std::array<Real, 3>, 3> weights{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) weights[i][j] = Real(conversion.weights[i][j]);
  }
  const auto [y_zero, cb_zero, cr_zero] = conversion.zeros;
  const auto level = [max_level](Real value) {
    const int rounded = int(value + Real(0.5));
    return static_cast<Word>(rounded < 0 ? 0 : rounded > max_level ? max_level : rounded);
  };
  for (int x = 0; x < width; ++x) {
    const auto a = Real(y[x] - y_zero);
    const auto b = Real(cb[x] - cb_zero);
    const auto c = Real(cr[x] - cr_zero);
    const auto color = [&](std::size_t i) {
      return level(weights[i][0] * a + weights[i][1] * b + weights[i][2] * c);
    };
    words[x] = level(alpha_weight * Real(alpha[x])) << (3 * kBits) | color(0) << (2 * kBits) |
               color(1) << kBits | color(2);
  }
}

template <typename Real, typename Picture>
Picture converted(const AVFrame& frame, Picture picture, int max_level, const std::string& path) {
  const AVPixFmtDescriptor& format = descriptor_of(frame);
  const Conversion conversion = conversion_of(frame, max_level, path);
  picture.width_px = frame.width;
  picture.height_px = frame.height;
  picture.words.resize(std::size_t(frame.width) * std::size_t(frame.height));
  Upsampler cb(frame, component_of(format, 1));
  Upsampler cr(frame, component_of(format, 2));
  const int alpha_component = component_of(format, kAlpha);
  std::vector<std::uint16_t> luma(std::size_t(frame.width));
  std::vector<std::uint16_t> alpha(std::size_t(frame.width), std::uint16_t(max_level));
  const double alpha_max =
      alpha_component < 0 ? max_level : (1 << format.comp[alpha_component].depth) - 1;
  for (int y = 0; y < frame.height; ++y) {
    read_levels(frame, component_of(format, 0), y, luma.data());
    if (alpha_component >= 0) read_levels(frame, alpha_component, y, alpha.data());
    convert_row({luma.data(), cb.row(y), cr.row(y), alpha.data()}, conversion, max_level,
                Real(max_level / alpha_max), frame.width,
                picture.words.data() + std::ptrdiff_t{y} * frame.width);
  }
  return picture;
}

}  // namespace

AnyImage rgb_of(const AVFrame& frame, const std::string& path) {
  if (is_rgb(frame)) return samples_of(frame);
  constexpr int kMaxDeep = 65535;
  if (greatest_depth(descriptor_of(frame)) <= 8) return converted<float>(frame, Image{}, 255, path);
  return converted<double>(frame, DeepImage{.max_level = kMaxDeep}, kMaxDeep, path);
}

}  // namespace piblocks
