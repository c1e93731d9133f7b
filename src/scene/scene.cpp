#include <piblocks/error.hpp>
#include <piblocks/image.hpp>
#include <piblocks/scene.hpp>
#include <piblocks/two_blocks.hpp>

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/rounded.hpp"
#include "core/text.hpp"
#include "scene/scene_keys.hpp"

namespace piblocks {
namespace {

/// Line breaks, tabs and the like.
bool has_control_characters(std::string_view text) {
  // A char has a sign on x86-64, and none on arm64.
  return std::ranges::any_of(
      text, [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '\x7f'; });
}

void check_range(const char* key, const Range& range, SceneProblems& problems) {
  const bool rises = range.low < range.high && is_finite(range.low) && is_finite(range.high) &&
                     to_double(range.high - range.low) > 0;
  problems.require(rises, key, "= [{}, {}]: must be two finite numbers in rising order", range.low,
                   range.high);
}

void check_size(const char* key, const FrameSize& size, SceneProblems& problems) {
  const auto [width, height] = size;
  const auto is_side = [](int side) { return side >= 1 && side <= kMaxSide_px; };
  const bool has_sides = is_side(width) && is_side(height);
  problems.require(has_sides, key, "= {}x{}: each side must be from 1 to {} pixels", width, height,
                   kMaxSide_px);
  problems.require(!has_sides || std::int64_t{width} * height <= kMaxFrame_px, key,
                   "= {}x{}: a frame must have at most {} pixels, as 8192x8192", width, height,
                   kMaxFrame_px);
}

void check_view(const View& view, SceneProblems& problems) {
  check_range("view.x", view.x, problems);
  check_range("view.y", view.y, problems);
  check_size("view.size", {view.width_px, view.height_px}, problems);
  problems.require(!view.colors.background || view.background == Background::opaque,
                   "view.background", "is transparent and has a colour; leave one of them out");
  // Codecs and containers count time in 32-bit fractions.
  constexpr long kMaxTerm = 1'000'000;
  const Rational& rate = view.frame_rate;
  problems.require(
      rate > 0 && rate <= kMaxFrameRate && rate.get_num() <= kMaxTerm && rate.get_den() <= kMaxTerm,
      "view.fps", "= {}: must be greater than 0 and at most {}, as a fraction of numbers up to {}",
      rate, kMaxFrameRate, kMaxTerm);
  const Rational& shutter = view.shutter;
  problems.require(shutter <= 0 || view.background == Background::opaque, "view.shutter",
                   "needs an opaque background: motion blur mixes the blocks with it; leave the "
                   "shutter out, or use --opaque");
  problems.require(shutter >= 0 && shutter <= 1, "view.shutter",
                   "= {}: must be from 0 (the instant alone) to 1 (all of the time to the next "
                   "frame)",
                   shutter);
}

void check_time(const TimeSpan& time, SceneProblems& problems) {
  problems.require_finite("time.from", time.from.offset);
  problems.require_finite("time.to", time.to.offset);
  problems.require_finite("time.speed", time.speed);
  problems.require_positive("time.speed", time.speed);
  const bool are_times = time.from.is_time() && time.to.is_time();
  problems.require(!are_times || time.to.offset > time.from.offset, "time.to",
                   "= {}: must be after time.from = {}", time.to.offset, time.from.offset);
}

void check_slow_motion(const Scene& scene, SceneProblems& problems) {
  constexpr const char* kKey = "time.slow-motion";
  const std::vector<SlowMotion>& windows = scene.pacing.slow_motion;
  problems.require(windows.size() <= kMaxWindows, kKey, "must have at most {} of them",
                   kMaxWindows);
  // Other programs get all of these numbers.
  const auto is_usable = [&](const Rational& factor) {
    return factor > 0 && is_finite(factor) && is_finite(1 / factor) &&
           is_finite(scene.time.speed / factor);
  };
  const auto wrong = std::ranges::find_if_not(windows, is_usable, &SlowMotion::factor);
  if (wrong == windows.end()) return;
  problems.add(kKey, "has a window whose factor is {}: {}", wrong->factor,
               wrong->factor <= 0 ? "it must be greater than 0"
                                  : "it, or the speed by it, is beyond the range of a double "
                                    "(about 1.8e308)");
}

void check_pacing(const Scene& scene, SceneProblems& problems) {
  const Pacing& pacing = scene.pacing;
  check_slow_motion(scene, problems);
  problems.require(pacing.ease_s >= 0 && pacing.ease_s <= kMaxEase_s, "time.ease",
                   "= {}: must be from 0 (abrupt) to {} seconds of video", pacing.ease_s,
                   kMaxEase_s);
  problems.require(pacing.freezes.size() <= kMaxWindows, "time.freeze",
                   "must have at most {} of them", kMaxWindows);
  for (const Freeze& freeze : pacing.freezes) {
    if (freeze.length_s > 0) continue;
    problems.add("time.freeze", "has a freeze of {} s: it must be longer than 0", freeze.length_s);
    break;
  }
  for (const auto& [key, seconds] : {std::pair("time.hold-start", pacing.hold_start_s),
                                     std::pair("time.hold-end", pacing.hold_end_s)}) {
    problems.require_finite(key, seconds);
    problems.require(seconds >= 0, key, "= {}: must be at least 0", seconds);
  }
  if (pacing.duration_s) problems.require_positive("time.duration", *pacing.duration_s);
}

/// Each value may be there once: a panel has one place, a kept picture one file.
template <typename Value>
void check_each_once(const char* key, const std::vector<Value>& list, const auto& name_of,
                     SceneProblems& problems) {
  for (auto value = list.begin(); value != list.end(); ++value) {
    if (std::find(list.begin(), value, *value) == value) continue;
    problems.add_item(key, name_of(*value), "has '{}' more than once", name_of(*value));
    return;
  }
}

void check_loupe(const Loupe& loupe, SceneProblems& problems) {
  constexpr const char* kKey = "show.loupe";
  if (!loupe.window) return;
  const auto& [from, to, zoom] = *loupe.window;
  problems.require(
      zoom > 1 && is_finite(zoom), kKey,
      "enlarges by {}: the factor must be more than 1, and within the range of a double", zoom);
  const bool are_times = from.is_time() && to.is_time();
  problems.require(!are_times || from.offset < to.offset, kKey,
                   "ends at {}: it must end after it begins", to.offset);
}

void check_show(const Show& show, SceneProblems& problems) {
  const auto name_of = [](auto value) { return exact_text(value); };
  if (show.overlays) check_each_once("show.overlays", *show.overlays, name_of, problems);
  check_each_once("show.panels", show.panels, name_of, problems);
  problems.require(show.base >= kMinBase && show.base <= kMaxBase, "base",
                   "= {}: must be from {} to {}", show.base, kMinBase, kMaxBase);
  check_line("show.title", show.title, problems);
  check_line("show.caption", show.caption, problems);
  problems.require(!has_control_characters(show.logo), "show.logo", "must be one line of text");
  if (show.loupe) check_loupe(*show.loupe, problems);
}

/// What is there for discs, for blocks, or for two blocks beside something immovable alone.
void check_fits(const Scene& scene, SceneProblems& problems) {
  const Show& show = scene.show;
  const bool is_plane = scene.system.dimensions == 2;
  const auto require_for = [&](bool is_for, Overlay overlay, const char* reason) {
    const std::string name = exact_text(overlay);
    if (!is_for && show.has(overlay))
      problems.add_item("show.overlays", name, "'{}' {}", name, reason);
  };
  require_for(is_plane, Overlay::trails, "is for discs; blocks have the diagram 'time'");
  require_for(is_plane, Overlay::angles, "is for walls of discs; leave it out");
  require_for(!is_plane, Overlay::ruler, "is for blocks on a line");
  const bool is_pair = two_blocks_of(scene.system).has_value();
  const auto require_pair = [&](bool is_there, const char* key, const std::string& what) {
    if (is_pair || !is_there) return;
    problems.add_item(key, what,
                      "has '{}', which needs two blocks beside one wall or fixed block, and no "
                      "more; leave it out",
                      what);
  };
  require_pair(show.has(Overlay::digits), "show.overlays", "digits");
  if (show.loupe && show.loupe->is_on) {
    problems.require(!is_plane, "show.loupe", "is for blocks on a line; leave it out");
    problems.require(is_plane || is_pair || show.loupe->window, "show.loupe",
                     "'{}' is for two blocks beside one wall or fixed block, which have a turn; "
                     "give a window with a collision, as 1.9:2.1:100",
                     exact_text(*show.loupe));
  }
  for (const Panel panel : show.panels) {
    const std::string name = exact_text(panel);
    const bool is_for_all = panel == Panel::count || panel == Panel::speeds;
    const bool is_for_line = panel == Panel::time || panel == Panel::conservation;
    if (panel == Panel::separation) {
      if (!is_plane) problems.add_item("show.panels", name, "'{}' is for discs", name);
    } else if (is_plane && !is_for_all) {
      problems.add_item("show.panels", name,
                        "'{}' is not for discs, which have count, speeds and separation", name);
    } else if (!is_for_all && !is_for_line) {
      require_pair(true, "show.panels", name);
    }
  }
  const bool is_early = scene.time.from.is_time() && scene.time.from.offset < 0;
  problems.require(is_pair || !is_early, "time.from",
                   "= {}: the motion of other bodies than two blocks and a wall begins at time 0",
                   scene.time.from.offset);
}

/// What pictures say where the energy is kept, by collisions and from outside.
void check_energy(const Scene& scene, SceneProblems& problems) {
  const bool is_kept = is_elastic(scene.system);
  if (is_kept && !is_driven(scene.system)) return;
  const auto refuse = [&](const char* key, const std::string& name) {
    problems.add_item(key, name, "has '{}', which needs {}", name,
                      is_kept ? "walls that rest; leave it out"
                              : "elastic collisions; leave it out, or leave out the restitution");
  };
  for (const Panel panel : scene.show.panels) {
    if (panel == Panel::time || panel == Panel::count || panel == Panel::separation) continue;
    refuse("show.panels", exact_text(panel));
  }
  if (scene.show.has(Overlay::digits)) refuse("show.overlays", exact_text(Overlay::digits));
}

void check_golden(const Golden& golden, SceneProblems& problems) {
  constexpr const char* kKey = "golden.frames";
  if (golden.size) check_size("golden.size", *golden.size, problems);
  check_each_once(kKey, golden.frames, std::identity(), problems);
  for (const std::string& text : golden.frames) {
    try {
      parse_instant(text);
    } catch (const UsageError& error) {
      problems.add(kKey, "has '{}': {}", shortened(text), std::string(error.what()));
      return;
    }
  }
}

}  // namespace

void check_line(const char* key, std::string_view text, SceneProblems& problems) {
  const bool is_short = text.size() <= kMaxLine_bytes;
  problems.require(is_short, key, "is longer than {} bytes", kMaxLine_bytes);
  if (!is_short) return;
  problems.require(is_utf8(text), key, "is not valid UTF-8; write it in that encoding");
  problems.require(!has_control_characters(text), key, "must be one line of text");
}

std::vector<Overlay> overlays_of(const Scene& scene) {
  if (scene.show.overlays) return *scene.show.overlays;
  constexpr std::size_t kMostMasses = 12;
  const System& system = scene.system;
  const bool has_masses =
      is_lecture(scene.view.theme) && system.dimensions == 1 && system.bodies.size() <= kMostMasses;
  return has_masses ? std::vector{Overlay::masses} : std::vector<Overlay>();
}

Rational width_by_mass(const Body& blue, const Body& red) {
  if (blue.mass.value_or(0) <= 0 || red.mass.value_or(0) <= 0) return red.size;
  // Either mass may be beyond the range of a double.
  const auto log_100 = [](const Integer& value) {
    long exponent = 0;
    const double mantissa = mpz_get_d_2exp(&exponent, value.get_mpz_t());
    return (rounded::log10(mantissa) + static_cast<double>(exponent) * rounded::log10(2)) / 2;
  };
  const Rational ratio = *red.mass / *blue.mass;
  const double hundreds = log_100(ratio.get_num()) - log_100(ratio.get_den());
  const double factor = std::clamp(1 + hundreds / 8, 0.5, 1.5);
  // To a thousandth, which makes the eighths exact.
  return blue.size * Rational(Integer(std::lround(factor * 1000))) / 1000;
}

std::vector<Problem> problems_of(const Scene& scene) {
  SceneProblems problems(problems_of(scene.system));
  problems.require(scene.styles.size() == scene.system.bodies.size(), "body",
                   "must have one style for each body");
  for (std::size_t i = 0; i < std::min(scene.styles.size(), scene.system.bodies.size()); ++i) {
    const BodyStyle& style = scene.styles[i];
    const std::string key = body_key(scene.system, i) + '.';
    if (!style.label.empty()) check_line((key + "label").c_str(), style.label, problems);
    problems.require(!style.path || scene.system.dimensions == 2, key + "path",
                     "is for discs; blocks have the diagram 'time'");
  }
  check_energy(scene, problems);
  check_fits(scene, problems);
  check_view(scene.view, problems);
  check_time(scene.time, problems);
  check_pacing(scene, problems);
  check_show(scene.show, problems);
  check_golden(scene.golden, problems);
  return problems.take();
}

}  // namespace piblocks
