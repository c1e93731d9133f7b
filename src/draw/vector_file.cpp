#include "draw/vector_file.hpp"

#include <cairo-pdf.h>
#include <cairo-svg.h>

#include <algorithm>
#include <new>
#include <string_view>

#include "draw/cairo_handles.hpp"

namespace piblocks {
namespace {

using MakeSurface = cairo_surface_t* (*)(cairo_write_func_t write, void* bytes, double width,
                                         double height);

/// Called by Cairo, which no exception may pass through.
cairo_status_t append_bytes(void* target, const unsigned char* data, unsigned int length) {
  auto& bytes = *static_cast<std::vector<std::uint8_t>*>(target);
  try {
    bytes.insert(bytes.end(), data, data + length);
  } catch (const std::bad_alloc&) {
    return CAIRO_STATUS_NO_MEMORY;
  }
  return CAIRO_STATUS_SUCCESS;
}

cairo_surface_t* make_svg(cairo_write_func_t write, void* bytes, double width, double height) {
  cairo_surface_t* surface = cairo_svg_surface_create_for_stream(write, bytes, width, height);
  cairo_svg_surface_set_document_unit(surface, CAIRO_SVG_UNIT_PX);
  return surface;
}

cairo_surface_t* make_pdf(cairo_write_func_t write, void* bytes, double width, double height) {
  cairo_surface_t* surface = cairo_pdf_surface_create_for_stream(write, bytes, width, height);
  // Cairo would write the time of day: equal scenes would give different files.
  cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_CREATE_DATE, "1970-01-01T00:00:00Z");
  return surface;
}

std::vector<std::uint8_t> write_file(int width_px, int height_px, const PaintPicture& paint,
                                     MakeSurface make) {
  std::vector<std::uint8_t> bytes;
  const CairoSurfacePtr surface(make(append_bytes, &bytes, width_px, height_px));
  const CairoPtr cr(cairo_create(surface.get()));
  paint(*cr);
  cairo_surface_finish(surface.get());
  check_cairo(cairo_surface_status(surface.get()), "finish the vector file");
  return bytes;
}

/// Cairo 1.16 names the picture's group by a counter of the process, "surface12": equal draw lists
/// would give different files.
std::vector<std::uint8_t> with_fixed_id(std::vector<std::uint8_t> svg) {
  constexpr std::string_view kCounted = "<g id=\"surface";
  constexpr std::string_view kFixed = "<g id=\"picture";
  const auto begin = std::search(svg.begin(), svg.end(), kCounted.begin(), kCounted.end());
  if (begin == svg.end()) return svg;
  // cppcheck-suppress derefInvalidIteratorRedundantCheck ; at the end this has returned
  const auto end = std::find(begin + kCounted.size(), svg.end(), '"');
  svg.insert(svg.erase(begin, end), kFixed.begin(), kFixed.end());
  return svg;
}

}  // namespace

std::vector<std::uint8_t> write_svg(int width_px, int height_px, const PaintPicture& paint) {
  return with_fixed_id(write_file(width_px, height_px, paint, make_svg));
}

std::vector<std::uint8_t> write_pdf(int width_px, int height_px, const PaintPicture& paint) {
  return write_file(width_px, height_px, paint, make_pdf);
}

}  // namespace piblocks
