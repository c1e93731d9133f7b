// By how much something is enlarged that becomes smaller and smaller.
// In: how many times as large it may become. Out: a power of ten, or a step between two.
#pragma once

#include <functional>
#include <vector>

namespace piblocks {

/// The logarithm to base 2, exact at powers of two and straight between them. Unlike std::log2() it
/// is the same on every machine. @param x  > 0
double straight_log2(double x);
/// Its inverse.
double straight_exp2(double y);

/// How long a zoom takes from one level to the next, in seconds of video.
inline constexpr double kZoomEase_s = 0.4;

/// A level that changes in steps, with steps that take kZoomEase_s. It never exceeds
/// level_at(0): it starts to rise when level_at() rises, and has fallen by the time level_at()
/// falls. A higher level that lasts less than kZoomEase_s is left out. The result depends on the
/// moment alone.
/// @param level_at  the level so many seconds of video from now, at most kZoomEase_s; between steps
///                  it is asked for a few times only
double eased_level(const std::function<int(double from_now_s)>& level_at);

/// As the room for the gap grows, the zoom stays at each power of ten for a part of the way to the
/// next, and then rises to the next. It is continuous and never falls.
class Zoom {
 public:
  /// The share of the way from one power of ten to the next, on a logarithmic scale, in which the
  /// zoom stays. Half of the way is about a factor of three.
  static constexpr double kPlateau = 0.5;

  /// @param most_exponent  of the largest power of ten, at least 1
  explicit Zoom(long most_exponent, double plateau = kPlateau);

  /// At most `room`, unless that is below 1. @param room  > 0, may be infinite
  double factor_for(double room) const;
  double power(long exponent) const { return powers_.at(static_cast<std::size_t>(exponent)); }
  long most_exponent() const noexcept { return static_cast<long>(powers_.size()) - 1; }
  /// Of the greatest power of ten that is not above a zoom.
  long exponent_of(double zoom) const;

 private:
  double plateau_;
  std::vector<double> powers_;  ///< 1, 10, 100, …
};

}  // namespace piblocks
