// The window of a pretended application, drawn with Cairo.
// In: what the application draws. Out: pixels, and the rectangles that the application drew in.
#pragma once

#include <cairo.h>
#include <piblocks/image.hpp>

#include <cstdint>
#include <string>
#include <vector>

#include "draw/cairo_handles.hpp"

namespace piblocks::benchmark {

inline constexpr int kScreenWidth_px = 1920;
inline constexpr int kScreenHeight_px = 1080;

/// 0xRRGGBB
using Colour = std::uint32_t;

class Screen {
 public:
  /// A cell of text: all characters are equally wide.
  static constexpr int kCellWidth_px = 11;
  static constexpr int kLineHeight_px = 22;

  Screen();

  /// For drawing shapes. The caller reports what it has drawn by mark_changed().
  cairo_t& cairo() { return *cairo_; }
  void set_colour(Colour colour);

  /// Fills a rectangle, which counts as changed.
  void fill(const PixelRect& rect, Colour colour);
  /// Writes over what is there. @param x_px, y_px  upper left corner of the first cell
  void write(int x_px, int y_px, const std::string& text, Colour colour);
  /// The same at another size, from the baseline.
  void write_large(double x_px, double baseline_px, double size_px, const std::string& text,
                   Colour colour);
  void mark_changed(const PixelRect& rect);
  /// The rectangle around points, with a margin on each side.
  void mark_changed(double left, double top, double right, double bottom, double margin);

  /// What changed since it was last asked.
  std::vector<PixelRect> take_changed();
  ImageView view();
  void save_png(const std::string& path) const;

 private:
  CairoSurfacePtr surface_;
  CairoPtr cairo_;
  CairoFontFacePtr font_;
  std::vector<PixelRect> changed_;
};

inline constexpr PixelRect kWholeScreen = {0, 0, kScreenWidth_px, kScreenHeight_px};

}  // namespace piblocks::benchmark
