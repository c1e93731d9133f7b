// Pictures of every pixel format that libavutil knows.
#include <gtest/gtest.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <string>
#include <vector>

#include "media/libav/decoded_frame.hpp"
#include "media/pixels/frame_reader.hpp"
#include "support/traced_random.hpp"

extern "C" {
#include <libavutil/imgutils.h>
#include <libavutil/pixdesc.h>
}

namespace piblocks {
namespace {

AvFramePtr picture_of(Random& random, const AVPixFmtDescriptor& format, int width, int height) {
  auto picture = own_av<AvFramePtr>(av_frame_alloc(), "picture");
  picture->format = av_pix_fmt_desc_get_id(&format);
  picture->width = width;
  picture->height = height;
  if (av_frame_get_buffer(picture.get(), 0) < 0) return nullptr;
  for (const AVBufferRef* buffer : picture->buf) {
    if (buffer == nullptr) continue;
    std::generate_n(buffer->data, buffer->size,
                    [&] { return static_cast<std::uint8_t>(random.integer(0, 255)); });
  }
  return picture;
}

/// Formats whose pictures are in memory, not in a graphics processor.
std::vector<const AVPixFmtDescriptor*> formats_in_memory() {
  std::vector<const AVPixFmtDescriptor*> formats;
  const AVPixFmtDescriptor* format = nullptr;
  while ((format = av_pix_fmt_desc_next(format)) != nullptr) {
    if ((format->flags & AV_PIX_FMT_FLAG_HWACCEL) == 0) formats.push_back(format);
  }
  return formats;
}

bool is_comparable(const AVFrame& picture) {
  try {
    check_pixel_format(picture, "a.nut");
    return true;
  } catch (const MediaError& error) {
    const auto* const format = av_pix_fmt_desc_get(static_cast<AVPixelFormat>(picture.format));
    EXPECT_NE(std::string(error.what()).find(format->name), std::string::npos) << error.what();
    return false;
  }
}

/// The samples of a component, row by row.
struct Plane {
  int width = 0;
  int height = 0;
  std::vector<std::uint16_t> levels = {};
};

std::vector<Plane> random_planes(Random& random, const AVPixFmtDescriptor& format, int width,
                                 int height) {
  std::vector<Plane> planes;
  for (int component = 0; component < format.nb_components; ++component) {
    const bool is_chroma = format.nb_components > 2 && (component == 1 || component == 2) &&
                           (format.flags & AV_PIX_FMT_FLAG_RGB) == 0;
    Plane plane{is_chroma ? width >> format.log2_chroma_w : width,
                is_chroma ? height >> format.log2_chroma_h : height};
    const int greatest = (1 << format.comp[component].depth) - 1;
    for (int i = plane.width * plane.height; i > 0; --i) {
      plane.levels.push_back(static_cast<std::uint16_t>(random.integer(0, greatest)));
    }
    planes.push_back(std::move(plane));
  }
  return planes;
}

/// Fills the picture; libavutil only adds bits to it.
void write_planes(const std::vector<Plane>& planes, const AVPixFmtDescriptor& format,
                  AVFrame& picture) {
  for (std::size_t component = 0; component < planes.size(); ++component) {
    const int plane = format.comp[component].plane;
    const std::ptrdiff_t rows = planes[component].height;
    std::fill_n(picture.data[plane], rows * picture.linesize[plane], std::uint8_t{0});
  }
  for (std::size_t component = 0; component < planes.size(); ++component) {
    const Plane& plane = planes[component];
    for (int y = 0; y < plane.height; ++y) {
      av_write_image_line2(plane.levels.data() + std::ptrdiff_t{y} * plane.width, picture.data,
                           picture.linesize, &format, 0, y, static_cast<int>(component),
                           plane.width, sizeof(std::uint16_t));
    }
  }
}

template <typename Picture>
int differing(const Picture& a, const Picture& b) {
  int count = 0;
  for (std::size_t i = 0; i < a.words.size(); ++i) count += a.words[i] != b.words[i] ? 1 : 0;
  return count;
}

int differing(const AnyImage& a, const AnyImage& b) {
  if (const auto* const flat = std::get_if<Image>(&a)) return differing(*flat, std::get<Image>(b));
  return differing(std::get<DeepImage>(a), std::get<DeepImage>(b));
}

/// Hardly any two entries of a random palette are equal.
TEST(VideoSamples, EverySampleOfEveryFormatIsReadWhereItIs) {
  TracedRandom random(41);
  std::size_t comparable = 0;
  for (const AVPixFmtDescriptor* format : formats_in_memory()) {
    SCOPED_TRACE(format->name);
    const AvFramePtr picture = picture_of(random, *format, 24, 16);
    ASSERT_TRUE(picture);
    if (!is_comparable(*picture)) continue;
    ++comparable;
    std::vector<Plane> planes = random_planes(random, *format, 24, 16);
    for (Plane& plane : planes) {
      for (int i = 0; i < 8; ++i) {
        write_planes(planes, *format, *picture);
        const AnyImage before = samples_of(*picture);
        const auto last = static_cast<std::int64_t>(plane.levels.size()) - 1;
        std::uint16_t& level = plane.levels.at(std::size_t(random.integer(0, last)));
        level = static_cast<std::uint16_t>(level == 0 ? 1 : level - 1);
        write_planes(planes, *format, *picture);
        ASSERT_EQ(differing(before, samples_of(*picture)), 24 * 16 / std::ssize(plane.levels));
      }
    }
  }
  EXPECT_GT(comparable, 150U);
}

TEST(VideoSamples, AnySizeOfAnyFormatCanBeReadAndShown) {
  TracedRandom random(42);
  for (const AVPixFmtDescriptor* format : formats_in_memory()) {
    SCOPED_TRACE(format->name);
    for (const auto& [width, height] : {std::pair{1, 1}, {3, 2}, {17, 9}, {70, 5}}) {
      const AvFramePtr picture = picture_of(random, *format, width, height);
      if (!picture || !is_comparable(*picture)) continue;
      const AnyImage samples = samples_of(*picture);
      EXPECT_FALSE(layout_of(*picture).empty());
      if (std::string_view(format->name).starts_with("xyz")) {
        EXPECT_THROW(rgb_of(*picture, "a.nut"), MediaError);
      } else {
        EXPECT_GE(max_level_of(rgb_of(*picture, "a.nut")), max_level_of(samples));
      }
    }
  }
}

TEST(VideoSamples, TheArrangementInMemoryIsNoDifference) {
  TracedRandom random(43);
  const AVPixFmtDescriptor& planar = *av_pix_fmt_desc_get(AV_PIX_FMT_YUV420P);
  const std::vector<Plane> planes = random_planes(random, planar, 32, 16);
  const AvFramePtr reference = picture_of(random, planar, 32, 16);
  write_planes(planes, planar, *reference);
  for (const AVPixelFormat other : {AV_PIX_FMT_NV12, AV_PIX_FMT_NV21}) {
    const AVPixFmtDescriptor& format = *av_pix_fmt_desc_get(other);
    const AvFramePtr packed = picture_of(random, format, 32, 16);
    write_planes(planes, format, *packed);
    EXPECT_EQ(layout_of(*packed), layout_of(*reference));
    EXPECT_EQ(differing(samples_of(*packed), samples_of(*reference)), 0) << format.name;
  }
}

TEST(VideoSamples, RangeAndMatrixArePartOfTheLayout) {
  Random random(44);
  const AvFramePtr picture = picture_of(random, *av_pix_fmt_desc_get(AV_PIX_FMT_YUV420P), 16, 16);
  const std::string untagged = layout_of(*picture);
  picture->color_range = AVCOL_RANGE_MPEG;
  picture->colorspace = AVCOL_SPC_SMPTE170M;
  EXPECT_EQ(layout_of(*picture), untagged);  // what players assume
  picture->colorspace = AVCOL_SPC_BT709;
  const std::string bt709 = layout_of(*picture);
  EXPECT_NE(bt709, untagged);
  picture->color_range = AVCOL_RANGE_JPEG;
  EXPECT_NE(layout_of(*picture), bt709);
}

TEST(VideoSamples, GreyIsRgbWithEqualSamples) {
  Random random(45);
  for (const AVPixelFormat grey : {AV_PIX_FMT_GRAY8, AV_PIX_FMT_MONOWHITE, AV_PIX_FMT_MONOBLACK}) {
    const AvFramePtr picture = picture_of(random, *av_pix_fmt_desc_get(grey), 16, 4);
    EXPECT_EQ(layout_of(*picture), "rgba");
    const AnyImage samples = samples_of(*picture);
    for (const std::uint32_t word : std::get<Image>(samples).words) {
      EXPECT_EQ(word, 0xff000000U | (word & 0xff) * 0x010101U);
    }
  }
  const AvFramePtr white = picture_of(random, *av_pix_fmt_desc_get(AV_PIX_FMT_MONOWHITE), 8, 1);
  white->data[0][0] = 0x7f;  // the first pixel is 0, which is white here
  EXPECT_EQ(std::get<Image>(samples_of(*white)).words.at(0), 0xffffffffU);
  EXPECT_EQ(std::get<Image>(samples_of(*white)).words.at(1), 0xff000000U);
}

}  // namespace
}  // namespace piblocks
