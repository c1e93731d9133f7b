#include "draw/canvas.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>
#include <map>
#include <new>
#include <optional>
#include <string_view>
#include <utility>
#include <variant>

#include "draw/cairo_calls.hpp"
#include "draw/painter.hpp"
#include "draw/region.hpp"

namespace piblocks {
namespace {

/// How Cairo rounds a slanted edge depends on where the surface ends. The pixels of rectangles,
/// text, small discs, plates and exposed blocks do not depend on it.
bool depends_on_surface(const DrawItem& item) {
  if (const auto* group = std::get_if<GroupItem>(&item)) {
    return !is_on_pixels(*group) || std::ranges::any_of(group->list->items, depends_on_surface);
  }
  if (const auto* disc = std::get_if<DiscItem>(&item)) return !is_small(*disc);
  return std::holds_alternative<PathItem>(item) || std::holds_alternative<ImageItem>(item);
}

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

/// How Cairo names groups and images in an SVG file: "surface12" and "image5" in version 1.16,
/// "source-12" in 1.18.
constexpr std::array<std::string_view, 3> kIdPrefixes = {"surface", "source-", "image"};

/// Of the prefix that a text begins with; 0 if it begins with none.
std::size_t length_of_prefix(std::string_view text) {
  for (const std::string_view name : kIdPrefixes) {
    if (text.starts_with(name)) return name.size();
  }
  return 0;
}

/// Cairo counts these ids over the whole process. Here they are counted anew in each file, so that
/// equal draw lists give equal files.
std::vector<std::uint8_t> with_fixed_ids(const std::vector<std::uint8_t>& svg) {
  const std::string_view text(reinterpret_cast<const char*>(svg.data()), svg.size());
  std::map<std::string_view, std::size_t> numbers;
  std::string fixed;
  std::size_t copied = 0;
  for (auto mark = text.find_first_of("\"#"); mark != std::string_view::npos;
       mark = text.find_first_of("\"#", mark + 1)) {
    const std::size_t at = mark + 1;
    const std::size_t length = length_of_prefix(text.substr(at));
    const bool is_name = text[mark] == '#' || text.substr(0, at).ends_with("id=\"");
    if (length == 0 || !is_name) continue;
    const std::size_t begin = at + length;
    const std::size_t end = std::min(text.find_first_not_of("0123456789", begin), text.size());
    if (end == begin) continue;
    const std::string_view name = text.substr(at, end - at);
    const std::size_t number = numbers.try_emplace(name, numbers.size() + 1).first->second;
    fixed += text.substr(copied, at - copied);
    fixed += number == 1 ? "picture" : "picture" + std::to_string(number);
    copied = end;
  }
  fixed += text.substr(copied);
  return {fixed.begin(), fixed.end()};
}

}  // namespace

/// A file of Cairo's, as far as it has been written.
struct VectorFile {
  VectorFile(MakeSurface make, int width_px, int height_px)
      : surface(make(append_bytes, &bytes, width_px, height_px)), cr(cairo_create(surface.get())) {}

  /// The bytes that have come since the last call.
  std::vector<std::uint8_t> take() {
    check_cairo(cairo_surface_status(surface.get()), "write the vector file");
    return std::exchange(bytes, {});
  }
  std::vector<std::uint8_t> finish() {
    cairo_surface_finish(surface.get());
    return take();
  }

  std::vector<std::uint8_t> bytes;
  Painter painter{TextSetting::lines};
  CairoSurfacePtr surface;
  CairoPtr cr;
};

struct Canvas::Pixels {
  Pixels(int width_px, int height_px, Background background)
      : format(background == Background::transparent ? CAIRO_FORMAT_ARGB32 : CAIRO_FORMAT_RGB24),
        surface(image_surface(format, width_px, height_px, "make a canvas")),
        region(width_px, height_px) {}

  /// Paints what is in the region, and nothing else that would change a pixel.
  void paint(const DrawList& list) {
    rects = region.rects();
    in_tiles.clear();
    for (const DrawItem& item : list.items) {
      if (depends_on_surface(item)) in_tiles.push_back(&item);
    }
    if (!in_tiles.empty()) paint_tiles(list);
    for (const PixelRect& rect : rects) {
      if (!is_painted_in_tiles(rect)) paint_rect(list, rect);
    }
  }

  cairo_format_t format;
  CairoSurfacePtr surface;
  Painter painter{TextSetting::glyphs};
  std::optional<DrawList> shown;
  Region region;
  std::span<const PixelRect> rects;  ///< of the region
  // Kept for their memory.
  std::vector<bool> is_tile_painted;
  std::vector<const DrawItem*> in_tiles;  ///< items that are painted in tiles

 private:
  static constexpr int kTile_px = 4 * Region::kCell_px;

  std::size_t columns_of_tiles() const {
    return static_cast<std::size_t>(cairo_image_surface_get_width(surface.get()) + kTile_px - 1) /
           kTile_px;
  }
  /// Of each tile that shares a pixel with the rectangle; its number, row by row.
  template <typename Visit>
  void for_each_tile(const PixelRect& rect, const Visit& visit) const {
    const std::size_t columns = columns_of_tiles();
    for (int y = rect.y_px / kTile_px; y * kTile_px < rect.bottom_px(); ++y) {
      for (int x = rect.x_px / kTile_px; x * kTile_px < rect.right_px(); ++x) {
        visit(static_cast<std::size_t>(y) * columns + static_cast<std::size_t>(x));
      }
    }
  }
  bool needs_tiles(const PixelRect& rect) const {
    return std::ranges::any_of(in_tiles,
                               [&](const DrawItem* item) { return reaches(*item, rect); });
  }
  bool is_painted_in_tiles(const PixelRect& rect) const {
    bool is_painted = !in_tiles.empty();
    if (is_painted)
      for_each_tile(rect, [&](std::size_t tile) { is_painted &= is_tile_painted[tile]; });
    return is_painted;
  }

  /// Paints whole tiles of a fixed grid, so that the same pixels come out whatever the region is.
  void paint_tiles(const DrawList& list) {
    const std::size_t columns = columns_of_tiles();
    const auto rows = static_cast<std::size_t>((list.height_px + kTile_px - 1) / kTile_px);
    is_tile_painted.assign(columns * rows, false);
    for (const PixelRect& rect : rects) {
      if (!needs_tiles(rect)) continue;
      for_each_tile(rect, [&](std::size_t tile) { is_tile_painted[tile] = true; });
    }
    for (std::size_t tile = 0; tile < is_tile_painted.size(); ++tile) {
      if (!is_tile_painted[tile]) continue;
      const int left = static_cast<int>(tile % columns) * kTile_px;
      const int top = static_cast<int>(tile / columns) * kTile_px;
      paint_rect(list, {left, top, std::min(kTile_px, list.width_px - left),
                        std::min(kTile_px, list.height_px - top)});
    }
  }

  /// Paints the rectangle as a picture of its own that shares the memory of the whole. Under a clip
  /// Cairo's antialiased edges come out a step lighter or darker.
  void paint_rect(const DrawList& list, const PixelRect& rect) {
    cairo_surface_flush(surface.get());
    const int stride_bytes = cairo_image_surface_get_stride(surface.get());
    unsigned char* const corner = cairo_image_surface_get_data(surface.get()) +
                                  std::ptrdiff_t{rect.y_px} * stride_bytes + 4 * rect.x_px;
    if (!list.background) {
      // By hand: Cairo knows when it has cleared a surface itself, and then paints in other ways.
      for (int y = 0; y < rect.height_px; ++y) {
        std::memset(corner + std::ptrdiff_t{y} * stride_bytes, 0, std::size_t(rect.width_px) * 4);
      }
    }
    const CairoSurfacePtr pixels(cairo_image_surface_create_for_data(corner, format, rect.width_px,
                                                                     rect.height_px, stride_bytes));
    cairo_surface_set_device_offset(pixels.get(), -rect.x_px, -rect.y_px);
    const CairoPtr cr(cairo_create(pixels.get()));
    painter.paint(*cr, list, rect);
    cairo_surface_finish(pixels.get());
    cairo_surface_mark_dirty(surface.get());
  }
};

Canvas::Canvas(int width_px, int height_px, Background background)
    : pixels_(std::make_unique<Pixels>(width_px, height_px, background)) {}

Canvas::~Canvas() = default;

void Canvas::listen(std::stop_token stop) { pixels_->painter.listen(std::move(stop)); }

void Canvas::paint(const DrawList& list) {
  assert(list.width_px == view().width_px && list.height_px == view().height_px);
  assert(list.background || view().has_alpha);
  pixels_->region.clear();
  pixels_->region.add({0, 0, list.width_px, list.height_px});
  pixels_->shown.reset();  // if painting is broken off, nobody knows what is there
  pixels_->paint(list);
  pixels_->shown = list;
}

std::span<const PixelRect> Canvas::update(DrawList list) {
  if (!pixels_->shown) {
    paint(list);
    return pixels_->rects;
  }
  const MeasureText width_em = [this](Face face, std::string_view text) {
    return pixels_->painter.font(face).width_em(text);
  };
  pixels_->region.clear();
  add_changes(*pixels_->shown, list, width_em, pixels_->region);
  pixels_->shown.reset();
  pixels_->paint(list);
  pixels_->shown = std::move(list);
  return pixels_->rects;
}

ImageView Canvas::view() const {
  cairo_surface_t* surface = pixels_->surface.get();
  return {cairo_image_surface_get_data(surface), cairo_image_surface_get_width(surface),
          cairo_image_surface_get_height(surface), cairo_image_surface_get_stride(surface),
          pixels_->format == CAIRO_FORMAT_ARGB32};
}

std::vector<std::string> draw_library_versions() {
  FT_Library library = nullptr;
  int major = 0;
  int minor = 0;
  int patch = 0;
  if (FT_Init_FreeType(&library) == 0) {
    FT_Library_Version(library, &major, &minor, &patch);
    FT_Done_FreeType(library);
  }
  return {fmt::format("cairo {}", cairo_version_string()),
          std::string("pixman ") + pixman_version_string(),
          fmt::format("freetype {}.{}.{}", major, minor, patch), "fonts " PIBLOCKS_FONT_NAMES};
}

std::string painter_fingerprint() {
  return fmt::format("{}", fmt::join(draw_library_versions(), ", "));
}

Image draw_pixels(const DrawList& list) {
  Image image{list.width_px, list.height_px, {}};
  image.words.resize(std::size_t(image.width_px) * std::size_t(image.height_px));
  const CairoSurfacePtr surface(cairo_image_surface_create_for_data(
      reinterpret_cast<unsigned char*>(image.words.data()), CAIRO_FORMAT_RGB24, image.width_px,
      image.height_px, 4 * image.width_px));
  const CairoPtr cr(cairo_create(surface.get()));
  Painter(TextSetting::glyphs).paint(*cr, list);
  cairo_surface_finish(surface.get());
  check_cairo(cairo_surface_status(surface.get()), "paint a sheet");
  return image;
}

std::vector<std::uint8_t> draw_svg(const DrawList& list) {
  VectorFile file(make_svg, list.width_px, list.height_px);
  file.painter.paint(*file.cr, list);
  return with_fixed_ids(file.finish());
}

std::vector<std::uint8_t> draw_pdf(const DrawList& list) {
  PdfPages pages(list.width_px, list.height_px);
  std::vector<std::uint8_t> pdf = pages.add(list);
  const std::vector<std::uint8_t> end = pages.finish();
  pdf.insert(pdf.end(), end.begin(), end.end());
  return pdf;
}

PdfPages::PdfPages(int width_px, int height_px)
    : file_(std::make_unique<VectorFile>(make_pdf, width_px, height_px)) {}

PdfPages::~PdfPages() = default;

std::vector<std::uint8_t> PdfPages::add(const DrawList& list) {
  file_->painter.paint(*file_->cr, list);
  cairo_show_page(file_->cr.get());
  return file_->take();
}

std::vector<std::uint8_t> PdfPages::finish() { return file_->finish(); }

}  // namespace piblocks
