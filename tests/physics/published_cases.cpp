#include "physics/published_cases.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <fstream>
#include <span>

namespace piblocks {
namespace {

/// The names of all sources that live, the widest first.
std::vector<std::string>& sources() {
  static std::vector<std::string> names;
  return names;
}

/// The same on all systems, although their functions of C differ in the last place.
std::string text_of(double value) {
  return std::isinf(value) ? "never" : fmt::format("{:.10g}", value + 0.0);
}

std::string difference_of(double said, double ours) {
  const bool is_rounding =
      said == ours || std::abs(ours - said) <= kRoundings * std::max(1.0, std::abs(said));
  return is_rounding ? "0" : fmt::format("{:.1e}", ours - said);
}

/// All values, written to the file that PIBLOCKS_TABLE names; to none without it.
class Table {
 public:
  Table() {
    if (const char* name = std::getenv("PIBLOCKS_TABLE")) file_.open(name);
    if (!file_.is_open()) return;
    file_ << R"(# What other public programs state

Values of tests and examples of other programs, which piblocks computes too: `published_cases_test` compares them, and
makes this file, `PIBLOCKS_TABLE=tests/physics/published.md build/asan/tests/physics/published_cases_test`. Times and
places have the units of the source. A difference of 0 is below 1e-14, or 1e-14 of a value above 1. Other differences
are those of the digits that the source gives, of its steps in time, of its statistics, or of 314,159 rounded collisions
(the discs of pool); the tests say which.
)";
  }

  void add(const std::string& what, double said, double ours) {
    if (!file_.is_open() || sources().empty()) return;
    if (sources().front() != program_) {
      program_ = sources().front();
      file_ << "\n## " << program_ << "\n\n| Case | Value | Theirs | Ours | Difference |\n"
            << "|---|---|---:|---:|---:|\n";
    }
    file_ << fmt::format("| {} | {} | {} | {} | {} |\n",
                         fmt::join(std::span(sources()).subspan(1), ", "), what, text_of(said),
                         text_of(ours), difference_of(said, ours));
  }

 private:
  std::ofstream file_;
  std::string program_;
};

/// The bodies just after the first collision and all others at that instant.
std::vector<Motion> after_first(const Log& log) {
  std::vector<Motion> motions = log.state_at(0).bodies;
  const double first = log.collision(1).time.hi;
  for (Integer k = 1; log.has(k) && log.collision(k).time.hi == first; ++k) {
    const Collision found = log.collision(k);
    motions[found.first] = found.first_after;
    if (found.second < motions.size()) motions[found.second] = found.second_after;
  }
  return motions;
}

}  // namespace

Source::Source(std::string name) : trace_(__FILE__, __LINE__, name) {
  sources().push_back(std::move(name));
}

Source::~Source() { sources().pop_back(); }

void expect_said(const std::string& what, double said, double ours, double tolerance) {
  if (std::isnan(said)) return;
  static Table table;
  table.add(what, said, ours);
  if (said == ours) return;  // two infinities have no difference
  EXPECT_NEAR(ours, said, tolerance) << what;
}

void expect_motion(const std::string& body, const Motion& said, const Motion& ours,
                   double tolerance) {
  const Source source(body);
  expect_said("x", said.position[0], ours.position[0], tolerance);
  expect_said("y", said.position[1], ours.position[1], tolerance);
  expect_said("velocity along x", said.velocity[0], ours.velocity[0], tolerance);
  expect_said("velocity along y", said.velocity[1], ours.velocity[1], tolerance);
}

double energy_of(const System& system, const std::vector<Motion>& motions) {
  double sum = 0;
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const auto& v = motions[i].velocity;
    const auto& mass = system.bodies[i].mass;
    if (mass) sum += to_double(*mass) / 2 * (v[0] * v[0] + v[1] * v[1]);
  }
  return sum;
}

void expect_hit(const Hit& hit) {
  const Source source(hit.source);
  const auto log = make_log(hit.system);
  const double time = log->has(1) ? log->collision(1).time.hi : kNever;
  expect_said("time", hit.time, time, hit.tolerance);
  if (time == kNever) {
    EXPECT_TRUE(hit.after.empty()) << "nothing is hit";
    return;
  }
  const std::vector<Motion> after = after_first(*log);
  for (std::size_t i = 0; i < hit.after.size(); ++i) {
    expect_motion(fmt::format("body {}", i + 1), hit.after[i], after[i], hit.tolerance);
  }
  std::vector<Motion> start;
  for (const Body& body : hit.system.bodies) {
    start.push_back({{}, {to_double(body.velocity[0]), to_double(body.velocity[1])}});
  }
  expect_said("energy lost", hit.energy_lost,
              energy_of(hit.system, start) - energy_of(hit.system, after), hit.tolerance);
}

void expect_hits(const std::vector<Hit>& hits) {
  for (const Hit& hit : hits) expect_hit(hit);
}

void expect_times(const std::string& source, const Log& log, const std::vector<double>& times,
                  double tolerance) {
  const Source scope(source);
  for (std::size_t k = 0; k < times.size(); ++k) {
    expect_said(fmt::format("time {}", k + 1), times[k], log.collision(Integer(k + 1)).time.hi,
                tolerance);
  }
}
}  // namespace piblocks
