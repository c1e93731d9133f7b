// Contact: when two bodies meet, what their velocities are then, and who is first of several.
// In: gaps, speeds and masses. Out: times, changes of velocity, an order of pairs.
// Scalar is double, long double, a Boost.Multiprecision float or Rational.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <tuple>

namespace piblocks {

/// The mass of a body that no collision moves. Of exact numbers such a mass is std::nullopt.
template <typename Scalar>
inline const Scalar kInfiniteMass = std::numeric_limits<Scalar>::infinity();

/// How long until a gap closes. Nothing if it does not: a gap that keeps its width does not close.
/// @param gap      between two bodies; below 0 if they overlap, by rounding for example
/// @param closing  the speed at which they approach each other
template <typename Scalar>
std::optional<Scalar> time_to_contact(const Scalar& gap, const Scalar& closing) {
  if (!(closing > 0)) return std::nullopt;
  if (!(gap > 0)) return Scalar(0);
  return Scalar(gap / closing);
}

/// The share of a change of relative velocity that the body of mass `own` gets: `other` / (`own` +
/// `other`). At most one mass is infinite.
template <typename Scalar>
Scalar share_of_change(const Scalar& own, const Scalar& other) {
  const Scalar sum = own + other;
  if constexpr (std::numeric_limits<Scalar>::has_infinity) {
    if (other == kInfiniteMass<Scalar>) return Scalar(1);
    // If the sum overflows, this quotient is as good. It rounds once more.
    if (own < sum && sum == kInfiniteMass<Scalar>) {
      return Scalar(Scalar(1) / (Scalar(1) + own / other));
    }
  }
  return Scalar(other / sum);
}

/// The same of masses that may be missing.
template <typename Scalar>
Scalar share_of_change(const std::optional<Scalar>& own, const std::optional<Scalar>& other) {
  if (!own) return Scalar(0);
  if (!other) return Scalar(1);
  return Scalar(*other / (*own + *other));
}

/// By how much a collision without friction changes a body's velocity along the line of centres,
/// away from the other body (Landau & Lifshitz, Mechanics, section 17).
/// @param closing      the speed at which the two approach each other
/// @param share        share_of_change() of this body
/// @param restitution  the share of that speed with which they part, 0 … 1
template <typename Scalar>
Scalar velocity_change(const Scalar& closing, const Scalar& share,
                       const Scalar& restitution = Scalar(1)) {
  return Scalar(Scalar(1 + restitution) * closing * share);
}

/// The place of a pair among all that meet at one instant: pairs of movable bodies come first, then
/// those with something immovable; each in the order of their numbers. This is the order that
/// counts pi. Renumbering immovable bodies does not change the order of movable ones.
struct TieRank {
  bool has_immovable = false;
  std::uint32_t first = 0;   ///< the lower number; beside an immovable body the movable one's
  std::uint32_t second = 0;  ///< the other

  /// At most one of the two is immovable.
  static constexpr TieRank of(std::uint32_t a, bool is_a_movable, std::uint32_t b,
                              bool is_b_movable) {
    if (is_a_movable && is_b_movable) return {false, std::min(a, b), std::max(a, b)};
    return is_a_movable ? TieRank{true, a, b} : TieRank{true, b, a};
  }
  friend constexpr bool operator<(const TieRank& a, const TieRank& b) {
    return std::tie(a.has_immovable, a.first, a.second) <
           std::tie(b.has_immovable, b.first, b.second);
  }
};

}  // namespace piblocks
