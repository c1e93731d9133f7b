#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/two_blocks.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/smooth_step.hpp"
#include "draw/number_text.hpp"
#include "draw/overlays/overlays.hpp"
#include "scene/counted_pi.hpp"
#include "scene/schedule.hpp"

namespace piblocks {
namespace {

constexpr std::string_view kCountLabel = "collisions";
constexpr std::string_view kOverLabel = "no more collisions";
constexpr std::string_view kPiLabel = "π = ";
/// Digits of pi that are shown beyond those that the film counts, at most.
constexpr std::size_t kMoreDigits = 4;
/// Between label and count, in ems of the label.
constexpr double kLabelGap_em = 0.5;
/// A hit makes the count larger, as long as hits are few. It shrinks back in this time of video.
constexpr double kPulse = 0.06;
constexpr double kPulse_s = 0.12;
/// Sums of the same advances in different order differ by less.
constexpr double kNegligible_px = 0.01;

std::size_t digits_in(std::string_view text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](char c) { return c != ',' && c != '.'; }));
}

/// Length of the beginning of a number that has so many digits.
std::size_t length_with(std::size_t digits, std::string_view text) {
  std::size_t length = 0;
  while (digits > 0 && length < text.size()) {
    if (text[length] != '.') --digits;
    ++length;
  }
  return length;
}

/// The digits of pi with those that follow, as far as there is room; empty if there is none.
std::string pi_line(const LayoutContext& context, std::size_t counted) {
  const Sizes& sizes = context.sizes;
  const double room_px = context.scene.view.width_px - 2 * sizes.margin;
  for (std::size_t more = kMoreDigits;; --more) {
    std::string digits = pi_digits(context.scene.show.base, counted + more);
    const std::string line = std::string(kPiLabel) + digits + "…";
    if (context.font.width_em(line) * sizes.text <= room_px) return digits;
    if (more == 0) return {};
  }
}

/// The last collision of the run; nothing if the film does not come that far.
std::optional<Integer> last_shown(const Scene& scene, const Log& log) {
  if (log.knows_last()) return log.last();
  if (!has_span(scene, log)) return std::nullopt;
  Integer last = log.count_at(span_of(scene, log).to);
  return log.has(last + 1) ? std::nullopt : std::optional(std::move(last));
}

class Counter {
 public:
  Counter(const LayoutContext& context, const CounterPlace& place, std::string pi_count)
      : place_(place),
        sizes_(context.sizes),
        palette_(context.palette),
        face_(context.font.face()),
        base_(context.scene.show.base),
        last_(last_shown(context.scene, context.log)),
        pulses_(context.shows_hits()),
        pi_count_(std::move(pi_count)),
        pi_(pi_count_.empty() ? "" : pi_line(context, digits_in(pi_count_))),
        count_widths_(context.fonts.of(Face::digits),
                      count_characters(base_) + std::string(kEndlessCount)),
        pi_widths_(context.font, std::string(kPiLabel) + "…" + pi_),
        label_px_(context.font.width_em(kCountLabel) * sizes_.text),
        over_px_(context.font.width_em(kOverLabel) * sizes_.text) {}

  void operator()(const FrameState& shown, std::vector<DrawItem>& items) const {
    const Integer& count = shown.state.count;
    const bool is_over = last_ && count >= *last_;
    const bool is_infinite = shown.state.is_infinite;
    const std::string text = is_infinite ? std::string(kEndlessCount) : count_text(count, base_);
    // An instant outside of the film may have a longer count than any in it.
    const double count_em = count_widths_.width_em(text);
    const double size_px = std::min(place_.size_px, (place_.room_px + kNegligible_px) / count_em);
    const double left = place_.right_px - count_em * size_px;
    const double growth_px = growth_of(shown, size_px, count_em);
    const bool is_beside = place_.label_baseline_px == place_.baseline_px;
    const double label_right = is_beside ? left - kLabelGap_em * sizes_.text : place_.right_px;
    if (place_.has_label) {
      const bool says_over = is_over && !is_infinite;
      const Point at{label_right - (says_over ? over_px_ : label_px_), place_.label_baseline_px};
      items.emplace_back(TextItem{ItemId::label, at,
                                  std::string(says_over ? kOverLabel : kCountLabel), sizes_.text,
                                  is_over ? palette_.done : palette_.muted, face_});
    }
    // From its middle.
    const Point grown{left - growth_px * count_em / 2,
                      place_.baseline_px + growth_px * kHalfFigure_em};
    items.emplace_back(TextItem{ItemId::count, grown, text, size_px + growth_px,
                                is_over ? palette_.accent : palette_.text, Face::digits});
    if (place_.has_pi) add_pi(lit_length(text, pi_count_), items);
  }

 private:
  /// By whole pixels, so that few sizes of glyphs are made. It leaves room beside the label.
  double growth_of(const FrameState& shown, double size_px, double count_em) const {
    if (!pulses_ || shown.hits.empty()) return 0;
    const double left = 1 - std::min(1.0, shown.hits.back().age_s / kPulse_s);
    const double most = std::min(kPulse * size_px, kLabelGap_em * sizes_.text / count_em);
    return std::round(smooth_step(left) * most);
  }

  /// @param lit  length of the count's beginning that is right
  void add_pi(std::size_t lit, std::vector<DrawItem>& items) const {
    const std::size_t length = length_with(digits_in(pi_count_.substr(0, lit)), pi_);
    const std::size_t counted = length_with(digits_in(pi_count_), pi_);
    double right = place_.right_px;
    const auto add = [&](std::size_t n, std::string text, const Color& color) {
      if (text.empty()) return;
      right -= pi_widths_.width_em(text) * sizes_.text;
      const Point at{right, place_.pi_baseline_px};
      items.emplace_back(
          TextItem{nth(ItemId::pi, n), at, std::move(text), sizes_.text, color, face_});
    };
    // From right to left: digits that the film does not count, those still to come, those reached.
    add(0, pi_.substr(counted) + "…", palette_.muted);
    add(1, pi_.substr(length, counted - length), palette_.text);
    add(2, pi_.substr(0, length), palette_.accent);
    add(3, std::string(kPiLabel), palette_.text);
  }

  CounterPlace place_;
  Sizes sizes_;
  Palette palette_;
  Face face_;
  int base_;
  std::optional<Integer> last_;  ///< of the run, if the film comes that far
  bool pulses_;                  ///< where hits are seen
  std::string pi_count_;
  std::string pi_;
  TextWidths count_widths_;
  TextWidths pi_widths_;
  double label_px_;
  double over_px_;
};

}  // namespace

std::string pi_count(const LayoutContext& context) {
  const Scene& scene = context.scene;
  const bool is_asked_for = scene.show.has(Overlay::digits);
  const bool is_of_theme = !scene.show.overlays && scene.view.theme != Theme::article;
  if (context.pair() == nullptr || !(is_asked_for || is_of_theme)) return {};
  const PairLog& log = context.two_blocks();
  const int base = scene.show.base;
  if (!places_of_pi(log.blocks(), base)) {
    if (is_of_theme) return {};
    throw UsageError(
        "show.overlays",
        fmt::format(
            "there are no digits of pi to light up, since this scene does not count "
            "them; leave out 'digits', or give a mass ratio of {}^(D-1) and a blue.velocity of 0",
            base * base),
        exact_text(Overlay::digits));
  }
  if (!counted_pi(log.blocks(), log.last(), base).empty()) return count_text(log.last(), base);
  if (is_of_theme) return {};
  const std::string counted = log.last().get_str(base);
  std::string digits = pi_digits(base, counted.size());
  std::erase(digits, '.');
  throw UsageError(
      "show.overlays",
      fmt::format("there are no digits of pi to light up: this scene counts {} in base {}, and "
                  "pi begins with {}; leave out 'digits', or use more digits",
                  counted, base, digits),
      exact_text(Overlay::digits));
}

std::size_t lit_length(std::string_view count, std::string_view expected) {
  if (count.size() != expected.size()) return 0;
  std::size_t length = 0;
  while (length < count.size() && count[length] == expected[length]) ++length;
  if (length > 0 && length < count.size() && count[length - 1] == ',') --length;
  return length;
}

Integer longest_count(const Scene& scene, const Log& log) {
  if (log.knows_last() && log.first_index() > 0) return log.last();
  // A still may show an instant that no film comes to.
  if (!has_span(scene, log)) {
    return log.knows_last() ? log.last() : to_integer(kMaxSteppedCollisions);
  }
  const Span span = span_of(scene, log);
  Integer last = log.knows_last() ? log.last() : log.count_at(span.to);
  const Integer first = log.count_at(span.from);
  const auto length = [&](const Integer& count) {
    return count_text(count, scene.show.base).size();
  };
  return length(first) > length(last) ? first : last;
}

CounterRoom counter_room(const LayoutContext& context, const std::string& pi_count) {
  const Integer longest = longest_count(context.scene, context.log);
  CounterRoom room;
  room.count_em = count_width_em(longest, context.scene.show.base, context.fonts.of(Face::digits));
  room.label_px = (context.font.width_em(kOverLabel) + kLabelGap_em) * context.sizes.text;
  if (pi_count.empty()) return room;
  const std::string pi = pi_line(context, digits_in(pi_count));
  if (!pi.empty()) {
    room.pi_px = context.font.width_em(std::string(kPiLabel) + pi + "…") * context.sizes.text;
  }
  return room;
}

Drawable counter(const LayoutContext& context, const CounterPlace& place,
                 const std::string& pi_count) {
  return {Counter(context, place, pi_count), {.hits = context.shows_hits()}};
}

}  // namespace piblocks
