// Pictures of pictures and of text: title cards, split screens, fades and sheets.
// In: lines of text or draw lists. Out: a draw list.
#pragma once

#include <piblocks/scene.hpp>
#include <piblocks/script.hpp>

#include <string>
#include <vector>

#include "draw/draw_list.hpp"
#include "draw/look.hpp"

namespace piblocks {

/// A title card: lines of text in the middle of the frame. The first one is a heading. Lines that
/// do not fit are made smaller. @param lines  at least one, not empty.
/// @throws UsageError if a line cannot be set, or is too long for the frame.
DrawList compose_card(const std::vector<std::string>& lines, const View& view);

/// A card whose lines become others: of one size, each beginning at the same place.
class ChangingCard {
 public:
  /// @param lines, becomes  as of a Card without problems
  /// @throws UsageError as compose_card()
  ChangingCard(const std::vector<std::string>& lines, const std::vector<std::string>& becomes,
               const View& view);

  /// @param share  of the way from the lines to what they become, 0 … 1
  DrawList picture(double share) const;

 private:
  /// Characters that stay, or that slide in.
  struct Piece {
    std::string text;
    bool is_new;
    double width_px;
  };
  using Line = std::vector<Piece>;

  DrawList empty_;
  Palette palette_;
  std::vector<Line> lines_;
  std::size_t size_before_;  ///< lines that are there from the beginning
  double size_px_;
  Face face_;
};

/// The frame in equal cells.
class SplitScreen {
 public:
  /// @throws UsageError if the frame is too small for so many.
  SplitScreen(const View& view, std::size_t count, Split split = Split::automatic);

  /// Whether cells are one above the other.
  bool is_in_rows() const noexcept { return is_in_rows_; }

  /// Whole pixels that do not overlap, in order.
  const std::vector<PixelRect>& cells() const noexcept { return cells_; }
  /// @param pictures  one for each cell, of its size.
  DrawList compose(std::vector<DrawList> pictures) const;

 private:
  DrawList empty_;  ///< with what is between the cells
  std::vector<PixelRect> cells_;
  bool is_in_rows_ = false;
};

/// The picture, partly faded into its background. @param opacity  of what is on the
/// background, 0 … 1.
DrawList faded(DrawList picture, double opacity);

struct CaptionedPicture {
  DrawList picture;
  std::string caption;  ///< UTF-8, one line, set underneath; may be empty
};

/// Pictures of one size in rows, from the upper left, as large as margins, gaps and captions allow.
/// Captions have one size. They are left out where pictures with them would be less than half as
/// wide as without. @param pictures  at least one.
/// @throws DrawError if the font cannot be loaded.
DrawList arrange(std::vector<CaptionedPicture> pictures, int width_px, int height_px);

}  // namespace piblocks
