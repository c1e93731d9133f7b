// Several contacts at one instant, taken as one: what the velocities are then.
// In: touching bodies and their velocities. Out: velocities, and their bounds.
// src/physics/README.md, "Contacts at once", has the rule and derives the bounds.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "physics/discs/disc_system.hpp"

namespace piblocks::discs {

/// The share of the sum of the radii within which bodies count as touching, and the share of the
/// greatest speed below which they do not count as approaching.
inline constexpr double kTouch = 0x1p-40;

struct Touch {
  std::uint32_t first = 0;   ///< a movable disc
  std::uint32_t second = 0;  ///< a disc, or the number of discs + a wall
  Vector normal = {};        ///< of length 1, from the first to the second
  double normal_error = 0;   ///< bound of the length of the normal's error
  double restitution = 1;
};

/// Impulses of touches that approach each other, all at once.
struct Stage {
  std::vector<Touch> touches = {};
  std::vector<double> closing = {};   ///< of each touch, the speed
  std::vector<double> impulses = {};  ///< of each touch, > 0
  std::vector<double> matrix = {};    ///< G, row by row
  double trace = 0;                   ///< of G
  double inverse_trace = 0;           ///< of its inverse
  bool has_dropped = false;           ///< whether some would have pulled, and were left out

  double influence(std::size_t one, std::size_t other) const {
    return matrix[one * touches.size() + other];
  }
  /// Whether an order would matter.
  bool is_tied() const;
};

/// At what speed two that touch approach each other.
double closing_speed(const DiscSystem& system, const Touch& touch);

/// Without touches if none approaches. Nothing if their normals depend on each other, so that the
/// impulses are not determined, or if they are too many.
/// @param touches      of which those approach that close in at more than least_speed
std::optional<Stage> stage_of(const DiscSystem& system, const std::vector<Touch>& touches,
                              double least_speed);

/// Widens the bounds of the velocities for what apply() will change. @return whether the bounds
/// hold: if not, rounding may have changed which touches approach, or with what impulses
bool widen(DiscSystem& system, const Stage& stage);
void apply(DiscSystem& system, const Touch& touch, double impulse);

/// Whether each touch surely approaches at more than that speed, or surely does not.
bool are_decided(const DiscSystem& system, const std::vector<Touch>& touches, double least_speed);

}  // namespace piblocks::discs
