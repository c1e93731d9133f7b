#include <fmt/format.h>
#include <piblocks/bodies.hpp>
#include <piblocks/error.hpp>
#include <piblocks/event_simulator.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>

#include "bodies/contest.hpp"
#include "bodies/tables.hpp"
#include "disc_gas.hpp"
#include "support/precise_discs.hpp"

namespace piblocks::benchmark {
namespace {

constexpr std::uint32_t kDiscs = 10;
constexpr int kInstants = 200;
/// From here on two trajectories have nothing in common.
constexpr double kParted = 1e-3;
constexpr mpfr_prec_t kFewBits = 400;
constexpr mpfr_prec_t kRightBits = 2400;

/// Discs among four immovable ones, which leave gaps too narrow for them: a box that the general
/// engine knows, too.
BodySystem between_large_discs() {
  BodySystem system = disc_gas(kDiscs);
  // Near the middle, in few digits: no number type rounds them.
  const Rational x(std::round(to_double(system.walls[1].point[0] / 2)));
  const Rational y(std::round(to_double(system.walls[3].point[1] / 2)));
  system.walls.clear();
  const Rational radius = 20;
  const Rational away(57, 2);
  for (const int sign : {-1, 1}) {
    system.bodies.push_back({std::nullopt, {x + sign * away, y}, {0, 0}, radius});
    system.bodies.push_back({std::nullopt, {x, y + sign * away}, {0, 0}, radius});
  }
  return system;
}

std::vector<double> program_positions(const BodySystem& system,
                                      const std::vector<Rational>& instants) {
  const std::unique_ptr<BodyLog> log = make_body_log(system, instants.back());
  std::vector<double> positions;
  for (const Rational& time : instants) {
    const BodiesState state = log->state_at(time);
    for (std::uint32_t i = 0; i < kDiscs; ++i) {
      for (const double coordinate : state.bodies[i].position) positions.push_back(coordinate);
    }
  }
  return positions;
}

/// Walls are balls of a radius r at which they bulge, by about 50/r, as much as rounding does.
template <typename Number>
std::vector<Number> simulator_positions(const BodySystem& system,
                                        const std::vector<double>& instants) {
  using std::sqrt;
  const Number radius = sqrt(Number(50) / std::numeric_limits<Number>::epsilon());
  EventSimulator<Number, 2> simulator(
      particles_with_round_walls<Number>(system, radius, to_number<Number>));
  std::vector<Number> positions;
  for (const double instant : instants) {
    const Number time(instant);
    while (*simulator.next_time() <= time) simulator.step();
    const auto particles = simulator.particles_at(time);
    for (std::uint32_t i = 0; i < kDiscs; ++i) {
      positions.push_back(particles[i].position[0]);
      positions.push_back(particles[i].position[1]);
    }
  }
  return positions;
}

/// All pairs in many bits. They go on for ever.
class PreciseRun {
 public:
  PreciseRun(const BodySystem& system, mpfr_prec_t bits) : bits_(bits), discs_(system, bits) {
    step();
  }

  /// Of the next collision.
  const Real& next_time() const { return next_; }

  void step() {
    flights_.clear();
    for (std::uint32_t i = 0; i < kDiscs; ++i) flights_.push_back(discs_.flight(i));
    next_ = discs_.step()->time;
  }

  void add_positions(const Real& time, std::vector<Real>& positions) const {
    for (const PreciseDiscs::Flight& flight : flights_) {
      for (const std::size_t axis : {0U, 1U}) {
        positions.push_back(flight.position.at(axis) +
                            flight.velocity.at(axis) * (time - flight.time));
      }
    }
  }

  Real number(double value) const { return Real(bits_, Rational(value)); }

 private:
  mpfr_prec_t bits_;
  PreciseDiscs discs_;
  std::vector<PreciseDiscs::Flight> flights_ = {};  // until the next collision
  Real next_{bits_, 0};
};

bool is_after(const Real& a, const Real& b) { return (a - b).sign() > 0; }

/// @param counts  gets the number of collisions before each instant
std::vector<Real> precise_positions(const BodySystem& system, const std::vector<double>& instants,
                                    mpfr_prec_t bits, std::vector<int>* counts = nullptr) {
  PreciseRun run(system, bits);
  std::vector<Real> positions;
  int collisions = 0;
  for (const double instant : instants) {
    const Real time = run.number(instant);
    for (; !is_after(run.next_time(), time); ++collisions) run.step();
    run.add_positions(time, positions);
    if (counts != nullptr) counts->push_back(collisions);
  }
  return positions;
}

struct RightAnswers {
  Answers positions = {};
  std::vector<int> counts = {};  ///< of collisions, at each instant
};

/// How far a method comes before it is more than kParted off.
struct Verdict {
  std::optional<double> error;   ///< nothing if it does not come to the end
  std::optional<int> parted_at;  ///< collisions
};

Verdict verdict_on(const Answers& answers, const RightAnswers& right) {
  if (answers.empty()) return {};
  Wide worst = 0;
  const std::size_t per_instant = right.positions.size() / right.counts.size();
  for (std::size_t i = 0; i < right.positions.size(); ++i) {
    worst = std::max(worst, Wide(abs(answers[i] - right.positions[i])));
    if (worst > kParted) return {std::nullopt, right.counts[i / per_instant]};
  }
  return {static_cast<double>(worst), std::nullopt};
}

/// @throws SimulationError if many bits are not enough.
RightAnswers right_answers(const BodySystem& system, const std::vector<double>& instants) {
  RightAnswers right;
  for (const Real& number : precise_positions(system, instants, kRightBits, &right.counts)) {
    right.positions.push_back(to_wide(number));
  }
  Answers more;
  for (const Real& number : precise_positions(system, instants, 2 * kRightBits)) {
    more.push_back(to_wide(number));
  }
  const std::optional<double> error = verdict_on(more, right).error;
  if (error && *error < 1e-60) return right;
  throw SimulationError(
      fmt::format("discs: {} collisions in {} bits are not those in {}: take more bits",
                  right.counts.back(), kRightBits, 2 * kRightBits));
}

std::vector<Contestant> disc_contestants(const BodySystem& system,
                                         const std::vector<double>& instants) {
  const std::vector<Rational> exact(instants.begin(), instants.end());
  std::vector<Contestant> all = {
      contestant("piblocks::BodyLog", "double", [=] { return program_positions(system, exact); })};
  all.push_back(contestant("the same without states", "double",
                           [=] { return no_positions(system, exact.back()); }));
  const auto add = [&]<typename Number>(Number) {
    all.push_back(contestant("piblocks::EventSimulator", kNumberName<Number>,
                             [=] { return simulator_positions<Number>(system, instants); }));
  };
  add(0.0);
  add(0.0L);
  add(Decimal50(0));
  for (const mpfr_prec_t bits : {kFewBits, kRightBits}) {
    all.push_back(contestant("all pairs", fmt::format("MPFR {} bits", bits),
                             [=] { return precise_positions(system, instants, bits); }));
  }
  return all;
}

/// Until when, and how many collisions then are certain.
double certain_until(const BodySystem& system) {
  for (Rational until = 1;; until *= 2) {
    const std::unique_ptr<BodyLog> log = make_body_log(system, until);
    if (const std::optional<double> end = log->certain_until()) return *end;
  }
}

double time_after(const BodySystem& system, int collisions) {
  PreciseRun run(system, kRightBits);
  for (int k = 1; k < collisions; ++k) run.step();
  const double last = run.next_time().to_double();
  run.step();
  return (last + run.next_time().to_double()) / 2;
}

void print_rows(const std::string& name, const BodySystem& system, double end) {
  const std::vector<double> instants = random_instants(end, kInstants);
  const RightAnswers right = right_answers(system, instants);
  std::vector<Contestant> contestants = disc_contestants(system, instants);
  time_all(contestants);
  for (const Contestant& contestant : contestants) {
    const Verdict verdict = verdict_on(contestant.reply(), right);
    fmt::print("| {} | {} | {} | {} | {} | {} | {} |\n", name, right.counts.back(),
               contestant.method, contestant.number, time_text(contestant),
               error_text(verdict.error),
               verdict.parted_at ? std::to_string(*verdict.parted_at) : "–");
  }
}

}  // namespace

void print_disc_table() {
  fmt::print("| Container | Collisions | Method | Number type | time | error | parted at |\n");
  fmt::print("|---|---:|---|---|---:|---:|---:|\n");
  const BodySystem box = disc_gas(kDiscs);
  const BodySystem round = between_large_discs();
  constexpr int kMany = 2000;
  print_rows("walls", box, certain_until(box));
  print_rows("walls", box, time_after(box, kMany));
  print_rows("large discs", round, certain_until(round));
  print_rows("large discs", round, time_after(round, kMany));
  fmt::print("\n");
}

}  // namespace piblocks::benchmark
