#include "physics/discs/disc_system.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>

#include "core/real.hpp"
#include "physics/problems.hpp"

namespace piblocks::discs {
namespace {

/// Squares and products of numbers within these limits neither overflow nor underflow.
constexpr double kMostLength = 0x1p400;
constexpr double kLeastRadius = 0x1p-400;
constexpr double kLeastMass = 0x1p-600;
constexpr long kMostExponent = 1000;

/// The power of two below |value| or the one below that; nothing for 0.
std::optional<long> exponent_of(const Rational& value) {
  if (value == 0) return std::nullopt;
  return static_cast<long>(mpz_sizeinbase(value.get_num_mpz_t(), 2)) -
         static_cast<long>(mpz_sizeinbase(value.get_den_mpz_t(), 2));
}

/// value / 2^exponent
Rational scaled_down(const Rational& value, long exponent) {
  return exponent >= 0 ? Rational(value >> static_cast<mp_bitcnt_t>(exponent))
                       : Rational(value << static_cast<mp_bitcnt_t>(-exponent));
}

/// A number as a double, and a bound of its rounding error.
struct Rounded {
  double value;
  double error;

  Rounded(const Rational& exact, long exponent) {
    const Rational scaled = scaled_down(exact, exponent);
    value = to_double(scaled);
    const bool is_exact = std::isfinite(value) && Rational(value) == scaled;
    error = is_exact ? 0 : 0x1p-52 * std::abs(value) + 0x1p-1000;
  }
};

struct Exponents {
  long length = 0;
  long speed = 0;
  long mass = 0;
};

Exponents exponents_of(const System& system) {
  std::optional<long> length;
  std::optional<long> speed;
  std::optional<long> mass;
  for (const Body& body : system.bodies) {
    length = std::max(length, exponent_of(body.size));
    for (const Rational& part : body.velocity) speed = std::max(speed, exponent_of(part));
    if (body.mass) mass = std::max(mass, exponent_of(*body.mass));
  }
  for (const Wall& wall : system.walls) {
    for (const Rational& part : wall.velocity) speed = std::max(speed, exponent_of(part));
  }
  return {length.value_or(0), speed.value_or(0), mass.value_or(0)};
}

[[noreturn]] void fail_range(std::size_t body, const std::string& what) {
  throw SimulationError(
      fmt::format("simulation: body {}: {} is out of the range of a double beside the others; use "
                  "numbers that are less far apart",
                  body + 1, what));
}

void add_disc(DiscSystem& result, const Body& body, const Exponents& exponents) {
  const std::size_t number = result.discs.size();
  const Rounded x(body.position[0], exponents.length);
  const Rounded y(body.position[1], exponents.length);
  const Rounded radius(body.size, exponents.length);
  const Rounded vx(body.velocity[0], exponents.speed);
  const Rounded vy(body.velocity[1], exponents.speed);
  // Written so that NaN fails, too.
  if (!(std::abs(x.value) < kMostLength && std::abs(y.value) < kMostLength)) {
    fail_range(number, "its position");
  }
  if (!(radius.value > kLeastRadius)) fail_range(number, "its radius");
  const double mass = body.mass ? Rounded(*body.mass, exponents.mass).value : kNever;
  if (!(mass > kLeastMass)) fail_range(number, "its mass");
  Disc disc;
  disc.position = {x.value, y.value};
  disc.velocity = {vx.value, vy.value};
  disc.radius = radius.value;
  result.discs.push_back(disc);
  result.masses.push_back(mass);
  result.has_immovable |= mass == kNever;
  result.bounds.push_back({x.error + y.error, vx.error + vy.error, 0});
}

/// The normal's length is a root, so this is computed with 256 bits and then rounded.
WallLine wall_line(const Wall& wall, const Exponents& exponents) {
  constexpr mpfr_prec_t kBits = 256;
  const Rational along = piblocks::dot(wall.normal, wall.point);
  const Rational pace = piblocks::dot(wall.normal, wall.velocity);
  const Real norm = sqrt(Real(kBits, piblocks::dot(wall.normal, wall.normal)));
  WallLine line;
  line.normal = {(Real(kBits, wall.normal[0]) / norm).to_double(),
                 (Real(kBits, wall.normal[1]) / norm).to_double()};
  const Real offset = Real(kBits, scaled_down(along, exponents.length)) / norm;
  line.offset = offset.to_double();
  const Real speed = Real(kBits, scaled_down(pace, exponents.speed)) / norm;
  line.speed = speed.to_double();
  if (!(std::abs(line.offset) < kMostLength)) {
    throw SimulationError(fmt::format(
        "simulation: wall {}: its distance is out of the range of a double beside the discs; use "
        "numbers that are less far apart",
        wall.name));
  }
  const bool is_axis = wall.normal[0] == 0 || wall.normal[1] == 0;
  const auto error = [&](const Real& exact, double value) {
    const bool is_exact = is_axis && exact.to_rational() == Rational(value);
    return is_exact ? 0 : 0x1p-52 * std::abs(value) + 0x1p-1000;
  };
  line.normal_error = is_axis ? 0 : 0x1p-52;
  line.offset_error = error(offset, line.offset);
  line.speed_error = pace == 0 ? 0 : error(speed, line.speed);
  return line;
}

std::vector<std::array<double, 2>> restitutions_of(const System& system) {
  if (is_elastic(system)) return {};
  std::vector<std::array<double, 2>> result;
  // What is less than 1 stays so, since bounds tell it from 1.
  const auto rounded = [](const Rational& e) {
    return e < 1 ? std::min(to_double(e), 1 - 0x1p-53) : 1.0;
  };
  const auto add = [&](const std::optional<Rational>& own) {
    result.push_back({rounded(own.value_or(system.restitution)),
                      rounded(own.value_or(system.wall_restitution))});
  };
  for (const Body& body : system.bodies) add(body.restitution);
  for (const Wall& wall : system.walls) add(wall.restitution);
  return result;
}

}  // namespace

double DiscSystem::restitution(std::uint32_t first, std::uint32_t second) const {
  if (restitutions.empty()) return 1;
  const bool is_free = is_movable(first) && is_movable(second);
  const std::size_t kind = is_free ? 0 : 1;
  return std::min(restitutions[first][kind], restitutions[second][kind]);
}

DiscSystem disc_system_of(const System& system) {
  const Exponents exponents = exponents_of(system);
  const long time = exponents.length - exponents.speed;
  for (const long exponent : {exponents.length, exponents.speed, time}) {
    if (std::abs(exponent) < kMostExponent) continue;
    throw SimulationError(
        "simulation: the discs' radii, speeds or their quotients are out of the range of a double; "
        "use other units");
  }
  DiscSystem result;
  result.units = {std::ldexp(1.0, static_cast<int>(exponents.length)),
                  std::ldexp(1.0, static_cast<int>(exponents.speed)),
                  std::ldexp(1.0, static_cast<int>(time))};
  for (const Body& body : system.bodies) add_disc(result, body, exponents);
  for (const Wall& wall : system.walls) result.walls.push_back(wall_line(wall, exponents));
  result.restitutions = restitutions_of(system);
  return result;
}

}  // namespace piblocks::discs
