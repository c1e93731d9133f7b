#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/rounded.hpp"
#include "draw/number_text.hpp"
#include "draw/overlays/overlays.hpp"
#include "scene/schedule.hpp"

namespace piblocks {
namespace {

constexpr int kLeastTimeDecimals = 2;
constexpr int kMostTimeDecimals = 9;
// In ems.
constexpr double kBetweenReadOuts = 2.0;
constexpr double kRowHeight = 1.5;
constexpr double kRowBaseline = 1.05;

/// A short text that changes with what is shown.
struct ReadOut {
  const char* name;    ///< in messages
  std::string widest;  ///< the text that takes most room
  std::function<std::string(const FrameState&)> text;
  Color color;
  bool is_slow_motion = false;
};

/// Slow motion has more decimals, since less time passes from frame to frame.
int time_decimals(const Scene& scene, const Log& log) {
  double least_speed = 1;  // simulation time per second of video
  if (has_span(scene, log)) {
    const Schedule schedule = make_schedule(scene, log);
    for (const Stretch& stretch : schedule.stretches()) {
      if (stretch.speed == 0) continue;
      least_speed = std::min(least_speed, std::abs(to_double(stretch.speed)));
    }
  } else {
    // A scene whose end never comes can still be shown at an instant.
    least_speed = std::min(least_speed, to_double(scene.time.speed));
  }
  const double more = std::ceil(-rounded::log10(least_speed) - 1e-9);
  return static_cast<int>(
      std::clamp<double>(kLeastTimeDecimals + more, kLeastTimeDecimals, kMostTimeDecimals));
}

ReadOut time_read_out(const LayoutContext& context) {
  const auto text = [decimals = time_decimals(context.scene, context.log)](const Rational& time) {
    return fmt::format("t = {}", fixed_text(time, decimals));
  };
  Rational end = 0;
  if (has_span(context.scene, context.log)) {
    const Span span = span_of(context.scene, context.log);
    end = std::max(Rational(abs(span.from)), Rational(abs(span.to)));
  }
  return {"time", text(-end), [=](const FrameState& shown) { return text(shown.time); },
          context.palette.text};
}

std::string slowdown_text(const Rational& slowdown) {
  if (slowdown == 1) return {};
  if (slowdown < 1) return fmt::format("{}× faster", short_text(1 / slowdown));
  return fmt::format("{}× slower", short_text(slowdown));
}

/// The factors at which slow motion stays, in rising order.
std::vector<Rational> steady_factors(const Pacing& pacing) {
  std::vector<Rational> factors = {1};
  for (const SlowMotion& slow : pacing.slow_motion) factors.push_back(slow.factor);
  if (pacing.automatic_slow_motion) {
    for (int factor = 10; factor <= kMaxAutomaticFactor; factor *= 10) factors.emplace_back(factor);
  }
  std::ranges::sort(factors);
  factors.erase(std::unique(factors.begin(), factors.end()), factors.end());
  return factors;
}

/// A whole number of one or two digits and zeros. @param value  > 0
Rational of_two_digits(const Rational& value) {
  Rational unit = 1;
  while (value >= 100 * unit) unit *= 10;
  return floor(value / unit + Rational(1, 2)) * unit;
}

/// The label of a factor between two steady ones, while slow motion eases in or out. Empty if the
/// rounded factor is above `most`.
std::string passing_text(const Rational& slowdown, const Rational& most) {
  if (slowdown < 1) {
    const Rational faster = of_two_digits(1 / slowdown);
    return faster <= most ? slowdown_text(1 / faster) : "";
  }
  const Rational rounded = of_two_digits(slowdown);
  return rounded <= most ? slowdown_text(rounded) : "";
}

}  // namespace

SlowMotionLabel slow_motion_label(const LayoutContext& context) {
  std::string widest;
  std::vector<Rational> steady = steady_factors(context.scene.pacing);
  for (const Rational& slowdown : steady) {
    std::string text = slowdown_text(slowdown);
    if (context.font.width_em(text) > context.font.width_em(widest)) widest = std::move(text);
  }
  // Passing factors take no more room than those that stay.
  const double room_em = context.font.width_em(widest);
  Rational most = 0;
  for (const int passing : {9, 99, 990, 9'900, 99'000, 990'000}) {
    const double width_em = std::max(context.font.width_em(slowdown_text(passing)),
                                     context.font.width_em(slowdown_text(Rational(1, passing))));
    if (width_em <= room_em) most = passing;
  }
  const auto text = [steady = std::move(steady), most](const FrameState& shown) {
    const bool is_steady = std::ranges::binary_search(steady, shown.slowdown);
    return is_steady ? slowdown_text(shown.slowdown) : passing_text(shown.slowdown, most);
  };
  return {std::move(widest), text};
}

namespace {

ReadOut slow_motion_read_out(const LayoutContext& context) {
  SlowMotionLabel label = slow_motion_label(context);
  return {"slow motion", std::move(label.widest), std::move(label.text), context.palette.accent,
          true};
}

constexpr int kMostDigits = 6;
constexpr int kDigitsOfSums = 4;  ///< at most, where sums stand alone
constexpr int kLeastDigits = 3;

/// How values up to a largest one are written: with as many decimals as give the largest so many
/// digits, and as multiples of a power of ten if it is very large or very small.
struct Scale {
  Scale(const Magnitude& most, int digits)
      : largest(written_with(digits - 1, most)),
        is_plain(largest.exponent >= -2 && largest.exponent < digits),
        decimals(digits - 1 - (is_plain ? static_cast<int>(largest.exponent) : 0)),
        unit(is_plain ? "" : " ×" + power_text(largest.exponent)) {}

  std::string text(double value) const { return fixed_text(value, decimals); }

  Magnitude largest;
  bool is_plain;
  int decimals;
  std::string unit;
};

/// Whether there is a word for each body, so that its share of a sum can be shown.
bool has_names(const LayoutContext& context) { return context.pair() != nullptr; }

/// The energy of bodies that lose some in collisions, or get some from what is immovable.
ReadOut changing_energy(const LayoutContext& context, int digits) {
  const System& system = context.scene.system;
  const Rational exact_most = most_twice_energy(context.scene, context.log) / 2;
  const Scale scale(magnitude_of(exact_most), digits);
  const mpf_class most(exact_most);
  const mpf_class begin(Rational(twice_energy(system) / 2));
  const mpf_class unit = scale.is_plain || most == 0 ? mpf_class(1) : scale.largest.mantissa / most;
  const auto text = [=, is_lossless = is_elastic(system), has_drive = is_driven(system)](
                        const mpf_class& now, const mpf_class& first) {
    const auto number = [&](const mpf_class& value) {
      return scale.text(mpf_class(value * unit).get_d());
    };
    const std::string energy = fmt::format("Energy{} {}", scale.unit, number(now));
    if (!has_drive) return fmt::format("{}, lost {}", energy, number(first - now));
    if (!is_lossless) return fmt::format("{}, at first {}", energy, number(first));
    return fmt::format("{}, from outside {}{}", energy, now < first ? "" : "+",
                       number(now - first));
  };
  // The second number is as long as the first at most, and has a sign if it comes from outside.
  const bool has_first = is_driven(system) && !is_elastic(system);
  const std::string widest = text(most, has_first ? begin : mpf_class(2 * most));
  return {"energy", widest,
          [=, masses = masses_or_zero(system)](const FrameState& shown) {
            return text(twice_energy(masses, shown.state) / 2, begin);
          },
          context.palette.text};
}

/// The energy of each body that has a name, and the sum of all.
ReadOut energy_read_out(const LayoutContext& context, int digits) {
  const System& system = context.scene.system;
  const Rational exact_sum = twice_energy(system) / 2;
  const bool is_constant = is_elastic(system) && !is_driven(system);
  if (!has_names(context) && !is_constant) return changing_energy(context, digits);
  if (!has_names(context)) {
    std::string text = fmt::format("Energy {}", short_text(exact_sum));
    return {"energy", text, [=](const FrameState&) { return text; }, context.palette.text};
  }
  const Scale scale(magnitude_of(exact_sum), digits);
  const double sum = scale.is_plain ? to_double(exact_sum) : scale.largest.mantissa;
  const auto text = [=, red_name = context.palette.red.name, blue_name = context.palette.blue.name](
                        double red, double blue, double both) {
    return fmt::format("Energy{}: {} {} + {} {} = {}", scale.unit, red_name, scale.text(red),
                       blue_name, scale.text(blue), scale.text(both));
  };
  const TwoBlocks& blocks = context.two_blocks().blocks();
  // A body's velocity if it had all the energy. It may be beyond the range of a double.
  const auto fastest = [&](std::size_t i) {
    return root_of(2 * exact_sum / *system.bodies[i].mass);
  };
  const auto energy = [sum](const Motion& body, const mpf_class& most) {
    const double share = most > 0 ? mpf_class(body.velocity[0] / most).get_d() : 0;
    return sum * std::min(1.0, share * share);
  };
  const auto shown_text = [=, inner = blocks.blue_id, outer = blocks.red_id,
                           most_of_blue = fastest(blocks.blue_id),
                           most_of_red = fastest(blocks.red_id),
                           is_kept = is_elastic(blocks)](const FrameState& shown) {
    const double red = energy(shown.state.bodies[outer], most_of_red);
    const double blue = is_kept ? sum - red : energy(shown.state.bodies[inner], most_of_blue);
    return text(red, blue, is_kept ? sum : red + blue);
  };
  return {"energy", text(sum, sum, sum), shown_text, context.palette.text};
}

/// The momenta of bodies, and their sum. Walls and fixed bodies take some of it.
class Momenta {
 public:
  Momenta(const LayoutContext& context, int digits)
      : system_(context.scene.system),
        // The heaviest body has the most momentum when it has all the energy.
        most_squared_(most_twice_energy(context.scene, context.log) * heaviest_mass(system_)),
        scale_(root_magnitude_of(most_squared_), digits),
        most_(scale_.largest.mantissa *
              (scale_.is_plain ? to_double(power_of_ten(scale_.largest.exponent)) : 1)) {
    if (has_names(context)) {
      names_ = {context.palette.blue.name, context.palette.red.name};
      named_ = {context.two_blocks().blocks().blue_id, context.two_blocks().blocks().red_id};
    }
    for (const Body& body : system_.bodies) factors_.push_back(factor_of(body.mass.value_or(0)));
    for (const std::size_t axis : {0U, 1U}) {
      if (!is_kept(axis)) continue;
      kept_.at(axis) = sum_of(
          axis, [&](std::size_t i) { return to_double(system_.bodies[i].velocity.at(axis)); });
    }
  }

  std::string widest() const { return text({-most_, -most_}, {-most_, -most_}); }

  std::string operator()(const FrameState& shown) const {
    const std::vector<Motion>& bodies = shown.state.bodies;
    std::vector<double> each;
    for (const std::size_t i : named_) {
      each.push_back(mpf_class(factors_[i] * bodies[i].velocity[0]).get_d());
    }
    std::array<double, 2> sum{};
    for (const std::size_t axis : {0U, 1U}) {
      const auto velocity = [&](std::size_t i) { return bodies[i].velocity.at(axis); };
      sum.at(axis) = kept_.at(axis) ? *kept_.at(axis) : sum_of(axis, velocity);
    }
    return text(each, sum);
  }

 private:
  /// Masses may be beyond the range of a double, and so may these factors.
  mpf_class factor_of(const Rational& mass) const {
    if (most_squared_ == 0) return 0;
    return most_ * root_of(mass * mass / most_squared_);
  }

  /// Whether nothing takes any of it.
  bool is_kept(std::size_t axis) const {
    return std::ranges::all_of(system_.bodies, [](const Body& body) { return bool(body.mass); }) &&
           std::ranges::all_of(system_.walls,
                               [=](const Wall& wall) { return wall.normal.at(axis) == 0; });
  }

  /// From the last body to the first.
  double sum_of(std::size_t axis, const auto& velocity) const {
    if (axis == 1 && system_.dimensions == 1) return 0;
    double sum = 0;
    for (std::size_t i = factors_.size(); i-- > 0;) {
      sum += mpf_class(factors_[i] * velocity(i)).get_d();
    }
    return sum;
  }

  std::string text(const std::vector<double>& each, const std::array<double, 2>& sum) const {
    if (!names_.empty()) {
      return fmt::format("Momentum{}: {} {}, {} {}, sum {}", scale_.unit, names_[1],
                         scale_.text(each[1]), names_[0], scale_.text(each[0]),
                         scale_.text(sum[0]));
    }
    if (system_.dimensions == 1) {
      return fmt::format("Momentum{} {}", scale_.unit, scale_.text(sum[0]));
    }
    return fmt::format("Momentum{} ({}, {})", scale_.unit, scale_.text(sum[0]),
                       scale_.text(sum[1]));
  }

  System system_;
  Rational most_squared_;
  Scale scale_;
  double most_;
  std::vector<const char*> names_;  ///< of the bodies if the momentum of each is shown
  std::vector<std::size_t> named_;  ///< the bodies that have them
  std::vector<mpf_class> factors_;  ///< from a velocity to a momentum
  std::array<std::optional<double>, 2> kept_;
};

ReadOut momentum_read_out(const LayoutContext& context, int digits) {
  Momenta momenta(context, digits);
  std::string widest = momenta.widest();
  return {"momentum", std::move(widest), std::move(momenta), context.palette.text};
}

double room_for_read_outs(const LayoutContext& context) {
  return context.scene.view.width_px - 2 * context.sizes.margin;
}

/// With as many digits as have room, up to a most.
ReadOut fitted(const LayoutContext& context,
               ReadOut (*read_out_of)(const LayoutContext& context, int digits)) {
  for (int digits = has_names(context) ? kMostDigits : kDigitsOfSums;; --digits) {
    ReadOut read_out = read_out_of(context, digits);
    const double width = context.font.width_em(read_out.widest) * context.sizes.text;
    if (width <= room_for_read_outs(context) || digits == kLeastDigits) return read_out;
  }
}

/// From this time on the picture may be wrong.
ReadOut certainty_read_out(const LayoutContext& context, double until, bool is_collapse) {
  const std::string text =
      is_collapse ? "from here on nothing is computed" : "from here on rounding may decide";
  return {"certainty", text,
          [=](const FrameState& shown) {
            return to_double(shown.time) >= until ? text : std::string();
          },
          context.palette.accent};
}

std::vector<ReadOut> read_outs_of(const LayoutContext& context) {
  const Show& show = context.scene.show;
  std::vector<ReadOut> read_outs;
  if (show.has(Overlay::time)) read_outs.push_back(time_read_out(context));
  if (has_slow_motion(context.scene.pacing)) read_outs.push_back(slow_motion_read_out(context));
  if (show.has(Overlay::energy)) read_outs.push_back(fitted(context, energy_read_out));
  if (show.has(Overlay::momentum)) read_outs.push_back(fitted(context, momentum_read_out));
  if (context.log.is_always_certain() || !has_span(context.scene, context.log)) return read_outs;
  const Span span = span_of(context.scene, context.log);
  if (const std::optional<double> until = context.log.certain_until(span.to)) {
    read_outs.push_back(
        certainty_read_out(context, *until, collapse_at(context.log, *until, span.to).has_value()));
  }
  return read_outs;
}

}  // namespace

ReadOutRows::ReadOutRows(const LayoutContext& context)
    : text_px_(context.sizes.text), face_(context.font.face()) {
  std::vector<ReadOut> read_outs = read_outs_of(context);
  if (read_outs.empty()) return;
  const double margin = context.sizes.margin;
  const double room_px = room_for_read_outs(context);
  std::string characters(kNumberCharacters);
  for (const ReadOut& read_out : read_outs) characters += read_out.widest;
  widths_ = TextWidths(context.font, characters);
  std::vector<double> widths;
  widths.reserve(read_outs.size());
  for (const ReadOut& read_out : read_outs) {
    widths.push_back(context.font.width_em(read_out.widest) * text_px_);
  }
  const auto widest = std::ranges::max_element(widths);
  if (*widest > room_px) {
    const std::string name = read_outs[std::size_t(widest - widths.begin())].name;
    const bool is_overlay = std::ranges::any_of(
        overlays_of(context.scene), [&](Overlay overlay) { return exact_text(overlay) == name; });
    throw UsageError("show.overlays",
                     fmt::format("'{}' cannot be read in {:.0f} pixels; leave it out, or make "
                                 "the frame wider",
                                 name, room_px),
                     is_overlay ? name : "");
  }
  const double gap = kBetweenReadOuts * text_px_;
  std::size_t first = 0;
  while (first < read_outs.size()) {
    double width = widths[first];
    std::size_t end = first + 1;
    for (; end < read_outs.size() && width + gap + widths[end] <= room_px; ++end) {
      width += gap + widths[end];
    }
    double x = margin;
    for (; first < end; ++first) {
      ReadOut& read_out = read_outs[first];
      const Point origin{x, height_ + kRowBaseline * text_px_};
      placed_.push_back({std::move(read_out.text), read_out.color, read_out.widest.size(),
                         widths[first], origin, read_out.is_slow_motion});
      x += widths[first] + gap;
    }
    height_ += kRowHeight * text_px_;
  }
  const bool is_article = context.scene.view.theme == Theme::article;
  if (is_article || placed_.size() > 1 || !placed_.front().is_slow_motion) return;
  height_ = 0;
  lone_px_ = placed_.front().room_px;
}

void ReadOutRows::move(double y, const Point& slow_motion) {
  for (Placed& placed : placed_) placed.origin.y += y;
  if (lone_px_ > 0) placed_.front().origin = {slow_motion.x - lone_px_, slow_motion.y};
}

void ReadOutRows::operator()(const FrameState& shown, std::vector<DrawItem>& items) const {
  // An instant outside of the scene's span may need more room than any in it.
  double shift = 0;
  for (std::size_t n = 0; n < placed_.size(); ++n) {
    const Placed& placed = placed_[n];
    if (n > 0 && placed.origin.y != placed_[n - 1].origin.y) shift = 0;
    std::string text = placed.text(shown);
    if (text.empty()) continue;
    const bool is_shared = placed.is_slow_motion && loupe_opacity_;
    const double opacity = is_shared ? 1 - loupe_opacity_(shown) : 1;
    if (opacity <= 0) continue;
    const Point origin{placed.origin.x + shift, placed.origin.y};
    if (text.size() > placed.room_bytes) {
      shift += std::max(0.0, widths_.width_em(text) * text_px_ - placed.room_px);
    }
    items.emplace_back(TextItem{nth(ItemId::read_outs, n), origin, std::move(text), text_px_,
                                faded(placed.color, opacity), face_});
  }
}

}  // namespace piblocks
