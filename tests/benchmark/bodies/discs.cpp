#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/event_simulator.hpp>
#include <piblocks/log.hpp>

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
/// From here on two trajectories have nothing in common.
constexpr double kParted = 1e-3;
constexpr mpfr_prec_t kFewBits = 400;
constexpr mpfr_prec_t kRightBits = 2400;

std::vector<double> disc_positions(const System& system, const std::vector<Rational>& instants) {
  const std::unique_ptr<Log> log = make_log(system, instants.back());
  std::vector<double> positions;
  for (const Rational& time : instants) {
    const State state = log->state_at(time);
    for (std::uint32_t i = 0; i < kDiscs; ++i) {
      for (const double coordinate : state.bodies[i].position) positions.push_back(coordinate);
    }
  }
  return positions;
}

/// Walls are balls of a radius r at which they bulge, by about 50/r, as much as rounding does.
template <typename Number>
std::vector<Number> simulated_disc_positions(const System& system,
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
  PreciseRun(const System& system, mpfr_prec_t bits) : bits_(bits), discs_(system, bits) { step(); }

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
std::vector<Real> precise_disc_positions(const System& system, const std::vector<double>& instants,
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
  Wide worst = 0;
  const std::size_t per_instant = right.positions.size() / right.counts.size();
  for (std::size_t i = 0; i < right.positions.size(); ++i) {
    worst = std::max(worst, Wide(abs(answers[i] - right.positions[i])));
    if (worst > kParted) return {std::nullopt, right.counts[i / per_instant]};
  }
  return {static_cast<double>(worst), std::nullopt};
}

/// @throws SimulationError if many bits are not enough.
RightAnswers right_answers(const System& system, const std::vector<double>& instants) {
  RightAnswers right;
  for (const Real& number : precise_disc_positions(system, instants, kRightBits, &right.counts)) {
    right.positions.push_back(to_wide(number));
  }
  Answers more;
  for (const Real& number : precise_disc_positions(system, instants, 2 * kRightBits)) {
    more.push_back(to_wide(number));
  }
  const std::optional<double> error = verdict_on(more, right).error;
  if (error && *error < 1e-60) return right;
  throw SimulationError(
      fmt::format("discs: {} collisions in {} bits are not those in {}: take more bits",
                  right.counts.back(), kRightBits, 2 * kRightBits));
}

std::vector<Contestant> disc_contestants(const System& system,
                                         const std::vector<double>& instants) {
  const std::vector<Rational> exact(instants.begin(), instants.end());
  std::vector<Contestant> all = {
      contestant("piblocks::Log", "double", [=] { return disc_positions(system, exact); })};
  const auto add = [&]<typename Number>(Number) {
    all.push_back(contestant("piblocks::EventSimulator", kNumberName<Number>,
                             [=] { return simulated_disc_positions<Number>(system, instants); }));
  };
  add(0.0);
  add(0.0L);
  add(Decimal50(0));
  for (const mpfr_prec_t bits : {kFewBits, kRightBits}) {
    const char* role = bits == kRightBits ? ", reference" : "";
    all.push_back(contestant("all pairs", fmt::format("MPFR {} bits{}", bits, role),
                             [=] { return precise_disc_positions(system, instants, bits); }));
  }
  return all;
}

double end_of_certainty(const System& system) {
  for (Rational until = 1;; until *= 2) {
    const std::unique_ptr<Log> log = make_log(system, until);
    if (const std::optional<double> end = log->certain_until(until)) return *end;
  }
}

double time_after_discs(const System& system, int collisions) {
  PreciseRun run(system, kRightBits);
  for (int k = 1; k < collisions; ++k) run.step();
  const double last = run.next_time().to_double();
  run.step();
  return (last + run.next_time().to_double()) / 2;
}

/// Times and verdicts of all contestants, up to one instant.
struct DiscColumn {
  int collisions = 0;
  std::vector<Contestant> contestants = {};
  std::vector<Verdict> verdicts = {};
};

DiscColumn disc_column(const System& system, double end) {
  const std::vector<double> instants = random_instants(end, kInstants);
  const RightAnswers right = right_answers(system, instants);
  DiscColumn column{right.counts.back(), disc_contestants(system, instants)};
  for (const Contestant& contestant : column.contestants) {
    column.verdicts.push_back(verdict_on(contestant.reply(), right));
  }
  time_all(column.contestants);
  return column;
}

}  // namespace

void print_disc_table() {
  constexpr int kMany = 2000;
  fmt::print(
      "| Method | Number type | while certain: time | error | 2,000 collisions: time | parted at "
      "|\n"
      "|---|---|---:|---:|---:|---:|\n");
  const System system = disc_gas(kDiscs);
  const DiscColumn certain = disc_column(system, end_of_certainty(system));
  const DiscColumn many = disc_column(system, time_after_discs(system, kMany));
  for (std::size_t row = 0; row < certain.contestants.size(); ++row) {
    const Contestant& contestant = certain.contestants[row];
    const std::optional<int> parted_at = many.verdicts[row].parted_at;
    fmt::print("| {} | {} | {} | {} | {} | {} |\n", contestant.method, contestant.number,
               time_text(contestant), error_text(certain.verdicts[row].error),
               time_text(many.contestants[row]), parted_at ? std::to_string(*parted_at) : "–");
  }
  fmt::print("\n{} collisions are certain.\n\n", certain.collisions);
}

}  // namespace piblocks::benchmark
