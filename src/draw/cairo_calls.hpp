// The functions of Cairo, FreeType and pixman that drawing calls, owners of Cairo's objects, and
// its errors as exceptions. cairo_calls_linux.cpp loads libcairo when the first of them is called:
// with the libraries of X11 that it brings it takes a millisecond, and a count or a comparison does
// without. cairo_calls_posix.cpp links them; the build takes one of the two.
#pragma once

#include <cairo-ft.h>
#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <fmt/format.h>
#include <ft2build.h>
#include <piblocks/error.hpp>
#include <pixman.h>
#include FT_FREETYPE_H

#include <memory>

#include "core/found_function.hpp"

namespace piblocks {

/// The address of one of these functions. Thread-safe. @throws DrawError if it cannot be loaded
void* drawing_function(const char* name);

// NOLINTBEGIN(cppcoreguidelines-macro-usage): only a macro makes declarations of a list of names
// clang-format off
#define PIBLOCKS_DRAWING_FUNCTIONS(X) \
  X(FT_Done_Face) X(FT_Done_FreeType) X(FT_Get_Char_Index) X(FT_Init_FreeType) \
  X(FT_Library_Version) X(FT_New_Memory_Face) X(cairo_clip) X(cairo_close_path) X(cairo_create) \
  X(cairo_curve_to) X(cairo_destroy) X(cairo_device_to_user) X(cairo_fill) \
  X(cairo_fill_preserve) X(cairo_font_face_destroy) X(cairo_font_face_set_user_data) \
  X(cairo_font_options_create) X(cairo_font_options_destroy) X(cairo_font_options_set_antialias) \
  X(cairo_font_options_set_hint_metrics) X(cairo_font_options_set_hint_style) \
  X(cairo_ft_font_face_create_for_ft_face) X(cairo_get_group_target) X(cairo_get_matrix) \
  X(cairo_get_scaled_font) X(cairo_get_source) X(cairo_get_target) X(cairo_glyph_free) \
  X(cairo_image_surface_create) X(cairo_image_surface_create_for_data) \
  X(cairo_image_surface_get_data) X(cairo_image_surface_get_height) \
  X(cairo_image_surface_get_stride) X(cairo_image_surface_get_width) X(cairo_line_to) \
  X(cairo_matrix_init_identity) X(cairo_matrix_init_scale) X(cairo_move_to) X(cairo_new_path) \
  X(cairo_new_sub_path) X(cairo_paint) X(cairo_paint_with_alpha) \
  X(cairo_pattern_add_color_stop_rgba) X(cairo_pattern_create_radial) X(cairo_pattern_destroy) \
  X(cairo_pattern_set_filter) X(cairo_pdf_surface_create_for_stream) \
  X(cairo_pdf_surface_set_metadata) X(cairo_pop_group_to_source) X(cairo_push_group) \
  X(cairo_rectangle) X(cairo_restore) X(cairo_save) X(cairo_scale) X(cairo_scaled_font_create) \
  X(cairo_scaled_font_destroy) X(cairo_scaled_font_reference) X(cairo_scaled_font_status) \
  X(cairo_scaled_font_text_extents) X(cairo_scaled_font_text_to_glyphs) X(cairo_set_dash) \
  X(cairo_set_font_face) X(cairo_set_font_options) X(cairo_set_font_size) X(cairo_set_line_cap) \
  X(cairo_set_line_join) X(cairo_set_line_width) X(cairo_set_operator) X(cairo_set_source) \
  X(cairo_set_source_rgb) X(cairo_set_source_rgba) X(cairo_set_source_surface) \
  X(cairo_show_glyphs) X(cairo_show_page) X(cairo_show_text) X(cairo_status) X(cairo_status_to_string) \
  X(cairo_stroke) X(cairo_stroke_preserve) X(cairo_surface_destroy) X(cairo_surface_finish) \
  X(cairo_surface_flush) X(cairo_surface_get_device_offset) X(cairo_surface_get_type) \
  X(cairo_surface_mark_dirty) X(cairo_surface_set_device_offset) X(cairo_surface_status) \
  X(cairo_svg_surface_create_for_stream) X(cairo_svg_surface_set_document_unit) \
  X(cairo_translate) X(cairo_user_to_device) X(cairo_version_string) X(pixman_version_string)
// clang-format on

// In this namespace the name of a function means an object, which has the function's type.
#define PIBLOCKS_FOUND(name) \
  inline constinit const FoundFunction<drawing_function, decltype(::name)> name(#name);
PIBLOCKS_DRAWING_FUNCTIONS(PIBLOCKS_FOUND)
#undef PIBLOCKS_FOUND
// NOLINTEND(cppcoreguidelines-macro-usage)

template <const auto& kRelease>
struct Released {
  void operator()(auto* object) const { kRelease(object); }
};

using CairoPtr = std::unique_ptr<cairo_t, Released<cairo_destroy>>;
using CairoSurfacePtr = std::unique_ptr<cairo_surface_t, Released<cairo_surface_destroy>>;
using CairoPatternPtr = std::unique_ptr<cairo_pattern_t, Released<cairo_pattern_destroy>>;
using CairoFontFacePtr = std::unique_ptr<cairo_font_face_t, Released<cairo_font_face_destroy>>;
using CairoScaledFontPtr =
    std::unique_ptr<cairo_scaled_font_t, Released<cairo_scaled_font_destroy>>;
using CairoFontOptionsPtr =
    std::unique_ptr<cairo_font_options_t, Released<cairo_font_options_destroy>>;

/// @throws DrawError naming the operation if the status is not success.
inline void check_cairo(cairo_status_t status, const char* operation) {
  if (status == CAIRO_STATUS_SUCCESS) return;
  throw DrawError(fmt::format("draw: {}: {}", operation, cairo_status_to_string(status)));
}

/// @throws DrawError naming the operation, if there is no memory for it.
inline CairoSurfacePtr image_surface(cairo_format_t format, int width_px, int height_px,
                                     const char* operation) {
  CairoSurfacePtr surface(cairo_image_surface_create(format, width_px, height_px));
  check_cairo(cairo_surface_status(surface.get()), operation);
  return surface;
}

}  // namespace piblocks
