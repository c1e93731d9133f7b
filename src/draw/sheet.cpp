#include "draw/sheet.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

#include "draw/cairo_handles.hpp"
#include "draw/font.hpp"
#include "draw/painter.hpp"
#include "draw/vector_file.hpp"

namespace piblocks {
namespace {

constexpr Color kPaper = {255, 255, 255};
constexpr Color kFrame = {160, 160, 160};
constexpr Color kCaption = {32, 32, 32};

// In parts of the page's shorter side.
constexpr double kMargin = 0.05;
constexpr double kGap = 0.025;
constexpr double kLargestText = 0.018;
// In ems of the caption.
constexpr double kBaseline = 1.25;  // below the picture
constexpr double kCaptionHeight = 1.6;

/// Where pictures go, all of one size.
struct Grid {
  int columns = 1;
  int rows = 1;
  double width = 0;   // of a picture
  double height = 0;  // likewise
};

/// The number of columns that makes the pictures largest.
Grid best_grid(int count, double aspect, double width, double height, double gap, double caption) {
  Grid best;
  for (int columns = 1; columns <= count; ++columns) {
    Grid grid{columns, (count + columns - 1) / columns};
    const double room_x = (width - (columns - 1) * gap) / columns;
    const double room_y = (height - (grid.rows - 1) * gap) / grid.rows - caption;
    grid.width = std::max(0.0, std::min(room_x, room_y * aspect));
    grid.height = grid.width / aspect;
    if (grid.width > best.width) best = grid;
  }
  return best;
}

TextItem caption_below(const Rectangle& place, const std::string& text, double size_px,
                       const Font& font) {
  const double width_em = std::max(1e-3, font.width_em(text));
  const double fitted = std::min(size_px, place.width / width_em);
  return {ItemId::label,
          {place.x + (place.width - width_em * fitted) / 2,
           place.y + place.height + kBaseline * size_px},
          text,
          fitted,
          kCaption};
}

/// The lists are in pixels of their own.
void paint_picture(cairo_t& cr, Painter& painter, const PlacedPicture& placed) {
  cairo_save(&cr);
  cairo_rectangle(&cr, placed.place.x, placed.place.y, placed.place.width, placed.place.height);
  cairo_clip(&cr);
  cairo_translate(&cr, placed.place.x, placed.place.y);
  const double scale = placed.place.width / placed.picture.width_px;
  cairo_scale(&cr, scale, scale);
  painter.paint(cr, placed.picture);
  cairo_restore(&cr);
}

void paint(cairo_t& cr, const Sheet& sheet, TextSetting setting) {
  Painter painter(setting);
  const DrawList& page = sheet.page;
  painter.paint(cr, {page.width_px, page.height_px, page.background, {}});
  for (const PlacedPicture& placed : sheet.pictures) paint_picture(cr, painter, placed);
  painter.paint(cr, {page.width_px, page.height_px, std::nullopt, page.items});
}

}  // namespace

Sheet arrange(std::vector<CaptionedPicture> pictures, int width_px, int height_px) {
  assert(!pictures.empty());
  const Font font;
  const double side = std::min(width_px, height_px);
  const double margin = kMargin * side;
  const double gap = kGap * side;
  const double text_px = kLargestText * side;
  const DrawList& first = pictures.front().picture;
  const double aspect = double(first.width_px) / first.height_px;
  const double caption = kCaptionHeight * text_px;
  const Grid grid = best_grid(static_cast<int>(pictures.size()), aspect, width_px - 2 * margin,
                              height_px - 2 * margin, gap, caption);
  const double step_x = grid.width + gap;
  const double step_y = grid.height + caption + gap;
  const double left = (width_px - grid.columns * step_x + gap) / 2;
  const double top = (height_px - grid.rows * step_y + gap) / 2;

  Sheet sheet{{}, {width_px, height_px, kPaper, {}}};
  // Half inside the picture, half outside.
  const Stroke line{kFrame, std::max(0.5, side / 1200), 0};
  for (int i = 0; i < static_cast<int>(pictures.size()); ++i) {
    CaptionedPicture& source = pictures[static_cast<std::size_t>(i)];
    const int column = i % grid.columns;
    const int row = i / grid.columns;
    const Rectangle place{left + column * step_x, top + row * step_y, grid.width, grid.height};
    sheet.page.items.emplace_back(
        RectangleItem{ItemId::wall,
                      {place.x - line.width_px / 2, place.y - line.width_px / 2,
                       place.width + line.width_px, place.height + line.width_px},
                      std::nullopt,
                      line});
    sheet.page.items.emplace_back(caption_below(place, source.caption, text_px, font));
    sheet.pictures.push_back({std::move(source.picture), place});
  }
  return sheet;
}

Image draw_pixels(const Sheet& sheet) {
  Image image{sheet.page.width_px, sheet.page.height_px, {}};
  image.words.resize(std::size_t(image.width_px) * std::size_t(image.height_px));
  const CairoSurfacePtr surface(cairo_image_surface_create_for_data(
      reinterpret_cast<unsigned char*>(image.words.data()), CAIRO_FORMAT_RGB24, image.width_px,
      image.height_px, 4 * image.width_px));
  const CairoPtr cr(cairo_create(surface.get()));
  paint(*cr, sheet, TextSetting::glyphs);
  cairo_surface_finish(surface.get());
  check_cairo(cairo_surface_status(surface.get()), "paint a sheet");
  return image;
}

std::vector<std::uint8_t> draw_svg(const Sheet& sheet) {
  return write_svg(sheet.page.width_px, sheet.page.height_px,
                   [&](cairo_t& cr) { paint(cr, sheet, TextSetting::lines); });
}

std::vector<std::uint8_t> draw_pdf(const Sheet& sheet) {
  return write_pdf(sheet.page.width_px, sheet.page.height_px,
                   [&](cairo_t& cr) { paint(cr, sheet, TextSetting::lines); });
}

}  // namespace piblocks
