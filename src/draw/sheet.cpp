#include "draw/sheet.hpp"

#include <algorithm>
#include <cassert>
#include <iterator>
#include <utility>

#include "draw/cairo_handles.hpp"
#include "draw/font.hpp"
#include "draw/painter.hpp"
#include "draw/style.hpp"

namespace piblocks {
namespace {

constexpr Color kPaper = {255, 255, 255};
constexpr Color kFrame = {160, 160, 160};
constexpr Color kCaption = {32, 32, 32};

// In ems of the caption.
constexpr double kBaseline = 1.25;  // below the picture
constexpr double kCaptionHeight = 1.6;

TextItem caption_below(const Rectangle& place, const std::string& text, double size_px,
                       const Font& font) {
  const double fitted_px = font.fitted_px(text, size_px, place.width);
  return {ItemId::label,
          {place.x + (place.width - font.width_em(text) * fitted_px) / 2,
           place.y + place.height + kBaseline * size_px},
          text,
          fitted_px,
          kCaption};
}

/// A line around a picture, half inside of it, half outside.
RectangleItem frame_of(const Rectangle& place, double width_px) {
  return {ItemId::wall,
          {place.x - width_px / 2, place.y - width_px / 2, place.width + width_px,
           place.height + width_px},
          std::nullopt,
          Stroke{kFrame, width_px, 0}};
}

}  // namespace

DrawList arrange(std::vector<CaptionedPicture> pictures, int width_px, int height_px) {
  assert(!pictures.empty());
  const Font font;
  const double side = std::min(width_px, height_px);
  const double margin = style::kSheetMargin * side;
  const double gap = style::kSheetGap * side;
  const double text_px = style::kSheetCaption * side;
  const double line_px = std::max(0.5, style::kSheetLine * side);
  const double caption = kCaptionHeight * text_px;
  const DrawList& first = pictures.front().picture;
  const double aspect = double(first.width_px) / first.height_px;
  const int count = static_cast<int>(pictures.size());
  const auto rows = [count](int columns) { return (count + columns - 1) / columns; };
  const auto picture_width = [&](int columns) {
    const double room_x = (width_px - 2 * margin - (columns - 1) * gap) / columns;
    const double room_y =
        (height_px - 2 * margin - (rows(columns) - 1) * gap) / rows(columns) - caption;
    return std::max(0.0, std::min(room_x, room_y * aspect));
  };
  int columns = 1;
  for (int more = 2; more <= count; ++more) {
    if (picture_width(more) > picture_width(columns)) columns = more;
  }
  const double width = picture_width(columns);
  const double height = width / aspect;
  const double step_x = width + gap;
  const double step_y = height + caption + gap;
  const double left = (width_px - columns * step_x + gap) / 2;
  const double top = (height_px - rows(columns) * step_y + gap) / 2;

  DrawList page{width_px, height_px, kPaper, {}};
  std::vector<DrawItem> above;
  for (int i = 0; i < count; ++i) {
    auto& [picture, caption_text] = pictures[static_cast<std::size_t>(i)];
    const Rectangle place{left + i % columns * step_x, top + i / columns * step_y, width, height};
    page.items.emplace_back(GroupItem{ItemId::compared, place,
                                      std::make_shared<const DrawList>(std::move(picture)), 1});
    above.emplace_back(frame_of(place, line_px));
    above.emplace_back(caption_below(place, caption_text, text_px, font));
  }
  std::ranges::move(above, std::back_inserter(page.items));
  return page;
}

Image draw_pixels(const DrawList& page) {
  Image image{page.width_px, page.height_px, {}};
  image.words.resize(std::size_t(image.width_px) * std::size_t(image.height_px));
  const CairoSurfacePtr surface(cairo_image_surface_create_for_data(
      reinterpret_cast<unsigned char*>(image.words.data()), CAIRO_FORMAT_RGB24, image.width_px,
      image.height_px, 4 * image.width_px));
  const CairoPtr cr(cairo_create(surface.get()));
  Painter(TextSetting::glyphs).paint(*cr, page);
  cairo_surface_finish(surface.get());
  check_cairo(cairo_surface_status(surface.get()), "paint a sheet");
  return image;
}

}  // namespace piblocks
