// All panels, and what they are made of.
// In: a drawing context and the place of the panel. Out: a drawable.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "draw/layout.hpp"
#include "scene/schedule.hpp"

namespace piblocks {

/// Where a diagram is, the first of its ids, and its name for messages.
struct PanelPlace {
  Rect area;
  ItemId first_id = ItemId::panels;
  Panel panel = Panel::velocity;
};

/// The velocities as a point on a circle, and a chord for each collision. That of Panel::ellipse is
/// first the ellipse that it is before velocities are scaled by the masses' roots.
Drawable velocity_panel(const DrawingContext& context, const PanelPlace& place);
/// The path through the plane of both gaps, enlarged near the corner.
Drawable position_panel(const DrawingContext& context, const PanelPlace& place);
/// The straight line through the unfolded wedges. Those of Panel::mirrors unfold one by one, each
/// after its collision.
Drawable unfolded_panel(const DrawingContext& context, const PanelPlace& place);
/// How near the count comes to a wrong digit of pi.
/// @throws UsageError if the scene does not count pi, or the panel is too small.
Drawable certainty_panel(const DrawingContext& context, const PanelPlace& place);
/// Both gaps against time; of other bodies, where each block of a line is.
Drawable time_panel(const DrawingContext& context, const PanelPlace& place);
/// Collisions so far against time.
Drawable count_panel(const DrawingContext& context, const PanelPlace& place);
/// Bars of energy and momentum.
Drawable conservation_panel(const DrawingContext& context, const PanelPlace& place);
/// How many discs or blocks have which speed, and the distribution that Maxwell found.
/// @throws UsageError if there are too few.
Drawable speeds_panel(const DrawingContext& context, const PanelPlace& place);
/// The squared distance of the centres of the two discs that meet first, against time. It is
/// (r₁ + r₂)² twice: when they touch, and when they would part if they passed through each other.
/// @throws UsageError if no two discs meet.
Drawable separation_panel(const DrawingContext& context, const PanelPlace& place);

/// The two blocks of a state, as seen from what is immovable beside them.
PairState blocks_state(const State& state, const TwoBlocks& blocks);
/// Whether red comes, at least three collisions happen, and red goes while the scene is shown.
bool shows_a_turn(const DrawingContext& context);

// Of axes with figures below them, in ems.
inline constexpr double kBelowAxis_em = 1.7;
inline constexpr double kBetweenTicks_em = 4;

/// A panel's title, its items that stay, and forms for those that move.
class Diagram {
 public:
  /// @param titles  sentences that say what to see, from the longest to the shortest; the first one
  ///                that fits is shown
  /// @throws UsageError if none does.
  Diagram(const DrawingContext& context, const PanelPlace& place,
          const std::vector<Formula>& titles);
  /// Without a title, but with room for one.
  Diagram(const DrawingContext& context, const PanelPlace& place);

  /// A title as the n-th and the next of the things that move. Until finish().
  /// @param titles   as of the constructor
  /// @param size_px  of its type if it has room, else it has the size of text
  std::vector<DrawItem> title(std::size_t n, const std::vector<Formula>& titles, const Color& color,
                              double size_px) const;

  /// What is left below the title.
  const Rect& inside() const noexcept { return inside_; }
  double text_px() const noexcept { return text_px_; }
  const Palette& palette() const noexcept { return palette_; }
  const Sizes& sizes() const noexcept { return sizes_; }
  /// Width of lines of data, in widths of the grid's lines.
  double data_width() const noexcept { return sizes_.data_line / sizes_.grid_line; }
  /// For formulas. Until finish().
  FormulaSetter setter() const { return {*fonts_, font_->face()}; }

  // Add something that stays. Widths and dashes are in widths of the grid's lines.
  void line(std::vector<Point> points, const Color& color, double width = 1, double dash = 0) {
    const Stroke stroke{color, width * sizes_.grid_line, dash * sizes_.grid_line};
    items_.emplace_back(line_item(next_id(), std::move(points), stroke));
  }
  void shape(std::vector<Point> outline, const std::optional<Color>& fill,
             const std::optional<Color>& line = std::nullopt) {
    items_.emplace_back(shape_item(next_id(), std::move(outline), fill, line));
  }
  void box(const Rect& box, const std::optional<Color>& fill,
           const std::optional<Color>& line = std::nullopt) {
    shape(box.corners(), fill, line);
  }
  /// @param anchor  the part of the text's width that is left of `at`: 0, 0.5 or 1
  void text(const std::string& text, const Point& at, double anchor, const Color& color);
  void formula(const Formula& formula, const Point& at, double anchor, const Color& color);
  /// At a tick of an axis. The text is empty if it has no room.
  struct Figure {
    double x;  ///< of the tick, and of the text's middle
    std::string text;
    double width_px;
  };
  /// An axis with ticks. Its name is at its end, in the place of figures, if two others remain.
  void axis(const Point& from, const Point& to, std::span<const Figure> figures,
            const std::string& name);

  // The n-th of the things that move, which are above all that stays.
  ItemId moving(std::size_t n) const { return nth(first_id_, kMoving + n); }
  PathItem moving_line(std::size_t n, std::vector<Point> points, const Color& color,
                       double width = 1) const {
    return line_item(moving(n), std::move(points), {color, width * sizes_.grid_line});
  }
  PathItem moving_shape(std::size_t n, std::vector<Point> outline, const Color& fill,
                        const std::optional<Color>& line = std::nullopt) const {
    return shape_item(moving(n), std::move(outline), fill, line);
  }
  /// More that stays, above the first `n` of the things that move.
  /// @throws UsageError as finish()
  PlateItem plate(std::size_t n, std::vector<DrawItem> items) const;
  DiscItem dot(std::size_t n, const Point& at, const Color& color, double radius_px) const {
    return {moving(n), at, radius_px, color, Stroke{palette_.background, sizes_.grid_line}};
  }
  /// Marks the present.
  DiscItem dot(std::size_t n, const Point& at, const Color& color) const {
    return dot(n, at, color, kDotRadius * sizes_.grid_line);
  }

  /// The same, larger, where it is the only one.
  DiscItem present_dot(std::size_t n, const Point& at) const {
    return dot(n, at, palette_.accent, style::kPresentDot * sizes_.short_side);
  }

  /// All that stays as one item; nothing can be added to it any more.
  /// @throws UsageError if some of it is beyond the range of numbers.
  void finish();
  const PlateItem& item() const noexcept { return item_; }

 private:
  static constexpr std::size_t kMoving = 32768;
  static constexpr double kDotRadius = 3.2;  // in line widths

  PathItem shape_item(ItemId id, std::vector<Point> outline, const std::optional<Color>& fill,
                      const std::optional<Color>& line) const {
    PathItem item{id, std::move(outline), true, fill};
    if (line) item.stroke = Stroke{*line, sizes_.grid_line};
    return item;
  }
  /// @throws UsageError if none fits.
  const Formula& fitting(const std::vector<Formula>& titles) const;
  void check_range(const std::vector<DrawItem>& items) const;
  ItemId next_id() const { return nth(first_id_, items_.size()); }

  Palette palette_;
  Point title_at_;
  double title_room_px_;
  // Of the context, which ends with finish().
  const Fonts* fonts_;
  const Font* font_;
  ItemId first_id_;
  Panel panel_;
  Sizes sizes_;
  double text_px_;
  Rect inside_;
  std::vector<DrawItem> items_;
  PlateItem item_;
};

/// A title that follows the collisions, so that it says nothing before it can be seen.
class PhasedTitle {
 public:
  /// Each as titles of a Diagram.
  struct Sentences {
    std::vector<Formula> before;  ///< the first collision
    std::vector<Formula> during;
    std::vector<Formula> after = {};  ///< the last; in the accent, large if it has room
  };
  /// @param before  collisions before the scene begins @param last  the last collision
  PhasedTitle(const Diagram& diagram, const Sentences& sentences, Integer before, Integer last);

  void add(const Integer& count, std::vector<DrawItem>& items) const;

 private:
  static constexpr std::size_t kFirst = 32000;  ///< of the things that move in its diagram

  std::vector<DrawItem> before_;
  std::vector<DrawItem> during_;
  std::vector<DrawItem> after_;
  Integer first_count_;
  Integer last_count_;
};

class TimeAxis {
 public:
  /// From the scene's beginning to its end, with its figures inside the diagram.
  /// @param indent_em  room left of the axis
  /// @throws UsageError unless the scene ends after it begins, or if its time is beyond a double.
  TimeAxis(const DrawingContext& context, const Diagram& diagram, double indent_em);

  const Span& span() const noexcept { return span_; }
  /// The diagram without the figures below it.
  const Rect& plot() const noexcept { return plot_; }
  double right() const noexcept { return plot_.right(); }
  double bottom() const noexcept { return plot_.bottom(); }
  double x_of(double time) const noexcept { return plot_.x + (time - from_) * scale_; }
  /// Whether a time is on the axis. Stills may show instants that are not.
  bool shows(double time) const noexcept {
    const double x = x_of(time);
    return x >= plot_.x - 1 && x <= plot_.right() + 1;
  }

  /// Axis, ticks and figures.
  void add_base(Diagram& diagram) const {
    diagram.axis({plot_.x, bottom()}, {right(), bottom()}, figures_, "time");
  }
  /// Marks the present as the n-th of the things that move, from the axis to a height. A rectangle
  /// on whole pixels costs less than a line.
  RectangleItem cursor(const Diagram& diagram, std::size_t n, const Point& present) const;

 private:
  void place_figures(const Font& font, double em);

  Span span_;
  double from_;
  double length_;
  Rect plot_;
  double scale_ = 1;  ///< pixels per unit of time
  std::vector<Diagram::Figure> figures_;
};

}  // namespace piblocks
