#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/rounded.hpp"
#include "draw/number_text.hpp"
#include "draw/panels/panels.hpp"

namespace piblocks {
namespace {

constexpr std::size_t kLeastBodies = 20;
constexpr int kLeastBins = 8;
constexpr int kMostBins = 24;
/// The axis ends at this multiple of the speed of mean energy; few are faster.
constexpr double kFastest = 2.6;
/// Part of the diagram's height that the curve's maximum takes.
constexpr double kCurveHeight = 0.62;
constexpr int kCurvePoints = 160;
/// Of the figure 0, which is centred on the axis's beginning.
constexpr double kHalfZero_em = 0.32;

std::vector<double> masses_of(const System& system) {
  std::vector<double> masses;
  for (const Body& body : system.bodies) {
    if (body.mass) masses.push_back(to_double(*body.mass));
  }
  return masses;
}

/// The speeds' distribution in equilibrium. In a plane a body of mass m has the speed v with the
/// density (m v/kT) exp(-m v^2/2kT), on a line with sqrt(2m/(pi kT)) exp(-m v^2/2kT) (Landau and
/// Lifshitz, Statistical Physics, section 29). kT is the mean energy, or twice this on a line.
class Maxwell {
 public:
  Maxwell(const System& system, double energy)
      : is_plane_(system.dimensions == 2),
        masses_(masses_of(system)),
        temperature_(energy / double(masses_.size()) * (is_plane_ ? 1 : 2)) {}

  /// The mean of all bodies' densities.
  double density(double speed) const {
    double sum = 0;
    for (const double mass : masses_) {
      const double a = mass / temperature_;
      const double fall = rounded::exp(-a * speed * speed / 2);
      sum += (is_plane_ ? a * speed : std::sqrt(2 * a / std::numbers::pi)) * fall;
    }
    return sum / double(masses_.size());
  }
  /// Speed of the mean mass at the mean energy.
  double usual_speed() const {
    double mass = 0;
    for (const double one : masses_) mass += one / double(masses_.size());
    return std::sqrt(temperature_ / mass * (is_plane_ ? 2 : 1));
  }
  double movable() const { return double(masses_.size()); }

 private:
  bool is_plane_;
  std::vector<double> masses_;
  double temperature_;  ///< times Boltzmann's constant
};

double energy_of(const System& system) { return to_double(twice_energy(system)) / 2; }

class SpeedsPanel {
 public:
  SpeedsPanel(const DrawingContext& context, const PanelPlace& place)
      : system_(context.scene.system),
        diagram_(context, place, titles(context)),
        maxwell_(system_, energy_of(system_)),
        plot_(diagram_.inside()),
        fastest_(kFastest * maxwell_.usual_speed()),
        bins_(std::clamp(int(std::sqrt(maxwell_.movable())), kLeastBins, kMostBins)) {
    const double half_figure = kHalfZero_em * diagram_.text_px();
    plot_ = {plot_.x + half_figure, plot_.y, plot_.width - half_figure,
             plot_.height - kBelowAxis_em * diagram_.text_px()};
    add_axis(context);
    add_curve();
    diagram_.finish();
  }

  void operator()(const FrameState& shown, std::vector<DrawItem>& items) const {
    std::vector<int> counts(std::size_t(bins_), 0);
    for (std::size_t i = 0; i < shown.state.bodies.size(); ++i) {
      if (!system_.bodies[i].mass) continue;
      const auto& [x, y] = shown.state.bodies[i].velocity;
      const auto bin = static_cast<std::size_t>(std::sqrt(x * x + y * y) / fastest_ * bins_);
      if (bin < counts.size()) ++counts[bin];
    }
    items.emplace_back(diagram_.item());
    const double width = plot_.width / bins_;
    const double bin_speed = fastest_ / bins_;
    for (std::size_t bin = 0; bin < counts.size(); ++bin) {
      if (counts[bin] == 0) continue;
      const double density = counts[bin] / (maxwell_.movable() * bin_speed);
      const double left = std::round(plot_.x + double(bin) * width);
      const double right = std::round(plot_.x + double(bin + 1) * width) - 1;
      const double top = std::round(y_of(density));
      items.emplace_back(RectangleItem{diagram_.moving(bin),
                                       {left, top, right - left, plot_.bottom() - top},
                                       diagram_.palette().shade});
    }
    items.emplace_back(above_);
  }

 private:
  static std::vector<Formula> titles(const DrawingContext& context) {
    const System& system = context.scene.system;
    const double energy = energy_of(system);
    if (masses_of(system).size() < kLeastBodies || energy <= 0) {
      throw UsageError("show.panels",
                       fmt::format("'speeds' needs at least {} bodies of finite mass, and one that "
                                   "moves; leave the diagram out",
                                   kLeastBodies));
    }
    if (!std::isfinite(energy)) {
      throw UsageError("show.panels",
                       "'speeds' needs an energy within the range of a double (about 1.8e308); "
                       "leave the diagram out, or use less extreme velocities");
    }
    return context.setter().texts(
        {"The speeds approach Maxwell's curve", "Speeds and Maxwell's curve", "Speeds"});
  }

  double y_of(double density) const {
    const double share = std::min(1.0, density / greatest_ * kCurveHeight);
    return plot_.y + plot_.height * (1 - share);
  }

  void add_axis(const DrawingContext& context) {
    const double em = diagram_.text_px();
    const Ticks ticks = ticks_of(0, fastest_, kBetweenTicks_em * em * fastest_ / plot_.width);
    std::vector<Diagram::Figure> figures;
    for (const double value : ticks.values) {
      const double x = plot_.x + value / fastest_ * plot_.width;
      const std::string text = tick_text(value, ticks.step);
      const double width = context.font.width_em(text) * em;
      const bool has_room = x + width / 2 <= plot_.right();
      figures.push_back({x, has_room ? text : "", width});
    }
    diagram_.axis({plot_.x, plot_.bottom()}, {plot_.right(), plot_.bottom()}, figures, "speed");
  }

  void add_curve() {
    greatest_ = 0;
    std::vector<double> densities;
    for (int i = 0; i <= kCurvePoints; ++i) {
      densities.push_back(maxwell_.density(fastest_ * i / kCurvePoints));
      greatest_ = std::max(greatest_, densities.back());
    }
    std::vector<Point> points;
    for (int i = 0; i <= kCurvePoints; ++i) {
      points.push_back({plot_.x + plot_.width * i / kCurvePoints, y_of(densities[std::size_t(i)])});
    }
    // The bars stand on the axis, and end behind its line.
    const double bottom = plot_.bottom();
    std::vector<DrawItem> lines;
    lines.emplace_back(diagram_.moving_line(kCurve, {{plot_.x, bottom}, {plot_.right(), bottom}},
                                            diagram_.palette().muted));
    lines.emplace_back(diagram_.moving_line(kCurve + 1, std::move(points),
                                            diagram_.palette().accent, diagram_.data_width()));
    above_ = diagram_.plate(kCurve, std::move(lines));
  }

  static constexpr std::size_t kCurve = 1000;  ///< after all bars

  System system_;
  Diagram diagram_;
  Maxwell maxwell_;
  Rect plot_;
  double fastest_;
  int bins_;
  double greatest_ = 1;  ///< density of the curve's maximum
  PlateItem above_;
};

}  // namespace

Drawable speeds_panel(const DrawingContext& context, const PanelPlace& place) {
  return {SpeedsPanel(context, place)};
}

}  // namespace piblocks
