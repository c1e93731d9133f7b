// What is wrong with the values of a scene.
// In: exact values. Out: problems with keys and reasons; the exception that lists them.
#pragma once

#include <fmt/format.h>
#include <piblocks/exact.hpp>
#include <piblocks/system.hpp>

#include <cmath>
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

inline bool is_finite(const Rational& value) { return std::isfinite(to_double(value)); }

/// Collects what is wrong with the values of a scene.
class SceneProblems {
 public:
  /// @param list  known already.
  explicit SceneProblems(std::vector<Problem> list = {}) : list_(std::move(list)) {}
  /// @param reason, args  as fmt::format() takes them.
  template <typename... Args>
  void add(const std::string& key, fmt::format_string<const Args&...> reason, const Args&... args) {
    add_item(key, "", reason, args...);
  }
  template <typename... Args>
  void require(bool holds, const std::string& key, fmt::format_string<const Args&...> reason,
               const Args&... args) {
    if (!holds) add(key, reason, args...);
  }
  /// About one of a key's list. @param item  as of Problem
  template <typename... Args>
  void add_item(const std::string& key, const std::string& item,
                fmt::format_string<const Args&...> reason, const Args&... args) {
    list_.push_back({key, fmt::format(reason, args...), item});
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

/// What messages call a body.
std::string name_of(const System& system, std::size_t body);
/// Of a value of it.
std::string key_of(const System& system, std::size_t body, const char* value);
/// As in "the left wall", or "the wall".
std::string noun_of(const Wall& wall);

/// Of vectors of a plane; it is exact.
inline Rational dot(const ExactVector& a, const ExactVector& b) {
  return a[0] * b[0] + a[1] * b[1];
}

/// Bodies that overlap, or are beyond a wall: by how much. Touching is allowed. It takes about
/// n log n steps for n bodies. @param system  whose numbers are right
void check_overlaps(const System& system, SceneProblems& problems);

/// @throws SceneError that lists the problems, if there are any.
void require_valid(const std::vector<Problem>& problems);

}  // namespace piblocks
