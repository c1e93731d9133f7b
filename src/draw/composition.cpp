#include "draw/composition.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "draw/layout.hpp"
#include "draw/look.hpp"
#include "draw/number_text.hpp"
#include "draw/overlays/overlays.hpp"
#include "draw/panels/panels.hpp"
#include "draw/region.hpp"
#include "scene/schedule.hpp"

namespace piblocks {
namespace {

/// A smaller logo is a speck.
constexpr double kLeastLogo_px = 1;
constexpr double kLeastLogoLength_px = 3;

/// Whether a system is one that counts the digits of pi in this base: blue at rest, off the wall,
/// mass ratio a power of the base's square.
bool counts_pi(const BlockSystem& system, int base) {
  const Rational ratio = system.red.mass / system.blue.mass;
  if (system.blue.velocity != 0 || system.red.velocity >= 0 || system.blue_gap() <= 0) return false;
  Integer rest;
  mpz_remove(rest.get_mpz_t(), ratio.get_num_mpz_t(), Integer(base * base).get_mpz_t());
  return ratio.get_den() == 1 && rest == 1;
}

/// @throws UsageError if the scene's count is not made of the digits of pi.
std::string lit_digits(const Scene& scene, const CollisionLog& log) {
  const int base = scene.show.base;
  if (!scene.show.has(Overlay::digits)) return {};
  if (!counts_pi(scene.system, base)) {
    throw UsageError(fmt::format(
        "show.overlays: there are no digits of pi to light up, since this scene does not count "
        "them; leave out 'digits', or give a mass ratio of {}^(D-1) and a blue.velocity of 0",
        base * base));
  }
  const std::string counted = log.size().get_str(base);
  std::string digits = pi_digits(base, counted.size());
  std::erase(digits, '.');
  if (counted == digits) return count_text(log.size(), base);
  throw UsageError(fmt::format(
      "show.overlays: there are no digits of pi to light up: this scene counts {} in base {}, and "
      "pi begins with {}; leave out 'digits', or use more digits",
      counted, base, digits));
}

/// The longest count that the film shows. Counts before time 0 are negative and may be longer.
Integer longest_count(const Scene& scene, const CollisionLog& log) {
  const Integer& last = log.size();
  if (log.first_index() > 0 || !has_span(scene, log)) return last;
  const Integer first = log.state_at(span_of(scene, log).from).count;
  const auto length = [&](const Integer& count) {
    return count_text(count, scene.show.base).size();
  };
  return length(first) > length(last) ? first : last;
}

void check(bool is_finite, const Rational& time) {
  if (is_finite) return;
  throw UsageError(
      fmt::format("frame: at time {} something is at a place beyond the range of a double (about "
                  "1.8e308); show another time, or use less extreme positions, velocities and "
                  "widths",
                  short_text(time)));
}

bool is_finite(const Motion& motion) {
  return std::isfinite(motion.position) && std::isfinite(motion.velocity);
}

/// The logo as large as fits, in the lower right corner of its place. @throws UsageError
ImageItem place_logo(const Rectangle& place, std::shared_ptr<const Image> logo) {
  const double scale = std::min(place.width / logo->width_px, place.height / logo->height_px);
  const double width = scale * logo->width_px;
  const double height = scale * logo->height_px;
  if (std::min(width, height) < kLeastLogo_px || std::max(width, height) < kLeastLogoLength_px) {
    throw UsageError(fmt::format(
        "show.logo: a picture of {}x{} would be {:.1f}x{:.1f} pixels here; leave it out, make the "
        "frame larger, or use a picture of another shape",
        logo->width_px, logo->height_px, width, height));
  }
  return {ItemId::logo,
          {place.x + place.width - width, place.y + place.height - height, width, height},
          std::move(logo)};
}

}  // namespace

Composition::Composition(const Scene& scene, const CollisionLog& log,
                         std::shared_ptr<const Image> logo)
    : empty_{scene.view.width_px, scene.view.height_px, background_of(scene.view), {}} {
  const Font font;
  const Palette palette = palette_of(scene.view.theme);
  Layout layout;  // made below: the height of the read-outs decides it
  const View& view = scene.view;
  const DrawingContext context{
      .scene = scene,
      .log = log,
      .palette = palette,
      .font = font,
      .layout = layout,
      .text_px = std::max(style::kLeastText_px, style::kSmall * short_measure(view)),
      .line_px = std::max(1.0, line_width_px(view) / 2),
      .needs = needs_};
  ReadOutRows rows(context);
  const FramePlan plan = plan_frame(context, rows.height());
  layout = lay_out(scene, longest_count(scene, log), plan.stage, font);

  const Show& show = scene.show;
  drawables_.push_back(stage(context, lit_digits(scene, log)));
  if (show.has(Overlay::masses)) drawables_.push_back(mass_labels(context));
  if (show.has(Overlay::velocities)) drawables_.push_back(velocity_arrows(context));
  if (show.has(Overlay::ruler)) drawables_.push_back(ruler(context));
  rows.move(plan.stage.y + plan.stage.height);
  drawables_.emplace_back(std::move(rows));
  std::vector<DrawItem> lines;
  if (plan.title) lines.emplace_back(*plan.title);
  if (plan.caption) lines.emplace_back(*plan.caption);
  if (logo) lines.emplace_back(place_logo(plan.logo, std::move(logo)));
  drawables_.push_back(unchanging(std::move(lines)));
  // In the order of Panel.
  constexpr std::array kPanels = {velocity_panel, position_panel, unfolded_panel, time_panel,
                                  rate_panel};
  for (std::size_t i = 0; i < show.panels.size(); ++i) {
    const auto make_panel = kPanels.at(static_cast<std::size_t>(show.panels[i]));
    const auto first_id = ItemId{static_cast<std::uint32_t>(ItemId::panels) +
                                 ids_from(static_cast<std::uint32_t>(i))};
    drawables_.push_back(make_panel(context, {plan.panels[i], first_id, show.panels[i]}));
  }
}

DrawList Composition::frame(const FrameState& shown) const {
  check(is_finite(shown.state.blue) && is_finite(shown.state.red), shown.time);
  DrawList list = empty_;
  for (const Drawable& drawable : drawables_) drawable(shown, list.items);
  check(are_finite(list.items), shown.time);
  return list;
}

}  // namespace piblocks
