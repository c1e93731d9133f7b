// Discs in numbers of many bits, every pair in turn: what the engine for discs is compared with.
// In: a System. Out: its collisions, true to far more digits than a double has.
#pragma once

#include <piblocks/system.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/real.hpp"

namespace piblocks {

class PreciseDiscs {
 public:
  struct Flight {
    std::array<Real, 2> position;  ///< at `time`
    std::array<Real, 2> velocity;
    Real time;  ///< of the last collision
  };
  struct Step {
    Real time;
    std::uint32_t first;
    std::uint32_t second;  ///< as in Collision
  };

  explicit PreciseDiscs(const System& system, mpfr_prec_t bits = 400);

  std::optional<Step> step();
  const Flight& flight(std::uint32_t body) const { return bodies_[body].flight; }

 private:
  using Vector = std::array<Real, 2>;
  struct Disc {
    Flight flight;
    Real radius;
    std::optional<Real> mass;
    std::size_t last;
    std::size_t event = 0;                  ///< several contacts at once, if it met nobody since
    std::vector<std::size_t> touched = {};  ///< whom it did not approach after that
  };
  struct Contact {
    std::size_t first;  ///< movable
    std::size_t second;
    Vector normal;  ///< from the first
    Real closing;
    Real rebound;
    Real impulse;
  };
  struct Line {
    Vector normal;
    Vector point;
    Vector velocity;
  };

  Vector position_at(const Disc& disc, const Real& time) const;
  std::optional<Real> pair_time(const Disc& a, const Disc& b) const;
  std::optional<Real> wall_time(const Disc& disc, const Line& wall) const;
  void predict(std::size_t body);
  void move(std::size_t body, const Real& time, std::size_t partner);
  void collide(std::size_t first, std::size_t second, const Real& time);
  void reflect(std::size_t body, std::size_t wall);
  Real rebound(std::size_t first, std::size_t second) const;
  bool have_just_met(std::size_t first, std::size_t second) const;

  bool is_movable(std::size_t body) const { return body < bodies_.size() && bodies_[body].mass; }
  std::optional<Contact> contact(std::size_t first, std::size_t second, const Real& time) const;
  std::vector<Contact> cluster_of(const Step& step) const;
  bool is_corner(const std::vector<Contact>& contacts) const;
  Vector velocity_of(std::size_t body, const Contact& contact) const;
  Real closing(const Contact& contact) const;
  Real inverse_mass(std::size_t body) const;
  bool solve(std::vector<Contact>& contacts) const;
  bool solve_without_pulling(std::vector<Contact>& contacts) const;
  bool meet_at_once(const Step& step);
  void note_event(const std::vector<Contact>& contacts, const Real& least);

  System system_;
  mpfr_prec_t bits_;
  std::vector<Disc> bodies_ = {};
  std::vector<Line> walls_ = {};
  std::vector<std::vector<std::optional<Real>>> times_ = {};  ///< [first][second], walls last
  std::vector<Step> pending_ = {};                            ///< the next one last
  std::size_t events_ = 0;
};

}  // namespace piblocks
