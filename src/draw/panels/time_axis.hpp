// The axis of diagrams over simulation time.
// In: a setting and a sheet. Out: places of instants, ticks below, a line that marks the present.
#pragma once

#include <string>
#include <vector>

#include "draw/panels/panels.hpp"
#include "scene/schedule.hpp"

namespace piblocks {

class TimeAxis {
 public:
  /// From the scene's beginning to its end, with its figures inside the diagram.
  /// @param indent_em  room left of it.
  /// @throws UsageError if there is no such time, or none that can be told.
  TimeAxis(const Setting& setting, const PanelSheet& sheet, double indent_em);

  const Rational& from() const noexcept { return from_; }
  const Rational& to() const noexcept { return to_; }
  double bottom() const noexcept { return plot_.y + plot_.height; }
  double height() const noexcept { return plot_.height; }
  double left() const noexcept { return plot_.x; }
  double width() const noexcept { return plot_.width; }

  double x_of(double time) const noexcept { return plot_.x + (time - low_) * scale_; }
  /// Whether a place is on the axis; freeze and loop never leave it, other instants may.
  bool shows(double x) const noexcept { return x >= plot_.x - 1 && x <= plot_.x + plot_.width + 1; }
  /// Columns of this width.
  int columns(double width_px) const;

  /// Axis, ticks and figures.
  void add_base(PanelSheet& sheet) const;
  PathItem cursor(const PanelSheet& sheet, double x) const;

 private:
  TimeAxis(const Span& span, const Font& font, const PanelSheet& sheet, double indent_em);

  struct Figure {
    double x;
    std::string text;
    double width_px;
  };

  std::vector<Figure> figures_of(const Font& font, double em) const;
  void set_scale() { scale_ = plot_.width / span_; }

  Rational from_;
  Rational to_;
  Rectangle plot_;
  double low_;
  double span_;
  double scale_ = 1;
  std::vector<Figure> figures_;  ///< one at each tick; without a text where that has no room
};

}  // namespace piblocks
