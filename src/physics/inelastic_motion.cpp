#include "physics/inelastic_motion.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <cmath>

#include "physics/exact_motion.hpp"

namespace piblocks {
namespace {

// What of an endless run is listed: README.md, "Restitution".
constexpr long kEnergyLeft_bits = 200;
constexpr long kTimeLeft_bits = 100;

/// A term of so many bits has the right sign.
constexpr mpfr_prec_t kSign_bits = 8;

/// A time is rounded up by less than 2^-100 of the flight.
constexpr long kTimeGrid_bits = 104;

/// a - b, and 0 if that is only the rounding of both, to this many bits.
Real clean_difference(const Real& a, const Real& b, mpfr_prec_t good_bits) {
  const Real difference = a - b;
  const bool is_noise = std::max(a.exponent(), b.exponent()) - difference.exponent() > good_bits;
  return is_noise ? Real(difference.bits(), 0) : difference;
}

}  // namespace

InelasticMotion::InelasticMotion(const TwoBlocks& system)
    : ratio(system.blue.mass / system.red.mass),
      wall_restitution(system.wall_restitution),
      blocks_restitution(system.blocks_restitution),
      gaps{system.blue_gap(), system.blue_gap() + system.blocks_gap()},
      rates{system.blue.velocity, system.red.velocity},
      areal_velocity(gaps.second * rates.first - gaps.first * rates.second),
      powers((1 + wall_restitution) * (1 + blocks_restitution) / (1 + ratio) - wall_restitution -
                 blocks_restitution,
             wall_restitution * blocks_restitution),
      total(0),
      listed(0) {
  find_first_collision();
  if (collides) unroll();
}

void InelasticMotion::unroll() {
  find_sequences();
  total = find_total();
  listed = total ? *total : find_listed();
}

std::optional<Corner> InelasticMotion::corner() const {
  const auto& [u1, u2] = rates;
  const bool comes_in = u2 < 0 && u1 <= 0 && u2 <= u1;
  if (!collides || areal_velocity != 0 || !comes_in || !total) return std::nullopt;
  Corner corner{first_time, blocks_first, *total, *total + 1};
  // If only one pair approaches, the other has had a collision without effect.
  if (u1 == 0 || u1 == u2) return corner;
  InelasticMotion other = *this;
  other.blocks_first = !blocks_first;
  other.unroll();
  if (!other.total) return std::nullopt;
  corner.other_count = *other.total;
  return corner;
}

std::optional<Rational> InelasticMotion::turn() const {
  if (rates.first == 0 && rates.second == 0) return std::nullopt;
  if (rates.second >= 0 || !collides) return 0;
  // u2 after collisions of the blocks is e s_n - s_{n+1}.
  const std::size_t i = blocks_first ? 0 : 1;
  const Rational& e = blocks_restitution;
  const RoundSequence inwards{speeds[i + 1].a - e * speeds[i].a, speeds[i + 1].b - e * speeds[i].b};
  const std::optional<Integer> round =
      inwards.a > 0 ? powers.first_not_positive(inwards) : std::optional<Integer>(0);
  if (round) {
    const Integer n = 2 * *round + 1 + Integer(long(i));
    if (n <= listed) return time_past(n);
  }
  if (total) return std::nullopt;
  if (coincides_from(listed)) return time_past(listed);
  // Rounded up, so that the blocks rest by then.
  constexpr mpfr_prec_t kBits = 256;
  const std::optional<Real> end = collapse_time(kBits);
  if (!end) return std::nullopt;
  return (*end + scaled(*end, 16 - kBits)).to_rational();
}

Rational InelasticMotion::closing(CollisionKind kind, const Pair& rates) {
  return kind == CollisionKind::wall ? Rational(-rates.first)
                                     : Rational(rates.first - rates.second);
}

std::optional<DensestCollisions> InelasticMotion::densest() const {
  if (!collides) return std::nullopt;
  if (!total) {
    const std::optional<Rational> end = turn();
    return end ? std::optional(DensestCollisions{*end, std::nullopt}) : std::nullopt;
  }
  if (*total < 2) return std::nullopt;
  if (coincides_from(*total - 1)) return DensestCollisions{time_past(*total), std::nullopt};
  const Integer middle = densest_index();
  const Integer first = std::max(Integer(1), std::min(Integer(middle - 1), Integer(*total - 2)));
  const Integer last = std::min(*total, Integer(first + 2));
  constexpr mpfr_prec_t kBits = 64;
  Real length(kBits, 0);
  for (Integer n = first; n < last; ++n) length = length + flight_after(n, kBits);
  const Real rate = Real(kBits, Rational(last - first)) / length;
  return DensestCollisions{time_past(middle), rate.to_rational()};
}

Integer InelasticMotion::densest_index() const {
  const Rational discriminant = powers.trace() * powers.trace() - 4 * powers.determinant();
  if (discriminant >= 0) return 1;
  const mpfr_prec_t bits = 64 + mpfr_prec_t(mpz_sizeinbase(total->get_mpz_t(), 2));
  const Real round_angle =
      atan2(sqrt(Real(bits, Rational(-discriminant))), Real(bits, powers.trace()));
  const Integer after_middle = floor((Real::pi(bits) / round_angle).to_rational());
  return std::clamp(Integer(*total - after_middle), Integer(1), *total);
}

Real InelasticMotion::flight_after(const Integer& n, mpfr_prec_t good_bits) const {
  const InelasticNumbers now = numbers(n, good_bits + 4);
  return areal_velocity_before(n, good_bits + 4) / (now.speed * now.next_speed);
}

InelasticMotion::Pair InelasticMotion::after(CollisionKind kind, const Pair& before) const {
  const auto& [first, second] = before;
  if (kind == CollisionKind::wall) return {-wall_restitution * first, second};
  const Rational impulse = (1 + blocks_restitution) * (first - second) / (1 + ratio);
  return {first - impulse, second + ratio * impulse};
}

void InelasticMotion::find_first_collision() {
  const Rational to_wall = closing(CollisionKind::wall, rates);
  const Rational to_blocks = closing(CollisionKind::blocks, rates);
  if (to_wall <= 0 && to_blocks <= 0) return;
  collides = true;
  // Divided by a positive speed if there is one; the other cannot come first.
  const Rational between = gaps.second - gaps.first;
  blocks_first = to_blocks > 0 && (to_wall <= 0 || between * to_wall <= gaps.first * to_blocks);
  first_time = blocks_first ? Rational(between / to_blocks) : Rational(gaps.first / to_wall);
}

void InelasticMotion::find_sequences() {
  std::array<Rational, 5> speed;
  std::array<Rational, 5> reach;
  Pair velocity = rates;
  Pair place = gaps;
  bool blocks = blocks_first;
  for (std::size_t i = 0; i < speed.size(); ++i, blocks = !blocks) {
    const CollisionKind kind = blocks ? CollisionKind::blocks : CollisionKind::wall;
    speed[i] = closing(kind, velocity);
    reach[i] = -closing(kind, place);
    velocity = after(kind, velocity);
    place = after(kind, place);
  }
  for (std::size_t i = 0; i < speeds.size(); ++i) {
    speeds[i] = powers.sequence(speed[i], speed[i + 2]);
    reaches[i] = powers.sequence(reach[i], reach[i + 2]);
  }
}

std::optional<Integer> InelasticMotion::find_total() const {
  if (speeds[1].a <= 0) return 1;
  const std::optional<Integer> odd = powers.first_not_positive(speeds[0]);
  const std::optional<Integer> even = powers.first_not_positive(speeds[1]);
  std::optional<Integer> count;
  if (odd) count = 2 * *odd;
  if (even && (!count || 2 * *even + 1 < *count)) count = 2 * *even + 1;
  return count;
}

bool InelasticMotion::coincides_from(const Integer& n) const {
  if (areal_velocity == 0) return true;
  if (n == 1) return false;
  return restitution(kind(1)) == 0 || (n > 2 && powers.determinant() == 0);
}

std::optional<Real> InelasticMotion::collapse_time(mpfr_prec_t bits) const {
  if (total) return std::nullopt;
  if (areal_velocity == 0) return Real(bits, first_time);
  if (powers.lacks_greater(speeds[0])) return std::nullopt;
  return powers.limit_of_ratio(reaches[0], speeds[0], bits);
}

bool InelasticMotion::is_listed(const Integer& n) const {
  if (n == 1) return true;
  constexpr mpfr_prec_t kBits = 300;
  const auto energy = [&](const Real& u1, const Real& u2) {
    return Real(kBits, ratio) * u1 * u1 + u2 * u2;
  };
  const InelasticGaps before = gaps_after(n - 1, kBits);
  const Real least =
      scaled(energy(Real(kBits, rates.first), Real(kBits, rates.second)), -kEnergyLeft_bits);
  if ((energy(before.u1, before.u2) - least).sign() < 0) return false;
  if (coincides_from(n)) return true;
  const std::optional<Real> end = collapse_time(kBits);
  if (!end) return true;
  const InelasticNumbers now = numbers(n, kBits);
  const Real left = *end - now.reach / now.speed;
  const Real first_left = *end - Real(kBits, first_time);
  return (left - scaled(first_left, -kTimeLeft_bits)).sign() >= 0;
}

Integer InelasticMotion::find_listed() const {
  Integer not_listed = 1;
  while (is_listed(not_listed)) not_listed *= 2;
  Integer last = not_listed / 2;
  while (last + 1 < not_listed) {
    const Integer middle = (last + not_listed) / 2;
    (is_listed(middle) ? last : not_listed) = middle;
  }
  return last;
}

RoundSequence InelasticMotion::gap_at(std::size_t sequence, const Rational& time) const {
  const RoundSequence& speed = speeds[sequence];
  const RoundSequence& reach = reaches[sequence];
  return {reach.a - speed.a * time, reach.b - speed.b * time};
}

std::optional<Integer> InelasticMotion::odd_until(const Rational& time) const {
  if (areal_velocity == 0) return std::nullopt;
  // The first gap that is open, of those that collisions 1, 3, 5 … close.
  std::optional<Integer> odd = powers.first_positive(gap_at(0, time));
  if (total) {
    const Integer most = (*total + 1) / 2;
    if (!odd || *odd > most) odd = most;
  }
  if (!odd || 2 * *odd > listed) return std::nullopt;
  return odd;
}

Integer InelasticMotion::count_at(const Rational& time) const {
  if (!collides || time < first_time) return 0;
  const std::optional<Integer> odd = odd_until(time);
  if (!odd) return listed;
  const Real gap = powers.terms({gap_at(1, time)}, *odd - 1, kSign_bits).front();
  return gap.sign() > 0 ? Integer(2 * *odd - 1) : Integer(2 * *odd);
}

std::pair<Integer, InelasticGaps> InelasticMotion::state_at(const Rational& time,
                                                            mpfr_prec_t good_bits) const {
  const std::optional<Integer> odd = odd_until(time);
  if (!odd) return {listed, gaps_at(time, listed, good_bits)};
  // As in count_at(), with the numbers of both cases from the same powers.
  const mpfr_prec_t bits = good_bits + 8;
  const std::vector<Real> terms = powers.terms(
      {gap_at(0, time), gap_at(1, time), gap_at(2, time), speeds[0], speeds[1], speeds[2]},
      *odd - 1, bits);
  const bool after_even = terms[1].sign() <= 0;
  const std::size_t i = after_even ? 1 : 0;
  Integer count = 2 * *odd - (after_even ? 0 : 1);
  InelasticGaps now = folded(count, -terms[i], terms[i + 1], terms[i + 3], terms[i + 4], good_bits);
  return {std::move(count), std::move(now)};
}

InelasticNumbers InelasticMotion::numbers(const Integer& n, mpfr_prec_t good_bits) const {
  const std::size_t i = sequence_of(n);
  const std::vector<Real> terms =
      powers.terms({speeds[i], reaches[i], speeds[i + 1]}, round_of(n), good_bits);
  return {terms[0], terms[1], terms[2]};
}

InelasticGaps InelasticMotion::folded(const Integer& n, const Real& opened, const Real& to_close,
                                      const Real& speed, const Real& next_speed,
                                      mpfr_prec_t good_bits) const {
  const CollisionKind met = kind(n);
  const Real share(speed.bits(), restitution(met));
  const Real apart = share * opened;
  const Real away = share * speed;
  const Real u2 = clean_difference(away, next_speed, good_bits - 8);
  if (met == CollisionKind::wall) return {apart, apart + to_close, away, u2};
  return {to_close, to_close + apart, -next_speed, u2};
}

InelasticGaps InelasticMotion::gaps_at(const Rational& time, const Integer& n,
                                       mpfr_prec_t good_bits) const {
  const std::size_t i = sequence_of(n);
  const std::vector<Real> terms = powers.terms(
      {gap_at(i, time), gap_at(i + 1, time), speeds[i], speeds[i + 1]}, round_of(n), good_bits + 8);
  return folded(n, -terms[0], terms[1], terms[2], terms[3], good_bits);
}

Real InelasticMotion::areal_velocity_before(const Integer& n, mpfr_prec_t good_bits) const {
  const Rational at_first = abs(areal_velocity) * (sequence_of(n) == 1 ? restitution(kind(1)) : 1);
  return Real(good_bits + 2, at_first) * powers.determinant_power(round_of(n), good_bits + 2);
}

InelasticGaps InelasticMotion::gaps_after(const Integer& n, const InelasticNumbers& now,
                                          mpfr_prec_t good_bits) const {
  const Real to_close = areal_velocity_before(n, good_bits + 8) / now.speed;
  return folded(n, Real(good_bits, 0), to_close, now.speed, now.next_speed, good_bits);
}

Real InelasticMotion::sum(const RoundSequence& z, const Integer& first, const Integer& last,
                          mpfr_prec_t good_bits) const {
  if (first == last) return powers.terms({z}, first, good_bits).front();
  // With x_k = (T - 1) z_k - z_{k+1} the sum is (x_{last+1} - x_first)/(1 - T + D).
  const Rational& trace = powers.trace();
  const Rational next = (trace * z.a + z.b) / 2;
  const Rational next_b = trace * next - 2 * powers.determinant() * z.a;
  const RoundSequence x{(trace - 1) * z.a - next, (trace - 1) * z.b - next_b};
  const Rational share = 1 - trace + powers.determinant();
  for (mpfr_prec_t bits = good_bits + 64; bits <= kMaxDecisionBits; bits *= 2) {
    const Real begin = powers.terms({x}, first, bits).front();
    const Real end = powers.terms({x}, last + 1, bits).front();
    const Real difference = end - begin;
    const long lost = std::max(begin.exponent(), end.exponent()) - difference.exponent();
    if (difference.sign() != 0 && lost + good_bits + 4 <= bits) {
      return difference / Real(bits, share);
    }
    if (begin.sign() == 0 && end.sign() == 0) return difference;
  }
  throw SimulationError(fmt::format("impulse: {} bits do not give the sum", kMaxDecisionBits));
}

InelasticSums InelasticMotion::sums(const Integer& first, const Integer& last,
                                    mpfr_prec_t good_bits) const {
  const std::size_t i = sequence_of(first);
  return {sum(speeds[i], round_of(first), round_of(last), good_bits),
          sum(reaches[i], round_of(first), round_of(last), good_bits)};
}

Rational InelasticMotion::rounded_time(const Integer& n, mpfr_prec_t bits) const {
  const InelasticNumbers now = numbers(n, bits);
  const Real time = now.reach / now.speed;
  const Real flight = now.next_speed.sign() > 0 ? flight_after(n, bits) : time;
  const long grid = flight.exponent() - kTimeGrid_bits;
  const Rational unit = scaled(Real(64, 1), grid).to_rational();
  const Rational up = time.to_rational() + scaled(time, 4 - bits).to_rational();
  return Rational(ceil(up / unit)) * unit;
}

Rational InelasticMotion::time_past(const Integer& n) const {
  const bool coincides = coincides_from(n);
  // In the corner that comes after collision 2 at the latest.
  const Integer first = coincides && n > 3 ? Integer(3) : n;
  const std::size_t i = sequence_of(first);
  const Integer k = round_of(first);
  const double max_bits = coincides ? HUGE_VAL : kShortTime_bits;
  if (const auto reach = powers.exact_term(reaches[i], k, max_bits)) {
    return *reach / *powers.exact_term(speeds[i], k, max_bits);
  }
  constexpr mpfr_prec_t kFirst_bits = 256;
  for (mpfr_prec_t bits = kFirst_bits; bits <= kMaxDecisionBits; bits *= 2) {
    Rational time = rounded_time(n, bits);
    if (count_at(time) == n) return time;
  }
  throw SimulationError(
      fmt::format("collision: {} bits do not tell its time from the next one's", kMaxDecisionBits));
}

}  // namespace piblocks
