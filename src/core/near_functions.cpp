#include "core/near_functions.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "core/two_sum.hpp"

// A table reduces the argument to a small rest. A short polynomial gives the function of the rest.
// The table and the first terms have two doubles; only terms below 2^-19 of the value have one. So
// each error is at most a few times 2^-72 of the value.

namespace piblocks::near {
namespace {

constexpr double kOutside = std::numeric_limits<double>::quiet_NaN();
constexpr DoubleDouble outside() { return {0, kOutside}; }

// Arithmetic of double-doubles, right to about 2^-102, for the tables.

constexpr DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
  const DoubleDouble sum = two_sum(a.hi, b.hi);
  const DoubleDouble rest = two_sum(a.lo, b.lo);
  const DoubleDouble nearly = ordered_sum(sum.hi, sum.lo + rest.hi);
  return ordered_sum(nearly.hi, nearly.lo + rest.lo);
}
constexpr DoubleDouble operator-(const DoubleDouble& a) { return {-a.hi, -a.lo}; }
constexpr DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
  const DoubleDouble product = split_product(a.hi, b.hi);
  return ordered_sum(product.hi, product.lo + (a.hi * b.lo + a.lo * b.hi));
}
constexpr DoubleDouble operator/(const DoubleDouble& a, const DoubleDouble& b) {
  const double first = a.hi / b.hi;
  const DoubleDouble rest = a + -(DoubleDouble{first, 0} * b);
  const double second = rest.hi / b.hi;
  const DoubleDouble after = rest + -(DoubleDouble{second, 0} * b);
  return DoubleDouble{first, 0} + DoubleDouble{second, after.hi / b.hi};
}

/// The sum of first power^n / divisor(n) for n = 0, 1, …, until nothing is added.
template <typename Divisor>
constexpr DoubleDouble series(DoubleDouble first, const DoubleDouble& power,
                              const Divisor& divisor) {
  DoubleDouble sum{0, 0};
  for (int n = 0;; ++n) {
    const DoubleDouble term = first / DoubleDouble{divisor(n), 0};
    const DoubleDouble next = sum + term;
    if (next == sum) return sum;
    sum = next;
    first = first * power;
  }
}
constexpr double factorial(int n) { return n < 2 ? 1 : n * factorial(n - 1); }

constexpr DoubleDouble kPi{0x1.921fb54442d18p+1, 0x1.1a62633145c07p-53};
constexpr double kPiThird = -0x1.f1976b7ed8fbcp-109;
constexpr DoubleDouble kLn2{0x1.62e42fefa39efp-1, 0x1.abc9e3b39803fp-56};

/// x rounded to a multiple of `unit`. For |x| < 2^51 unit.
constexpr double to_multiple(double x, double unit) {
  const double shift = 0x1.8p52 * unit;
  return (x + shift) - shift;
}

/// 2^exponent, a normal number.
double power_of_two(std::int64_t exponent) {
  return std::bit_cast<double>(std::uint64_t(exponent + 1023) << 52);
}

/// The sum of both, the rest being below 2^-16 of the first.
DoubleDouble with_rest(const DoubleDouble& sum, double rest) {
  return ordered_sum(sum.hi, sum.lo + rest);
}

// ---- sine and cosine: x = k pi/1024 + r, |r| < 2^-9.3

constexpr int kSteps = 1024;          // in pi
constexpr int kQuarter = kSteps / 4;  // of pi

/// At index * pi/1024.
struct Turn {
  DoubleDouble sine;
  DoubleDouble cosine;
};

constexpr std::array<Turn, kQuarter + 1> make_turns() {
  const DoubleDouble step = kPi / DoubleDouble{kSteps, 0};
  const DoubleDouble minus_square = -(step * step);
  const Turn first{series(step, minus_square, [](int n) { return factorial(2 * n + 1); }),
                   series({1, 0}, minus_square, [](int n) { return factorial(2 * n); })};
  std::array<Turn, kQuarter + 1> turns{};
  turns[0] = {{0, 0}, {1, 0}};
  for (std::size_t i = 1; i < turns.size(); ++i) {
    const auto& [sine, cosine] = turns[i - 1];
    turns[i] = {sine * first.cosine + cosine * first.sine,
                cosine * first.cosine + -(sine * first.sine)};
  }
  return turns;
}
constexpr auto kTurns = make_turns();

/// pi/1024 as two numbers of 33 bits, multiples of which are exact up to 2^20, and a rest.
constexpr std::array<double, 3> split_step() {
  const double high = to_multiple(kPi.hi, 0x1p-31);
  const DoubleDouble rest = two_sum(kPi.hi - high, kPi.lo);
  const double middle = to_multiple(rest.hi, 0x1p-64);
  const double low = (rest.hi - middle) + (rest.lo + kPiThird);
  return std::array{high / kSteps, middle / kSteps, low / kSteps};
}
constexpr auto kStepParts = split_step();

/// An argument of sine and cosine: a multiple of pi/2, an angle of the table, and a rest.
struct ReducedAngle {
  explicit ReducedAngle(double x) {
    const double k = to_multiple(x * (kSteps / kPi.hi), 1);
    // Both differences are exact: x and the products are multiples of small units. The rest of
    // pi/1024 is rounded at 2^-109, which is all the error of r.
    const DoubleDouble difference = two_sum(x - k * kStepParts[0], -(k * kStepParts[1]));
    rest = ordered_sum(difference.hi, difference.lo - k * kStepParts[2]);
    const auto index = static_cast<std::int64_t>(k);
    quadrant = (index + kQuarter) >> 9;
    const std::int64_t in_quadrant = index - (quadrant << 9);
    const Turn& turn = kTurns[std::size_t(in_quadrant < 0 ? -in_quadrant : in_quadrant)];
    sine = in_quadrant < 0 ? -turn.sine : turn.sine;
    cosine = turn.cosine;
    // Near a multiple of pi/2 one of both values is r itself, whose relative error is 2^-70 here.
    vanishes = in_quadrant == 0 && index != 0 && std::fabs(rest.hi) < 0x1p-37;
    const double square = rest.hi * rest.hi;
    cosine_less_1 =
        square * (-1.0 / 2 + square * (1.0 / 24 - square * (1.0 / 720))) - rest.hi * rest.lo;
    sine_less_r = rest.hi * (square * (-1.0 / 6 + square * (1.0 / 120 - square * (1.0 / 5040))));
  }

  /// a cos r + b sin r, for a = 0 or |a| > 2^-8.4, |a|, |b| <= 1. cos r - 1 is below 2^-19.6: its
  /// three roundings and the four of the sums below are less than 2^-70 of a, and a is at most
  /// twice the result. sin r - r is below 2^-21.2 of r. What the series lack is below 2^-89.
  DoubleDouble turned(const DoubleDouble& a, const DoubleDouble& b) const {
    const DoubleDouble product = split_product(b.hi, rest.hi);
    const double small = product.lo + (b.hi * rest.lo + b.lo * rest.hi);
    return with_rest(two_sum(a.hi, product.hi),
                     (a.hi * cosine_less_1 + b.hi * sine_less_r) + (small + a.lo));
  }
  DoubleDouble sine_in_quadrant() const { return vanishes ? outside() : turned(sine, cosine); }
  DoubleDouble cosine_in_quadrant() const { return turned(cosine, -sine); }

  /// The sine after so many more quarters of a turn.
  DoubleDouble sine_after(std::int64_t quarters) const {
    const std::int64_t all = quadrant + quarters;
    const DoubleDouble value = (all & 1) != 0 ? cosine_in_quadrant() : sine_in_quadrant();
    return (all & 2) != 0 ? -value : value;
  }

  DoubleDouble rest;
  std::int64_t quadrant;
  DoubleDouble sine;
  DoubleDouble cosine;
  bool vanishes;
  double cosine_less_1;
  double sine_less_r;
};

bool is_turn_at_hand(double x) { return std::fabs(x) >= 0x1p-27 && std::fabs(x) <= 0x1p10; }

// ---- exp: x = k ln 2/256 + r, |r| < 2^-9.5

constexpr int kPowers = 256;

/// 2^(index/256)
constexpr std::array<DoubleDouble, kPowers> make_roots() {
  const DoubleDouble step = kLn2 / DoubleDouble{kPowers, 0};
  const DoubleDouble root = series({1, 0}, step, factorial);
  std::array<DoubleDouble, kPowers> roots{};
  roots[0] = {1, 0};
  for (std::size_t i = 1; i < roots.size(); ++i) roots[i] = roots[i - 1] * root;
  return roots;
}
constexpr auto kRoots = make_roots();

/// ln 2/256: 33 bits and a double. Together they are right to 2^-95.
constexpr double kPowerHigh = to_multiple(kLn2.hi, 0x1p-33) / kPowers;
constexpr double kPowerLow = ((kLn2.hi - kPowerHigh * kPowers) + kLn2.lo) / kPowers;

// ---- log: x = 2^k m, 3/4 <= m < 3/2; m = (1 + z)/c, |z| < 2^-8.4 or, for c = 1, 2^-9

constexpr int kReciprocals = 256;                               // for each unit of m
constexpr int kFirstReciprocal = 192;                           // of m = 3/4
constexpr std::int64_t kThreeQuarters = 0x3fe8'0000'0000'0000;  // bits of 3/4

struct Reciprocal {
  double value = 0;  ///< c, of 12 bits
  DoubleDouble log;  ///< -ln c
};

constexpr std::array<Reciprocal, kFirstReciprocal + 1> make_reciprocals() {
  std::array<Reciprocal, kFirstReciprocal + 1> table{};
  for (std::size_t i = 0; i < table.size(); ++i) {
    const double c = to_multiple(kReciprocals / double(i + kFirstReciprocal), 0x1p-11);
    // ln c = 2 artanh((c - 1)/(c + 1))
    const DoubleDouble q = DoubleDouble{c - 1, 0} / DoubleDouble{c + 1, 0};
    const DoubleDouble minus_2q{-2 * q.hi, -2 * q.lo};
    table[i] = {c, series(minus_2q, q * q, [](int n) { return 2.0 * n + 1; })};
  }
  return table;
}
constexpr auto kReciprocalTable = make_reciprocals();

/// ln 2: 42 bits and a double. Together they are right to 2^-96.
constexpr double kLn2High = to_multiple(kLn2.hi, 0x1p-42);
constexpr double kLn2Low = (kLn2.hi - kLn2High) + kLn2.lo;

/// Of a normal x.hi > 0. The cube of z and what follows are below 2^-19 of the result: the cube's
/// five roundings are less than 2^-69.7. The square and all else of the result have two doubles.
/// Nothing cancels: |k| ln 2 is more than twice |ln m|, and |ln m| > 2^-9.1 unless c = 1.
DoubleDouble log_of(const DoubleDouble& x) {
  const auto bits = std::bit_cast<std::int64_t>(x.hi);
  const std::int64_t k = (bits - kThreeQuarters) >> 52;
  const auto m = std::bit_cast<double>(bits - (k << 52));
  const double m_low = x.lo == 0 ? 0 : x.lo * power_of_two(-k);
  const auto& [c, log_c] =
      kReciprocalTable[std::size_t(to_multiple(m * kReciprocals, 1)) - kFirstReciprocal];
  const DoubleDouble product = split_product(m, c);
  const DoubleDouble z = two_sum(product.hi - 1, product.lo + m_low * c);
  const DoubleDouble square = split_product(z.hi, z.hi);
  constexpr std::array kFactors{1.0 / 9, 1.0 / 8, 1.0 / 7, 1.0 / 6, 1.0 / 5, 1.0 / 4, 1.0 / 3};
  double factor = 1.0 / 10;
  for (const double next : kFactors) factor = next - z.hi * factor;
  const DoubleDouble log_z = ordered_sum(z.hi, -square.hi / 2);
  const double rest_z = (z.lo - square.lo / 2 - z.hi * z.lo) + square.hi * z.hi * factor;
  const DoubleDouble table = two_sum(double(k) * kLn2High, log_c.hi);
  const DoubleDouble sum = two_sum(table.hi, log_z.hi);
  return with_rest(sum, ((table.lo + log_c.lo) + (log_z.lo + double(k) * kLn2Low)) + rest_z);
}

// ---- arc tangent of n/d, 0 <= n <= d: arctan(i/256) + arctan r, |r| < 2^-8.99

constexpr int kArcs = 256;

/// arctan(index/256)
constexpr std::array<DoubleDouble, kArcs + 1> make_arcs() {
  std::array<DoubleDouble, kArcs + 1> table{};
  for (std::size_t i = 1; i < table.size(); ++i) {
    // Of the difference of both angles.
    const DoubleDouble product{double(i - 1) * double(i), 0};
    const DoubleDouble tangent =
        DoubleDouble{kArcs, 0} / (DoubleDouble{kArcs * kArcs, 0} + product);
    table[i] =
        table[i - 1] + series(tangent, -(tangent * tangent), [](int n) { return 2.0 * n + 1; });
  }
  return table;
}
constexpr auto kArcTable = make_arcs();

/// (n - i/256 d)/(d + i/256 n). The numerator is exact where it is small beside n; the quotient is
/// right to 2^-100.
DoubleDouble rest_of_tangent(double n, double d, double arc) {
  const DoubleDouble from = split_product(arc, d);
  const DoubleDouble difference = two_sum(n, -from.hi);
  const DoubleDouble numerator = two_sum(difference.hi, difference.lo - from.lo);
  const DoubleDouble more = split_product(arc, n);
  const DoubleDouble sum = two_sum(d, more.hi);
  const DoubleDouble denominator = ordered_sum(sum.hi, sum.lo + more.lo);
  const double quotient = numerator.hi / denominator.hi;
  const DoubleDouble product = split_product(quotient, denominator.hi);
  const double remainder =
      ((numerator.hi - product.hi) - product.lo) + (numerator.lo - quotient * denominator.lo);
  return ordered_sum(quotient, remainder / denominator.hi);
}

bool is_moderate(double x) { return std::fabs(x) >= 0x1p-480 && std::fabs(x) <= 0x1p480; }

}  // namespace

DoubleDouble sin(double x) {
  return is_turn_at_hand(x) ? ReducedAngle(x).sine_after(0) : outside();
}

DoubleDouble cos(double x) {
  return is_turn_at_hand(x) ? ReducedAngle(x).sine_after(1) : outside();
}

SinCos sin_cos(double x) {
  if (!is_turn_at_hand(x)) return {outside(), outside()};
  const ReducedAngle angle(x);
  return {angle.sine_after(0), angle.sine_after(1)};
}

/// The square of r is below 2^-20 of the result, and its eight roundings are less than 2^-70.
DoubleDouble exp(double x) {
  if (!(std::fabs(x) <= 600)) return outside();
  const double k = to_multiple(x * (kPowers / kLn2.hi), 1);
  const DoubleDouble r = two_sum(x - k * kPowerHigh, -(k * kPowerLow));
  const auto index = static_cast<std::int64_t>(k);
  const DoubleDouble& root = kRoots[std::size_t(index) % kPowers];
  constexpr std::array kFactors{1.0 / 120, 1.0 / 24, 1.0 / 6, 1.0 / 2};
  double factor = 1.0 / 720;
  for (const double next : kFactors) factor = next + r.hi * factor;
  const double rest = r.lo + (r.hi * r.lo + r.hi * r.hi * factor);
  const DoubleDouble product = split_product(root.hi, r.hi);
  const DoubleDouble value = with_rest(ordered_sum(root.hi, product.hi),
                                       (product.lo + (root.lo + root.lo * r.hi)) + root.hi * rest);
  const double scale = power_of_two(index >> 8);
  return {value.hi * scale, value.lo * scale};
}

DoubleDouble log(double x) {
  constexpr double kLeast = std::numeric_limits<double>::min();
  constexpr double kMost = std::numeric_limits<double>::max();
  return x >= kLeast && x <= kMost ? log_of({x, 0}) : outside();
}

DoubleDouble log1p(double x) {
  if (!(x > -1 + 0x1p-53 && std::fabs(x) >= 0x1p-60 && x <= 0x1p900)) return outside();
  return log_of(two_sum(1, x));
}

/// The cube of r is below 2^-19.5 of the result, and its roundings are less than 2^-70. Nothing
/// cancels: the angle of the table is at least 2^-8 or 0, and 2 |r|.
DoubleDouble atan2(double y, double x) {
  if (!is_moderate(y) || !is_moderate(x)) return outside();
  const double up = std::fabs(y);
  const double along = std::fabs(x);
  const bool is_steep = up > along;
  const double n = is_steep ? along : up;
  const double d = is_steep ? up : along;
  const auto index = static_cast<std::size_t>(to_multiple(n / d * kArcs, 1));
  const DoubleDouble r = rest_of_tangent(n, d, double(index) / kArcs);
  const double square = r.hi * r.hi;
  const double cube = r.hi * (square * (-1.0 / 3 + square * (1.0 / 5 - square * (1.0 / 7))));
  const DoubleDouble& arc = kArcTable[index];
  const DoubleDouble angle = with_rest(two_sum(arc.hi, r.hi), cube + (arc.lo + r.lo));

  const double quarters = is_steep ? 1 : x < 0 ? 2 : 0;
  const double sign = is_steep == (x < 0) ? 1 : -1;
  const DoubleDouble sum = two_sum(quarters * (kPi.hi / 2), sign * angle.hi);
  const DoubleDouble value = with_rest(sum, quarters * (kPi.lo / 2) + sign * angle.lo);
  return y < 0 ? -value : value;
}

/// The root's correction is right to 2^-51 of itself, which is below 2^-52 of the root.
DoubleDouble hypot(double a, double b) {
  if (!is_moderate(a) || !is_moderate(b)) return outside();
  const DoubleDouble a_square = split_product(a, a);
  const DoubleDouble b_square = split_product(b, b);
  const DoubleDouble sum = two_sum(a_square.hi, b_square.hi);
  const double root = std::sqrt(sum.hi);
  const DoubleDouble square = split_product(root, root);
  const double rest = (sum.hi - square.hi) + ((sum.lo - square.lo) + (a_square.lo + b_square.lo));
  return ordered_sum(root, rest / (2 * root));
}

}  // namespace piblocks::near
