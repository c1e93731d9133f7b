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
  /// @param indent_em  room left of the axis
  /// @throws UsageError if the scene ends before it begins, or its time is beyond a double.
  TimeAxis(const Setting& setting, const PanelSheet& sheet, double indent_em);

  const Span& span() const noexcept { return span_; }
  /// The diagram without the figures below it.
  const Rectangle& plot() const noexcept { return plot_; }
  double bottom() const noexcept { return plot_.y + plot_.height; }
  double x_of(double time) const noexcept { return plot_.x + (time - from_) * scale_; }
  /// Whether a place is on the axis. Stills may show instants that are not.
  bool shows(double x) const noexcept { return x >= plot_.x - 1 && x <= plot_.x + plot_.width + 1; }

  /// Axis, ticks and figures.
  void add_base(PanelSheet& sheet) const;
  PathItem cursor(const PanelSheet& sheet, double x) const;

 private:
  struct Figure {
    double x;
    std::string text;
    double width_px;
  };

  void place_figures(const Font& font, double em);

  Span span_;
  double from_;
  double length_;
  Rectangle plot_;
  double scale_ = 1;             ///< pixels per unit of time
  std::vector<Figure> figures_;  ///< one at each tick; its text is empty if it has no room
};

}  // namespace piblocks
