// Draw lists made visible.
// In: a draw list. Out: pixels, or a vector file, from the same painter.
#pragma once

#include <piblocks/image.hpp>
#include <piblocks/scene.hpp>

#include <cstdint>
#include <memory>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "draw/draw_list.hpp"

namespace piblocks {

/// Pixels that are painted again and again, by one thread at a time. Canvases are independent.
class Canvas {
 public:
  /// Its pixels have alpha if the background is transparent.
  /// @throws DrawError if there is no memory for it.
  Canvas(int width_px, int height_px, Background background = Background::opaque);
  ~Canvas();
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;

  /// From now on paint() and update() throw Interrupted soon after the token asks for it.
  void listen(std::stop_token stop);
  /// Replaces the whole picture. @throws DrawError
  /// @param list  of the canvas's size; has a background unless the canvas is transparent
  void paint(const DrawList& list);
  /// Makes the picture what paint() would make it, but paints only where it may have changed.
  /// @returns this region, valid until the next call; the whole frame if nothing was painted before
  /// @throws DrawError
  std::span<const PixelRect> update(DrawList list);
  /// The picture; valid until the next paint() or update().
  ImageView view() const;

 private:
  struct Pixels;
  std::unique_ptr<Pixels> pixels_;
};

/// The picture in opaque pixels, painted at once: slanted edges come out slightly different from
/// those of a Canvas. @throws DrawError
Image draw_pixels(const DrawList& list);
/// The picture as an SVG file: text as outlines, one unit a pixel. What is exposed is shown at the
/// picture's instant.
std::vector<std::uint8_t> draw_svg(const DrawList& list);
/// The same as a PDF file of one page, one point a pixel; text stays text.
std::vector<std::uint8_t> draw_pdf(const DrawList& list);

/// A PDF file with a page for each picture, in pieces. Used by one thread at a time.
class PdfPages {
 public:
  PdfPages(int width_px, int height_px);
  ~PdfPages();
  PdfPages(const PdfPages&) = delete;
  PdfPages& operator=(const PdfPages&) = delete;

  /// @returns the next bytes of the file. @throws DrawError
  std::vector<std::uint8_t> add(const DrawList& list);
  /// @returns its last bytes. @throws DrawError
  std::vector<std::uint8_t> finish();

 private:
  std::unique_ptr<struct VectorFile> file_;
};

/// Name and version of each drawing library that is linked, such as "cairo 1.16.0", and the font.
std::vector<std::string> draw_library_versions();
/// The same in one line: all that may change a pixel.
std::string painter_fingerprint();

}  // namespace piblocks
