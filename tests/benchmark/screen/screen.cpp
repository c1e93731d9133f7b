#include "screen/screen.hpp"

#include <cairo-ft.h>
#include <ft2build.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include FT_FREETYPE_H

namespace piblocks::benchmark {
namespace {

constexpr double kTextSize_px = 18;
constexpr int kBaseline_px = 17;  // below the top of a line

/// Of a font that lives as long as the program.
FT_Face load_font() {
  FT_Library library = nullptr;
  FT_Face face = nullptr;
  if (FT_Init_FreeType(&library) != 0 || FT_New_Face(library, SCREEN_FONT, 0, &face) != 0) {
    throw DrawError("draw: cannot load " SCREEN_FONT " (Debian package fonts-dejavu-core)");
  }
  return face;
}

CairoFontFacePtr screen_font() {
  static const FT_Face face = load_font();
  return CairoFontFacePtr(cairo_ft_font_face_create_for_ft_face(face, 0));
}

}  // namespace

Screen::Screen()
    : surface_(
          image_surface(CAIRO_FORMAT_RGB24, kScreenWidth_px, kScreenHeight_px, "make a screen")),
      cairo_(cairo_create(surface_.get())),
      font_(screen_font()) {
  cairo_set_font_face(cairo_.get(), font_.get());
  const CairoFontOptionsPtr options(cairo_font_options_create());
  cairo_font_options_set_antialias(options.get(), CAIRO_ANTIALIAS_GRAY);
  cairo_font_options_set_hint_style(options.get(), CAIRO_HINT_STYLE_SLIGHT);
  cairo_font_options_set_hint_metrics(options.get(), CAIRO_HINT_METRICS_ON);
  cairo_set_font_options(cairo_.get(), options.get());
}

void Screen::set_colour(Colour colour) {
  const auto level = [&](int shift) { return double(colour >> shift & 0xff) / 255; };
  cairo_set_source_rgb(cairo_.get(), level(16), level(8), level(0));
}

void Screen::fill(const PixelRect& rect, Colour colour) {
  set_colour(colour);
  cairo_rectangle(cairo_.get(), rect.x_px, rect.y_px, rect.width_px, rect.height_px);
  cairo_fill(cairo_.get());
  mark_changed(rect);
}

void Screen::write(int x_px, int y_px, const std::string& text, Colour colour) {
  write_large(x_px, y_px + kBaseline_px, kTextSize_px, text, colour);
}

void Screen::write_large(double x_px, double baseline_px, double size_px, const std::string& text,
                         Colour colour) {
  set_colour(colour);
  cairo_set_font_size(cairo_.get(), size_px);
  cairo_move_to(cairo_.get(), x_px, baseline_px);
  cairo_show_text(cairo_.get(), text.c_str());
}

void Screen::mark_changed(const PixelRect& rect) {
  const int left = std::max(rect.x_px, 0);
  const int top = std::max(rect.y_px, 0);
  const int right = std::min(rect.x_px + rect.width_px, kScreenWidth_px);
  const int bottom = std::min(rect.y_px + rect.height_px, kScreenHeight_px);
  if (left < right && top < bottom) changed_.push_back({left, top, right - left, bottom - top});
}

void Screen::mark_changed(double left, double top, double right, double bottom, double margin) {
  const int x = int(std::floor(left - margin));
  const int y = int(std::floor(top - margin));
  mark_changed({x, y, int(std::ceil(right + margin)) - x, int(std::ceil(bottom + margin)) - y});
}

std::vector<PixelRect> Screen::take_changed() { return std::exchange(changed_, {}); }

ImageView Screen::view() {
  cairo_surface_flush(surface_.get());
  return {cairo_image_surface_get_data(surface_.get()), kScreenWidth_px, kScreenHeight_px,
          cairo_image_surface_get_stride(surface_.get())};
}

void Screen::save_png(const std::string& path) const {
  check_cairo(cairo_surface_write_to_png(surface_.get(), path.c_str()), "write a PNG file");
}

}  // namespace piblocks::benchmark
