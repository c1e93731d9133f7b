#include "draw/composition.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "draw/finite.hpp"
#include "draw/frame_plan.hpp"
#include "draw/number_text.hpp"
#include "draw/overlays/overlays.hpp"
#include "draw/panels/panels.hpp"
#include "draw/stage.hpp"
#include "scene/schedule.hpp"

namespace piblocks {
namespace {

/// A smaller logo is a speck.
constexpr double kLeastLogo_px = 1;
constexpr double kLeastLogoLength_px = 3;

/// Whether the counts of a system are the digits of pi: blue at rest, off the wall, and a mass
/// ratio that is a power of 100.
bool counts_pi(const BlockSystem& system) {
  Rational ratio = system.red.mass / system.blue.mass;
  if (system.blue.velocity != 0 || system.red.velocity >= 0 || system.blue_gap() <= 0) return false;
  if (ratio.get_den() != 1) return false;
  const std::string digits = ratio.get_num().get_str();
  return digits.size() % 2 == 1 && digits.find_first_not_of('0', 1) == std::string::npos &&
         digits.front() == '1';
}

std::string lit_digits(const Scene& scene, const CollisionLog& log) {
  if (!scene.show.has(Overlay::digits)) return {};
  if (counts_pi(scene.system)) return with_thousands_separators(log.size());
  throw UsageError(
      "show.overlays: there are no digits of pi to light up, since this scene does not count them; "
      "leave out 'digits', or give a mass ratio of 100^(D-1) and a blue.velocity of 0");
}

/// Of the counts that the film shows: before time 0 they are negative, and may be longer than the
/// last one.
Integer longest_count(const Scene& scene, const CollisionLog& log) {
  const Integer& last = log.size();
  if (log.first_index() > 0 || !has_span(scene, log)) return last;
  const Integer first = log.state_at(span_of(scene, log).from).count;
  return first.get_str().size() > last.get_str().size() ? first : last;
}

std::vector<ReadOut> read_outs_of(const Setting& setting) {
  const Scene& scene = setting.scene;
  std::vector<ReadOut> read_outs;
  if (scene.show.has(Overlay::time)) read_outs.push_back(time_read_out(setting));
  if (has_slow_motion(scene.pacing)) {
    read_outs.push_back(slower_read_out(setting));
  }
  if (scene.show.has(Overlay::energy)) read_outs.push_back(energy_read_out(setting));
  if (scene.show.has(Overlay::momentum)) read_outs.push_back(momentum_read_out(setting));
  return read_outs;
}

std::unique_ptr<PicturePart> make_panel(Panel panel, const Setting& setting,
                                        const PanelPlace& place) {
  switch (panel) {
    case Panel::velocity:
      return velocity_panel(setting, place);
    case Panel::position:
      return position_panel(setting, place);
    case Panel::unfolded:
      return unfolded_panel(setting, place);
    case Panel::time:
      return time_panel(setting, place);
    case Panel::rate:
      return rate_panel(setting, place);
  }
  return nullptr;
}

[[noreturn]] void refuse_time(const Rational& time) {
  throw UsageError(
      fmt::format("frame: at time {} something is at a place beyond the range of a double (about "
                  "1.8e308); show "
                  "another time, or use less extreme positions, velocities and widths",
                  short_text(time)));
}

void check_finite(const FrameState& shown) {
  for (const Motion& motion : {shown.state.blue, shown.state.red}) {
    if (!std::isfinite(motion.position) || !std::isfinite(motion.velocity)) refuse_time(shown.time);
  }
}

void check_finite(std::span<const DrawItem> items, const Rational& time) {
  if (!are_finite(items)) refuse_time(time);
}

/// As large as fits, in the lower right corner of its place.
/// @throws UsageError if nothing could be seen of it.
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

struct Composition::Contents {
  Contents(const Scene& scene, const CollisionLog& log, std::shared_ptr<const Image> logo);

  int width_px;
  int height_px;
  Palette palette;
  std::optional<Color> background;
  std::unique_ptr<const StagePicture> stage;
  std::vector<std::unique_ptr<const PicturePart>> parts;  ///< in the order of their ids
  std::vector<DrawItem> lines;                            ///< title, caption and logo
  std::vector<std::unique_ptr<const PicturePart>> panels;

 private:
  void add_parts(const Setting& setting);
  void add_panels(const Setting& setting, const std::vector<Rectangle>& places);
};

Composition::Contents::Contents(const Scene& scene, const CollisionLog& log,
                                std::shared_ptr<const Image> logo)
    : width_px(scene.view.width_px),
      height_px(scene.view.height_px),
      palette(palette_of(scene.view.theme)),
      background(background_of(scene.view)) {
  const Font font;
  const Layout nowhere;
  const double text_px = small_text_px(scene.view);
  auto rows =
      std::make_unique<ReadOutRows>(read_outs_of({scene, log, palette, font, nowhere, text_px, 1}),
                                    read_out_area(scene.view), text_px, font);
  const FramePlan plan = plan_frame(scene, palette, font, rows->height());
  const Layout layout = lay_out(scene, longest_count(scene, log), plan.stage, font);
  stage = std::make_unique<StagePicture>(scene, layout, palette, font, lit_digits(scene, log));

  const Setting setting{scene, log, palette, font, layout, plan.text_px, plan.line_px};
  add_parts(setting);
  if (rows->height() > 0) {
    rows->move(plan.stage.y + plan.stage.height);
    parts.push_back(std::move(rows));
  }
  if (plan.title) lines.emplace_back(*plan.title);
  if (plan.caption) lines.emplace_back(*plan.caption);
  if (logo) lines.emplace_back(place_logo(plan.logo, std::move(logo)));
  add_panels(setting, plan.panels);
}

void Composition::Contents::add_parts(const Setting& setting) {
  const Show& show = setting.scene.show;
  if (show.has(Overlay::masses)) parts.push_back(mass_labels(setting));
  if (show.has(Overlay::velocities)) parts.push_back(velocity_arrows(setting));
  if (show.has(Overlay::ruler)) parts.push_back(ruler(setting));
}

void Composition::Contents::add_panels(const Setting& setting,
                                       const std::vector<Rectangle>& places) {
  const std::vector<Panel>& shown = setting.scene.show.panels;
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const auto first_id = ItemId{static_cast<std::uint32_t>(ItemId::panels) +
                                 ids_from(static_cast<std::uint32_t>(i))};
    panels.push_back(make_panel(shown[i], setting, {places[i], first_id, shown[i]}));
  }
}

Composition::Composition(const Scene& scene, const CollisionLog& log,
                         std::shared_ptr<const Image> logo)
    : contents_(std::make_unique<const Contents>(scene, log, std::move(logo))) {}
Composition::~Composition() = default;
Composition::Composition(Composition&&) noexcept = default;
Composition& Composition::operator=(Composition&&) noexcept = default;

DrawList Composition::frame(const FrameState& shown, std::span<const ExposurePart> exposure) const {
  check_finite(shown);
  DrawList list{contents_->width_px, contents_->height_px, contents_->background, {}};
  contents_->stage->add(shown.state, exposure, list.items);
  for (const auto& part : contents_->parts) part->add(shown, list.items);
  list.items.insert(list.items.end(), contents_->lines.begin(), contents_->lines.end());
  for (const auto& panel : contents_->panels) panel->add(shown, list.items);
  check_finite(list.items, shown.time);
  return list;
}

}  // namespace piblocks
