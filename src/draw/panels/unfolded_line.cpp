#include "draw/panels/unfolded_line.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/rounded.hpp"
#include "draw/number_text.hpp"
#include "scene/counted_pi.hpp"

namespace piblocks {
namespace {

/// Of the area's height.
constexpr double kLevel = 0.2;
/// What is farther from the corner than so many times the farthest crossing is not shown.
constexpr double kWidest = 4;
/// More mirrors than these have no true angles, and run together.
constexpr int kMostTrueMirrors = 40;
/// The part of the width between the first crossing and the last, with true angles.
constexpr double kCrossedShare = 0.94;
/// Radius of the arc: of the way to the nearer of the outer crossings, and of the line's height.
constexpr double kArcShare = 0.72;
constexpr double kLeastArc = 3;
/// Height of the area, in the arc's radius, at most.
constexpr double kAboveArc = 1.15;
/// More mirrors than these are thinned.
constexpr int kMostMirrors = 128;
/// Mirrors are looked for up to this distance and time.
constexpr double kFarthest = 1e300;
/// A larger error of rounding would be seen.
constexpr double kMostRounding_px = 1.0 / 64;
/// Of the times of collisions, in parts of the time: they are pairs of doubles.
constexpr double kTimeRounding = 0x1p-102;
/// Between rays where the line crosses none, in radians.
constexpr double kFanStep = 0.02;

/// Collisions from the beginning of the scene on.
Integer crossings_of(const DrawingContext& context) {
  const Integer before =
      context.two_blocks().blocks_at(span_of(context.scene, context.log).from).count;
  return context.log.last() - (before < 0 ? before : Integer(0));
}

/// The wedge angle in radians: as a unit fraction where that is good to three digits.
std::string angle_text(const TwoBlocks& system) {
  const GapWedge wedge(system);
  const Rational ratio = system.red.mass / system.blue.mass;
  const Integer root = sqrt(Integer(ratio.get_num()));
  const bool is_unit_fraction = ratio >= 100 && Rational(root * root) == ratio;
  if (is_unit_fraction) {
    const std::string digits = root.get_str();
    const auto zeros = static_cast<long>(digits.size()) - 1;
    const bool is_power = digits.front() == '1' && digits.find_first_not_of('0', 1) > digits.size();
    if (is_power && zeros > 2) return power_text(-zeros);
    if (zeros <= 4) return "1/" + short_text(Rational(root));
  }
  const Magnitude theta = written_with(2, wedge.theta_magnitude());
  if (theta.exponent >= -4) {
    return fixed_text(wedge.theta, static_cast<int>(std::max(2L, 2 - theta.exponent)));
  }
  return fmt::format("{}×{}", fixed_text(theta.mantissa, 2), power_text(theta.exponent));
}

}  // namespace

StraightLine::StraightLine(const TwoBlocks& system) : wedge_(system) {
  const Rational y1 = system.blue_gap();
  const Rational y2 = y1 + system.blocks_gap();
  const Point start{wedge_.cosine * to_double(y2), wedge_.sine * to_double(y1)};
  const Point velocity{wedge_.cosine * to_double(system.red.velocity),
                       wedge_.sine * to_double(system.blue.velocity)};
  const double speed = rounded::hypot(velocity.x, velocity.y);
  if (speed == 0) {
    start_ = start.x;
    height_ = start.y;
    return;
  }
  turn_ = turn_of(system).value();
  const Rational turning = y2 * system.blue.velocity - y1 * system.red.velocity;
  const double sign = turning < 0 ? 1 : -1;
  velocity_ = sign * speed;
  // The plane is turned so that this direction points to the right.
  const Point right = velocity / velocity_;
  if (turning != 0) height_ = std::abs(cross(start, right));
  first_ray_ = -rounded::atan2(right.y, right.x);
}

double StraightLine::at(const Rational& time) const {
  return moves() ? velocity_ * to_double(Rational(time - turn_)) : start_;
}

double StraightLine::rounding() const {
  return std::abs(velocity_) * to_double(abs(turn_)) * kTimeRounding;
}

Rational StraightLine::time_at(double position) const {
  return turn_ + Rational(position) / Rational(velocity_);
}

UnfoldedMap::UnfoldedMap(const Scene& scene, const PairLog& log, const Rect& area, double margin_px,
                         double arc_px)
    : line_(log.blocks()),
      most_area_(area),
      margin_px_(margin_px),
      most_arc_px_(arc_px),
      span_(span_of(scene, log)) {
  place_corner(log);
  if (!line_.moves() || line_.rounding() * scale_ <= kMostRounding_px) return;
  // Collisions are nearer to each other than their rounded times can tell.
  is_exact_ = true;
  place_corner(log);
}

/// Of a collision; exact only where its rounded time would show in the picture.
Rational UnfoldedMap::time_of(const PairLog& log, const PairCollision& collision) const {
  return is_exact_ ? log.time_after(collision.index) : to_rational(collision.time);
}

/// The corner and all of the line that is shown are in the area.
void UnfoldedMap::place_corner(const PairLog& log) {
  area_ = most_area_;
  level_px_ = kLevel * area_.height;
  has_true_angles_ = false;
  double from = line_.at(span_.from);
  double to = line_.at(span_.to);
  if (line_.moves() && !line_.meets_corner()) {
    const Integer first = log.blocks_at(span_.from).count + 1;
    const Integer last = log.blocks_at(span_.to).count;
    if (first <= last) {
      const auto place = [&](const Integer& index) {
        return line_.at(time_of(log, log.blocks_collision(index)));
      };
      const bool are_few = last - first < kMostTrueMirrors;
      if (are_few && place_with_true_angles(place(first), place(last))) return;
      const double reach = kWidest * std::max(std::abs(place(first)), std::abs(place(last)));
      from = std::clamp(from, -reach, reach);
      to = std::clamp(to, -reach, reach);
    }
  }
  const double low = std::min({0.0, from, to});
  const double high = std::max({0.0, from, to});
  if (high > low) {
    scale_ = (area_.width - 2 * margin_px_) / (high - low);
    corner_x_ = area_.x + margin_px_ - low * scale_;
  } else {
    if (!line_.meets_corner()) scale_ = level_px_ / line_.height();
    corner_x_ = area_.x + area_.width / 2;
  }
  across_ = line_.meets_corner() ? level_px_ : scale_ * line_.height();
}

/// @param first, last  crossings, in units of the line @returns whether there is room
bool UnfoldedMap::place_with_true_angles(double first, double last) {
  const auto [low, high] = std::minmax({0.0, first, last});
  const double width = std::max(high - low, line_.height());
  const double widest = kLevel * area_.height / line_.height();
  const double scale = std::min(kCrossedShare * area_.width / width, widest);
  if (!(scale * line_.height() >= margin_px_)) return false;
  scale_ = scale;
  level_px_ = across_ = scale * line_.height();
  corner_x_ = area_.x + area_.width / 2 - (low + high) / 2 * scale;
  // The angle's name has room between the arc and the first crossing.
  const double crossing = std::max(kLeastArc * level_px_, kArcShare * std::min(-low, high) * scale);
  arc_px_ = std::min({most_arc_px_, crossing, area_.height});
  // What is left of a high panel is below it.
  area_.height = std::min(area_.height, kAboveArc * arc_px_);
  has_true_angles_ = true;
  return true;
}

Point UnfoldedMap::end_of(const Point& towards) const {
  if (has_true_angles_) {
    const bool is_seen = corner_x_ + towards.x >= left() && corner_x_ + towards.x <= right();
    const double share = arc_px_ / rounded::hypot(towards.x, towards.y);
    const Point along = (is_seen ? std::max(1.0, share) : share) * towards;
    return {corner_x_ + along.x, base_y() - along.y};
  }
  const double side = (towards.x > 0 ? right() : left()) - corner_x_;
  const bool is_above = towards.y * std::abs(side) >= area_.height * std::abs(towards.x);
  if (is_above) return {corner_x_ + towards.x / towards.y * area_.height, area_.y};
  return {corner_x_ + side, base_y() - std::max(0.0, towards.y / towards.x * side)};
}

std::vector<Point> UnfoldedMap::sector(const Point& a, const Point& b) const {
  if (has_true_angles_) {
    std::vector<Point> outline = arc()->arc(rounded::atan2(a.y, a.x), rounded::atan2(b.y, b.x));
    outline.insert(outline.begin(), corner());
    return outline;
  }
  std::vector<Point> outline{corner(), end_of(a)};
  const bool is_a_low = outline.back().y > area_.y && a.x > 0;
  const Point end = end_of(b);
  const bool is_b_low = end.y > area_.y && b.x < 0;
  if (is_a_low && (end.y <= area_.y || is_b_low)) outline.push_back({right(), area_.y});
  if (is_b_low && (outline[1].y <= area_.y || is_a_low)) outline.push_back({left(), area_.y});
  outline.push_back(end);
  return outline;
}

Mirror UnfoldedMap::mirror_of(const PairLog& log, const Integer& index) const {
  const PairCollision collision = log.blocks_collision(index);
  const Rational time = time_of(log, collision);
  const double x = x_at(time);
  return {.index = index,
          .kind = collision.kind,
          .x = x,
          .is_met = time >= span_.from && time <= span_.to,
          .towards = {x - corner_x_, level_px_}};
}

/// Beyond the sides, rays that leave the area so far apart can be seen. Times stay in the range of
/// a double.
double UnfoldedMap::reach_px(double least_apart_px) const {
  const double farthest = kFarthest * scale_ * std::min(1.0, std::abs(line_.velocity()));
  return std::min(area_.width * std::max(1.0, level_px_ / least_apart_px), farthest);
}

std::vector<Mirror> UnfoldedMap::mirrors(const PairLog& log, double least_apart_px) const {
  if (!line_.moves() || line_.meets_corner()) return evenly_spaced_mirrors();
  const double reach = std::copysign(reach_px(least_apart_px), line_.velocity());
  if (!(std::abs(reach) > 0)) return {};
  const Integer first = log.blocks_at(line_.time_at(-reach / scale_)).count + 1;
  const Integer last = log.blocks_at(line_.time_at(reach / scale_)).count;
  const bool is_thinned = last - first >= kMostMirrors;
  std::vector<Mirror> mirrors;
  for (Integer index = first; index <= last;) {
    mirrors.push_back(mirror_of(log, index));
    const double x = mirrors.back().x - corner_x_;
    Integer next = index + 1;
    if (is_thinned) {
      const double step = least_apart_px * std::max(1.0, x * x / (area_.width * level_px_));
      const double target =
          std::clamp(x + std::copysign(step, reach), -std::abs(reach), std::abs(reach));
      next = std::max(next, Integer(log.blocks_at(line_.time_at(target / scale_)).count + 1));
      // Both kinds take turns.
      if (Integer(next - index) % 2 == 0) next += 1;
    }
    index = next;
  }
  for (std::size_t i = 0; i < mirrors.size(); ++i) {
    const auto to = [&](std::size_t k) { return std::abs(mirrors[i].x - mirrors[k].x); };
    double apart = area_.width;
    if (i > 0) apart = std::min(apart, to(i - 1));
    if (i + 1 < mirrors.size()) apart = std::min(apart, to(i + 1));
    mirrors[i].apart_px = apart;
  }
  return mirrors;
}

/// Where no ray is crossed one by one.
std::vector<Mirror> UnfoldedMap::evenly_spaced_mirrors() const {
  std::vector<Mirror> mirrors;
  if (line_.theta() == 0) return mirrors;
  const double step = line_.theta() * std::ceil(kFanStep / line_.theta());
  const double first = line_.first_ray();
  for (double k = std::floor(-first / step) + 1; first + k * step < std::numbers::pi; ++k) {
    const double angle = first + k * step;
    const auto [sine, cosine] = rounded::sin_cos(angle);
    mirrors.push_back({.index = Integer(static_cast<long>(mirrors.size()) + 1),
                       .is_met = false,
                       .towards = picture_of({cosine, sine})});
  }
  return mirrors;
}

PhasedTitle::Sentences unfolded_sentences(const DrawingContext& context, bool unfolds) {
  const FormulaSetter set = context.setter();
  const Integer count = crossings_of(context);
  const std::string number = count == 0 ? "no" : count_text(count, context.scene.show.base);
  const std::string brief_number = count < 1000000 ? number : short_text(Rational(count));
  const char* const mirrors = count == 1 ? " mirror" : " mirrors";
  std::vector<Formula> path =
      set.texts({"Each hit is a mirror: the path is straight", "A straight path"});
  if (unfolds) {
    path.insert(path.begin(), set.text("Unfold a mirror at each hit: the path stays straight"));
  }
  std::vector<Formula> crossed;
  for (const std::string& some : {number, brief_number}) {
    crossed.push_back(set.text("A straight path crosses " + some + mirrors));
  }
  crossed.push_back(set.text("A straight path"));
  const std::optional<Formula> ratio = half_turn_ratio(context);
  if (!ratio) return {path, path, crossed};
  const Formula angles =
      set.text(number + " equal angles ") + set.italic("θ") + set.text(" fit into half a turn");
  return {path,
          path,
          {angles + set.text(", which is π: ") + *ratio, angles + set.text(": ") + *ratio, angles,
           *ratio, set.text("A straight path")}};
}

std::optional<Formula> half_turn_ratio(const DrawingContext& context) {
  std::string text = half_turn_text(context.two_blocks().blocks());
  if (text.empty()) return std::nullopt;
  if (context.scene.show.base != kUsualBase) text = "π/θ";
  const FormulaSetter set = context.setter();
  constexpr std::string_view kAngle = "θ";
  const std::size_t angle = text.find(kAngle);
  return set.text(text.substr(0, angle)) + set.italic(kAngle) +
         set.text(text.substr(angle + kAngle.size()));
}

Formula angle_note(const DrawingContext& context) {
  const FormulaSetter set = context.setter();
  const auto mass = [&](const char* index, const Color& color) {
    return set.lowered(set.italic("m"), set.text(index)).colored(color);
  };
  const Palette& palette = context.palette;
  return set.italic("θ") + set.text(" = arctan ") +
         set.root(mass("1", palette.blue.label) + set.text("/") + mass("2", palette.red.label)) +
         set.text(" ≈ " + angle_text(context.two_blocks().blocks()));
}

std::optional<Formula> thinning_note(const FormulaSetter& set, const std::vector<Mirror>& mirrors) {
  if (mirrors.empty()) return std::nullopt;
  const Integer all = mirrors.back().index - mirrors.front().index + 1;
  const Integer share = all / Integer(static_cast<unsigned long>(mirrors.size()));
  if (share <= 1) return std::nullopt;
  const auto exponent = static_cast<long>(share.get_str().size()) - 1;
  if (exponent == 0) return set.text("not all mirrors are drawn");
  constexpr long kMostZeros = 4;
  const std::string power =
      exponent > kMostZeros ? power_text(exponent) : short_text(power_of_ten(exponent));
  return set.text("1 in " + power + " mirrors drawn");
}

}  // namespace piblocks
