// The frames of a GIF as browsers show them. libavcodec's decoder fills areas that no frame covers
// with the background colour of the screen, which browsers ignore.
#include <fmt/format.h>
#include <gif_lib.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/stop.hpp"
#include "media/libav/av.hpp"
#include "media/libav/av_module.hpp"
#include "media/pixels/animation.hpp"
#include "media/pixels/frame_reader.hpp"

namespace piblocks {
namespace {

struct CloseGif {
  void operator()(GifFileType* file) const { DGifCloseFile(file, nullptr); }
};

int read_input(GifFileType* file, GifByteType* bytes, int count) {
  return avio_read(static_cast<AVIOContext*>(file->UserData), bytes, count);
}

class GifReader final : public FrameReader {
 public:
  GifReader(std::string path, std::unique_ptr<VideoInput> input)
      : path_(std::move(path)), input_(std::move(input)) {
    avio_seek(input_->file->pb, 0, SEEK_SET);  // in a pipe too: libavformat has kept its beginning
    int error = 0;
    file_.reset(DGifOpen(input_->file->pb, read_input, &error));
    if (!file_) fail(error);
    check_size(file_->SWidth, file_->SHeight);
    screen_.emplace(file_->SWidth, file_->SHeight, Image{});
  }

  bool next() override {
    if (more_frames_ > 0) return more_frames_-- > 0;
    GraphicsControlBlock control{DISPOSAL_UNSPECIFIED, false, 0, NO_TRANSPARENT_COLOR};
    while (true) {
      GifRecordType type = UNDEFINED_RECORD_TYPE;
      check(DGifGetRecordType(file_.get(), &type));
      if (type == TERMINATE_RECORD_TYPE) return false;
      if (type == EXTENSION_RECORD_TYPE) read_extension(control);
      if (type != IMAGE_DESC_RECORD_TYPE) continue;
      check(DGifGetImageDesc(file_.get()));
      show(control);
      more_frames_ = frames_of_.of_next({control.DelayTime, 100}) - 1;
      return true;
    }
  }
  AnyImage samples() override { return *shown_; }

 private:
  [[noreturn]] void fail(int error) const {
    const bool is_cut_off = error == D_GIF_ERR_READ_FAILED || error == D_GIF_ERR_EOF_TOO_SOON;
    const char* const reason = GifErrorString(error);
    throw MediaError(fmt::format("video: cannot read '{}': {}", path_,
                                 is_cut_off          ? "it is cut off before its last frame"
                                 : reason != nullptr ? reason
                                                     : "it is damaged"));
  }
  void check(int code) const {
    check_stop(input_->stop);
    if (code == GIF_ERROR) fail(file_->Error);
  }
  void check_size(int width_px, int height_px) const {
    const std::int64_t pixels = std::int64_t{width_px} * height_px;
    if (width_px > 0 && height_px > 0 && pixels <= kMaxFrame_px) return;
    throw MediaError(fmt::format("video: cannot read '{}': a picture of {}x{} pixels", path_,
                                 width_px, height_px));
  }
  void read_extension(GraphicsControlBlock& control) {
    int kind = 0;
    GifByteType* block = nullptr;  // its size comes first
    check(DGifGetExtension(file_.get(), &kind, &block));
    std::string name;
    while (block != nullptr) {
      if (kind == GRAPHICS_EXT_FUNC_CODE) DGifExtensionToGCB(block[0], block + 1, &control);
      const std::string text(block + 1, block + 1 + block[0]);
      if (kind == APPLICATION_EXT_FUNC_CODE && name == kFrameRateExtension)
        frames_of_.set_rate(text);
      if (name.empty()) name = text;
      check(DGifGetExtensionNext(file_.get(), &block));
    }
  }
  /// Puts the image that is described now on the screen.
  void show(const GraphicsControlBlock& control) {
    const GifImageDesc& image = file_->Image;
    check_size(image.Width, image.Height);
    const auto inside = [](int size, int at, int room) {
      return static_cast<std::uint32_t>(std::clamp(room - at, 0, size));
    };
    const FrameControl place{.width = inside(image.Width, image.Left, file_->SWidth),
                             .height = inside(image.Height, image.Top, file_->SHeight),
                             .x = static_cast<std::uint32_t>(std::min(image.Left, file_->SWidth)),
                             .y = static_cast<std::uint32_t>(std::min(image.Top, file_->SHeight)),
                             .disposal = disposal_of(control),
                             .is_blended = true};
    shown_ = &screen_->show(place, read_picture(image, place, control.TransparentColor));
  }
  static Disposal disposal_of(const GraphicsControlBlock& control) {
    if (control.DisposalMode == DISPOSE_BACKGROUND) return Disposal::background;
    return control.DisposalMode == DISPOSE_PREVIOUS ? Disposal::previous : Disposal::none;
  }
  /// The part of the image that is on the screen.
  Image read_picture(const GifImageDesc& image, const FrameControl& place, int transparent) {
    const ColorMapObject* const map = image.ColorMap != nullptr ? image.ColorMap : file_->SColorMap;
    Image picture{int(place.width), int(place.height), {}};
    picture.words.resize(std::size_t{place.width} * place.height);
    std::vector<GifPixelType> line(std::size_t(image.Width));
    for (const auto& [first, step] : passes(image.Interlace)) {
      for (int y = first; y < image.Height; y += step) {
        check(DGifGetLine(file_.get(), line.data(), image.Width));
        if (y >= picture.height_px) continue;
        std::ranges::transform(std::span(line).first(place.width),
                               picture.words.begin() + std::ptrdiff_t(y) * picture.width_px,
                               [&](int index) { return color_of(map, index, transparent); });
      }
    }
    return picture;
  }
  static std::vector<std::pair<int, int>> passes(bool is_interlaced) {
    if (is_interlaced) return {{0, 8}, {4, 8}, {2, 4}, {1, 2}};
    return {{0, 1}};
  }
  /// 0xAARRGGBB; transparent black where the image leaves what is there.
  std::uint32_t color_of(const ColorMapObject* map, int index, int transparent) const {
    constexpr std::uint32_t kOpaque = 0xff000000;
    if (index == transparent) return 0;
    const int count = map == nullptr ? 0 : map->ColorCount;
    if (index < count) {
      const GifColorType& color = map->Colors[index];
      return kOpaque | std::uint32_t{color.Red} << 16 | std::uint32_t{color.Green} << 8 |
             color.Blue;
    }
    throw MediaError(fmt::format(
        "video: cannot read '{}': a pixel has colour {} of a palette of {}", path_, index, count));
  }

  std::string path_;
  std::unique_ptr<VideoInput> input_;
  std::unique_ptr<GifFileType, CloseGif> file_;
  std::optional<Screen<Image>> screen_;
  ImageFrames frames_of_;
  std::int64_t more_frames_ = 0;  // that show the last image
  const Image* shown_ = nullptr;
};

}  // namespace

std::unique_ptr<FrameReader> read_gif(const std::string& path, std::unique_ptr<VideoInput> input) {
  return std::make_unique<GifReader>(path, std::move(input));
}

}  // namespace piblocks
