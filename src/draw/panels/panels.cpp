#include "draw/panels/panels.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>

#include "draw/extent.hpp"
#include "draw/number_text.hpp"

namespace piblocks {
namespace {

// In ems.
constexpr double kTitleHeight = 1.5;
constexpr double kTitleBaseline = 0.73;
constexpr double kLargeTitleBaseline = 1;
constexpr double kAround = 0.5;
constexpr double kTick = 0.25;
constexpr double kFigureBaseline = 1.4;
constexpr double kLeastGap = 0.6;  // between figures of time
constexpr double kSlack_px = 0.5;

}  // namespace

PairState blocks_state(const State& state, const TwoBlocks& blocks) {
  const auto motion = [&](std::size_t body) {
    const auto& [position, velocity] = state.bodies[body];
    return BlockMotion{blocks.side * position[0], blocks.side * velocity[0]};
  };
  return {state.count, motion(blocks.blue_id), motion(blocks.red_id)};
}

bool shows_a_turn(const DrawingContext& context) {
  if (context.pair() == nullptr) return false;
  const Span span = span_of(context.scene, context.log);
  const PairState first = context.two_blocks().blocks_at(span.from);
  const PairState last = context.two_blocks().blocks_at(span.to);
  return first.red.velocity < 0 && last.red.velocity > 0 && last.count - first.count >= 3;
}

Diagram::Diagram(const DrawingContext& context, const PanelPlace& place)
    : palette_(context.palette),
      title_at_{place.area.x, place.area.y + kTitleBaseline * context.sizes.text},
      title_room_px_(place.area.width),
      fonts_(&context.fonts),
      font_(&context.font),
      first_id_(place.first_id),
      panel_(place.panel),
      sizes_(context.sizes),
      text_px_(context.sizes.text) {
  const Rect& whole = place.area;
  const double top = kTitleHeight * text_px_;
  inside_ = {whole.x, whole.y + top, whole.width, whole.height - top};
  // Lines along its border are wider than the area.
  item_ = {nth(first_id_, 0), whole.grown(kAround * text_px_).whole_pixels(), nullptr};
}

Diagram::Diagram(const DrawingContext& context, const PanelPlace& place,
                 const std::vector<Formula>& titles)
    : Diagram(context, place) {
  formula(fitting(titles), title_at_, 0, palette_.text);
}

const Formula& Diagram::fitting(const std::vector<Formula>& titles) const {
  const auto width_px = [&](const Formula& title) { return title.width_em() * text_px_; };
  const auto title = std::ranges::find_if(
      titles, [&](const Formula& wording) { return width_px(wording) <= title_room_px_; });
  if (title != titles.end()) return *title;
  throw UsageError(
      "show.panels",
      fmt::format("the title of the diagram '{}' needs {:.0f} pixels, and there are {:.0f}; "
                  "leave out a diagram, or make the frame larger",
                  exact_text(panel_), width_px(titles.back()), title_room_px_));
}

std::vector<DrawItem> Diagram::title(std::size_t n, const std::vector<Formula>& titles,
                                     const Color& color, double size_px) const {
  const Formula& title = fitting(titles);
  std::vector<DrawItem> items;
  if (size_px > text_px_ && title.width_em() * size_px <= title_room_px_) {
    const double lower = (kLargeTitleBaseline - kTitleBaseline) * text_px_;
    title.add_to(items, moving(n), {title_at_.x, title_at_.y + lower}, size_px, color);
  } else {
    title.add_to(items, moving(n), title_at_, text_px_, color);
  }
  return items;
}

PhasedTitle::PhasedTitle(const Diagram& diagram, const Sentences& sentences, Integer before,
                         Integer last)
    : before_(diagram.title(kFirst, sentences.before, diagram.palette().text, diagram.text_px())),
      during_(diagram.title(kFirst, sentences.during, diagram.palette().text, diagram.text_px())),
      after_(
          diagram.title(kFirst, sentences.after, diagram.palette().accent, diagram.sizes().title)),
      first_count_(std::move(before)),
      last_count_(std::move(last)) {}

void PhasedTitle::add(const Integer& count, std::vector<DrawItem>& items) const {
  const std::vector<DrawItem>& title = count >= last_count_   ? after_
                                       : count > first_count_ ? during_
                                                              : before_;
  items.insert(items.end(), title.begin(), title.end());
}

void Diagram::check_range(const std::vector<DrawItem>& items) const {
  if (are_finite(items)) return;
  throw UsageError(
      "show.panels",
      fmt::format("the diagram '{}' needs numbers beyond the range of a double (about 1.8e308); "
                  "leave it out, or use less extreme positions, velocities and times",
                  exact_text(panel_)));
}

void Diagram::finish() {
  check_range(items_);
  item_.plate = std::make_shared<const Plate>(Plate{std::move(items_)});
  fonts_ = nullptr;
  font_ = nullptr;
}

PlateItem Diagram::plate(std::size_t n, std::vector<DrawItem> items) const {
  check_range(items);
  return {moving(n), item_.bounds, std::make_shared<const Plate>(Plate{std::move(items)})};
}

void Diagram::text(const std::string& text, const Point& at, double anchor, const Color& color) {
  const double width = font_->width_em(text) * text_px_;
  items_.emplace_back(
      TextItem{next_id(), {at.x - anchor * width, at.y}, text, text_px_, color, font_->face()});
}

void Diagram::formula(const Formula& formula, const Point& at, double anchor, const Color& color) {
  const double left = at.x - anchor * formula.width_em() * text_px_;
  formula.add_to(items_, next_id(), {left, at.y}, text_px_, color);
}

void Diagram::axis(const Point& from, const Point& to, std::span<const Figure> figures,
                   const std::string& name) {
  const double baseline = to.y + kFigureBaseline * text_px_;
  const double end = to.x - (font_->width_em(name) + kLeastGap) * text_px_;
  const auto is_before_name = [&](const Figure& figure) {
    return !figure.text.empty() && figure.x + figure.width_px / 2 <= end;
  };
  // One figure alone gives no scale.
  const bool is_named = std::ranges::count_if(figures, is_before_name) >= 2;
  line({from, to}, palette_.muted);
  for (const Figure& figure : figures) {
    line({{figure.x, to.y}, {figure.x, to.y + kTick * text_px_}}, palette_.muted);
    const bool is_written = is_named ? is_before_name(figure) : !figure.text.empty();
    if (is_written) text(figure.text, {figure.x, baseline}, 0.5, palette_.muted);
  }
  if (is_named) text(name, {to.x, baseline}, 1, palette_.muted);
}

TimeAxis::TimeAxis(const DrawingContext& context, const Diagram& diagram, double indent_em)
    : span_(span_of(context.scene, context.log)),
      from_(to_double(span_.from)),
      length_(to_double(span_.to - span_.from)),
      plot_(diagram.inside()) {
  if (span_.to <= span_.from) {
    throw UsageError(
        "show.panels",
        fmt::format("a diagram over time needs an end after the beginning, and the "
                    "scene goes from {} to {}; change time.from or time.to, or leave the diagram "
                    "out",
                    to_text(span_.from), to_text(span_.to)));
  }
  if (!(length_ > 0) || !std::isfinite(length_)) {
    throw UsageError("show.panels",
                     "the time that the scene shows is beyond the range of a double; leave out "
                     "diagrams over time, or change time.from and time.to");
  }
  const double em = diagram.text_px();
  const double inside_left = plot_.x;
  const double inside_right = plot_.right();
  plot_.height -= kBelowAxis_em * em;
  plot_.x += indent_em * em;
  plot_.width -= indent_em * em;
  // Figures are centred on their marks, and those at the ends need room beside the axis. Making
  // room moves the marks, each time by less.
  constexpr int kPasses = 4;
  for (int pass = 0; pass < kPasses; ++pass) {
    place_figures(context.font, em);
    if (figures_.empty()) return;
    const Diagram::Figure& first = figures_.front();
    const Diagram::Figure& last = figures_.back();
    const double left = std::max(0.0, inside_left - (first.x - first.width_px / 2));
    const double right = std::max(0.0, last.x + last.width_px / 2 - inside_right);
    plot_.x += left;
    plot_.width -= left + right;
  }
  place_figures(context.font, em);
  for (Diagram::Figure& figure : figures_) {
    const bool fits = figure.x - figure.width_px / 2 >= inside_left - kSlack_px &&
                      figure.x + figure.width_px / 2 <= inside_right + kSlack_px;
    if (!fits) figure.text.clear();
  }
}

void TimeAxis::place_figures(const Font& font, double em) {
  scale_ = plot_.width / length_;
  const FigureAxis axis{
      .low = from_, .high = from_ + length_, .em = em / scale_, .gap_em = kLeastGap};
  Ticks ticks = ticks_of(axis.low, axis.high, kBetweenTicks_em * axis.em);
  // One figure alone gives no scale.
  if (ticks.values.size() < 2) ticks = ticks_of(axis.low, axis.high, axis.em);
  ticks = with_room_for_figures(std::move(ticks), axis, font);
  figures_.clear();
  for (const double value : ticks.values) {
    std::string text = tick_text(value, ticks.step);
    const double width_px = font.width_em(text) * em;
    figures_.push_back({x_of(value), std::move(text), width_px});
  }
}

RectangleItem TimeAxis::cursor(const Diagram& diagram, std::size_t n, const Point& present) const {
  const double width = std::max(1.0, std::round(diagram.sizes().grid_line));
  const double top = std::round(present.y);
  return {
      diagram.moving(n),
      {std::round(present.x - width / 2), top, width, std::max(0.0, std::round(bottom()) - top)},
      diagram.palette().accent};
}

}  // namespace piblocks
