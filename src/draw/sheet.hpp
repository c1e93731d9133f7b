// Many pictures on one page.
// In: draw lists, each with a line of text, and the size of a page. Out: a page that is painted as
// one, in pixels or as a vector file.
#pragma once

#include <piblocks/image.hpp>

#include <cstdint>
#include <string>
#include <vector>

#include "draw/draw_list.hpp"

namespace piblocks {

struct CaptionedPicture {
  DrawList picture;
  std::string caption;  ///< UTF-8, one line, set underneath
};

/// A picture that is shown smaller or larger, cut off at the edge of its place.
struct PlacedPicture {
  DrawList picture;
  Rectangle place;  ///< of the page; of the shape of the picture
};

struct Sheet {
  std::vector<PlacedPicture> pictures;
  DrawList page;  ///< its background is below the pictures, its items are above
};

/// Pictures of one size in rows, from the upper left, as large as they can be with room for
/// margins, gaps and captions. A caption that is too long for its picture is set smaller.
/// @param pictures at least one.
/// @throws DrawError if the font cannot be loaded.
Sheet arrange(std::vector<CaptionedPicture> pictures, int width_px, int height_px);

/// The page in opaque pixels. @throws DrawError
Image draw_pixels(const Sheet& sheet);
/// As draw_svg() and draw_pdf() of one draw list.
std::vector<std::uint8_t> draw_svg(const Sheet& sheet);
std::vector<std::uint8_t> draw_pdf(const Sheet& sheet);

}  // namespace piblocks
