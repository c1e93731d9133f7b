#include "screen/recording.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

namespace piblocks::benchmark {
namespace {

YuvView<std::uint8_t> planes_of(std::vector<std::uint8_t>& samples) {
  std::uint8_t* const y = samples.data();
  std::uint8_t* const cb = y + Picture::kLuma;
  return {.y = {y, kScreenWidth_px},
          .cb = {cb, kScreenWidth_px / 2},
          .cr = {cb + Picture::kLuma / 4, kScreenWidth_px / 2}};
}

}  // namespace

Recording record(const Material& material) {
  Screen screen;
  const auto application = material.start();
  Recording recording;
  std::vector<std::uint8_t> shown(Picture::kLuma / 2 * 3);
  std::vector<std::uint8_t> whole(shown.size());
  double changed_px = 0;
  for (int number = 0; number < kPictures; ++number) {
    application->draw(screen, number);
    const ImageView view = screen.view();
    Picture& picture = recording.pictures.emplace_back();
    for (const PixelRect& rect : screen.take_changed()) {
      const PixelRect& aligned = picture.changed.emplace_back(chroma_aligned(rect, view));
      convert_to_yuv420(view, aligned, planes_of(shown));
      if (number > 0) changed_px += double(aligned.width_px) * aligned.height_px;
    }
    convert_to_yuv420(view, kWholeScreen, planes_of(whole));
    if (shown != whole) {
      throw Error(
          fmt::format("{}: picture {} changes outside of its rectangles", material.name, number));
    }
    picture.samples = shown;
  }
  recording.changed_share = changed_px / (kPictures - 1) / double(Picture::kLuma);
  return recording;
}

}  // namespace piblocks::benchmark
