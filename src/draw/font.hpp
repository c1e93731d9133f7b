// The embedded fonts, loaded through FreeType.
// In: text. Out: its glyphs and widths, the same on every machine.
#pragma once

#include <cairo.h>

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "draw/draw_list.hpp"

namespace piblocks {

/// For one thread. Each Font has a FreeType library of its own: fonts of different threads share
/// nothing.
class Font {
 public:
  /// Height of capitals above the baseline, in ems.
  static constexpr double kCapHeight_em = 0.73;

  /// @throws DrawError if FreeType or Cairo refuses the font.
  explicit Font(Face face = Face::article);
  ~Font();
  Font(const Font&) = delete;
  Font& operator=(const Font&) = delete;

  Face face() const noexcept { return face_; }

  struct Run {
    const Font* font;
    std::string_view text;
  };
  /// The line as pieces, each in one font: characters that this font lacks are in Face::article.
  /// @param utf8  valid; must outlive the runs.
  std::vector<Run> runs(std::string_view utf8) const;

  /// Makes it the font of `cr`, unhinted and antialiased in grey. @param size_px  of the em
  void select(cairo_t& cr, double size_px) const;
  /// The glyphs of a line of text that starts at `origin`, in a context where select() was called.
  /// Each is at a whole pixel of the surface. Cairo 1.16 rounds to these anyway. Cairo 1.18 paints
  /// glyphs at quarters of a pixel, and elsewhere where the surface ends within the text.
  static std::vector<cairo_glyph_t> glyphs(cairo_t& cr, const Point& origin, std::string_view utf8);
  /// @param what  names the text in messages
  /// @throws UsageError if it is not UTF-8, a character needs shaping, or the font has no glyph.
  void check(std::string_view utf8, const char* what) const;
  /// Width of a line of text, in ems.
  double width_em(std::string_view utf8) const;

 private:
  bool has_glyph(std::uint32_t code) const;
  const Font& fallback() const;
  double own_width_em(std::string_view utf8) const;

  Face face_;
  struct Loaded;
  std::unique_ptr<Loaded> loaded_;
  mutable std::unique_ptr<Font> fallback_;  ///< loaded when a character is missing
};

/// Each typeface, loaded when it is asked for. For one thread.
class Fonts {
 public:
  const Font& of(Face face) const {
    std::unique_ptr<Font>& font = fonts_.at(static_cast<std::size_t>(face));
    if (!font) font = std::make_unique<Font>(face);
    return *font;
  }

 private:
  mutable std::array<std::unique_ptr<Font>, kFaces> fonts_;
};

/// Widths of texts that change from frame to frame. Const members are thread-safe.
class TextWidths {
 public:
  TextWidths() = default;
  /// @param characters  all that may occur, in valid UTF-8
  TextWidths(const Font& font, std::string_view characters);
  double width_em(std::string_view text) const;

 private:
  std::map<std::string, double, std::less<>> advances_;
};

}  // namespace piblocks
