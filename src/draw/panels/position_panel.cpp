#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <numbers>

#include "draw/panels/corner_path.hpp"
#include "draw/panels/panels.hpp"
#include "draw/panels/trajectory.hpp"

namespace piblocks {
namespace {

/// A wedge angle nearer to 0 or to a right angle could not be seen: another one is drawn.
constexpr double kLeastAngle = 0.2;
/// Path that would be nearer to itself than this, in widths of its line, is filled.
constexpr double kLeastApart = 1.8;
/// Past this there is no more to be seen where the path goes into the corner itself.
constexpr double kLeastShare = 1e-3;

// In ems.
constexpr double kNamesBelow_em = 1.5;
constexpr double kNameBaseline_em = 1.25;
constexpr double kFirstRow_em = 0.8;
constexpr double kSecondRow_em = 2.2;
constexpr double kBesideAxis_em = 0.4;
constexpr double kBesideContact_em = 0.5;
constexpr double kNameDepth_em = 0.25;
constexpr double kBetweenNames_em = 1;
constexpr double kLongestZoom_em = 4.6;
/// Of the room beside the wedge, how much is left of it.
constexpr double kLeftShare = 0.25;
/// Places of the name along the line of contact, in parts of the wedge; the first that fits.
constexpr std::array kContactPlaces{0.78, 0.7, 0.86, 0.62, 0.54};

std::vector<Formula> titles_of_positions(const DrawingContext& context) {
  const FormulaSetter set = context.setter();
  if (!shows_a_turn(context)) {
    return set.texts({"Both distances in their wedge", "Both distances", "Positions"});
  }
  return set.texts({"The distances zigzag into the corner and out",
                    "A zigzag into the corner and out", "A zigzag in a wedge", "Positions"});
}

/// The path of both gaps runs back and forth between two lines: on one blue meets the wall, on the
/// other it meets red. As red comes near, the picture is enlarged about the corner of the lines.
/// The wedge looks the same at every magnification.
class PositionPanel {
 public:
  PositionPanel(const DrawingContext& context, const PanelPlace& place)
      : diagram_(context, place, titles_of_positions(context)),
        path_(context.two_blocks(), span_of(context.scene, context.log),
              std::max(1, static_cast<int>(diagram_.inside().width))),
        most_(path_.greatest_y2() > 0 ? path_.greatest_y2() : 1),
        least_share_(path_.least_y2() > 0 ? path_.least_y2() / most_ : kLeastShare),
        zoom_(least_share_, context.setter()) {
    const GapWedge wedge(context.two_blocks().blocks());
    is_true_ = std::min(wedge.theta, std::numbers::pi / 2 - wedge.theta) >= kLeastAngle;
    place_wedge(is_true_ ? wedge.sine / wedge.cosine : 0);
    add_wedge();
    add_names();
    const double most = zoom_.factor_for(least_share_);
    for (std::size_t exponent = 0;
         exponent <= zoom_.most_exponent() && zoom_.power(exponent) <= most; ++exponent) {
      plateaus_.push_back(diagram_.plate(0, items_at(zoom_.power(exponent))));
    }
    diagram_.finish();
  }

  void operator()(const FrameState& shown, std::vector<DrawItem>& items) const {
    items.emplace_back(diagram_.item());
    const Gaps& gaps = shown.gaps;
    const double share = std::max(gaps.y2 / most_, least_share_);
    const double zoom = zoom_.factor_for(share);
    if (const auto exponent = zoom_.exponent_of(zoom); exponent && *exponent < plateaus_.size()) {
      items.emplace_back(plateaus_[*exponent]);
    } else {
      std::ranges::move(items_at(zoom), std::back_inserter(items));
    }
    if (gaps.y2 > most_ * (1 + 1e-9)) return;
    items.emplace_back(diagram_.present_dot(kDot, at(gaps, zoom)));
  }

 private:
  // The first of the things that move, by kind.
  static constexpr std::size_t kLines = 1;
  static constexpr std::size_t kZoomLabel = 16384;
  static constexpr std::size_t kDot = kZoomLabel + 64;
  static constexpr std::size_t kPiece = 6;  ///< segments of a line that are one item

  Point at(const Gaps& gaps, double zoom) const {
    return {corner_.x + gaps.y2 * zoom / most_ * width_,
            corner_.y - gaps.y1 * zoom / most_ * height_};
  }

  /// @param slope  of the line of contact; 0 if any will do
  void place_wedge(double slope) {
    const Rect& inside = diagram_.inside();
    const double room = inside.height - kNamesBelow_em * diagram_.text_px();
    width_ = inside.width;
    height_ = slope > 0 ? slope * width_ : std::min(width_, room);
    if (height_ > room) {
      width_ *= room / height_;
      height_ = room;
    }
    corner_ = {inside.x + (inside.width - width_) * kLeftShare, inside.y + room};
  }

  void add_wedge() {
    const Palette& palette = diagram_.palette();
    const Point far{corner_.x + width_, corner_.y - height_};
    const double line = diagram_.data_width();
    diagram_.line({corner_, {corner_.x, far.y}}, palette.grid);
    diagram_.line({corner_, {far.x, corner_.y}}, palette.blue.line, line);
    diagram_.line({corner_, far}, palette.red.line, line);
  }

  /// sqrt(m) x where the wedge is drawn as it is, else x.
  Formula axis_name(const char* index) const {
    const FormulaSetter set = diagram_.setter();
    Formula position = set.lowered(set.italic("x"), set.text(index));
    if (!is_true_) return position;
    return set.root(set.lowered(set.italic("m"), set.text(index))) + position;
  }

  void add_names() {
    const Palette& palette = diagram_.palette();
    const double em = diagram_.text_px();
    const double top = corner_.y - height_;
    const Formula upwards = axis_name("1");
    const double left = corner_.x + kBesideAxis_em * em;
    diagram_.formula(upwards, {left, top + kFirstRow_em * em}, 0, palette.blue.label);
    add_contact_name(left +
                     (std::max(upwards.width_em(), kLongestZoom_em) + kBetweenNames_em) * em);
    add_names_below();
  }

  /// Beside the line of contact: left of it, or right of its end.
  /// @param clear  left of this are the axis' name and the magnification
  void add_contact_name(double clear) {
    const Palette& palette = diagram_.palette();
    const double em = diagram_.text_px();
    const std::string text = fmt::format("{} meets {}", palette.blue.name, palette.red.name);
    const double width = diagram_.setter().text(text).width_em() * em;
    const double beside = kBesideContact_em * em;
    for (const double place : kContactPlaces) {
      const double height = place * height_ - kNameDepth_em * em;
      const double right = corner_.x + height / height_ * width_ - beside;
      const double y = corner_.y - place * height_;
      if (right - width < clear || y - em < corner_.y - height_) continue;
      diagram_.text(text, {right, y}, 1, palette.red.label);
      return;
    }
    const Rect& inside = diagram_.inside();
    const double left = corner_.x + width_ + beside;
    if (left + width > inside.right()) return;
    diagram_.text(text, {left, corner_.y - height_ + kFirstRow_em * em}, 0, palette.red.label);
  }

  /// The line of the wall at the left, the axis at the right, what else is true between them.
  void add_names_below() {
    const Palette& palette = diagram_.palette();
    const FormulaSetter set = diagram_.setter();
    const double em = diagram_.text_px();
    const double y = corner_.y + kNameBaseline_em * em;
    const double gap = kBetweenNames_em * em;
    const Formula across = axis_name("2");
    diagram_.formula(across, {corner_.x + width_, y}, 1, palette.red.label);
    double left = diagram_.inside().x;
    double room = corner_.x + width_ - across.width_em() * em - gap - left;
    for (const std::string& wall :
         {fmt::format("{} meets the wall", palette.blue.name), std::string("wall")}) {
      const double width = set.text(wall).width_em() * em;
      if (width > room) continue;
      const double begin = std::min(corner_.x, left + room - width);
      diagram_.text(wall, {begin, y}, 0, palette.blue.label);
      room -= begin + width + gap - left;
      left = begin + width + gap;
      break;
    }
    const std::string note = "not to scale";
    if (is_true_ || set.text(note).width_em() * em > room) return;
    diagram_.text(note, {left + room / 2, y}, 0.5, palette.muted);
  }

  std::vector<DrawItem> items_at(double zoom) const {
    const Palette& palette = diagram_.palette();
    const double window = most_ / zoom;
    const double line_px = diagram_.sizes().data_line;
    const ShownPath path =
        path_.shown({.to = window, .least_apart = kLeastApart * line_px / width_ * window});
    std::vector<DrawItem> items;
    if (path.filled_high > path.filled_low) {
      const auto& [lines, low, high] = path;
      items.emplace_back(diagram_.moving_shape(
          0,
          {at({0, low}, zoom), at({0, high}, zoom), at({high, high}, zoom), at({low, low}, zoom)},
          palette.text));
    }
    // Each area of the picture is painted by itself, and only with pieces that reach into it.
    std::size_t n = kLines;
    for (const std::vector<Gaps>& line : path.lines) {
      for (std::size_t first = 0; first + 1 < line.size(); first += kPiece) {
        std::vector<Point> points;
        for (std::size_t i = first; i < std::min(first + kPiece + 1, line.size()); ++i) {
          points.push_back(at(line[i], zoom));
        }
        items.emplace_back(
            diagram_.moving_line(n++, std::move(points), palette.text, diagram_.data_width()));
      }
    }
    if (zoom == 1) return items;
    const double em = diagram_.text_px();
    zoom_.text(zoom).add_to(
        items, diagram_.moving(kZoomLabel),
        {corner_.x + kBesideAxis_em * em, corner_.y - height_ + kSecondRow_em * em}, em,
        palette.text);
    return items;
  }

  Diagram diagram_;
  CornerPath path_;
  double most_;         ///< of red's gap
  double least_share_;  ///< least of red's gap, in parts of it
  CornerZoom zoom_;
  bool is_true_ = false;
  Point corner_;
  // Of the wedge.
  double width_ = 1;
  double height_ = 1;
  std::vector<PlateItem> plateaus_;  ///< by power of ten: what stays while the zoom does
};

}  // namespace

Drawable position_panel(const DrawingContext& context, const PanelPlace& place) {
  return {PositionPanel(context, place), {.gaps = true}};
}

}  // namespace piblocks
