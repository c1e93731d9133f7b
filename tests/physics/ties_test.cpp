// The order of collisions at one instant: the same for every way to write the same bodies.
#include <gtest/gtest.h>
#include <piblocks/log.hpp>
#include <piblocks/system.hpp>

#include <algorithm>
#include <string>
#include <tuple>

#include "support/property.hpp"

namespace piblocks {
namespace {

/// One collision without the names of what is immovable.
struct Meeting {
  double time = 0;
  std::size_t first = 0;                ///< among movable bodies
  std::size_t second = 0;               ///< likewise; kImmovable for all others
  std::array<double, 2> velocity = {};  ///< of the first, just after
  bool operator==(const Meeting&) const = default;
};
constexpr std::size_t kImmovable = 1'000;

std::vector<Meeting> meetings_of(const System& system, const Rational& until, int sign = 1) {
  std::vector<std::size_t> numbers;
  std::size_t movable = 0;
  for (const Body& body : system.bodies) numbers.push_back(body.mass ? movable++ : kImmovable);
  const auto log = make_log(system, until);
  std::vector<Meeting> meetings;
  for (Integer index = 1; index <= log->count_at(until); ++index) {
    const Collision found = log->collision(index);
    const std::size_t first = numbers[found.first];
    const std::size_t second = found.second < numbers.size() ? numbers[found.second] : kImmovable;
    const Motion& seen = first == kImmovable ? found.second_after : found.first_after;
    meetings.push_back({found.time.hi,
                        std::min(first, second),
                        std::max(first, second),
                        {sign * seen.velocity[0], seen.velocity[1]}});
  }
  return meetings;
}

/// Blocks of equal spacing and few speeds: many collisions happen at one instant.
System tied_line(Random& random) {
  System system;
  const auto count = random.integer(2, 4);
  for (std::int64_t i = 0; i < count; ++i) {
    system.bodies.push_back({.mass = random.integer(1, 3),
                             .position = {Rational(2 * i + random.integer(0, 1))},
                             .velocity = {Rational(random.integer(-1, 1))}});
  }
  for (std::size_t i = system.bodies.size(); i > 1; --i) {
    std::swap(system.bodies[i - 1],
              system.bodies[std::size_t(random.integer(0, std::int64_t(i) - 1))]);
  }
  return system;
}

Body immovable_block(const Rational& face, int side) {
  return {std::nullopt, {face - Rational(3, 2) * side}, {}, 3};
}

System mirrored(System system) {
  for (Body& body : system.bodies) {
    body.position[0] = -body.position[0];
    body.velocity[0] = -body.velocity[0];
  }
  for (Wall& wall : system.walls) {
    wall.point[0] = -wall.point[0];
    wall.normal[0] = -wall.normal[0];
  }
  return system;
}

TEST(TiesTest, DoNotDependOnHowImmovableThingsAreWritten) {
  const Rational until = 12;
  std::int64_t ties = 0;
  for (std::uint64_t i = 0; i < std::uint64_t(many(400)); ++i) {
    Random random(100 + i);
    SCOPED_TRACE(random.trace() + ", scene " + std::to_string(i));
    const System movable = tied_line(random);
    System walled = movable;
    walled.walls = {{"left", {-1}, {1}}};
    const bool is_box = random.integer(0, 1) == 1;
    const Rational right = Rational(2 * movable.bodies.size() + 1);
    if (is_box) walled.walls.push_back({"right", {right}, {-1}});
    const std::vector<Meeting> expected = meetings_of(walled, until);
    for (std::size_t k = 1; k < expected.size(); ++k) {
      ties += expected[k].time == expected[k - 1].time ? 1 : 0;
    }

    for (const std::size_t place : {std::size_t(0), std::size_t(1), movable.bodies.size()}) {
      System blocked = movable;
      const auto at = blocked.bodies.begin() + std::ptrdiff_t(place);
      blocked.bodies.insert(at, immovable_block(-1, 1));
      if (is_box) blocked.bodies.insert(blocked.bodies.begin(), immovable_block(right, -1));
      EXPECT_EQ(meetings_of(blocked, until), expected) << "with a fixed body at " << place;
    }
    System swapped = walled;
    std::ranges::reverse(swapped.walls);
    EXPECT_EQ(meetings_of(swapped, until), expected) << "walls in another order";
    EXPECT_EQ(meetings_of(mirrored(walled), until, -1), expected) << "mirrored";
    // Two blocks beside a wall are in closed form; with a third one they are stepped.
    if (is_box) continue;
    System larger = walled;
    larger.bodies.push_back({.position = {1000}});
    const auto is_same_pair = [](const Meeting& a, const Meeting& b) {
      return std::tie(a.first, a.second) == std::tie(b.first, b.second);
    };
    EXPECT_TRUE(std::ranges::equal(meetings_of(larger, until), expected, is_same_pair))
        << "far block";
  }
  EXPECT_GT(ties, many(100));
}

/// Discs on a grid, whose numbers have an exact mirror image.
TEST(TiesTest, OfDiscsAreThoseOfTheMirroredScene) {
  const Rational until = 6;
  std::int64_t ties = 0;
  for (std::uint64_t i = 0; i < std::uint64_t(many(100)); ++i) {
    Random random(9'000 + i);
    SCOPED_TRACE(random.trace() + ", scene " + std::to_string(i));
    System system;
    system.dimensions = 2;
    for (int place = 0; place < 6; ++place) {
      system.bodies.push_back(
          {.mass = random.integer(1, 2),
           .position = {Rational(4 * (place % 3)), Rational(4 * (place / 3))},
           .velocity = {Rational(random.integer(-1, 1)), Rational(random.integer(-1, 1))}});
    }
    System walled = system;
    walled.walls = {{"left", {-2}, {1}}, {"right", {10}, {-1}}};
    const std::vector<Meeting> expected = meetings_of(walled, until);
    for (std::size_t k = 1; k < expected.size(); ++k) {
      ties += expected[k].time == expected[k - 1].time ? 1 : 0;
    }
    EXPECT_EQ(meetings_of(mirrored(walled), until, -1), expected);
    for (const std::size_t place : {std::size_t(0), std::size_t(3), std::size_t(6)}) {
      // Two immovable discs, written before, between and after the others.
      System pinned = system;
      for (const int x : {-4, 12}) {
        const auto at = pinned.bodies.begin() + std::ptrdiff_t(place);
        pinned.bodies.insert(at, {std::nullopt, {Rational(x), 4}, {}, 1});
      }
      System last = system;
      for (const int x : {12, -4}) last.bodies.push_back({std::nullopt, {Rational(x), 4}, {}, 1});
      EXPECT_EQ(meetings_of(pinned, until), meetings_of(last, until)) << "at " << place;
    }
  }
  EXPECT_GT(ties, many(100));
}

/// Three blocks and a wall, all of which meet at time 1.
TEST(TiesTest, PairsOfMovableBodiesComeBeforeTheWall) {
  System system;
  for (const int x : {1, 3, 5}) {
    system.bodies.push_back(
        {.position = {Rational(x)}, .velocity = {Rational(-(x - 1), 2) - Rational(1, 2)}});
  }
  system.walls = {{"wall", {0}, {1}}};
  const auto log = make_log(system, 100);
  const auto pair = [&](int index) {
    const Collision found = log->collision(index);
    return std::pair(int(found.first), int(found.second));
  };
  EXPECT_EQ(log->collision(3).time.hi, 1);
  EXPECT_EQ(pair(1), std::pair(0, 1));
  EXPECT_EQ(pair(2), std::pair(1, 2));
}

}  // namespace
}  // namespace piblocks
