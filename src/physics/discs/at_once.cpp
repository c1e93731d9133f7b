#include "physics/discs/at_once.hpp"

#include <algorithm>
#include <cmath>

#include "physics/discs/bounds.hpp"

namespace piblocks::discs {
namespace {

/// A matrix is inverted in the cube of this number of steps.
constexpr std::size_t kMostAtOnce = 100;

double inverse_mass(const DiscSystem& system, std::uint32_t body) {
  return system.is_movable(body) ? 1 / system.masses[body] : 0;
}

/// Of the second from the first; of a wall only along its normal.
Vector relative_velocity(const DiscSystem& system, const Touch& touch) {
  const bool is_disc = touch.second < system.discs.size();
  const Vector other = is_disc
                           ? system.discs[touch.second].velocity
                           : -system.walls[touch.second - system.discs.size()].speed * touch.normal;
  return other - system.discs[touch.first].velocity;
}

/// What is between the true closing speed and the computed one, at most, because of the normal's
/// error and of what no collision moves.
double given_error(const DiscSystem& system, const Touch& touch) {
  const double speed = length(relative_velocity(system, touch)) * kUp;
  double error = speed * (touch.normal_error + 8 * kUnit);
  if (touch.second >= system.discs.size()) {
    const WallLine& wall = system.walls[touch.second - system.discs.size()];
    error += wall.speed_error + 4 * kUnit * std::abs(wall.speed);
  } else if (!system.is_movable(touch.second)) {
    error += system.bounds[touch.second].velocity;
  }
  return error * kUp;
}

/// Entry of G: how much closing speed an impulse of one touch takes from another.
double coupling(const DiscSystem& system, const Touch& one, const Touch& other) {
  const auto side = [](const Touch& touch, std::uint32_t body) {
    return body == touch.first ? -1.0 : body == touch.second ? 1.0 : 0.0;
  };
  double sum = 0;
  for (const std::uint32_t body : {one.first, one.second}) {
    sum += side(one, body) * side(other, body) * inverse_mass(system, body);
  }
  return sum * dot(one.normal, other.normal);
}

/// Without pivoting, which symmetric positive definite matrices do not need. Nothing if the matrix
/// is nearly singular.
std::optional<std::vector<double>> inverse_of(std::vector<double> matrix, std::size_t size) {
  std::vector<double> diagonal;
  for (std::size_t i = 0; i < size; ++i) diagonal.push_back(matrix[i * size + i]);
  for (std::size_t k = 0; k < size; ++k) {
    const double pivot = matrix[k * size + k];
    if (!(pivot > 0x1p-30 * diagonal[k])) return std::nullopt;
    matrix[k * size + k] = 1;
    for (std::size_t j = 0; j < size; ++j) matrix[k * size + j] /= pivot;
    for (std::size_t i = 0; i < size; ++i) {
      if (i == k) continue;
      const double factor = matrix[i * size + k];
      matrix[i * size + k] = 0;
      for (std::size_t j = 0; j < size; ++j) matrix[i * size + j] -= factor * matrix[k * size + j];
    }
  }
  return matrix;
}

/// Fills in the impulses. @return whether they are determined
bool solve(const DiscSystem& system, Stage& stage) {
  const std::size_t size = stage.touches.size();
  stage.matrix.clear();
  for (const Touch& one : stage.touches) {
    for (const Touch& other : stage.touches) stage.matrix.push_back(coupling(system, one, other));
  }
  const auto inverse = inverse_of(stage.matrix, size);
  if (!inverse) return false;
  stage.trace = stage.inverse_trace = 0;
  stage.impulses.assign(size, 0);
  for (std::size_t i = 0; i < size; ++i) {
    stage.trace += stage.matrix[i * size + i];
    stage.inverse_trace += (*inverse)[i * size + i];
    for (std::size_t j = 0; j < size; ++j) {
      const double change = (1 + stage.touches[j].restitution) * stage.closing[j];
      stage.impulses[i] += (*inverse)[i * size + j] * change;
    }
  }
  return true;
}

/// Leaves out what would pull. @return whether there was any
bool drop_pulling(Stage& stage) {
  Stage kept;
  for (std::size_t i = 0; i < stage.touches.size(); ++i) {
    if (stage.impulses[i] < 0) continue;
    kept.touches.push_back(stage.touches[i]);
    kept.closing.push_back(stage.closing[i]);
  }
  if (kept.touches.size() == stage.touches.size()) return false;
  stage = kept;
  stage.has_dropped = true;
  return true;
}

/// Whether the predicate holds for any two touches, given by their indices.
template <typename Predicate>
bool any_pair(const Stage& stage, const Predicate& predicate) {
  for (std::size_t i = 0; i < stage.touches.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (predicate(i, j)) return true;
    }
  }
  return false;
}

/// Whether all have one coefficient, or do not influence each other.
bool is_contraction(const Stage& stage) {
  return !any_pair(stage, [&](std::size_t i, std::size_t j) {
    return stage.touches[i].restitution != stage.touches[j].restitution &&
           stage.influence(i, j) != 0;
  });
}

std::vector<std::uint32_t> moved_bodies(const DiscSystem& system, const Stage& stage) {
  std::vector<std::uint32_t> bodies;
  for (const Touch& touch : stage.touches) {
    for (const std::uint32_t body : {touch.first, touch.second}) {
      if (system.is_movable(body)) bodies.push_back(body);
    }
  }
  std::ranges::sort(bodies);
  bodies.erase(std::unique(bodies.begin(), bodies.end()), bodies.end());
  return bodies;
}

/// In coordinates times the roots of the masses.
struct StageErrors {
  double turned;          ///< |dA|
  double given;           ///< of the closing speeds, without those of movable bodies
  double closing;         ///< |c|
  double least_singular;  ///< of A, less what dA may take from it
  double rounding;        ///< of the change of velocities

  StageErrors(const DiscSystem& system, const Stage& stage) {
    double turned2 = 0;
    double given2 = 0;
    double closing2 = 0;
    for (std::size_t i = 0; i < stage.touches.size(); ++i) {
      const Touch& touch = stage.touches[i];
      const double turn = touch.normal_error + 8 * kUnit;
      turned2 +=
          turn * turn * (inverse_mass(system, touch.first) + inverse_mass(system, touch.second));
      const double error = given_error(system, touch);
      given2 += error * error;
      closing2 += stage.closing[i] * stage.closing[i];
    }
    turned = std::sqrt(turned2);
    given = std::sqrt(given2);
    closing = std::sqrt(closing2);
    least_singular = 0.9375 / std::sqrt(stage.inverse_trace);
    const auto size = static_cast<double>(stage.touches.size());
    rounding = 16 * size * size * kUnit * stage.trace * std::sqrt(stage.trace) *
               stage.inverse_trace * stage.inverse_trace * closing;
  }

  /// Pseudo-inverses differ by at most 1.62 |dA| over both least singular values (Wedin, 1973).
  double of_change() const {
    const double s = least_singular;
    return (2 * (1.62 * turned * closing / (s * s) + given / s) + rounding) * kUp;
  }
};

}  // namespace

bool Stage::is_tied() const {
  return any_pair(*this, [&](std::size_t i, std::size_t j) {
    return std::abs(influence(i, j)) > 0x1p-30 * influence(i, i);
  });
}

double closing_speed(const DiscSystem& system, const Touch& touch) {
  return -dot(relative_velocity(system, touch), touch.normal);
}

std::optional<Stage> stage_of(const DiscSystem& system, const std::vector<Touch>& touches,
                              double least_speed) {
  Stage stage;
  for (const Touch& touch : touches) {
    const double closing = closing_speed(system, touch);
    if (!(closing > least_speed)) continue;
    stage.touches.push_back(touch);
    stage.closing.push_back(closing);
  }
  if (stage.touches.size() > kMostAtOnce) return std::nullopt;
  do {
    if (!solve(system, stage)) return std::nullopt;
  } while (drop_pulling(stage));
  return stage;
}

bool are_decided(const DiscSystem& system, const std::vector<Touch>& touches, double least_speed) {
  return std::ranges::all_of(touches, [&](const Touch& touch) {
    double error = given_error(system, touch) + system.bounds[touch.first].velocity;
    if (system.is_movable(touch.second)) error += system.bounds[touch.second].velocity;
    const double beyond = std::abs(closing_speed(system, touch) - least_speed);
    return beyond > error * kUp + 0x1p-10 * least_speed;
  });
}

bool widen(DiscSystem& system, const Stage& stage) {
  if (stage.has_dropped || !is_contraction(stage)) return false;
  const std::vector<std::uint32_t> moved = moved_bodies(system, stage);
  double before2 = 0;
  for (const std::uint32_t body : moved) {
    const double error = system.bounds[body].velocity;
    before2 += system.masses[body] * error * error;
  }
  const double before = std::sqrt(before2);
  const StageErrors errors(system, stage);
  const double s = errors.least_singular;
  if (!(errors.turned < s / 15)) return false;
  const double change = errors.of_change();
  const double doubt =
      ((change + 2 * before) + 4 * errors.turned * errors.closing / (s * s)) / s * kUp;
  if (std::ranges::any_of(stage.impulses, [&](double j) { return !(j > doubt); })) return false;
  const auto size = static_cast<double>(stage.touches.size());
  for (const std::uint32_t body : moved) {
    const double root = std::sqrt(system.masses[body]);
    const double speed = length(system.discs[body].velocity) + 2 * errors.closing / s / root;
    system.bounds[body].velocity = ((before + change) / root + 8 * size * kUnit * speed) * kUp;
  }
  return true;
}

void apply(DiscSystem& system, const Touch& touch, double impulse) {
  for (const std::uint32_t body : {touch.first, touch.second}) {
    if (!system.is_movable(body)) continue;
    const double change = impulse / system.masses[body];
    Vector& velocity = system.discs[body].velocity;
    velocity = velocity + (body == touch.first ? -change : change) * touch.normal;
  }
}

}  // namespace piblocks::discs
