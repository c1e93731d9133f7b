#include <cairo-pdf.h>
#include <cairo-svg.h>

#include <algorithm>
#include <new>
#include <string>
#include <string_view>

#include "draw/cairo_handles.hpp"
#include "draw/canvas.hpp"
#include "draw/painter.hpp"

namespace piblocks {
namespace {

using MakeSurface = cairo_surface_t* (*)(cairo_write_func_t write, void* bytes, double width,
                                         double height);

/// Cairo calls it, so that it must not throw.
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
  // Else Cairo writes the time of day, and equal scenes give different files.
  cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_CREATE_DATE, "1970-01-01T00:00:00Z");
  return surface;
}

std::vector<std::uint8_t> draw_file(const DrawList& list, MakeSurface make) {
  std::vector<std::uint8_t> bytes;
  const CairoSurfacePtr surface(make(append_bytes, &bytes, list.width_px, list.height_px));
  const CairoPtr cr(cairo_create(surface.get()));
  Painter(TextSetting::lines).paint(*cr, list);
  cairo_surface_finish(surface.get());
  check_cairo(cairo_surface_status(surface.get()), "finish the vector file");
  return bytes;
}

/// Cairo 1.16 numbers groups through the whole process, as "surface12", so that equal draw lists
/// give different files. This numbers them from the beginning of the file.
std::vector<std::uint8_t> with_fixed_ids(const std::vector<std::uint8_t>& svg) {
  constexpr std::string_view kCounted = "surface";
  const std::string_view text(reinterpret_cast<const char*>(svg.data()), svg.size());
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  std::vector<std::string_view> counts;
  std::string fixed;
  std::size_t copied = 0;
  for (auto at = text.find(kCounted); at != std::string_view::npos;
       at = text.find(kCounted, at + 1)) {
    const bool is_name = text.substr(0, at).ends_with("id=\"") || text.substr(0, at).ends_with('#');
    const std::size_t begin = at + kCounted.size();
    std::size_t end = begin;
    while (end < text.size() && is_digit(text[end])) ++end;
    if (!is_name || end == begin) continue;
    const std::string_view count = text.substr(begin, end - begin);
    auto known = std::ranges::find(counts, count);
    if (known == counts.end()) known = counts.insert(known, count);
    fixed += text.substr(copied, at - copied);
    fixed += known == counts.begin() ? "picture"
                                     : "picture" + std::to_string(known - counts.begin() + 1);
    copied = end;
  }
  fixed += text.substr(copied);
  return {fixed.begin(), fixed.end()};
}

}  // namespace

std::vector<std::uint8_t> draw_svg(const DrawList& list) {
  return with_fixed_ids(draw_file(list, make_svg));
}

std::vector<std::uint8_t> draw_pdf(const DrawList& list) { return draw_file(list, make_pdf); }

}  // namespace piblocks
