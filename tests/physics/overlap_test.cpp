// Which discs overlap at time 0: what problems_of() says of a system against all pairs.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <piblocks/log.hpp>
#include <piblocks/two_blocks.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace piblocks {
namespace {

/// Less a few roundings of the coordinates.
Rational solid_radius(const Body& body) {
  const Rational scale = abs(body.position[0]) + abs(body.position[1]) + body.size;
  return std::max(Rational(body.size - scale / power(2, 50)), Rational(body.size / 2));
}

bool overlap(const Body& a, const Body& b) {
  const Rational x = a.position[0] - b.position[0];
  const Rational y = a.position[1] - b.position[1];
  const Rational reach = solid_radius(a) + solid_radius(b);
  return x * x + y * y < reach * reach;
}

std::set<std::pair<std::size_t, std::size_t>> overlapping_pairs(const std::vector<Body>& bodies) {
  std::set<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (overlap(bodies[i], bodies[k])) pairs.emplace(i, k);
    }
  }
  return pairs;
}

/// Of each overlap that is named, both discs.
std::set<std::pair<std::size_t, std::size_t>> named_pairs(const System& system) {
  std::set<std::pair<std::size_t, std::size_t>> pairs;
  for (const auto& [key, reason, item, origin, means_nothing] : problems_of(system)) {
    const std::string before = "overlaps body ";
    const std::size_t at = reason.find(before);
    EXPECT_NE(at, std::string::npos) << key << ' ' << reason;
    if (at == std::string::npos) continue;
    pairs.emplace(std::stoul(key.substr(5)) - 1, std::stoul(reason.substr(at + before.size())) - 1);
  }
  return pairs;
}

/// Every named pair overlaps. Without the first disc of each, no discs overlap.
void expect_right(const System& system) {
  const auto all = overlapping_pairs(system.bodies);
  const auto named = named_pairs(system);
  std::set<std::size_t> lost;
  for (const auto& pair : named) {
    EXPECT_TRUE(all.contains(pair)) << pair.first + 1 << " and " << pair.second + 1;
    EXPECT_TRUE(lost.insert(pair.first).second) << "names body " << pair.first + 1 << " twice";
  }
  for (const auto& [one, other] : all) {
    EXPECT_TRUE(lost.contains(one) || lost.contains(other))
        << "misses " << one + 1 << " and " << other + 1;
  }
}

/// Discs with whole coordinates touch often: along the axes, and at sides of 3, 4 and 5.
TEST(OverlapTest, FindsAllAmongDiscsThatTouch) {
  std::mt19937 random(7);
  const auto whole = [&](int low, int high) {
    return std::uniform_int_distribution(low, high)(random);
  };
  int free = 0;
  for (int run = 0; run < 300; ++run) {
    System system{2, {}, {}};
    const int side = whole(3, 40);
    const int largest = whole(1, 6);
    const int most = whole(2, 25);
    for (int i = 0; i < most; ++i) {
      system.bodies.push_back({1, {whole(0, side), whole(0, side)}, {}, whole(1, largest)});
    }
    expect_right(system);
    free += overlapping_pairs(system.bodies).empty() ? 1 : 0;
    if (HasFailure()) FAIL() << "run " << run;
  }
  EXPECT_GT(free, 9);
}

/// Radii from 10^-9 to 10^9; many small discs beside and inside of large ones.
TEST(OverlapTest, FindsAllAmongDiscsOfAllSizes) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> share(-1, 1);
  for (int run = 0; run < 100; ++run) {
    System system{2, {}, {}};
    for (int i = 0; i < 30; ++i) {
      const int exponent = std::uniform_int_distribution(-9, 9)(random);
      const Rational size = exponent < 0
                                ? 1 / power(10, static_cast<unsigned long>(-exponent))
                                : Rational(power(10, static_cast<unsigned long>(exponent)));
      const Rational reach = size * std::uniform_int_distribution(1, 30)(random);
      Body body{1, {reach * Rational(share(random)), reach * Rational(share(random))}, {}, size};
      // Often it touches one that is there, or misses that by a hair.
      if (!system.bodies.empty() && i % 3 == 0) {
        const Body& other = system.bodies[random() % system.bodies.size()];
        const Rational apart =
            other.size + size + Rational(std::lround(share(random))) / power(2, 90);
        body.position = {other.position[0] + apart * 3 / 5, other.position[1] - apart * 4 / 5};
      }
      system.bodies.push_back(std::move(body));
    }
    expect_right(system);
    if (HasFailure()) FAIL() << "run " << run;
  }
}

/// Unit discs that touch at an angle of so many degrees, with their numbers rounded.
System touching_at(int degrees, bool to_decimals, double apart = 2) {
  const double angle = degrees * std::numbers::pi / 180;
  System system{2, {}, {}};
  system.bodies.push_back({1, {0, 0}, {1, 0}});
  Body other;
  const std::array<double, 2> place = {apart * std::cos(angle), apart * std::sin(angle)};
  for (const std::size_t axis : {0u, 1u}) {
    other.position[axis] =
        to_decimals ? parse_rational(fmt::format("{}", place[axis])) : Rational(place[axis]);
  }
  system.bodies.push_back(other);
  return system;
}

TEST(OverlapTest, TouchingIsSaidInDoublesAndInDecimals) {
  for (int degrees = 1; degrees < 90; ++degrees) {
    for (const bool to_decimals : {false, true}) {
      const System system = touching_at(degrees, to_decimals);
      ASSERT_TRUE(problems_of(system).empty()) << degrees;
      const auto log = make_log(system, 1);
      ASSERT_EQ(log->count_at(1), 1) << degrees;
      EXPECT_LT(log->collision(1).time.hi, 1e-13) << degrees;
      const std::vector<Problem> problems =
          problems_of(touching_at(degrees, to_decimals, 2 - 1e-9));
      ASSERT_EQ(problems.size(), 1u) << degrees;
      EXPECT_NE(problems[0].reason.find("overlaps body 1 by 1e-09"), std::string::npos)
          << problems[0].reason;
    }
  }
}

TEST(OverlapTest, WallsAreTouchedWithinRounding) {
  System system{2, {{1, {0, 0}}}, {{"slope", {0, 0}, {1, 1}}}};
  const auto problem = [&](double x) {
    system.bodies[0].position = {Rational(x), Rational(x)};
    const std::vector<Problem> problems = problems_of(system);
    return problems.empty() ? std::string() : problems[0].reason;
  };
  EXPECT_EQ(problem(std::sqrt(0.5)), "");
  EXPECT_EQ(problem(std::nextafter(std::sqrt(0.5), 0)), "");
  EXPECT_TRUE(
      problem(std::sqrt(0.5) * (1 - 1e-9)).ends_with("reaches 1e-09 beyond the slope wall"));
  EXPECT_TRUE(problem(0.0).ends_with("reaches 1 beyond the slope wall"));
  EXPECT_TRUE(problem(-std::sqrt(2.0)).ends_with("reaches 3 beyond the slope wall"));
}

TEST(OverlapTest, BlocksTouchWithinRoundingUnlessInClosedForm) {
  System system{1,
                {{1, {Rational(0.1)}, {}, Rational(0.1)}, {1, {Rational(0.3)}, {}, Rational(0.3)}}};
  system.bodies[1].position[0] = Rational(0.1) + Rational(0.05) + Rational(0.15) - 1 / power(2, 60);
  EXPECT_TRUE(problems_of(system).empty());
  system.walls = {{"wall", {0}, {1}}};
  ASSERT_TRUE(two_blocks_of(system));
  EXPECT_EQ(problems_of(system).size(), 1u);
  system.walls.clear();
  system.bodies[1].position[0] -= 1 / power(10, 9);
  EXPECT_EQ(problems_of(system).size(), 1u);
}

/// All pairs of a column share a range of x; to compare them would take minutes.
TEST(OverlapTest, IsQuickWhereverDiscsAre) {
  constexpr int kDiscs = 10'000;
  const auto expect_one = [](const auto& place_of, const char* what) {
    System system{2, {}, {}};
    for (int i = 0; i < kDiscs; ++i) system.bodies.push_back({1, place_of(i), {}, 1});
    EXPECT_TRUE(problems_of(system).empty()) << what;
    system.bodies.push_back({1, place_of(777), {}, 1});
    EXPECT_EQ(problems_of(system).size(), 1U) << what;
  };
  expect_one([](int i) { return ExactVector{0, 2 * i}; }, "column");
  expect_one([](int i) { return ExactVector{2 * i, 0}; }, "row");
  expect_one([](int i) { return ExactVector{2 * i, 2 * i}; }, "diagonal");
  expect_one([](int i) { return ExactVector{2 * (i % 100), 2 * (i / 100)}; }, "lattice");
}

}  // namespace
}  // namespace piblocks
