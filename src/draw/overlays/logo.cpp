#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <utility>

#include "draw/overlays/overlays.hpp"

namespace piblocks {
namespace {

/// A smaller logo is a speck.
constexpr double kLeastLogo_px = 1;
constexpr double kLeastLogoLength_px = 3;

}  // namespace

ImageItem place_logo(const Rect& place, std::shared_ptr<const Image> logo) {
  const double scale = std::min(place.width / logo->width_px, place.height / logo->height_px);
  const double width = scale * logo->width_px;
  const double height = scale * logo->height_px;
  if (std::min(width, height) < kLeastLogo_px || std::max(width, height) < kLeastLogoLength_px) {
    throw UsageError(
        "show.logo",
        fmt::format("a picture of {}x{} would be {:.1f}x{:.1f} pixels here; leave it out, make the "
                    "frame larger, or use a picture of another shape",
                    logo->width_px, logo->height_px, width, height));
  }
  return {ItemId::logo,
          {place.right() - width, place.bottom() - height, width, height},
          std::move(logo)};
}

}  // namespace piblocks
