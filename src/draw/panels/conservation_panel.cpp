#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "draw/number_text.hpp"
#include "draw/panels/panels.hpp"

namespace piblocks {
namespace {

// In ems.
constexpr double kEnergyRow_em = 1.6;
constexpr double kMomentumRow_em = 1.2;
constexpr double kMostStretch = 1.5;  ///< of rows, where there is more room
constexpr double kBarHeight = 0.62;   ///< in heights of its row
constexpr double kEnergyBarHeight = 0.8;
constexpr double kBesideBars_em = 0.6;
constexpr double kInBar_em = 0.4;
constexpr double kLeastBars_em = 5;
constexpr int kDecimals = 3;
/// A momentum at time 0 that is a smaller part of the largest one is no good unit.
constexpr double kLeastUnit = 0.1;

/// Momenta in a unit in which the largest ones are about 1.
struct Momenta {
  explicit Momenta(const BlockSystem& system) {
    const Rational energy = twice_energy(system);
    if (energy == 0) return;
    const Rational total =
        system.red.mass * system.red.velocity + system.blue.mass * system.blue.velocity;
    const mpf_class largest = root_of(energy * std::max(system.red.mass, system.blue.mass));
    mpf_class unit(abs(total), largest.get_prec());
    if (unit < kLeastUnit * largest) unit = largest;
    red_factor = mpf_class(system.red.mass, largest.get_prec()) / unit;
    blue_factor = mpf_class(system.blue.mass, largest.get_prec()) / unit;
    sum = mpf_class(mpf_class(total, largest.get_prec()) / unit).get_d();
    most = mpf_class(largest / unit).get_d();
    const mpf_class most_of_both = root_of(energy * (system.red.mass + system.blue.mass));
    least = sum - mpf_class(most_of_both / unit).get_d();
  }

  // From a velocity; they may be beyond the range of a double.
  mpf_class red_factor;
  mpf_class blue_factor;
  double sum = 0;     ///< at time 0, and always with what the wall has taken since
  double most = 1;    ///< of a block
  double least = -1;  ///< of the wall
};

// Rows of momentum, from top to bottom.
constexpr std::size_t kRedRow = 0;
constexpr std::size_t kBlueRow = 1;
constexpr std::size_t kWallRow = 2;
constexpr std::size_t kSumRow = 3;
constexpr std::size_t kRows = 4;

/// Energy as one bar that the blocks share. Momentum as bars on both sides of zero: those of the
/// blocks and the wall's, which always add up to the same.
class ConservationPanel {
 public:
  ConservationPanel(const DrawingContext& context, const PanelPlace& place)
      : diagram_(context, place, titles_of(context)),
        momenta_(context.two_blocks().system()),
        face_(context.font.face() == Face::article ? Face::article : Face::digits),
        widths_(context.fonts.of(face_), "0123456789.,−% ") {
    const Rational energy = twice_energy(context.two_blocks().system());
    if (energy > 0) red_factor_ = root_of(context.two_blocks().system().red.mass / energy);
    moves_ = energy > 0;
    place_rows();
    place_columns(context);
    add_still(context);
    diagram_.finish();
  }

  void operator()(const FrameState& shown, std::vector<DrawItem>& items) const {
    items.emplace_back(diagram_.item());
    if (!moves_) return;
    const double red = shown.state.bodies[1].velocity[0];
    const double share = mpf_class(red_factor_ * red).get_d();
    add_energy(std::clamp(share * share, 0.0, 1.0), items);
    std::array<double, kRows> values{};
    values[kRedRow] = mpf_class(momenta_.red_factor * red).get_d();
    values[kBlueRow] = mpf_class(momenta_.blue_factor * shown.state.bodies[0].velocity[0]).get_d();
    values[kWallRow] = momenta_.sum - values[kRedRow] - values[kBlueRow];
    const std::array colors = colors_of_rows();
    for (const std::size_t row : {kRedRow, kBlueRow, kWallRow}) {
      items.emplace_back(RectangleItem{diagram_.moving(3 + 2 * row), bar_of(row, values[row]),
                                       colors[row].first, std::nullopt});
      add_figure(row, values[row], 4 + 2 * row, items);
    }
  }

 private:
  static std::vector<Formula> titles_of(const DrawingContext& context) {
    const FormulaSetter set = context.setter();
    if (!shows_a_turn(context)) {
      return {set.text("Energy and momentum are conserved"), set.text("Conservation")};
    }
    return {set.text("Energy only changes hands; the wall takes the momentum"),
            set.text("Energy changes hands; the wall takes momentum"),
            set.text("The wall takes momentum, no energy"), set.text("Energy stays; momentum goes"),
            set.text("Conservation")};
  }

  /// Of the bar and of its name.
  std::array<std::pair<Color, Color>, kRows> colors_of_rows() const {
    const Palette& palette = diagram_.palette();
    return {{{palette.red.fill, palette.red.label},
             {palette.blue.fill, palette.blue.label},
             {palette.wall, palette.text},
             {palette.muted, palette.muted}}};
  }

  /// What has no room is left out: first the row of the sum, then the heading.
  void place_rows() {
    const Rectangle& inside = diagram_.inside();
    const double em = diagram_.text_px();
    const auto height_em = [&] {
      return kEnergyRow_em + kMomentumRow_em * double((has_sum_ ? 4 : 3) + (has_heading_ ? 1 : 0));
    };
    if (height_em() * em > inside.height) has_heading_ = false;
    if (height_em() * em > inside.height) has_sum_ = false;
    if (height_em() * em > inside.height) {
      throw UsageError(fmt::format(
          "show.panels: the bars of the diagram 'conservation' need {:.0f} pixels, and there are "
          "{:.0f}; leave something out, or make the frame higher",
          height_em() * em, inside.height));
    }
    const double stretch = std::clamp(inside.height / (height_em() * em), 1.0, kMostStretch);
    row_px_ = stretch * kMomentumRow_em * em;
    energy_px_ = stretch * kEnergyRow_em * em;
    double y = inside.y + energy_px_;
    if (has_heading_) y += row_px_;
    top_ = y;
  }

  void place_columns(const DrawingContext& context) {
    const Rectangle& inside = diagram_.inside();
    const double em = diagram_.text_px();
    names_ = {context.palette.red.name, context.palette.blue.name, "wall", "sum"};
    double label = context.font.width_em("energy");
    for (const std::string& name : names_) label = std::max(label, context.font.width_em(name));
    const double figure = std::max(widths_.width_em(text_of(momenta_.least)),
                                   widths_.width_em(text_of(-momenta_.most)));
    left_ = std::round(inside.x + (label + kBesideBars_em) * em);
    right_ = std::round(inside.x + inside.width - (figure + kBesideBars_em) * em);
    has_figures_ = right_ - left_ >= kLeastBars_em * em;
    if (!has_figures_) right_ = std::round(inside.x + inside.width);
    // The bar of energy ends where the figures do.
    energy_right_ = std::round(inside.x + inside.width);
  }

  double baseline(double top, double height) const {
    return top + height / 2 + kHalfFigure_em * diagram_.text_px();
  }
  double row_top(std::size_t row) const { return top_ + double(row) * row_px_; }
  double x_of(double value) const {
    const double share = (value - momenta_.least) / (momenta_.most - momenta_.least);
    return left_ + share * (right_ - left_);
  }

  Rectangle bar_of(std::size_t row, double value) const {
    const double zero = x_of(0);
    const double end = x_of(value);
    const double height = std::round(kBarHeight * row_px_);
    return {std::min(zero, end), std::round(row_top(row) + (row_px_ - height) / 2),
            std::abs(end - zero), height};
  }
  Rectangle energy_bar() const {
    const double height = std::round(kEnergyBarHeight * energy_px_);
    return {left_, std::round(diagram_.inside().y + (energy_px_ - height) / 2),
            energy_right_ - left_, height};
  }

  /// All that stays: names, the bar of energy in blue, which red covers, zero, the sum.
  void add_still(const DrawingContext& context) {
    const Palette& palette = diagram_.palette();
    const Rectangle bar = energy_bar();
    const double left = diagram_.inside().x;
    diagram_.text("energy", {left, baseline(diagram_.inside().y, energy_px_)}, 0, palette.muted);
    if (moves_) {
      diagram_.box(bar, context.palette.blue.fill);
    } else {
      diagram_.box(bar, std::nullopt, palette.muted);
    }
    if (has_heading_) {
      diagram_.text("momentum", {left, baseline(top_ - row_px_, row_px_)}, 0, palette.muted);
    }
    const std::array colors = colors_of_rows();
    const std::size_t rows = has_sum_ ? kRows : kSumRow;
    for (std::size_t row = 0; row < rows; ++row) {
      diagram_.text(names_.at(row), {left, baseline(row_top(row), row_px_)}, 0,
                    colors.at(row).second);
    }
    const double zero = x_of(0);
    diagram_.line({{zero, top_}, {zero, row_top(rows)}}, palette.muted);
    if (!has_sum_) return;
    diagram_.box(bar_of(kSumRow, momenta_.sum), palette.muted);
    if (!has_figures_) return;
    const std::string text = text_of(momenta_.sum);
    const double x = diagram_.inside().x + diagram_.inside().width;
    const double width = widths_.width_em(text) * diagram_.text_px();
    diagram_.formula(diagram_.setter().digits(text),
                     {x - width, baseline(row_top(kSumRow), row_px_)}, 0, palette.muted);
  }

  void add_energy(double red_share, std::vector<DrawItem>& items) const {
    const Palette& palette = diagram_.palette();
    const Rectangle bar = energy_bar();
    const double red_px = red_share * bar.width;
    items.emplace_back(RectangleItem{
        diagram_.moving(0), {bar.x, bar.y, red_px, bar.height}, palette.red.fill, std::nullopt});
    // Both figures add up to 100.
    const long tenths = std::lround(1000 * red_share);
    const double em = diagram_.text_px();
    const double y = baseline(bar.y, bar.height);
    const std::string red = fixed_text(double(tenths) / 10, 1) + " %";
    const std::string blue = fixed_text(double(1000 - tenths) / 10, 1) + " %";
    const double blue_em = widths_.width_em(blue) + kInBar_em;
    if ((widths_.width_em(red) + 2 * kInBar_em) * em <= red_px) {
      items.emplace_back(TextItem{
          diagram_.moving(1), {bar.x + kInBar_em * em, y}, red, em, palette.red.text, face_});
    }
    if ((blue_em + kInBar_em) * em <= bar.width - red_px) {
      items.emplace_back(TextItem{diagram_.moving(2),
                                  {bar.x + bar.width - blue_em * em, y},
                                  blue,
                                  em,
                                  palette.blue.text,
                                  face_});
    }
  }

  static std::string text_of(double value) { return fixed_text(value, kDecimals); }

  void add_figure(std::size_t row, double value, std::size_t n,
                  std::vector<DrawItem>& items) const {
    if (!has_figures_) return;
    std::string text = text_of(value);
    const double em = diagram_.text_px();
    const double right = diagram_.inside().x + diagram_.inside().width;
    items.emplace_back(
        TextItem{diagram_.moving(n),
                 {right - widths_.width_em(text) * em, baseline(row_top(row), row_px_)},
                 std::move(text),
                 em,
                 colors_of_rows().at(row).second,
                 face_});
  }

  Diagram diagram_;
  Momenta momenta_;
  mpf_class red_factor_;  ///< from red's velocity to the root of its share of the energy
  bool moves_ = false;
  Face face_;
  TextWidths widths_;
  std::array<std::string, kRows> names_;
  bool has_heading_ = true;
  bool has_sum_ = true;
  bool has_figures_ = true;
  double top_ = 0;  ///< of the rows of momentum
  double row_px_ = 0;
  double energy_px_ = 0;
  // Of the bars.
  double left_ = 0;
  double right_ = 0;
  double energy_right_ = 0;
};

}  // namespace

Drawable conservation_panel(const DrawingContext& context, const PanelPlace& place) {
  return ConservationPanel(context, place);
}

}  // namespace piblocks
