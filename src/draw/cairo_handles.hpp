// Owners of Cairo's objects.
// In: pointers fresh from Cairo. Out: smart pointers that release them, and checked errors.
#pragma once

#include <cairo.h>
#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <memory>

namespace piblocks {

struct CairoDeleter {
  void operator()(cairo_t* p) const { cairo_destroy(p); }
  void operator()(cairo_surface_t* p) const { cairo_surface_destroy(p); }
  void operator()(cairo_font_face_t* p) const { cairo_font_face_destroy(p); }
  void operator()(cairo_scaled_font_t* p) const { cairo_scaled_font_destroy(p); }
  void operator()(cairo_font_options_t* p) const { cairo_font_options_destroy(p); }
};

using CairoPtr = std::unique_ptr<cairo_t, CairoDeleter>;
using CairoSurfacePtr = std::unique_ptr<cairo_surface_t, CairoDeleter>;
using CairoFontFacePtr = std::unique_ptr<cairo_font_face_t, CairoDeleter>;
using CairoScaledFontPtr = std::unique_ptr<cairo_scaled_font_t, CairoDeleter>;
using CairoFontOptionsPtr = std::unique_ptr<cairo_font_options_t, CairoDeleter>;

/// @throws DrawError naming the operation if the status is not success.
inline void check_cairo(cairo_status_t status, const char* operation) {
  if (status == CAIRO_STATUS_SUCCESS) return;
  throw DrawError(fmt::format("draw: {}: {}", operation, cairo_status_to_string(status)));
}

}  // namespace piblocks
