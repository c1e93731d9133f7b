// Owners of Cairo's objects.
// In: pointers fresh from Cairo. Out: smart pointers that release them, and checked errors.
#pragma once

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <memory>

#include "draw/cairo_calls.hpp"

namespace piblocks {

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
