// What all engines do with blocks, and the engines that go from collision to collision.
// In: exact values. Out: doubles, problems, exceptions; logs that are held in memory.
#pragma once

#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/run.hpp>

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

/// In messages a Rational is what to_text() makes of it.
template <>
struct fmt::formatter<piblocks::Rational> : fmt::formatter<std::string> {
  template <typename Context>
  auto format(const piblocks::Rational& value, Context& context) const {
    return fmt::formatter<std::string>::format(piblocks::to_text(value), context);
  }
};

namespace piblocks {

inline Motion motion_of(const Block& block) {
  return {to_double(block.position), to_double(block.velocity)};
}

/// The motion at a time until which the block meets nothing, rounded once.
inline Motion motion_at(const Block& block, const Rational& time) {
  return {to_double(block.position + block.velocity * time), to_double(block.velocity)};
}

inline Motion reversed(const Motion& motion) { return {motion.position, -motion.velocity}; }

/// The same blocks with opposite velocities: what they do is the past of `system`, backwards.
inline TwoBlocks reversed(TwoBlocks system) {
  system.blue.velocity = -system.blue.velocity;
  system.red.velocity = -system.red.velocity;
  return system;
}

inline bool is_finite(const Rational& value) { return std::isfinite(to_double(value)); }

/// Collects what is wrong with the values of a scene.
class SceneProblems {
 public:
  /// @param list  known already.
  explicit SceneProblems(std::vector<Problem> list = {}) : list_(std::move(list)) {}
  /// @param reason, args  as fmt::format() takes them.
  template <typename... Args>
  void add(const std::string& key, fmt::format_string<const Args&...> reason, const Args&... args) {
    list_.push_back({key, fmt::format(reason, args...)});
  }
  template <typename... Args>
  void require(bool holds, const std::string& key, fmt::format_string<const Args&...> reason,
               const Args&... args) {
    if (!holds) add(key, reason, args...);
  }
  void require_positive(const std::string& key, const Rational& value) {
    require(value > 0, key, "= {}: must be greater than 0", value);
  }
  void require_finite(const std::string& key, const Rational& value) {
    require(is_finite(value), key, "is beyond the range of a double (about 1.8e308)");
  }
  bool empty() const { return list_.empty(); }
  std::vector<Problem> take() { return std::move(list_); }

 private:
  std::vector<Problem> list_;
};

/// @throws SceneError that lists the problems, if there are any.
void require_valid(const std::vector<Problem>& problems);

/// @param engine  named in the message.
/// @throws SimulationError if a number is not finite.
void require_finite(const Time& time, const Motion& blue, const Motion& red, const char* engine);

/// The collision is not the last one at its time.
class TiedCollision : public UsageError {
 public:
  TiedCollision(const Integer& index, Integer last);
  const Integer& last() const noexcept { return last_; }

 private:
  Integer last_;
};

/// Collisions that happen at the same time have no instant between them.
/// @throws TiedCollision unless the collision is the last one at its time.
void require_last(const Integer& index, const Integer& last_at_its_time);

/// As make_collision_log() of a system without problems, which has two_blocks_of().
std::unique_ptr<CollisionLog> make_valid_collision_log(const BodySystem& system,
                                                       Engine engine = Engine::unfolded);

/// The event loop in exact rational arithmetic, for the few collisions of a light red block. Every
/// answer is rounded once.
/// @param system  with m_red <= m_blue, or at rest.
std::unique_ptr<CollisionLog> make_exact_log(const BodySystem& system);

/// Engine::events, which advances positions to the next collision of any pair, in double precision.
/// @throws UsageError if the collisions are more than kMaxStoredCollisions.
/// @throws SimulationError if a number leaves its range, or the rounding of double precision more
///         than doubles the number of collisions.
std::unique_ptr<CollisionLog> make_stored_log(const BodySystem& system);

/// Name and version of each library of numbers that is linked, such as "MPFR 4.2.0".
std::vector<std::string> physics_library_versions();

}  // namespace piblocks
