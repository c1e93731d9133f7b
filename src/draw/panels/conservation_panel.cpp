#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "draw/number_text.hpp"
#include "draw/panels/panels.hpp"
#include "draw/stage/stage.hpp"

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
/// More blocks share one row of momentum if there is no room for all.
constexpr std::size_t kAlwaysRows = 2;
/// A momentum at time 0 that is a smaller part of the largest one is no good unit.
constexpr double kLeastUnit = 0.1;

/// Momenta in a unit in which the largest ones are about 1.
struct Momenta {
  explicit Momenta(const System& system) {
    const Rational energy = twice_energy(system);
    factors.resize(system.bodies.size());
    if (energy == 0) return;
    Rational total = 0;
    Rational masses = 0;
    for (const Body& body : system.bodies) {
      if (!body.mass) continue;
      total += *body.mass * body.velocity[0];
      masses += *body.mass;
    }
    const mpf_class largest = root_of(energy * heaviest_mass(system));
    mpf_class unit(abs(total), largest.get_prec());
    if (unit < kLeastUnit * largest) unit = largest;
    for (std::size_t i = 0; i < factors.size(); ++i) {
      const auto& mass = system.bodies[i].mass;
      if (mass) factors[i] = mpf_class(*mass, largest.get_prec()) / unit;
    }
    sum = mpf_class(mpf_class(total, largest.get_prec()) / unit).get_d();
    most_of_one = mpf_class(largest / unit).get_d();
    most_of_all = mpf_class(root_of(energy * masses) / unit).get_d();
  }

  /// From a body's velocity; they may be beyond the range of a double.
  std::vector<mpf_class> factors;
  double sum = 0;          ///< at time 0, and always with what walls have taken since
  double most_of_one = 1;  ///< the greatest that a block can have
  double most_of_all = 1;  ///< and all blocks together
};

/// A row of momentum.
struct Row {
  std::string name;
  Color fill;
  Color label;                      ///< of its name and its figure
  std::vector<std::size_t> bodies;  ///< whose momentum it shows; of walls and of the sum none
};

/// Energy as one bar that the blocks share. Momentum as bars on both sides of zero: those of the
/// blocks and that of walls and fixed blocks, which always add up to the same.
class ConservationPanel {
 public:
  ConservationPanel(const DrawingContext& context, const PanelPlace& place)
      : diagram_(context, place, titles_of(context)),
        colors_(context.colors),
        momenta_(context.scene.system),
        face_(context.font.face() == Face::article ? Face::article : Face::digits),
        widths_(context.fonts.of(face_), "0123456789.,−% ") {
    const Rational energy = twice_energy(context.scene.system);
    for (const Body& body : context.scene.system.bodies) {
      const bool has_part = energy > 0 && body.mass;
      energy_factors_.push_back(has_part ? root_of(*body.mass / energy) : mpf_class(0));
    }
    moves_ = energy > 0;
    make_rows(context);
    find_range(context.scene.system);
    place_rows();
    place_columns(context);
    add_still();
    diagram_.finish();
  }

  void operator()(const FrameState& shown, std::vector<DrawItem>& items) const {
    items.emplace_back(diagram_.item());
    if (!moves_) return;
    add_energy(shown.state.bodies, items);
    const std::size_t first = 2 * colors_.size() - 1;  // after all parts of the energy
    double rest = momenta_.sum;
    for (std::size_t row = 0; row < moving_rows_; ++row) {
      double value = 0;
      for (const std::size_t body : rows_[row].bodies) {
        value += mpf_class(momenta_.factors[body] * shown.state.bodies[body].velocity[0]).get_d();
      }
      if (rows_[row].bodies.empty()) value = rest;
      rest -= value;
      items.emplace_back(
          RectangleItem{diagram_.moving(first + 2 * row), bar_of(row, value), rows_[row].fill});
      add_figure(row, value, first + 2 * row + 1, items);
    }
  }

 private:
  static std::vector<Formula> titles_of(const DrawingContext& context) {
    const FormulaSetter set = context.setter();
    if (!shows_a_turn(context)) {
      return set.texts({"Energy and momentum are conserved", "Conservation"});
    }
    return set.texts({"Energy only changes hands; the wall takes the momentum",
                      "Energy changes hands; the wall takes momentum",
                      "The wall takes momentum, no energy", "Energy stays; momentum goes",
                      "Conservation"});
  }

  /// From the last block to the first, walls, and the sum.
  void make_rows(const DrawingContext& context) {
    const Palette& palette = context.palette;
    const System& system = context.scene.system;
    const bool is_pair = context.pair() != nullptr;
    for (std::size_t i = system.bodies.size(); i-- > 0;) {
      if (!system.bodies[i].mass) continue;
      std::string name = context.scene.styles[i].label;
      if (name.empty()) name = is_pair ? colors_[i].name : fmt::format("{}", i + 1);
      rows_.push_back({std::move(name), colors_[i].fill, colors_[i].label, {i}});
    }
    const std::size_t movable = rows_.size();
    if (!system.walls.empty() || movable < system.bodies.size()) {
      rows_.push_back({"wall", palette.wall, palette.text, {}});
    }
    moving_rows_ = rows_.size();
    rows_.push_back({"sum", palette.muted, palette.muted, {}});
    if (movable <= kAlwaysRows || height_em(moving_rows_) * diagram_.text_px() <= inside().height) {
      return;
    }
    // Many blocks share a row.
    Row all{"blocks", palette.text, palette.text, {}};
    for (std::size_t row = 0; row < movable; ++row) all.bodies.push_back(rows_[row].bodies.front());
    rows_.erase(rows_.begin(), rows_.begin() + std::ptrdiff_t(movable));
    rows_.insert(rows_.begin(), std::move(all));
    moving_rows_ = rows_.size() - 1;
  }

  /// The least and the greatest momentum of a row. Blocks that walls push to the right give them
  /// what is less than the sum.
  void find_range(const System& system) {
    const bool is_shared = !rows_.empty() && rows_.front().bodies.size() > 1;
    const double most_of_row = is_shared ? momenta_.most_of_all : momenta_.most_of_one;
    const LineWalls walls = line_walls(system);
    const bool has_fixed =
        std::ranges::any_of(system.bodies, [](const Body& body) { return !body.mass; });
    least_ = -most_of_row;
    most_ = most_of_row;
    if (walls.left || has_fixed) least_ = std::min(least_, momenta_.sum - momenta_.most_of_all);
    if (walls.right || has_fixed) most_ = std::max(most_, momenta_.sum + momenta_.most_of_all);
  }

  const Rect& inside() const { return diagram_.inside(); }
  static double height_em(std::size_t rows) {
    return kEnergyRow_em + kMomentumRow_em * double(rows);
  }

  /// What has no room is left out: first the heading, then the row of the sum.
  void place_rows() {
    const double em = diagram_.text_px();
    const auto height_px = [&] {
      return height_em(moving_rows_ + (has_sum_ ? 1 : 0) + (has_heading_ ? 1 : 0)) * em;
    };
    if (height_px() > inside().height) has_heading_ = false;
    if (height_px() > inside().height) has_sum_ = false;
    if (height_px() > inside().height) {
      throw UsageError(
          "show.panels",
          fmt::format("the bars of the diagram 'conservation' need {:.0f} pixels, and there are "
                      "{:.0f}; leave something out, or make the frame higher",
                      height_px(), inside().height));
    }
    const double stretch = std::clamp(inside().height / height_px(), 1.0, kMostStretch);
    row_px_ = stretch * kMomentumRow_em * em;
    energy_px_ = stretch * kEnergyRow_em * em;
    top_ = inside().y + energy_px_;
    if (has_heading_) top_ += row_px_;
    if (!has_sum_) rows_.pop_back();
  }

  void place_columns(const DrawingContext& context) {
    const double em = diagram_.text_px();
    double label = std::max(context.font.width_em("energy"), context.font.width_em("sum"));
    for (const Row& row : rows_) label = std::max(label, context.font.width_em(row.name));
    const double figure =
        std::max(widths_.width_em(text_of(least_)), widths_.width_em(text_of(most_)));
    left_ = std::round(inside().x + (label + kBesideBars_em) * em);
    right_ = std::round(inside().right() - (figure + kBesideBars_em) * em);
    has_figures_ = right_ - left_ >= kLeastBars_em * em;
    if (!has_figures_) right_ = std::round(inside().right());
    if (right_ - left_ < em) {
      throw UsageError("show.panels",
                       "the diagram 'conservation' has no room for bars beside the bodies' names; "
                       "use shorter labels, or make the frame wider");
    }
  }

  double baseline(double top, double height) const {
    return top + height / 2 + kHalfFigure_em * diagram_.text_px();
  }
  double row_top(std::size_t row) const { return top_ + double(row) * row_px_; }
  double x_of(double value) const {
    const double share = (value - least_) / (most_ - least_);
    return left_ + share * (right_ - left_);
  }

  Rect bar_of(std::size_t row, double value) const {
    const double zero = x_of(0);
    const double end = x_of(value);
    const double height = std::round(kBarHeight * row_px_);
    return {std::min(zero, end), std::round(row_top(row) + (row_px_ - height) / 2),
            std::abs(end - zero), height};
  }
  /// It ends where the figures do.
  Rect energy_bar() const {
    const double height = std::round(kEnergyBarHeight * energy_px_);
    return {left_, std::round(diagram_.inside().y + (energy_px_ - height) / 2),
            std::round(inside().right()) - left_, height};
  }

  /// All that stays: names, the bar of energy in the first block's colour, which others cover,
  /// zero, the sum.
  void add_still() {
    const Palette& palette = diagram_.palette();
    const Rect bar = energy_bar();
    const double left = inside().x;
    diagram_.text("energy", {left, baseline(inside().y, energy_px_)}, 0, palette.muted);
    if (moves_) {
      diagram_.box(bar, colors_.front().fill);
    } else {
      diagram_.box(bar, std::nullopt, palette.muted);
    }
    if (has_heading_) {
      diagram_.text("momentum", {left, baseline(top_ - row_px_, row_px_)}, 0, palette.muted);
    }
    for (std::size_t row = 0; row < rows_.size(); ++row) {
      diagram_.text(rows_[row].name, {left, baseline(row_top(row), row_px_)}, 0, rows_[row].label);
    }
    const double zero = x_of(0);
    diagram_.line({{zero, top_}, {zero, row_top(rows_.size())}}, palette.muted);
    if (!has_sum_) return;
    const std::size_t sum = moving_rows_;
    diagram_.box(bar_of(sum, momenta_.sum), palette.muted);
    if (!has_figures_) return;
    diagram_.formula(diagram_.setter().digits(text_of(momenta_.sum)),
                     {inside().right(), baseline(row_top(sum), row_px_)}, 1, palette.muted);
  }

  /// Parts of the bar from the last block to the first, which has what is left.
  void add_energy(const std::vector<Motion>& bodies, std::vector<DrawItem>& items) const {
    const Rect bar = energy_bar();
    const double em = diagram_.text_px();
    const std::size_t count = bodies.size();
    std::vector<DrawItem> figures;
    double begin = 0;
    for (std::size_t i = count; i-- > 0;) {
      const double root = mpf_class(energy_factors_[i] * bodies[i].velocity[0]).get_d();
      const double end = i == 0 ? 1 : std::clamp(begin + root * root, begin, 1.0);
      const Rect part{bar.x + begin * bar.width, bar.y, end * bar.width - begin * bar.width,
                      bar.height};
      if (i > 0) {
        items.emplace_back(RectangleItem{diagram_.moving(count - 1 - i), part, colors_[i].fill});
      }
      // All figures add up to 100.
      const long tenths = std::lround(1000 * end) - std::lround(1000 * begin);
      const std::string text = fixed_text(double(tenths) / 10, 1) + " %";
      const double width_em = widths_.width_em(text) + kInBar_em;
      if ((width_em + kInBar_em) * em <= part.width) {
        // That of the last part is at its right end.
        const Point at{i == 0 ? part.right() - width_em * em : part.x + kInBar_em * em,
                       baseline(bar.y, bar.height)};
        figures.emplace_back(
            TextItem{diagram_.moving(2 * count - 2 - i), at, text, em, colors_[i].text, face_});
      }
      begin = end;
    }
    std::ranges::move(figures, std::back_inserter(items));
  }

  static std::string text_of(double value) { return fixed_text(value, kDecimals); }

  void add_figure(std::size_t row, double value, std::size_t n,
                  std::vector<DrawItem>& items) const {
    if (!has_figures_) return;
    std::string text = text_of(value);
    const double em = diagram_.text_px();
    const Point at{inside().right() - widths_.width_em(text) * em, baseline(row_top(row), row_px_)};
    items.emplace_back(
        TextItem{diagram_.moving(n), at, std::move(text), em, rows_[row].label, face_});
  }

  Diagram diagram_;
  std::vector<BlockColors> colors_;
  Momenta momenta_;
  std::vector<mpf_class> energy_factors_;  ///< from a velocity to the root of its share
  bool moves_ = false;
  Face face_;
  TextWidths widths_;
  std::vector<Row> rows_;
  double least_ = -1;  ///< of what bars show
  double most_ = 1;
  std::size_t moving_rows_ = 0;  ///< all but the sum, which may be left out
  bool has_heading_ = true;
  bool has_sum_ = true;
  bool has_figures_ = true;
  double top_ = 0;  ///< of the rows of momentum
  double row_px_ = 0;
  double energy_px_ = 0;
  // Of the bars.
  double left_ = 0;
  double right_ = 0;
};

}  // namespace

Drawable conservation_panel(const DrawingContext& context, const PanelPlace& place) {
  return {ConservationPanel(context, place)};
}

}  // namespace piblocks
