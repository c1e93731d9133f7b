#include <cstddef>
#include <cstdint>
#include <memory>

#include "draw/disc_exposure.hpp"
#include "draw/extent.hpp"
#include "draw/painter.hpp"

namespace piblocks {

/// A pixel depends on the discs that pass it and its background alone, and adds them up in their
/// order, so that a part of the picture has the pixels of the whole.
void Painter::paint_exposed(cairo_t& cr, const ExposedDiscsItem& item, const PixelRect& area) {
  const PixelRect moving = moving_area(item, area);
  if (moving.width_px <= 0 || moving.height_px <= 0) return;
  cairo_surface_t* const surface = cairo_get_target(&cr);
  cairo_surface_flush(surface);
  const std::ptrdiff_t stride_bytes = cairo_image_surface_get_stride(surface);
  unsigned char* row = cairo_image_surface_get_data(surface) +
                       (moving.y_px - area.y_px) * stride_bytes +
                       std::ptrdiff_t{4} * (moving.x_px - area.x_px);
  if (!light_) light_ = std::make_unique<Light>();
  if (!disc_exposure_) disc_exposure_ = std::make_unique<DiscExposure>();
  disc_exposure_->begin(item, moving);
  for (int y = moving.y_px; y < moving.y_px + moving.height_px; ++y, row += stride_bytes) {
    disc_exposure_->paint_row(y, reinterpret_cast<std::uint32_t*>(row), *light_);
  }
  cairo_surface_mark_dirty(surface);
}

}  // namespace piblocks
