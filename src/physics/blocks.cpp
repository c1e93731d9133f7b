#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/run.hpp>

#include <cmath>

#include "physics/check_finite.hpp"
#include "physics/exact_motion.hpp"

namespace piblocks {
namespace {

void check_positive(const char* key, const Rational& value, std::vector<Problem>& problems) {
  if (value > 0) return;
  problems.push_back({key, fmt::format("= {}: must be greater than 0", to_text(value))});
}

}  // namespace

void check_finite(const char* key, const Rational& value, std::vector<Problem>& problems) {
  if (std::isfinite(to_double(value))) return;
  problems.push_back({key, "is beyond the range of a double (about 1.8e308)"});
}

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
  std::vector<Problem> problems;
  check_positive("blue.mass", system.blue.mass, problems);
  check_positive("red.mass", system.red.mass, problems);
  check_positive("blue.width", system.blue.width, problems);
  check_positive("red.width", system.red.width, problems);
  check_finite("wall.face", system.wall_face, problems);
  check_finite("blue.position", system.blue.position, problems);
  check_finite("red.position", system.red.position, problems);
  check_finite("blue.velocity", system.blue.velocity, problems);
  check_finite("red.velocity", system.red.velocity, problems);
  check_finite("blue.width", system.blue.width, problems);
  check_finite("red.width", system.red.width, problems);
  if (!problems.empty()) return problems;  // the gaps would only repeat them

  if (system.blue_gap() < 0) {
    problems.push_back(
        {"blue.position", fmt::format("= {}: blue reaches {} into the wall, whose face is at {}",
                                      to_text(system.blue.position), to_text(-system.blue_gap()),
                                      to_text(system.wall_face))});
  }
  if (system.blocks_gap() < 0) {
    problems.push_back(
        {"red.position", fmt::format("= {}: red overlaps blue by {}", to_text(system.red.position),
                                     to_text(-system.blocks_gap()))});
  }
  return problems;
}

std::vector<std::string> describe(const std::vector<Problem>& problems) {
  std::vector<std::string> lines;
  lines.reserve(problems.size());
  for (const Problem& problem : problems) lines.push_back(problem.key + " " + problem.reason);
  return lines;
}

std::string to_text(const Rational& value) {
  const std::string exact = value.get_str();
  return exact.size() <= 24 ? exact : fmt::format("{}", to_double(value));
}

}  // namespace piblocks
