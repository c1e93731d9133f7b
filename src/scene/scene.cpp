#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/image.hpp>
#include <piblocks/scene.hpp>

#include <algorithm>
#include <cmath>

#include "physics/check_finite.hpp"
#include "scene/line.hpp"

namespace piblocks {
namespace {

void check_range(const char* key, const Range& range, std::vector<Problem>& problems) {
  if (range.low < range.high && std::isfinite(to_double(range.low)) &&
      std::isfinite(to_double(range.high)) && to_double(range.high - range.low) > 0) {
    return;
  }
  problems.push_back({key, fmt::format("= [{}, {}]: must be two finite numbers in rising order",
                                       to_text(range.low), to_text(range.high))});
}

void check_size(const char* key, const FrameSize& size, std::vector<Problem>& problems) {
  const auto is_side = [](int side) { return side >= 1 && side <= kMaxSide_px; };
  if (!is_side(size.width_px) || !is_side(size.height_px)) {
    problems.push_back({key, fmt::format("= {}x{}: each side must be from 1 to {} pixels",
                                         size.width_px, size.height_px, kMaxSide_px)});
  } else if (std::int64_t{size.width_px} * size.height_px > kMaxFrame_px) {
    problems.push_back(
        {key, fmt::format("= {}x{}: a frame must have at most {} pixels, as 8192x8192",
                          size.width_px, size.height_px, kMaxFrame_px)});
  }
}

void check_frame_rate(const Rational& rate, std::vector<Problem>& problems) {
  // Codecs and containers count time in 32-bit fractions.
  constexpr long kMaxTerm = 1'000'000;
  if (rate > 0 && rate <= kMaxFrameRate && rate.get_num() <= kMaxTerm &&
      rate.get_den() <= kMaxTerm) {
    return;
  }
  problems.push_back(
      {"view.fps", fmt::format("= {}: must be greater than 0 and at most {}, as a fraction of "
                               "numbers up to {}",
                               to_text(rate), kMaxFrameRate, kMaxTerm)});
}

void check_shutter(const View& view, std::vector<Problem>& problems) {
  const Rational& shutter = view.shutter;
  if (shutter > 0 && view.background == Background::transparent) {
    problems.push_back({"view.shutter",
                        "asks for light from behind the blocks, and a transparent frame has none; "
                        "leave it out, or use --opaque"});
  }
  if (shutter >= 0 && shutter <= 1) return;
  problems.push_back(
      {"view.shutter", fmt::format("= {}: must be from 0 (the instant alone) to 1 (all of the time "
                                   "to the next frame)",
                                   to_text(shutter))});
}

void check_time(const TimeSpan& time, std::vector<Problem>& problems) {
  check_finite("time.from", time.from.offset, problems);
  check_finite("time.to", time.to.offset, problems);
  check_finite("time.speed", time.speed, problems);
  if (time.speed <= 0) {
    problems.push_back(
        {"time.speed", fmt::format("= {}: must be greater than 0", to_text(time.speed))});
  }
  if (time.from.is_time() && time.to.is_time() && time.to.offset <= time.from.offset) {
    problems.push_back(
        {"time.to", fmt::format("= {}: must be after time.from = {}", to_text(time.to.offset),
                                to_text(time.from.offset))});
  }
}

void check_count(const char* key, std::size_t count, std::vector<Problem>& problems) {
  if (count <= kMaxWindows) return;
  problems.push_back({key, fmt::format("must have at most {} of them", kMaxWindows)});
}

void check_seconds(const char* key, const Rational& seconds, const Rational& low,
                   std::vector<Problem>& problems) {
  check_finite(key, seconds, problems);
  if (seconds >= low) return;
  problems.push_back(
      {key, fmt::format("= {}: must be at least {}", to_text(seconds), to_text(low))});
}

void check_slow_motion(const Scene& scene, std::vector<Problem>& problems) {
  constexpr const char* kKey = "time.slow-motion";
  check_count(kKey, scene.pacing.slow_motion.size(), problems);
  const auto is_finite = [](const Rational& value) { return std::isfinite(to_double(value)); };
  for (const SlowMotion& window : scene.pacing.slow_motion) {
    const Rational& factor = window.factor;
    if (factor <= 0) {
      problems.push_back({kKey, fmt::format("has a window whose factor is {}: it must be greater "
                                            "than 0",
                                            to_text(factor))});
      return;
    }
    // All of them are told to other programs.
    if (is_finite(factor) && is_finite(1 / factor) && is_finite(scene.time.speed / factor)) {
      continue;
    }
    problems.push_back(
        {kKey, fmt::format("has a window whose factor is {}: it, or the speed by it, "
                           "is beyond the range of a double (about 1.8e308)",
                           to_text(factor))});
    return;
  }
}

void check_freezes(const Pacing& pacing, std::vector<Problem>& problems) {
  constexpr const char* kKey = "time.freeze";
  check_count(kKey, pacing.freezes.size(), problems);
  for (const Freeze& freeze : pacing.freezes) {
    if (freeze.length_s > 0) continue;
    problems.push_back({kKey, fmt::format("has a freeze of {} s: it must be longer than 0",
                                          to_text(freeze.length_s))});
    return;
  }
}

void check_line(const char* key, const std::string& text, std::vector<Problem>& problems) {
  const std::string problem = problem_of_line(text);
  if (!problem.empty()) problems.push_back({key, problem});
}

/// Each of them is there once: a panel has one place, a kept picture one file.
template <typename Value>
void check_each_once(const char* key, const std::vector<Value>& list, const auto& name_of,
                     std::vector<Problem>& problems) {
  for (auto value = list.begin(); value != list.end(); ++value) {
    if (std::find(list.begin(), value, *value) == value) continue;
    problems.push_back({key, fmt::format("has '{}' more than once", name_of(*value))});
    return;
  }
}

void check_show(const Show& show, std::vector<Problem>& problems) {
  const auto name_of = [](auto value) { return exact_text(value); };
  check_each_once("show.overlays", show.overlays, name_of, problems);
  check_each_once("show.panels", show.panels, name_of, problems);
  check_line("show.title", show.title, problems);
  check_line("show.caption", show.caption, problems);
  if (has_control_characters(show.logo)) {
    problems.push_back({"show.logo", "must be one line of text"});
  }
}

void check_golden(const Golden& golden, std::vector<Problem>& problems) {
  constexpr const char* kKey = "golden.frames";
  if (golden.size) check_size("golden.size", *golden.size, problems);
  check_each_once(
      kKey, golden.frames, [](const std::string& text) { return text; }, problems);
  for (const std::string& text : golden.frames) {
    try {
      parse_instant(text);
    } catch (const UsageError& error) {
      problems.push_back({kKey, fmt::format("has '{}': {}", text, error.what())});
      return;
    }
  }
}

void check_pacing(const Scene& scene, std::vector<Problem>& problems) {
  const Pacing& pacing = scene.pacing;
  check_slow_motion(scene, problems);
  check_freezes(pacing, problems);
  check_seconds("time.hold-start", pacing.hold_start_s, 0, problems);
  check_seconds("time.hold-end", pacing.hold_end_s, 0, problems);
  if (pacing.duration_s && *pacing.duration_s <= 0) {
    problems.push_back({"time.duration",
                        fmt::format("= {}: must be greater than 0", to_text(*pacing.duration_s))});
  }
}

}  // namespace

bool has_control_characters(std::string_view text) {
  return std::ranges::any_of(text, [](char c) { return (c >= 0 && c < ' ') || c == '\x7f'; });
}

std::string problem_of_line(std::string_view text) {
  if (text.size() > kMaxLine_bytes) return fmt::format("is longer than {} bytes", kMaxLine_bytes);
  return has_control_characters(text) ? "must be one line of text" : "";
}

Rational width_by_mass(const BlockSystem& system) {
  if (system.blue.mass <= 0 || system.red.mass <= 0) return system.red.width;
  // Either mass may be beyond what a double holds.
  const auto log_2 = [](const Integer& value) {
    long exponent = 0;
    const double mantissa = mpz_get_d_2exp(&exponent, value.get_mpz_t());
    return static_cast<double>(exponent) + std::log2(mantissa);
  };
  const Rational ratio = system.red.mass / system.blue.mass;
  const double hundreds = (log_2(ratio.get_num()) - log_2(ratio.get_den())) / std::log2(100.0);
  const double factor = std::clamp(1 + hundreds / 8, 0.5, 1.5);
  // To a thousandth, which makes the eighths exact.
  return system.blue.width * Rational(Integer(std::lround(factor * 1000))) / 1000;
}

std::vector<Problem> problems_of(const Scene& scene) {
  std::vector<Problem> problems = problems_of(scene.system);
  check_range("view.x", scene.view.x, problems);
  check_range("view.y", scene.view.y, problems);
  check_size("view.size", {scene.view.width_px, scene.view.height_px}, problems);
  check_frame_rate(scene.view.frame_rate, problems);
  check_shutter(scene.view, problems);
  check_time(scene.time, problems);
  check_pacing(scene, problems);
  check_show(scene.show, problems);
  check_golden(scene.golden, problems);
  return problems;
}

}  // namespace piblocks
