#include <boost/multiprecision/mpfr.hpp>
#include <mpfr.h>

#include <cstdlib>
#include <optional>

#include "support/oracle.hpp"

namespace piblocks::oracle {
namespace {

using Real = boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<0>,
                                           boost::multiprecision::et_off>;

/// The precision of every Real made in its scope.
class PrecisionScope {
 public:
  explicit PrecisionScope(std::int64_t bits) : outer_(Real::default_precision()) {
    Real::default_precision(static_cast<unsigned>(bits * 30103 / 100000 + 1));
  }
  ~PrecisionScope() { Real::default_precision(outer_); }
  PrecisionScope(const PrecisionScope&) = delete;
  PrecisionScope& operator=(const PrecisionScope&) = delete;

 private:
  unsigned outer_;
};

Real to_real(const Rational& value) {
  Real result;
  mpfr_set_q(result.backend().data(), value.get_mpq_t(), MPFR_RNDN);
  return result;
}

Rational to_rational(const Real& value) {
  Rational result;
  mpfr_get_q(result.get_mpq_t(), value.backend().data());
  return result;
}

Integer to_integer(const Real& whole) {
  Integer result;
  mpfr_get_z(result.get_mpz_t(), whole.backend().data(), MPFR_RNDN);
  return result;
}

std::int64_t bits_for(const TwoBlocks& system, std::int64_t extra_bits) {
  const Rational ratio = system.red.mass / system.blue.mass;
  const auto log2_of = [](const Integer& n) {
    return static_cast<std::int64_t>(mpz_sizeinbase(n.get_mpz_t(), 2));
  };
  const std::int64_t log2_ratio = std::abs(log2_of(ratio.get_num()) - log2_of(ratio.get_den()));
  return 512 + 4 * (log2_ratio + 1) + extra_bits;
}

/// One value for blue's gap to the wall and one for red's, reduced by the widths: they are equal
/// when the blocks touch.
struct Gaps {
  Rational blue;
  Rational red;
};

/// A point or direction of the plane (sqrt(m_blue) blue, sqrt(m_red) red). Its angle is measured
/// from the red axis, where blue is at the wall, towards the blue axis.
struct PlanePoint {
  Real x;
  Real y;
};

/// The straight line that a run becomes when the plane is reflected, not the motion. The blocks'
/// wedge lies between angle 0 (wall) and theta (blocks touch); its images between k theta and
/// (k + 1) theta.
class UnfoldedLine {
 public:
  explicit UnfoldedLine(const TwoBlocks& system)
      : system_(system),
        start_{system.blue.position - system.wall_face - system.blue.width / 2,
               system.red.position - system.wall_face - system.blue.width - system.red.width / 2},
        speed_{system.blue.velocity, system.red.velocity},
        swirl_(start_.red * speed_.blue - start_.blue * speed_.red),
        root_blue_(sqrt(to_real(system.blue.mass))),
        root_red_(sqrt(to_real(system.red.mass))),
        theta_(atan2(root_blue_, root_red_)),
        pi_(4 * atan(Real(1))) {}

  /// The state at t >= 0, or at any t if the line misses the corner.
  ExactState state(const Rational& t) const {
    const Integer count = count_at(t);
    const Integer sector = turns_up() ? count : Integer(-count);
    const PlanePoint point = fold(plane(gaps_at(t)), sector);
    const PlanePoint velocity = fold(plane(speed_), sector);
    return {
        count,
        {blue_at_corner() + to_rational(point.x / root_blue_),
         to_rational(velocity.x / root_blue_)},
        {red_at_corner() + to_rational(point.y / root_red_), to_rational(velocity.y / root_red_)}};
  }

  /// Collision `index` of a line that misses the corner.
  ExactEvent collision(const Integer& index) const {
    const Integer ray = turns_up() ? index : Integer(1 - index);
    const Real angle = theta_ * to_real(Rational(ray));
    const Real along_x = sin(angle);
    const Real along_y = cos(angle);
    const PlanePoint start = plane(start_);
    const PlanePoint speed = plane(speed_);
    // Start and speed have parts at right angles to the ray that cancel then.
    const Real t =
        (start.y * along_x - start.x * along_y) / (speed.x * along_y - speed.y * along_x);
    const Real distance = (start.x + speed.x * t) * along_x + (start.y + speed.y * t) * along_y;
    const bool odd = mpz_odd_p(ray.get_mpz_t()) != 0;
    const Real gap = odd ? Real(distance * sin(theta_) / root_blue_) : Real(0);
    const Real red_gap = odd ? gap : Real(distance / root_red_);
    const PlanePoint velocity = fold(speed, turns_up() ? index : Integer(-index));
    return {odd ? CollisionKind::blocks : CollisionKind::wall,
            to_rational(t),
            {blue_at_corner() + to_rational(gap), to_rational(velocity.x / root_blue_)},
            {red_at_corner() + to_rational(red_gap), to_rational(velocity.y / root_red_)}};
  }

  Integer total() const {
    if (swirl_ == 0) return corner_ahead() ? rays_before(phase_behind_corner()) : Integer(0);
    return rays_before(start_phase() + swept(swirl_, dot(start_, speed_)));
  }

  bool meets_corner() const { return swirl_ == 0; }
  bool is_in_corner_at(const Rational& t) const { return meets_corner() && corner_time() == t; }

 private:
  Rational blue_at_corner() const { return system_.wall_face + system_.blue.width / 2; }
  Rational red_at_corner() const {
    return system_.wall_face + system_.blue.width + system_.red.width / 2;
  }

  Gaps gaps_at(const Rational& t) const {
    return {start_.blue + speed_.blue * t, start_.red + speed_.red * t};
  }

  PlanePoint plane(const Gaps& gaps) const {
    return {root_blue_ * to_real(gaps.blue), root_red_ * to_real(gaps.red)};
  }

  Rational dot(const Gaps& a, const Gaps& b) const {
    return system_.blue.mass * a.blue * b.blue + system_.red.mass * a.red * b.red;
  }

  Real start_phase() const {
    return atan2(root_blue_ * to_real(start_.blue), root_red_ * to_real(start_.red));
  }

  /// Angle between two vectors from their exact cross product over sqrt(m_blue m_red), and their
  /// exact dot product.
  Real swept(const Rational& cross, const Rational& dot_product) const {
    return atan2(root_blue_ * root_red_ * to_real(cross), to_real(dot_product));
  }

  /// Whether the angle grows: the first ray met is the blocks'. Through the corner it is taken to
  /// grow if the blocks approach.
  bool turns_up() const { return swirl_ > 0 || (swirl_ == 0 && speed_.blue > speed_.red); }

  Integer count_at(const Rational& t) const {
    if (swirl_ == 0) {
      const std::optional<Rational> corner = corner_time();
      if (!corner || *corner < 0 || t < *corner) return 0;
      return rays_before(phase_behind_corner());
    }
    return rays_up_to(start_phase() + swept(swirl_ * t, dot(start_, gaps_at(t))));
  }

  /// When a line that meets the corner is there; none at rest.
  std::optional<Rational> corner_time() const {
    if (speed_.blue != 0) return Rational(-start_.blue / speed_.blue);
    if (speed_.red != 0) return Rational(-start_.red / speed_.red);
    return std::nullopt;
  }

  bool corner_ahead() const {
    const std::optional<Rational> corner = corner_time();
    return corner && *corner >= 0;
  }

  Real phase_behind_corner() const {
    if (start_.red != 0) return turns_up() ? Real(start_phase() + pi_) : Real(start_phase() - pi_);
    // Started in the corner: the velocity alone says where the line goes.
    const Real course = atan2(root_blue_ * to_real(speed_.blue), root_red_ * to_real(speed_.red));
    return turns_up() && course < 0 ? Real(course + 2 * pi_) : course;
  }

  /// Rays 1, 2, … up to a phase, or 0, -1, … down to it, that ray itself included. Before time 0
  /// minus the number of those between the phase and the start.
  Integer rays_up_to(const Real& phase) const {
    if (turns_up()) return to_integer(floor(in_rays(phase)));
    return to_integer(floor(in_rays(-phase))) + 1;
  }

  /// The same without the ray itself: a ray reached only at infinity, or one along which the line
  /// leaves the corner, is not crossed.
  Integer rays_before(const Real& phase) const {
    Integer rays = turns_up() ? Integer(to_integer(ceil(in_rays(phase))) - 1)
                              : to_integer(ceil(in_rays(-phase)));
    return rays < 0 ? Integer(0) : rays;
  }

  /// Phase over theta; on a ray if it is closer to it than half of the digits can tell.
  Real in_rays(const Real& phase) const {
    const Real rays = phase / theta_;
    const Real nearest = round(rays);
    const auto precision = static_cast<int>(mpfr_get_prec(rays.backend().data()));
    return abs(rays - nearest) < ldexp(Real(1), -precision / 2) ? nearest : rays;
  }

  /// Maps sector [k theta, (k + 1) theta] onto the wedge: a rotation for even k, a reflection for
  /// odd k.
  PlanePoint fold(const PlanePoint& p, const Integer& sector) const {
    const bool odd = mpz_odd_p(sector.get_mpz_t()) != 0;
    const Real angle = theta_ * to_real(Rational(odd ? Integer(sector + 1) : sector));
    const Real s = sin(angle);
    const Real c = cos(angle);
    const PlanePoint rotated = {c * p.x - s * p.y, s * p.x + c * p.y};
    return {odd ? Real(-rotated.x) : rotated.x, rotated.y};
  }

  TwoBlocks system_;
  Gaps start_;
  Gaps speed_;
  Rational swirl_;  // sign and, times sqrt(m_blue m_red), size of the angular momentum
  Real root_blue_;
  Real root_red_;
  Real theta_;
  Real pi_;
};

}  // namespace

ExactState high_precision_state(const TwoBlocks& system, const Rational& t,
                                std::int64_t extra_bits) {
  const PrecisionScope precision(bits_for(system, extra_bits));
  const UnfoldedLine line(system);
  if (t >= 0 || !line.meets_corner()) return line.state(t);
  if (line.is_in_corner_at(t)) return line.state(t);  // and the collisions have happened
  // Which of the corner's two limits is meant depends on the direction of time.
  ExactState state = UnfoldedLine(reversed(system)).state(-t);
  state.count = -state.count;
  state.blue.velocity = -state.blue.velocity;
  state.red.velocity = -state.red.velocity;
  return state;
}

ExactEvent high_precision_collision(const TwoBlocks& system, const Integer& index,
                                    std::int64_t extra_bits) {
  const PrecisionScope precision(bits_for(system, extra_bits));
  return UnfoldedLine(system).collision(index);
}

Integer high_precision_total(const TwoBlocks& system, std::int64_t extra_bits) {
  const PrecisionScope precision(bits_for(system, extra_bits));
  return UnfoldedLine(system).total();
}

}  // namespace piblocks::oracle
