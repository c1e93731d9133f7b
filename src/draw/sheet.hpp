// Many pictures on one page.
// In: draw lists, each with a line of text, and the size of a page. Out: a draw list of the page,
// and its pixels.
#pragma once

#include <piblocks/image.hpp>

#include <string>
#include <vector>

#include "draw/draw_list.hpp"

namespace piblocks {

struct CaptionedPicture {
  DrawList picture;
  std::string caption;  ///< UTF-8, one line, set underneath
};

/// Pictures of one size in rows, from the upper left, as large as margins, gaps and captions allow.
/// A caption that is too long for its picture is set smaller.
/// @param pictures  at least one.
/// @throws DrawError if the font cannot be loaded.
DrawList arrange(std::vector<CaptionedPicture> pictures, int width_px, int height_px);

/// The page in opaque pixels, painted at once: slanted edges come out slightly different from those
/// of a Canvas. @throws DrawError
Image draw_pixels(const DrawList& page);

}  // namespace piblocks
