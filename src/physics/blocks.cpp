#include "physics/blocks.hpp"

#include <piblocks/error.hpp>

#include "physics/exact_motion.hpp"

namespace piblocks {

std::optional<Rational> turn_of(const BlockSystem& system) {
  const ExactMotion motion(system);
  if (motion.at_rest()) return std::nullopt;
  return motion.closest_approach;
}

BlockSystem article_system(int digits) {
  if (digits < 1 || digits > kMaxDigits) {
    throw UsageError(fmt::format("digits = {}: must be from 1 to {}", digits, kMaxDigits));
  }
  BlockSystem system;
  system.red.mass = power(100, static_cast<unsigned long>(digits - 1));
  return system;
}

std::vector<Problem> problems_of(const BlockSystem& system) {
  const auto& [wall_face, blue, red] = system;
  SceneProblems problems;
  problems.require_positive("blue.mass", blue.mass);
  problems.require_positive("red.mass", red.mass);
  problems.require_positive("blue.width", blue.width);
  problems.require_positive("red.width", red.width);
  problems.require_finite("wall.face", wall_face);
  problems.require_finite("blue.position", blue.position);
  problems.require_finite("red.position", red.position);
  problems.require_finite("blue.velocity", blue.velocity);
  problems.require_finite("red.velocity", red.velocity);
  problems.require_finite("blue.width", blue.width);
  problems.require_finite("red.width", red.width);
  if (!problems.empty()) return problems.take();  // the gaps would only repeat them

  problems.require(system.blue_gap() >= 0, "blue.position",
                   "= {}: blue reaches {} into the wall, whose face is at {}", blue.position,
                   Rational(-system.blue_gap()), wall_face);
  problems.require(system.blocks_gap() >= 0, "red.position", "= {}: red overlaps blue by {}",
                   red.position, Rational(-system.blocks_gap()));
  return problems.take();
}

void require_valid(const std::vector<Problem>& problems) {
  if (problems.empty()) return;
  std::vector<std::string> lines;
  lines.reserve(problems.size());
  for (const auto& [key, reason] : problems) lines.push_back(fmt::format("{} {}", key, reason));
  throw SceneError(std::move(lines));
}

void require_finite(const Time& time, const Motion& blue, const Motion& red, const char* engine) {
  for (const double number : {time.hi, blue.position, blue.velocity, red.position, red.velocity}) {
    if (std::isfinite(number)) continue;
    throw SimulationError(
        fmt::format("{}: a time, position or velocity is beyond the range of a double (about "
                    "1.8e308)",
                    engine));
  }
}

void require_last(const Integer& index, const Integer& last_at_its_time) {
  if (index == last_at_its_time) return;
  throw UsageError(
      fmt::format("collision #{}: happens at the same time as all up to #{}; name the last of them",
                  index.get_str(), last_at_its_time.get_str()));
}

}  // namespace piblocks
