#include <fmt/format.h>
#include <fmt/ranges.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>

#include "core/text.hpp"
#include "draw/layout.hpp"
#include "draw/look.hpp"
#include "draw/overlays/loupe.hpp"
#include "draw/stage/stage.hpp"
#include "draw/text_lines.hpp"

namespace piblocks {
namespace {

// In ems.
constexpr double kLineStep = 1.25;  ///< from one line of a text to the next
constexpr double kBelowBaseline = 0.25;
constexpr double kPiStep = 2.0;  ///< from the count's baseline to the digits of pi

// In fractions of the frame's shorter side.
constexpr double kBelowHeader = 0.02;
constexpr double kBelowStage = 0.045;
constexpr double kLeastStage = 0.2;
constexpr double kLeastRowStage = 0.12;
/// In parts of its largest size: a smaller count has its label above it, and more room.
constexpr double kLeastBesideLabel = 0.6;
/// The counter's part of a row's width, at most.
constexpr double kMostCounter = 0.6;
constexpr double kRowCounter = 0.35;
/// Greatest height of a stage without overlays, where there is one diagram, and where there are
/// more.
constexpr double kStripStage = 0.2;
constexpr double kPlainStage = 0.24;
/// Part of the frame's longer side that discs have where there are diagrams.
constexpr double kPlaneStage = 0.56;
/// What the loupe adds to it in upright frames, and what each diagram has at least beside it.
constexpr double kLoupeRoom = 0.1;
constexpr double kDiagramsBesideLoupe = 0.5;

/// What a scene shows above and below the blocks, for a message.
std::vector<std::string> shown_element_names(const Scene& scene) {
  std::vector<std::string> names;
  if (scene.view.theme != Theme::article) names.emplace_back("the counter");
  if (!with_single_blanks(scene.show.title).empty()) names.emplace_back("the title");
  if (!with_single_blanks(scene.show.caption).empty()) names.emplace_back("the caption");
  if (!scene.show.logo.empty()) names.emplace_back("the logo");
  for (const Overlay overlay : {Overlay::time, Overlay::energy, Overlay::momentum}) {
    if (scene.show.has(overlay)) names.push_back(fmt::format("'{}'", exact_text(overlay)));
  }
  if (has_slow_motion(scene.pacing)) names.emplace_back("the slow motion's factor");
  if (!scene.show.panels.empty()) names.emplace_back("the diagrams");
  return names;
}

/// A title or a caption as it is set; empty if there is nothing to be seen.
/// @throws UsageError as check_readable()
std::string readable_line(const LayoutContext& context, const char* key, std::string_view line) {
  std::string text = with_single_blanks(line);
  if (!text.empty()) check_readable(context, key, text);
  return text;
}

/// Places things from the edges of the frame inwards. The stage gets what is left.
class FramePlanner {
 public:
  FramePlanner(const LayoutContext& context, const std::optional<CounterRoom>& counter)
      : context_(context),
        view_(context.scene.view),
        show_(context.scene.show),
        sizes_(context.sizes),
        title_(readable_line(context, "show.title", show_.title)),
        caption_(readable_line(context, "show.caption", show_.caption)),
        counter_(counter),
        left_(sizes_.margin),
        right_(view_.width_px - sizes_.margin),
        bottom_(view_.height_px) {}

  FramePlan run(double read_outs_height_px) {
    if (counter_ && view_.height_px < style::kRow * sizes_.short_side)
      return row(read_outs_height_px);
    place_axis_on(view_.width_px);
    place_header();
    place_foot();
    const bool has_edge = show_.panels.empty() && bottom_ == view_.height_px;
    // Read-outs end at the margin.
    if (read_outs_height_px > 0 && has_edge) {
      bottom_ -= std::max(0.0, sizes_.margin - kBelowBaseline * sizes_.text);
    }
    if (context_.is_plane() && !show_.panels.empty()) return beside(read_outs_height_px);
    double height = bottom_ - top_ - read_outs_height_px;
    if (!show_.panels.empty()) height = stage_height(height);
    if (height < kLeastStage * sizes_.short_side) throw_no_room();
    plan_.stage = {0, top_, double(view_.width_px), height};
    plan_.read_outs_top_px = top_ + height;
    if (!show_.panels.empty()) place_panels(plan_.read_outs_top_px + read_outs_height_px);
    return std::move(plan_);
  }

 private:
  /// Discs need height: diagrams are beside them, or below them in upright frames and below a view
  /// that is more than twice as wide as high.
  FramePlan beside(double read_outs_height_px) {
    const double bottom = bottom_ == view_.height_px ? bottom_ - sizes_.margin : bottom_;
    const double below = read_outs_height_px > 0 ? read_outs_height_px + sizes_.gap / 2 : 0;
    const double height = bottom - top_ - below;
    if (height < kLeastStage * sizes_.short_side) throw_no_room();
    Rect diagrams{left_, top_, right_ - left_, height};
    const bool is_flat = view_.x.high - view_.x.low > 2 * (view_.y.high - view_.y.low);
    if (view_.width_px >= view_.height_px && !is_flat) {
      const double stage = kPlaneStage * view_.width_px;
      plan_.stage = {0, top_, stage, height};
      diagrams.x = stage + sizes_.gap / 2;
      diagrams.width = right_ - diagrams.x;
      diagrams.y += sizes_.gap / 2;
      diagrams.height -= sizes_.gap / 2;
    } else {
      plan_.stage = {0, top_, double(view_.width_px), kPlaneStage * height};
      diagrams.y += plan_.stage.height;
      diagrams.height -= plan_.stage.height;
    }
    plan_.read_outs_top_px = bottom - read_outs_height_px;
    fill_panels(diagrams);
    return std::move(plan_);
  }

  /// A row of a split screen: the counter is beside the stage.
  FramePlan row(double read_outs_height_px) {
    if (view_.background == Background::transparent) {
      // Red would be seen behind the counter.
      throw UsageError("view.background",
                       "low rows of a split screen cannot be transparent; use columns, or an "
                       "opaque background");
    }
    // Of equal width where counts are short, so that rows have one scale.
    const double counter_width =
        std::max(set_count_size(kMostCounter * (right_ - left_)), kRowCounter * (right_ - left_));
    top_ = style::kRowMargin * sizes_.short_side;
    plan_.counter.slow_motion = {right_, top_ + Font::kCapHeight_em * sizes_.title};
    const double room = right_ - left_ - counter_width - sizes_.gap;
    const bool is_title_beside = context_.font.width_em(title_) * sizes_.title <= room;
    // Above the counter a long title has all the width, unless slow motion has its label there.
    if (!title_.empty()) place_row_title(counter_->slow_motion_px > 0 ? room : right_ - left_);
    place_row_counter(is_title_beside ? 0 : top_, counter_width);
    // Beside the stage the counter is as high as the row.
    plan_.header_bottom_px = view_.height_px;
    const double height =
        view_.height_px - style::kRowMargin * sizes_.short_side - top_ - read_outs_height_px;
    const bool is_full = !show_.panels.empty() || !caption_.empty() || !show_.logo.empty();
    if (is_full || height < kLeastRowStage * sizes_.short_side) throw_no_room();
    // The floor ends a margin before its area does.
    const double width = right_ - counter_width - 2 * sizes_.gap + sizes_.margin;
    plan_.stage = {0, top_, width, height};
    place_axis_on(width);
    plan_.read_outs_top_px = top_ + height;
    return std::move(plan_);
  }

  void place_row_title(double room_px) {
    // A second line would have no room.
    if (context_.font.width_em(title_) * sizes_.title > room_px) {
      throw_too_long("show.title", title_, room_px);
    }
    const double baseline = top_ + Font::kCapHeight_em * sizes_.title;
    add_line(ItemId::title, title_, baseline, sizes_.title);
    top_ = baseline + kBelowBaseline * sizes_.title;
  }

  /// In the middle of the row, or below a title. @param width_px  with the label
  void place_row_counter(double above_px, double width_px) {
    CounterPlace& place = plan_.counter;
    const double figures_px = Font::kCapHeight_em * place.size_px;
    const bool is_label_above = place.has_label && has_label_above_;
    const double label_px = is_label_above ? kPiStep * sizes_.text / 2 : 0;
    const double least = above_px + figures_px + 2 * label_px;
    place.right_px = right_;
    place.baseline_px = std::round(std::max(view_.height_px / 2.0 + figures_px / 4, least));
    place_pi();
    place.label_baseline_px = place.baseline_px;
    if (is_label_above) place.label_baseline_px -= figures_px + label_px;
    place.pi_row_left_px = right_ - std::max({width_px, counter_->pi_px, counter_->slow_motion_px});
  }

  void place_axis_on(double stage_width_px) {
    const bool has_axis = view_.theme != Theme::article && !context_.is_plane();
    if (has_axis) plan_.axis = place_axis(context_, stage_width_px);
  }

  void add_line(ItemId id, const std::string& text, double baseline, double size_px) {
    const Color color = id < ItemId::caption ? context_.palette.text : context_.palette.muted;
    plan_.lines.push_back(
        {id, {left_, std::round(baseline)}, text, size_px, color, context_.font.face()});
  }

  /// The title at the left. The counter at the right, on the same line if there is room.
  void place_header() {
    const double room = right_ - left_;
    const double title_width = context_.font.width_em(title_) * sizes_.title;
    double counter_width = 0;
    if (counter_) {
      counter_width = set_count_size(room);
      if (title_width > 0) counter_width += 2 * sizes_.gap;
    }
    const bool is_beside = title_width > 0 && title_width + counter_width <= room;
    if (!title_.empty() && !(counter_ && is_beside)) {
      double baseline = sizes_.margin + Font::kCapHeight_em * sizes_.title;
      std::size_t n = 0;
      for (const std::string& line :
           break_lines(context_.font, title_, {"show.title", sizes_.title, room})) {
        add_line(nth(ItemId::title, n++), line, baseline, sizes_.title);
        top_ = baseline + kBelowBaseline * sizes_.title;
        baseline += kLineStep * sizes_.title;
      }
    }
    if (counter_) place_counter(is_beside);
    if (top_ > 0) {
      top_ += kBelowHeader * sizes_.short_side;
    } else if (!show_.panels.empty()) {
      // Else the counter of the stage would stick to the upper edge.
      top_ = sizes_.margin / 2;
    }
  }

  /// @returns the width of label and count
  double set_count_size(double room_px) {
    CounterPlace& place = plan_.counter;
    const double largest = sizes_.type(style::kCounter);
    const double beside_label = (room_px - counter_->label_px) / counter_->count_em;
    has_label_above_ = beside_label < kLeastBesideLabel * largest;
    place.has_label = counter_->label_px <= room_px;
    place.size_px =
        std::min(largest, has_label_above_ ? room_px / counter_->count_em : beside_label);
    if (place.size_px < sizes_.type(style::kLeastType)) {
      throw UsageError(
          "view.theme",
          fmt::format("the digits of the count would be {:.1f} pixels high in {}x{}, which cannot "
                      "be read; use the theme 'article', fewer digits or a larger frame",
                      std::max(0.0, place.size_px), view_.width_px, view_.height_px));
    }
    place.room_px = counter_->count_em * place.size_px;
    return place.room_px + (has_label_above_ ? 0 : counter_->label_px);
  }

  void place_counter(bool is_beside_title) {
    CounterPlace& place = plan_.counter;
    place.right_px = right_;
    double above = top_ > 0 ? top_ + kBelowHeader * sizes_.short_side : sizes_.margin;
    if (place.has_label && has_label_above_) {
      place.label_baseline_px = std::round(above + Font::kCapHeight_em * sizes_.text);
      above += kLineStep * sizes_.text;
    }
    place.baseline_px = std::round(above + Font::kCapHeight_em * place.size_px);
    if (!has_label_above_) place.label_baseline_px = place.baseline_px;
    place_pi();
    if (is_beside_title) {
      add_line(ItemId::title, title_, place.baseline_px, sizes_.title);
    }
    // Digits of pi, and left of them the label of slow motion.
    double left = right_;
    if (place.has_pi) left -= counter_->pi_px + sizes_.gap;
    place.slow_motion = {left, place.pi_baseline_px};
    if (counter_->slow_motion_px > 0) left -= counter_->slow_motion_px + sizes_.gap;
    // Blocks that stay left of this line may be beside it.
    const bool is_above = left < right_ && reach_px(context_, plan_.axis) > left;
    top_ = is_above ? place.pi_baseline_px : place.baseline_px;
    top_ += kBelowBaseline * sizes_.text;
    place.pi_row_left_px = std::min(right_, left + sizes_.gap);
    plan_.header_bottom_px = top_;
    if (left < right_) {
      plan_.header_bottom_px = place.pi_baseline_px + kBelowBaseline * sizes_.text;
    }
  }

  /// The digits of pi are below the count, or nowhere in a frame of a few pixels.
  void place_pi() {
    CounterPlace& place = plan_.counter;
    place.pi_baseline_px = std::round(place.baseline_px + kPiStep * sizes_.text);
    place.has_pi = counter_->pi_px > 0 && place.pi_baseline_px + kBelowBaseline * sizes_.text <=
                                              view_.height_px - sizes_.margin;
  }

  /// Caption and logo are at the bottom; the stage ends above.
  void place_foot() {
    const double lower = view_.height_px - sizes_.margin;
    double height = 0;
    double room = right_ - left_;
    if (!show_.logo.empty()) {
      const double width = style::kLogoWidth * sizes_.short_side;
      height = style::kLogoHeight * sizes_.short_side;
      plan_.logo = {right_ - width, lower - height, width, height};
      room -= width + sizes_.gap;
    }
    if (!caption_.empty()) {
      const double size_px = sizes_.text;
      const auto lines = break_lines(context_.font, caption_, {"show.caption", size_px, room});
      const double below = double(lines.size() - 1) * kLineStep * size_px;
      height = std::max(height, below + Font::kCapHeight_em * size_px);
      double baseline = lower - below;
      std::size_t n = 0;
      for (const std::string& line : lines) {
        add_line(nth(ItemId::caption, n++), line, baseline, size_px);
        baseline += kLineStep * size_px;
      }
    }
    if (height > 0) bottom_ = lower - height - kBelowStage * sizes_.short_side;
  }

  /// Where there are diagrams, the stage is as high as it has to be.
  /// @param room_px  for both
  double stage_height(double room_px) {
    const bool has_arrows = show_.has(Overlay::velocities);
    double height = show_.panels.size() == 1 && !has_arrows ? kStripStage : kPlainStage;
    if (has_arrows) height += kArrowRoom;
    if (has_masses(context_.scene)) height += kMassRoom / 2;
    if (show_.has(Overlay::ruler)) height += kRulerRoom;
    height *= sizes_.short_side;
    if (view_.theme == Theme::article) {
      // With this the stage is as wide as the frame.
      height +=
          view_.width_px * to_double((view_.y.high - view_.y.low) / (view_.x.high - view_.x.low));
      return std::min(height, room_px / 2);
    }
    // In upright frames the loupe is below the digits of pi. It takes what diagrams do not need.
    const double spare =
        room_px - height - kDiagramsBesideLoupe * double(show_.panels.size()) * sizes_.short_side;
    if (view_.height_px > view_.width_px && spare > 0 && may_show_loupe(context_, plan_.axis)) {
      height += std::min(kLoupeRoom * sizes_.short_side, spare);
      plan_.is_floor_at_bottom = true;
    }
    return std::min(height, room_px / 2);
  }

  /// Diagrams are below the stage and its read-outs.
  void place_panels(double top_px) {
    const double top = top_px + kBelowStage * sizes_.short_side;
    const double bottom = bottom_ == view_.height_px ? bottom_ - sizes_.margin : bottom_;
    fill_panels({left_, top, right_ - left_, bottom - top});
  }

  void fill_panels(const Rect& area) {
    const double least = kLeastPanel_em * sizes_.text;
    plan_.panels = panel_grid(show_.panels.size(), area, sizes_.gap, sizes_.text);
    const Rect& panel = plan_.panels.front();
    if (std::min(panel.width, panel.height) >= least) return;
    const std::size_t count = show_.panels.size();
    throw UsageError(
        "show.panels",
        fmt::format(
            "{} into {}x{}; {}make the frame larger",
            count == 1 ? "a diagram does not fit" : fmt::format("{} diagrams do not fit", count),
            view_.width_px, view_.height_px, count == 1 ? "" : "leave some out, or "));
  }

  [[noreturn]] void throw_no_room() const {
    const std::vector<std::string> names = shown_element_names(context_.scene);
    throw UsageError(
        "show",
        fmt::format(
            "{} {} too little room for the blocks in {}x{}; leave something out, or make the "
            "frame higher",
            fmt::join(names, ", "), names.size() == 1 ? "leaves" : "leave", view_.width_px,
            view_.height_px));
  }

  const LayoutContext& context_;
  const View& view_;
  const Show& show_;
  const Sizes& sizes_;
  std::string title_;
  std::string caption_;
  const std::optional<CounterRoom>& counter_;
  double left_;
  double right_;
  double top_ = 0;  ///< the stage begins below
  double bottom_;   ///< and ends above
  bool has_label_above_ = false;
  FramePlan plan_;
};

}  // namespace

FramePlan plan_frame(const LayoutContext& context, const std::optional<CounterRoom>& counter,
                     double read_outs_height_px) {
  return FramePlanner(context, counter).run(read_outs_height_px);
}

}  // namespace piblocks
