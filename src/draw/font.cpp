#include "draw/font.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <span>

#include "core/text.hpp"
#include "draw/cairo_calls.hpp"

/// A font that is part of the program. font_data.S takes its file in where binaries are ELF;
/// elsewhere embed_fonts.cmake writes it down for the C compiler. Both lay this out.
struct PiblocksEmbeddedFont {
  const unsigned char* begin;
  const unsigned char* end;
};

// In the order of Face.
// NOLINTNEXTLINE(readability-identifier-naming): no constant, but a symbol of assembler or C
extern "C" const PiblocksEmbeddedFont piblocks_fonts[];

namespace piblocks {
namespace {

using FtLibraryPtr = std::unique_ptr<FT_LibraryRec_, Released<FT_Done_FreeType>>;

void check_freetype(FT_Error error, const char* operation) {
  if (error != 0) throw DrawError(fmt::format("draw: {}: FreeType error {}", operation, error));
}

constexpr cairo_user_data_key_t kFaceKey{};

/// Called by Cairo when it forgets the face, which may be after the Font is gone.
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

FT_Face load_embedded_face(Face which) {
  FT_Library created = nullptr;
  check_freetype(FT_Init_FreeType(&created), "start FreeType");
  FtLibraryPtr library(created);
  FT_Face face = nullptr;
  const auto& [begin, end] = piblocks_fonts[static_cast<std::size_t>(which)];
  check_freetype(FT_New_Memory_Face(library.get(), begin, end - begin, 0, &face),
                 "load an embedded font");
  static_cast<void>(library.release());  // release_face() finds it again through the face
  return face;
}

CairoFontFacePtr make_cairo_face(FT_Face face) {
  CairoFontFacePtr cairo_face(cairo_ft_font_face_create_for_ft_face(face, FT_LOAD_NO_HINTING));
  const cairo_status_t status =
      cairo_font_face_set_user_data(cairo_face.get(), &kFaceKey, face, release_face);
  if (status != CAIRO_STATUS_SUCCESS) release_face(face);
  check_cairo(status, "load an embedded font");
  return cairo_face;
}

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

/// Both ends included.
struct CodeRange {
  std::uint32_t first;
  std::uint32_t last;
};

// Blocks of the Unicode Standard, version 15, including their unassigned characters. Characters
// that the font has no glyph for need not be here.

/// Marks that stand over, under or within the letter before.
constexpr std::array kMarks{
    CodeRange{0x0300, 0x036F},   CodeRange{0x0483, 0x0489},   CodeRange{0x135D, 0x135F},
    CodeRange{0x1AB0, 0x1AFF},   CodeRange{0x1DC0, 0x1DFF},   CodeRange{0x20D0, 0x20FF},
    CodeRange{0x2CEF, 0x2CF1},   CodeRange{0x2D7F, 0x2D7F},   CodeRange{0x2DE0, 0x2DFF},
    CodeRange{0x302A, 0x302F},   CodeRange{0x3099, 0x309A},   CodeRange{0xA66F, 0xA672},
    CodeRange{0xA674, 0xA67D},   CodeRange{0xA69E, 0xA69F},   CodeRange{0xA6F0, 0xA6F1},
    CodeRange{0xFE20, 0xFE2F},   CodeRange{0x1D165, 0x1D169}, CodeRange{0x1D16D, 0x1D172},
    CodeRange{0x1D17B, 0x1D182}, CodeRange{0x1D185, 0x1D18B}, CodeRange{0x1D1AA, 0x1D1AD},
    CodeRange{0x1D242, 0x1D244}, CodeRange{0x1E000, 0x1E02F}, CodeRange{0x1E130, 0x1E136}};

/// Instructions to a program that sets text: joiners, directions, variants, line ends.
constexpr std::array kControls{
    CodeRange{0x0000, 0x001F},  CodeRange{0x007F, 0x009F}, CodeRange{0x00AD, 0x00AD},
    CodeRange{0x061C, 0x061C},  CodeRange{0x180B, 0x180F}, CodeRange{0x200B, 0x200F},
    CodeRange{0x2028, 0x202E},  CodeRange{0x2060, 0x206F}, CodeRange{0xFE00, 0xFE0F},
    CodeRange{0xFEFF, 0xFEFF},  CodeRange{0xFFF9, 0xFFFB}, CodeRange{0x1F3FB, 0x1F3FF},
    CodeRange{0xE0000, 0xE0FFF}};

/// Scripts from right to left, scripts whose letters join or, in and around India, change places.
constexpr std::array kScripts{
    CodeRange{0x0590, 0x109F}, CodeRange{0x1100, 0x11FF},   CodeRange{0x1700, 0x18AF},
    CodeRange{0x1900, 0x194F}, CodeRange{0x1A00, 0x1AAF},   CodeRange{0x1B00, 0x1C4F},
    CodeRange{0x1CC0, 0x1CFF}, CodeRange{0xA800, 0xA82F},   CodeRange{0xA840, 0xAAFF},
    CodeRange{0xABC0, 0xABFF}, CodeRange{0xD7B0, 0xD7FF},   CodeRange{0xFB1D, 0xFDFF},
    CodeRange{0xFE70, 0xFEFE}, CodeRange{0x10800, 0x11FFF}, CodeRange{0x1E800, 0x1EFFF}};

struct Unshaped {
  std::span<const CodeRange> ranges;
  bool is_letter;  ///< and can be shown in a message
  const char* reason;
  const char* remedy;
};

constexpr std::array kUnshaped{
    Unshaped{kControls, false,
             "is an instruction for shaping text, which is set letter by letter here",
             "leave it out"},
    Unshaped{kMarks, false,
             "is a combining mark, which needs shaping, and text is set letter by letter here",
             "use a letter that has the mark"},
    Unshaped{kScripts, true,
             "is in a script that needs shaping, and text is set letter by letter here",
             "use another script, or a picture as the logo"}};

/// Names the first character whose glyph depends on its neighbours, that is written from right to
/// left, or that is an instruction. Empty if there is none. @param utf8  valid
std::string shaping_problem(std::string_view utf8) {
  while (!utf8.empty()) {
    const std::uint32_t code = first_character(utf8).code;
    const std::size_t length_bytes = step_bytes(utf8);
    for (const Unshaped& kind : kUnshaped) {
      const auto has_code = [code](const CodeRange& range) {
        return code >= range.first && code <= range.last;
      };
      if (std::ranges::none_of(kind.ranges, has_code)) continue;
      const std::string letter =
          kind.is_letter ? fmt::format("'{}' (U+{:04X})", utf8.substr(0, length_bytes), code)
                         : fmt::format("U+{:04X}", code);
      return fmt::format("{} {}; {}", letter, kind.reason, kind.remedy);
    }
    utf8.remove_prefix(length_bytes);
  }
  return {};
}

}  // namespace

/// Sizes of one font that are kept. A film has some twenty.
constexpr std::size_t kMostKept = 64;

struct Font::Loaded {
  explicit Loaded(Face which) : ft_face(load_embedded_face(which)) {}

  /// Cairo keeps the font at the size that was used last in any thread. A thread that replaces it
  /// asserts that nobody uses it, which fails if the first thread asks for it at that moment. So
  /// each thread holds the fonts that it used last.
  void keep(cairo_scaled_font_t* sized) {
    const auto found = std::ranges::find(kept, sized, &CairoScaledFontPtr::get);
    if (found != kept.end()) {
      std::rotate(found, std::next(found), kept.end());  // the oldest is the first
      return;
    }
    if (kept.size() == kMostKept) kept.erase(kept.begin());
    kept.emplace_back(cairo_scaled_font_reference(sized));
  }

  CairoFontOptionsPtr options = font_options();
  FT_Face ft_face;  // belongs to `face`
  CairoFontFacePtr face = make_cairo_face(ft_face);
  CairoScaledFontPtr measure = scaled_for_measuring(*face, *options);
  std::vector<CairoScaledFontPtr> kept;
};

Font::Font(Face face) : face_(face), loaded_(std::make_unique<Loaded>(face)) {}
Font::~Font() = default;

bool Font::has_glyph(std::uint32_t code) const {
  return FT_Get_Char_Index(loaded_->ft_face, code) != 0;
}

const Font& Font::fallback() const {
  if (!fallback_) fallback_ = std::make_unique<Font>(Face::article);
  return *fallback_;
}

std::vector<Font::Run> Font::runs(std::string_view utf8) const {
  if (face_ == Face::article) return {{this, utf8}};
  std::vector<Run> runs;
  for (std::size_t at = 0; at < utf8.size();) {
    const std::uint32_t code = first_character(utf8.substr(at)).code;
    const std::size_t length_bytes = step_bytes(utf8.substr(at));
    const Font* font = has_glyph(code) ? this : &fallback();
    if (runs.empty() || runs.back().font != font) runs.push_back({font, utf8.substr(at, 0)});
    std::string_view& text = runs.back().text;
    text = {text.data(), text.size() + length_bytes};
    at += length_bytes;
  }
  return runs;
}

void Font::select(cairo_t& cr, double size_px) const {
  cairo_set_font_face(&cr, loaded_->face.get());
  cairo_set_font_options(&cr, loaded_->options.get());
  cairo_set_font_size(&cr, size_px);
  loaded_->keep(cairo_get_scaled_font(&cr));
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
  double left = 0;
  double top = 0;
  cairo_surface_get_device_offset(cairo_get_group_target(&cr), &left, &top);
  for (cairo_glyph_t& glyph : glyphs) {
    cairo_user_to_device(&cr, &glyph.x, &glyph.y);
    glyph.x = std::floor(glyph.x + left + 0.5) - left;
    glyph.y = std::floor(glyph.y + top + 0.5) - top;
    cairo_device_to_user(&cr, &glyph.x, &glyph.y);
  }
  return glyphs;
}

void Font::check(std::string_view utf8, const char* what) const {
  std::string_view missing;
  for (std::string_view rest = utf8; !rest.empty();) {
    const auto [code, length_bytes] = first_character(rest);
    if (length_bytes == 0) throw UsageError(what, "is not valid UTF-8");
    const bool is_known = has_glyph(code) || (face_ != Face::article && fallback().has_glyph(code));
    if (!is_known && missing.empty()) missing = rest.substr(0, length_bytes);
    rest.remove_prefix(length_bytes);
  }
  const std::string problem = shaping_problem(utf8);
  if (!problem.empty()) throw UsageError(what, problem);
  if (missing.empty()) return;
  throw UsageError(
      what,
      fmt::format("no embedded font has a glyph for '{}'; write it in other characters", missing));
}

double Font::width_em(std::string_view utf8) const {
  double sum = 0;
  for (const auto& [font, text] : runs(utf8)) sum += font->own_width_em(text);
  return sum;
}

double Font::own_width_em(std::string_view utf8) const {
  cairo_text_extents_t extents;
  cairo_scaled_font_text_extents(loaded_->measure.get(), std::string(utf8).c_str(), &extents);
  check_cairo(cairo_scaled_font_status(loaded_->measure.get()), "measure text");
  return extents.x_advance / kMeasure_px;
}

TextWidths::TextWidths(const Font& font, std::string_view characters) {
  while (!characters.empty()) {
    const std::size_t length = step_bytes(characters);
    const std::string character(characters.substr(0, length));
    advances_.try_emplace(character, font.width_em(character));
    characters.remove_prefix(length);
  }
}

double TextWidths::width_em(std::string_view text) const {
  double sum = 0;
  while (!text.empty()) {
    const std::size_t length = step_bytes(text);
    const auto found = advances_.find(text.substr(0, length));
    if (found != advances_.end()) sum += found->second;
    text.remove_prefix(length);
  }
  return sum;
}

}  // namespace piblocks
