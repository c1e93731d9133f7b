#include "draw/montage.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <utility>

#include "core/text.hpp"
#include "draw/font.hpp"
#include "draw/look.hpp"

namespace piblocks {
namespace {

/// A line that has to be smaller than this part of its planned size is too long.
constexpr double kLeastShrink = 0.4;
// In ems.
constexpr double kBelowHeading = 0.75;  // of the heading, to the next line's capitals
constexpr double kBetweenLines = 0.8;
constexpr double kStackStep = 1.15;  ///< from one large line to the next

double fitted_px(const std::string& text, double size_px, double width_px, const Font& font) {
  font.check(text, "card");
  const double fitted = std::min(size_px, width_px / font.width_em(text));
  if (fitted >= kLeastShrink * size_px) return fitted;
  throw UsageError(
      "card",
      fmt::format(
          "'{}' is too long to be read in {:.0f} pixels; break it into lines, or make the frame "
          "wider",
          text, width_px));
}

/// A smaller cell shows nothing.
constexpr int kLeastCell_px = 8;

// In ems of the caption.
constexpr double kCaptionBaseline = 1.25;  // below the picture
constexpr double kCaptionHeight = 1.6;
/// Captions that make pictures narrower than this part of their width without them are left out.
constexpr double kLeastShareWithCaptions = 0.5;

GroupItem group_of(ItemId id, const Rect& bounds, DrawList picture, double opacity = 1) {
  return {id, bounds, std::make_shared<const DrawList>(std::move(picture)), opacity};
}

/// A page of pictures of one shape.
struct SheetPage {
  double width;   ///< without margins
  double height;  ///< without margins
  double gap;
  double aspect;  ///< of the pictures, width : height
  int pictures;

  int rows(int columns) const { return (pictures + columns - 1) / columns; }
};

/// What all captions of a sheet need below their pictures; nothing if there are none.
struct CaptionSize {
  double width = 0;
  double height = 0;
};

/// Pictures in their cells, which are wider where captions are.
struct SheetGrid {
  int columns = 1;
  CaptionSize caption = {};
  double picture_width = 0;  ///< 0 if there is no room
};

double picture_width(const SheetPage& page, int columns, const CaptionSize& caption) {
  const int rows = page.rows(columns);
  const double room_x = (page.width - (columns - 1) * page.gap) / columns;
  const double room_y = (page.height - (rows - 1) * page.gap) / rows - caption.height;
  if (room_x < caption.width) return 0;
  return std::max(0.0, std::min(room_x, room_y * page.aspect));
}

/// With the largest pictures.
SheetGrid best_grid(const SheetPage& page, const CaptionSize& caption) {
  SheetGrid best{1, caption, picture_width(page, 1, caption)};
  for (int columns = 2; columns <= page.pictures; ++columns) {
    const double width = picture_width(page, columns, caption);
    if (width > best.picture_width) best = {columns, caption, width};
  }
  return best;
}

SheetGrid grid_of(const SheetPage& page, const CaptionSize& caption) {
  const SheetGrid without = best_grid(page, {});
  const SheetGrid with = best_grid(page, caption);
  return with.picture_width >= kLeastShareWithCaptions * without.picture_width ? with : without;
}

CaptionSize caption_size(const std::vector<CaptionedPicture>& pictures, const Font& font,
                         double text_px) {
  double width_em = 0;
  for (const CaptionedPicture& each : pictures) {
    if (!each.caption.empty()) width_em = std::max(width_em, font.width_em(each.caption));
  }
  if (width_em == 0) return {};
  return {width_em * text_px, kCaptionHeight * text_px};
}

}  // namespace

DrawList compose_card(const std::vector<std::string>& lines, const View& view) {
  const Font font(text_face_of(view.theme));
  const Palette palette = palette_of(view);
  const double measure = Sizes(view).short_side;
  const double inner_px = view.width_px - 2 * style::kCardMargin * measure;

  const double heading_px = fitted_px(lines.front(), style::kCardHeading * measure, inner_px, font);
  // All other lines have one size, so that none seems to matter more.
  double line_px = style::kCardLine * measure;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    line_px = std::min(line_px, fitted_px(lines[i], style::kCardLine * measure, inner_px, font));
  }
  const double heading_height = Font::kCapHeight_em * heading_px;
  const double line_height = Font::kCapHeight_em * line_px;
  const double first_step = kBelowHeading * heading_px + line_height;
  const double step = (Font::kCapHeight_em + kBetweenLines) * line_px;
  const double below = lines.size() > 1 ? first_step + double(lines.size() - 2) * step : 0;

  DrawList list{view.width_px, view.height_px, background_of(view), {}};
  double baseline = (view.height_px - heading_height - below) / 2 + heading_height;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const double size_px = i == 0 ? heading_px : line_px;
    if (i > 0) baseline += i == 1 ? first_step : step;
    const Point origin{(view.width_px - font.width_em(lines[i]) * size_px) / 2,
                       std::round(baseline)};
    list.items.emplace_back(TextItem{nth(ItemId::card, i), origin, lines[i], size_px,
                                     i == 0 ? palette.text : palette.muted, font.face()});
  }
  return list;
}

ChangingCard::ChangingCard(const std::vector<std::string>& lines,
                           const std::vector<std::string>& becomes, const View& view)
    : empty_{view.width_px, view.height_px, background_of(view), {}},
      palette_(palette_of(view.theme)),
      size_before_(lines.size()),
      size_px_(style::kCounter * Sizes(view).short_side),
      face_(text_face_of(view.theme)) {
  const Font font(face_);
  const double inner_px = view.width_px - 2 * style::kCardMargin * Sizes(view).short_side;
  for (const std::string& line : becomes) {
    size_px_ = std::min(size_px_, fitted_px(line, size_px_, inner_px, font));
  }
  const double high = view.height_px / (kStackStep * double(becomes.size() + 1));
  size_px_ = std::min(size_px_, high);
  for (std::size_t i = 0; i < becomes.size(); ++i) {
    std::string_view left = i < lines.size() ? std::string_view(lines[i]) : std::string_view();
    Line& line = lines_.emplace_back();
    for (std::string_view rest = becomes[i]; !rest.empty();) {
      const std::string_view next = rest.substr(0, step_bytes(rest));
      const bool is_new = i < lines.size() && !left.starts_with(next);
      if (line.empty() || line.back().is_new != is_new) line.push_back({{}, is_new, 0});
      line.back().text += next;
      rest.remove_prefix(next.size());
      if (!is_new) left.remove_prefix(std::min(left.size(), next.size()));
    }
    for (Piece& piece : line) piece.width_px = font.width_em(piece.text) * size_px_;
  }
}

DrawList ChangingCard::picture(double share) const {
  double widest = 0;
  for (const Line& line : lines_) {
    double width = 0;
    for (const Piece& piece : line) width += piece.width_px;
    widest = std::max(widest, width);
  }
  const double left = (empty_.width_px - widest) / 2;
  const double step = kStackStep * size_px_;
  const double high = double(lines_.size() - 1) * step + Font::kCapHeight_em * size_px_;
  double baseline = (empty_.height_px - high) / 2 + Font::kCapHeight_em * size_px_;
  DrawList list = empty_;
  std::size_t n = 0;
  for (std::size_t i = 0; i < lines_.size(); ++i, baseline += step) {
    const bool is_new_line = i >= size_before_;
    double x = left;
    for (const Piece& piece : lines_[i]) {
      const bool is_new = piece.is_new || is_new_line;
      const Color color = is_new ? faded(palette_.accent, share) : palette_.text;
      const ItemId id = nth(ItemId::card, n++);
      if (!is_new || share > 0) {
        list.items.emplace_back(
            TextItem{id, {x, std::round(baseline)}, piece.text, size_px_, color, face_});
      }
      x += (piece.is_new ? share : 1) * piece.width_px;
    }
  }
  return list;
}

SplitScreen::SplitScreen(const View& view, std::size_t count, Split split)
    : empty_{view.width_px, view.height_px, background_of(view), {}} {
  const bool is_wide_frame = view.width_px > view.height_px;
  const bool is_wide = split == Split::automatic ? is_wide_frame : split == Split::columns;
  is_in_rows_ = !is_wide;
  const Sizes sizes(view);
  const bool has_low_rows =
      !is_wide && view.height_px < double(count) * style::kRow * sizes.short_side;
  const int outer_px =
      has_low_rows
          ? static_cast<int>(std::lround(sizes.margin - style::kRowMargin * sizes.short_side))
          : 0;
  const int length = (is_wide ? view.width_px : view.height_px) - 2 * outer_px;
  const int breadth = is_wide ? view.height_px : view.width_px;
  const int line_px = std::max(1, static_cast<int>(std::lround(sizes.data_line)));
  const int n = static_cast<int>(count);
  const int cell_px = (length - (n - 1) * line_px) / n;
  if (std::min(cell_px, breadth) < kLeastCell_px) {
    throw UsageError("compare", fmt::format("{} runs do not fit into {}x{}; make the frame larger",
                                            count, view.width_px, view.height_px));
  }
  const auto place = [is_wide](int along, int across, int along_px, int across_px) {
    return is_wide ? PixelRect{along, across, along_px, across_px}
                   : PixelRect{across, along, across_px, along_px};
  };
  const int margin = static_cast<int>(std::lround(sizes.margin));
  for (int i = 0; i < n; ++i) {
    const int at = outer_px + i * (cell_px + line_px);
    cells_.push_back(place(at, 0, cell_px, breadth));
    if (i + 1 == n) break;
    empty_.items.emplace_back(
        RectangleItem{nth(ItemId::compared, static_cast<std::size_t>(i)),
                      to_rect(place(at + cell_px, margin, line_px, breadth - 2 * margin)),
                      palette_of(view).grid});
  }
}

DrawList SplitScreen::compose(std::vector<DrawList> pictures) const {
  DrawList list = empty_;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    list.items.emplace_back(group_of(nth(ItemId::compared, cells_.size() + i), to_rect(cells_[i]),
                                     std::move(pictures[i])));
  }
  return list;
}

DrawList faded(DrawList picture, double opacity) {
  DrawList ground{picture.width_px, picture.height_px, picture.background, {}};
  const Rect bounds = to_rect({0, 0, picture.width_px, picture.height_px});
  if (opacity > 0) {
    ground.items.emplace_back(group_of(ItemId::fade, bounds, std::move(picture), opacity));
  }
  return ground;
}

DrawList arrange(std::vector<CaptionedPicture> pictures, int width_px, int height_px) {
  assert(!pictures.empty());
  const Font font;
  const double side = std::min(width_px, height_px);
  const double margin = style::kSheetMargin * side;
  const double text_px = style::kSheetCaption * side;
  const double line_px = std::max(0.5, style::kSheetLine * side);
  const DrawList& first = pictures.front().picture;
  const SheetPage page{width_px - 2 * margin, height_px - 2 * margin, style::kSheetGap * side,
                       double(first.width_px) / first.height_px, static_cast<int>(pictures.size())};
  const SheetGrid grid = grid_of(page, caption_size(pictures, font, text_px));
  const double width = grid.picture_width;
  const double height = width / page.aspect;
  const double cell_width = std::max(width, grid.caption.width);
  const double step_x = cell_width + page.gap;
  const double step_y = height + grid.caption.height + page.gap;
  const double left = (width_px - grid.columns * step_x + page.gap + cell_width - width) / 2;
  const double top = (height_px - page.rows(grid.columns) * step_y + page.gap) / 2;

  DrawList list{width_px, height_px, style::kSheetPaper, {}};
  std::vector<DrawItem> above;
  for (int i = 0; i < page.pictures; ++i) {
    auto& [picture, text] = pictures[static_cast<std::size_t>(i)];
    const int column = i % grid.columns;
    const int row = i / grid.columns;
    const Rect place{left + column * step_x, top + row * step_y, width, height};
    list.items.emplace_back(group_of(ItemId::compared, place, std::move(picture)));
    // Half of the line around the picture is inside of it.
    above.emplace_back(RectangleItem{ItemId::wall, place.grown(line_px / 2), std::nullopt,
                                     Stroke{style::kSheetFrame, line_px}});
    if (grid.caption.height == 0 || text.empty()) continue;
    const Point origin{place.x + (width - font.width_em(text) * text_px) / 2,
                       place.bottom() + kCaptionBaseline * text_px};
    above.emplace_back(TextItem{ItemId::label, origin, text, text_px, style::kSheetText});
  }
  std::ranges::move(above, std::back_inserter(list.items));
  return list;
}

}  // namespace piblocks
