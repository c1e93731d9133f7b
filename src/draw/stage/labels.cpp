#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "draw/number_text.hpp"
#include "draw/stage/stage.hpp"
#include "draw/text_lines.hpp"

namespace piblocks {
namespace {

/// A label takes at most this part of its block's width.
constexpr double kMostOfBlock = 0.9;
/// Of the least block that a label is written on, in ems. A unit has a letter below the line.
constexpr double kHeight_em = 1;
constexpr double kHeightWithUnit_em = 1.2;
/// The same of discs, in parts of the diameter and of the radius.
constexpr double kMostOfDisc = 0.86;
/// Between a block and the label above it, in fractions of the frame's shorter side.
constexpr double kBelowLabel = 0.016;
/// Between the floor and a label below it.
constexpr double kBelowFloor = 0.022;
/// And between a label above its block and what is above that.
constexpr double kAboveLabel = 0.006;

/// What a body's label says; empty if it has none.
struct LabelText {
  std::string text;
  bool is_mass = false;
};

LabelText text_of(const LayoutContext& context, std::size_t body) {
  const std::string& label = context.scene.styles[body].label;
  if (!label.empty()) return {label, false};
  const auto& mass = context.scene.system.bodies[body].mass;
  if (!mass || !has_masses(context.scene)) return {};
  return {short_text(*mass), true};
}

/// What is written on the blocks of a line, and where that fits.
class BlockTexts {
 public:
  BlockTexts(const LayoutContext& context, const Layout& layout)
      : font_(context.font),
        layout_(layout),
        size_px_(context.sizes.mass),
        most_px_(text_columns_between_walls({context, layout}).width()) {
    const std::vector<Body>& bodies = context.scene.system.bodies;
    for (std::size_t i = 0; i < bodies.size(); ++i) texts_.push_back(text_of(context, i));
    find_peaks(context);
    add_units();
    if (!context.scene.show.overlays) leave_out_masses_without_place();
  }

  const std::string& text(std::size_t body) const { return texts_[body].text; }
  bool is_mass(std::size_t body) const { return texts_[body].is_mass; }
  bool fits(std::size_t body) const { return fits(text(body), body); }
  /// On the block; or above it, if it is heavier than its neighbours and none of them would run
  /// into the label.
  bool has_place(std::size_t body) const { return has_place(text(body), body); }
  /// Below the floor, if it has a label without a place on the block or above it.
  bool is_below(std::size_t body) const { return !text(body).empty() && !has_place(body); }

 private:
  bool has_place(const std::string& text, std::size_t body) const {
    return fits(text, body) || (is_peak_[body] && font_.width_em(text) * size_px_ <= most_px_);
  }
  bool fits(const std::string& text, std::size_t body) const {
    const bool has_unit = texts_[body].is_mass && text.ends_with('g');
    return font_.width_em(text) * size_px_ <= kMostOfBlock * layout_.width_px(body) &&
           (has_unit ? kHeightWithUnit_em : kHeight_em) * size_px_ <= layout_.height_px(body);
  }

  void find_peaks(const LayoutContext& context) {
    const std::vector<Body>& bodies = context.scene.system.bodies;
    const std::vector<std::size_t> order = from_left_to_right(context.scene.system);
    is_peak_.assign(bodies.size(), true);
    // What no collision moves is the heaviest; of equal ones it is the later one.
    const auto is_heavier = [&](std::size_t a, std::size_t b) {
      if (bodies[a].mass == bodies[b].mass) return a > b;
      return !bodies[a].mass || (bodies[b].mass && *bodies[a].mass > *bodies[b].mass);
    };
    for (std::size_t i = 1; i < order.size(); ++i) {
      const bool is_left_heavier = is_heavier(order[i - 1], order[i]);
      const std::size_t heavy = is_left_heavier ? order[i - 1] : order[i];
      const std::size_t light = is_left_heavier ? order[i] : order[i - 1];
      is_peak_[light] = false;
      if (layout_.height_px(heavy) < layout_.height_px(light)) is_peak_[heavy] = false;
    }
  }

  /// All masses have a unit, unless only numbers have room.
  void add_units() {
    std::vector<LabelText> full = texts_;
    for (std::size_t i = 0; i < full.size(); ++i) {
      if (!full[i].is_mass) continue;
      full[i].text += " kg";
      if (!has_place(full[i].text, i) && has_place(i)) return;
    }
    texts_ = std::move(full);
  }

  void leave_out_masses_without_place() {
    for (std::size_t i = 0; i < texts_.size(); ++i) {
      if (!texts_[i].is_mass || has_place(i)) continue;
      for (LabelText& label : texts_) label = label.is_mass ? LabelText() : label;
      return;
    }
  }

  const Font& font_;
  const Layout& layout_;
  double size_px_;
  double most_px_;  ///< of a text above its block
  std::vector<LabelText> texts_;
  std::vector<bool> is_peak_;
};

/// A block's label, whose middle is in column 0.
struct Label {
  std::size_t body = 0;
  TextItem text;
  bool is_inside = true;  ///< on the block, else above it
  Color beside;           ///< its colour when it is not on the block

  double half_px() const { return -text.origin.x; }
};

/// Where labels can be while their blocks are in sight. No label is cut: half a number would be
/// another number.
class LabelRoom {
 public:
  explicit LabelRoom(const DrawingContext& context)
      : layout_(context.layout),
        columns_(text_columns(context)),
        between_walls_(text_columns_between_walls(context)),
        pad_(kBelowLabel * context.sizes.short_side),
        frame_px_(context.layout.scale / to_double(context.scene.view.frame_rate)) {}

  void add(Label label, const FrameState& shown, std::vector<DrawItem>& items) const {
    const Rect block = layout_.at(label.body, shown);
    if (block.right() <= 0 || block.x >= layout_.visible_right_px) return;
    const double half = label.half_px();
    const Columns& columns = label.is_inside ? columns_ : between_walls_;
    double middle = block.x + block.width / 2;
    const double pad = std::min(pad_, std::max(0.0, block.width / 2 - half - kRounded_px));
    if (!label.is_inside) {
      middle = std::clamp(middle, columns.left + half,
                          std::max(columns.left + half, columns.right - half));
    } else {
      const double least = std::max(columns.left, block.x + pad) + half;
      const double most = std::min(columns.right, block.right() - pad) - half;
      middle = least <= most ? std::clamp(middle, least, most) : leave(label, block, shown);
    }
    // A label moves by whole pixels, so that its figures keep their distances and encoders find it
    // again. A fast one moves by two, because colours have half as many samples.
    const double px_per_frame = shown.state.bodies[label.body].velocity[0] * shown.pace * frame_px_;
    const int step = std::fabs(px_per_frame) < 1 ? 1 : 2;
    double& x = label.text.origin.x;
    x = std::min(std::max(step * std::round((x + middle) / step), std::ceil(columns.left)),
                 std::floor(columns.right - 2 * half));
    items.emplace_back(std::move(label.text));
  }

 private:
  /// Moves the label of a block of which too little is seen beside the block, or above it if
  /// another block is in the way. @returns the middle of the label
  double leave(Label& label, const Rect& block, const FrameState& shown) const {
    const double half = label.half_px();
    label.text.color = label.beside;
    const bool goes_right = block.right() > columns_.right;
    const double middle = goes_right ? std::min(block.x - pad_, columns_.right) - half
                                     : std::max(block.right() + pad_, columns_.left) + half;
    bool is_free = true;
    for (std::size_t i = 0; i < layout_.shapes.size() && is_free; ++i) {
      const Rect other = layout_.at(i, shown);
      is_free = i == label.body || other.right() <= middle - half - pad_ ||
                other.x >= middle + half + pad_;
    }
    if (is_free) return middle;
    label.text.origin.y = block.y - pad_;
    return std::clamp(block.x + block.width / 2, columns_.left + half,
                      std::max(columns_.left + half, columns_.right - half));
  }

  Layout layout_;
  // Where labels stay: those on their blocks, or beside blocks that leave; and all others.
  Columns columns_;
  Columns between_walls_;
  double pad_;
  double frame_px_;  ///< way in a frame at a velocity of 1 and the pace of 1
};

/// The blocks whose labels do not fit on them.
std::vector<std::size_t> labelled_beside(const LayoutContext& context, const Layout& layout,
                                         bool is_below) {
  if (!has_labels(context) || context.is_plane()) return {};
  const BlockTexts texts(context, layout);
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < layout.shapes.size(); ++i) {
    const bool is_beside = !texts.text(i).empty() && !texts.fits(i);
    if (is_beside && texts.is_below(i) == is_below) found.push_back(i);
  }
  return found;
}

std::string label_key(const DrawingContext& context, std::size_t body) {
  return body_key(context.scene.system, body) + ".label";
}

[[noreturn]] void throw_no_room(const DrawingContext& context, const BlockTexts& texts,
                                std::size_t body) {
  const Layout& layout = context.layout;
  const std::string& text = texts.text(body);
  const std::string place = fmt::format("its block of {:.0f}x{:.0f} pixels", layout.width_px(body),
                                        layout.height_px(body));
  if (texts.is_mass(body)) {
    throw UsageError(
        "show.overlays",
        fmt::format("the mass '{}' does not fit on {}; leave out 'masses', make the block or "
                    "the frame larger, or show less of the x axis",
                    text, place),
        exact_text(Overlay::masses));
  }
  throw UsageError(
      label_key(context, body),
      fmt::format("'{}' does not fit on {}; use a shorter one, make the block or the frame larger, "
                  "or show less of the x axis",
                  text, place));
}

void check_room(const DrawingContext& context, const BlockTexts& texts, std::size_t body) {
  if (texts.fits(body)) return;
  if (texts.is_below(body)) {
    // Below two blocks that meet, labels might meet too; and a scale may be there.
    const bool is_alone = labelled_below(context, context.layout).size() == 1;
    const bool is_wide = context.font.width_em(texts.text(body)) * context.sizes.mass >
                         text_columns_between_walls(context).width();
    const bool has_room =
        context.layout.below_px + kRounded_px >= label_room_below_px(context.sizes);
    if (is_alone && !is_wide && has_room && !context.scene.show.has(Overlay::ruler)) return;
    throw_no_room(context, texts, body);
  }
  const double needed = label_room_px(context.sizes);
  if (context.layout.above_px + kRounded_px >= needed) return;
  throw UsageError(
      texts.is_mass(body) ? "show.overlays" : label_key(context, body),
      fmt::format("the {} '{}' needs {:.0f} pixels above its block, and there are {:.0f}; leave "
                  "out {}, or make the block wider or the frame higher",
                  texts.is_mass(body) ? "mass" : "label", texts.text(body), needed,
                  std::max(0.0, context.layout.above_px),
                  texts.is_mass(body) ? "'masses'" : "the label"),
      texts.is_mass(body) ? exact_text(Overlay::masses) : "");
}

/// @param baseline  from where the body's place is measured: the frame's top, or a disc's centre
Label label_at(const DrawingContext& context, ItemId id, std::size_t body, const std::string& text,
               bool is_inside, double baseline) {
  const BlockColors& colors = context.colors[body];
  const double size_px = context.sizes.mass;
  return {body,
          {id,
           {-context.font.width_em(text) * size_px / 2, baseline},
           text,
           size_px,
           is_inside ? colors.text : colors.label,
           context.font.face()},
          is_inside,
          colors.label};
}

Label label_of(const DrawingContext& context, const BlockTexts& texts, std::size_t body) {
  if (!texts.is_mass(body)) check_readable(context, "body.label", texts.text(body));
  check_room(context, texts, body);
  const Layout& layout = context.layout;
  const double height = layout.height_px(body);
  const bool is_inside = texts.fits(body);
  const Sizes& sizes = context.sizes;
  double baseline = layout.floor_px - height / 2 + kHalfFigure_em * sizes.mass;
  if (!is_inside) baseline = layout.floor_px - height - kBelowLabel * sizes.short_side;
  if (texts.is_below(body)) {
    baseline = layout.floor_px + kBelowFloor * sizes.short_side + Font::kCapHeight_em * sizes.mass;
  }
  const ItemId id = nth(ItemId::masses, layout.shapes.size() - 1 - body);
  return label_at(context, id, body, texts.text(body), is_inside, baseline);
}

Drawable labels_of_line(const DrawingContext& context) {
  const BlockTexts texts(context, context.layout);
  std::vector<Label> labels;
  for (std::size_t i = context.layout.shapes.size(); i-- > 0;) {
    if (!texts.text(i).empty()) labels.push_back(label_of(context, texts, i));
  }
  return {[labels = std::move(labels), room = LabelRoom(context)](const FrameState& shown,
                                                                  std::vector<DrawItem>& items) {
    for (const Label& label : labels) room.add(label, shown, items);
  }};
}

/// The label on a disc, its origin as seen from the centre; above it if it has no room there.
Label label_of_disc(const DrawingContext& context, std::size_t body, const LabelText& label) {
  const std::string& text = label.text;
  if (!label.is_mass) check_readable(context, "body.label", text);
  const double size_px = context.sizes.mass;
  const double radius = context.layout.width_px(body) / 2;
  const double width = context.font.width_em(text) * size_px;
  const bool is_inside = width <= 2 * kMostOfDisc * radius && size_px <= kMostOfDisc * radius;
  const double baseline =
      is_inside ? kHalfFigure_em * size_px : -radius - kBelowLabel * context.sizes.short_side;
  return label_at(context, nth(ItemId::masses, body), body, text, is_inside, baseline);
}

Drawable labels_of_plane(const DrawingContext& context) {
  std::vector<Label> labels;
  for (std::size_t i = 0; i < context.layout.shapes.size(); ++i) {
    const LabelText label = text_of(context, i);
    if (!label.text.empty()) labels.push_back(label_of_disc(context, i, label));
  }
  const bool has_arrows = context.scene.show.has(Overlay::velocities);
  return {[labels = std::move(labels), layout = context.layout, has_arrows](
              const FrameState& shown, std::vector<DrawItem>& items) {
    for (const Label& label : labels) {
      const auto& [position, velocity] = shown.state.bodies[label.body];
      const Point centre = layout.at(position);
      TextItem text = label.text;
      // Below the disc if an arrow is above it.
      if (!label.is_inside && has_arrows && velocity[1] > 0) {
        text.origin.y = Font::kCapHeight_em * text.size_px - text.origin.y;
      }
      text.origin = centre + text.origin;
      text.origin = {std::round(text.origin.x), std::round(text.origin.y)};
      items.emplace_back(std::move(text));
    }
  }};
}

}  // namespace

double label_room_px(const Sizes& sizes) {
  return std::max(kMassRoom * sizes.short_side, (kBelowLabel + kAboveLabel) * sizes.short_side +
                                                    Font::kCapHeight_em * sizes.mass);
}

bool has_masses(const Scene& scene) {
  const std::vector<Overlay> shown = overlays_of(scene);
  return std::ranges::count(shown, Overlay::masses) > 0;
}

double label_room_below_px(const Sizes& sizes) {
  constexpr double kDescent_em = 0.22;
  return kBelowFloor * sizes.short_side + (Font::kCapHeight_em + kDescent_em) * sizes.mass;
}

bool has_labels(const LayoutContext& context) {
  return has_masses(context.scene) ||
         std::ranges::any_of(context.scene.styles,
                             [](const BodyStyle& style) { return !style.label.empty(); });
}

std::vector<std::size_t> labelled_above(const LayoutContext& context, const Layout& layout) {
  return labelled_beside(context, layout, false);
}

std::vector<std::size_t> labelled_below(const LayoutContext& context, const Layout& layout) {
  return labelled_beside(context, layout, true);
}

std::vector<std::size_t> from_left_to_right(const System& line) {
  std::vector<std::size_t> order(line.bodies.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t i) { return line.bodies[i].position[0]; });
  return order;
}

Drawable body_labels(const DrawingContext& context) {
  return context.is_plane() ? labels_of_plane(context) : labels_of_line(context);
}

}  // namespace piblocks
