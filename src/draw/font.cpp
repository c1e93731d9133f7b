#include "draw/font.hpp"

#include <cairo-ft.h>
#include <fmt/format.h>
#include <ft2build.h>
#include <piblocks/error.hpp>

#include <string>

#include "core/text.hpp"
#include "draw/cairo_handles.hpp"
#include FT_FREETYPE_H

// Defined in font_data.S.
// NOLINTBEGIN(readability-identifier-naming): no constants, but symbols of the assembler
extern "C" const unsigned char piblocks_font_begin[];
extern "C" const unsigned char piblocks_font_end[];
// NOLINTEND(readability-identifier-naming)

namespace piblocks {
namespace {

struct FtLibraryDeleter {
  void operator()(FT_Library p) const { FT_Done_FreeType(p); }
};
using FtLibraryPtr = std::unique_ptr<FT_LibraryRec_, FtLibraryDeleter>;

void check_freetype(FT_Error error, const char* operation) {
  if (error != 0) throw DrawError(fmt::format("draw: {}: FreeType error {}", operation, error));
}

constexpr cairo_user_data_key_t kFaceKey{};

/// Called by Cairo when it forgets the face, which may be after the Font is gone. Releases the
/// face's library with it.
void release_face(void* data) {
  auto* const face = static_cast<FT_Face>(data);
  const FtLibraryPtr library(face->glyph->library);
  FT_Done_Face(face);
}

CairoFontOptionsPtr font_options() {
  CairoFontOptionsPtr options(cairo_font_options_create());
  cairo_font_options_set_antialias(options.get(), CAIRO_ANTIALIAS_GRAY);
  cairo_font_options_set_hint_style(options.get(), CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options.get(), CAIRO_HINT_METRICS_OFF);
  return options;
}

FT_Face load_embedded_face() {
  FT_Library created = nullptr;
  check_freetype(FT_Init_FreeType(&created), "start FreeType");
  FtLibraryPtr library(created);
  FT_Face face = nullptr;
  // cppcheck-suppress comparePointers ; begin and end of one object, which the assembler lays out
  const auto size = static_cast<FT_Long>(piblocks_font_end - piblocks_font_begin);
  check_freetype(FT_New_Memory_Face(library.get(), piblocks_font_begin, size, 0, &face),
                 "load the embedded font");
  static_cast<void>(library.release());  // release_face() finds it again through the face
  return face;
}

CairoFontFacePtr make_cairo_face(FT_Face face) {
  CairoFontFacePtr cairo_face(cairo_ft_font_face_create_for_ft_face(face, FT_LOAD_NO_HINTING));
  const cairo_status_t status =
      cairo_font_face_set_user_data(cairo_face.get(), &kFaceKey, face, release_face);
  if (status != CAIRO_STATUS_SUCCESS) release_face(face);
  check_cairo(status, "load the embedded font");
  return cairo_face;
}

constexpr const char* kFontName = "DejaVu Sans";

/// Large, since Cairo rounds advances to 1/64 pixel. Unhinted advances scale with the size.
constexpr double kMeasure_px = 1024;

CairoScaledFontPtr scaled_for_measuring(cairo_font_face_t& face,
                                        const cairo_font_options_t& options) {
  cairo_matrix_t size;
  cairo_matrix_t identity;
  cairo_matrix_init_scale(&size, kMeasure_px, kMeasure_px);
  cairo_matrix_init_identity(&identity);
  return CairoScaledFontPtr(cairo_scaled_font_create(&face, &size, &identity, &options));
}

}  // namespace

struct Font::Faces {
  CairoFontOptionsPtr options = font_options();
  FT_Face ft_face = load_embedded_face();  // belongs to `face`
  CairoFontFacePtr face = make_cairo_face(ft_face);
  CairoScaledFontPtr measure = scaled_for_measuring(*face, *options);
};

Font::Font() : faces_(std::make_unique<Faces>()) {}
Font::~Font() = default;

void Font::select(cairo_t& cr, double size_px) const {
  cairo_set_font_face(&cr, faces_->face.get());
  cairo_set_font_options(&cr, faces_->options.get());
  cairo_set_font_size(&cr, size_px);
}

std::vector<cairo_glyph_t> Font::glyphs(cairo_t& cr, const Point& origin, std::string_view utf8) {
  cairo_glyph_t* found = nullptr;
  int count = 0;
  check_cairo(cairo_scaled_font_text_to_glyphs(cairo_get_scaled_font(&cr), origin.x, origin.y,
                                               utf8.data(), static_cast<int>(utf8.size()), &found,
                                               &count, nullptr, nullptr, nullptr),
              "set text");
  std::vector<cairo_glyph_t> glyphs(found, found + count);
  cairo_glyph_free(found);
  return glyphs;
}

void Font::check(std::string_view utf8, const char* what) const {
  std::string_view missing;
  for (std::string_view rest = utf8; !rest.empty();) {
    const auto [code, length_bytes] = first_character(rest);
    if (length_bytes == 0) throw UsageError(fmt::format("{}: is not valid UTF-8", what));
    const bool has_glyph = FT_Get_Char_Index(faces_->ft_face, code) != 0;
    if (!has_glyph && missing.empty()) missing = rest.substr(0, length_bytes);
    rest.remove_prefix(length_bytes);
  }
  const std::string problem = shaping_problem(utf8);
  if (!problem.empty()) throw UsageError(fmt::format("{}: {}", what, problem));
  if (missing.empty()) return;
  throw UsageError(fmt::format("{}: the font {} has no glyph for '{}'", what, kFontName, missing));
}

double Font::width_em(std::string_view utf8) const {
  cairo_text_extents_t extents;
  cairo_scaled_font_text_extents(faces_->measure.get(), std::string(utf8).c_str(), &extents);
  check_cairo(cairo_scaled_font_status(faces_->measure.get()), "measure text");
  return extents.x_advance / kMeasure_px;
}

TextWidths::TextWidths(const Font& font, std::string_view characters) {
  while (!characters.empty()) {
    const std::string_view character =
        characters.substr(0, first_character(characters).length_bytes);
    advances_.try_emplace(std::string(character), font.width_em(character));
    characters.remove_prefix(character.size());
  }
}

double TextWidths::width_em(std::string_view text) const {
  double sum = 0;
  while (!text.empty()) {
    const std::string_view character = text.substr(0, first_character(text).length_bytes);
    const auto found = advances_.find(character);
    if (found != advances_.end()) sum += found->second;
    text.remove_prefix(character.size());
  }
  return sum;
}

}  // namespace piblocks
